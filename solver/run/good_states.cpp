#include "solver/run/good_states.hpp"

#include <utility>

namespace porosph {

void GoodStates::remember(State state) {
  before_ = std::move(last_);
  last_ = std::move(state);
}

bool GoodStates::exchange(Particles& particles, std::vector<Vec2>& accelerations, std::int64_t& step) {
  std::optional<State>& good = before_ ? before_ : last_;
  if (!good) return false;
  std::swap(particles, good->particles);
  std::swap(accelerations, good->accelerations);
  std::swap(step, good->step);
  return true;
}

void GoodStates::visit(StateArchive& archive, const Particles& present) {
  for (std::optional<State>* state : {&last_, &before_}) {
    bool is_there = state->has_value();
    archive.value("remembered", is_there);
    if (!is_there) {
      state->reset();
      continue;
    }
    if (archive.restoring()) *state = State{present, std::vector<Vec2>(present.size()), 0};
    archive.value("remembered_step", (*state)->step);
    (*state)->particles.for_each_changing(
        [&](std::string_view name, auto& values) { archive.array(name, values); });
    archive.array("remembered_accelerations", (*state)->accelerations);
  }
}

}  // namespace porosph
