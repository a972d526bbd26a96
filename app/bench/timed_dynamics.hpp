// Dynamics of any kind with a clock at each of its calls.
#pragma once

#include "app/bench/clock.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph::bench {

/// What the calls took so far.
struct CallTimes {
  Seconds prepare, accelerations, strain;

  Seconds total() const {
    Seconds sum = prepare;
    sum += accelerations;
    return sum += strain;
  }
};

/// Passes every call on. `times` must outlive it.
class TimedDynamics final : public Dynamics {
 public:
  TimedDynamics(std::unique_ptr<Dynamics> timed, CallTimes& times)
      : timed_(std::move(timed)), times_(times) {}

  void prepare() override {
    add(times_.prepare, [&] { timed_->prepare(); });
  }
  void accelerations(std::span<Vec2> out) override {
    add(times_.accelerations, [&] { timed_->accelerations(out); });
  }
  void velocity_gradients(std::span<Mat2> out) override { timed_->velocity_gradients(out); }
  void strain(double dt, std::span<const double> volume_rates) override {
    add(times_.strain, [&] { timed_->strain(dt, volume_rates); });
  }
  void visit(StateArchive& state) override {
    timed_->counts = counts;
    timed_->visit(state);
  }

 private:
  template <class Call>
  void add(Seconds& sum, Call&& call) {
    sum += bench::timed(call);
    counts = timed_->counts;
  }

  std::unique_ptr<Dynamics> timed_;
  CallTimes& times_;
};

}  // namespace porosph::bench
