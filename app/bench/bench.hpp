// What all measurements share: how long they may take, where cases are, and what had to be left out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/bench/clock.hpp"
#include "solver/run/simulation.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph::bench {

struct BenchOptions {
  bool quick = false;
  int threads = 2;                        ///< the most to use
  double seconds = 600;                   ///< that all of it may take
  std::int64_t particles = 10'000'000;    ///< the most to use
  std::filesystem::path cases = "cases";  ///< folder of the case files
  std::filesystem::path out;              ///< folder for what is written
};

/// One after the other the measurements get what they need and note what they leave out.
class Bench {
 public:
  explicit Bench(BenchOptions options);

  const BenchOptions& options() const { return options_; }
  double seconds_left() const;
  /// Notes on standard error what is going on.
  void tell(const std::string& what) const;
  /// Something is not measured: what, and why.
  void leave_out(const std::string& what, const std::string& why);
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// True if `seconds` more are allowed, of what `share` of all the time leaves; else notes that `what` is
  /// left out.
  bool affords(const std::string& what, double seconds, double until);

 private:
  BenchOptions options_;
  Seconds start_ = now();
  std::vector<std::string> left_out_;
};

/// A case of `bench.options().cases`. Throws CaseError.
Case read(const Bench& bench, const std::string& file, const std::vector<std::string>& overrides);

/// For simulations by plain loops instead of the solver's.
std::unique_ptr<Dynamics> make_plain_dynamics(const FormulationCase& formulation, Model& model);

}  // namespace porosph::bench
