// Copies of the last states of a run that were good, to be looked at once it has broken down.
#pragma once

#include <optional>
#include <vector>

#include "solver/particles/particles.hpp"
#include "solver/particles/state.hpp"

namespace porosph {

/// The last two are kept, as the last may have been good only in appearance.
class GoodStates {
 public:
  struct State {
    Particles particles;
    std::vector<Vec2> accelerations;
    std::int64_t step = 0;
  };

  void remember(State state);
  /// Puts the older of those remembered in the place of the present state, and the present one in its place.
  /// Returns false where none is remembered.
  bool exchange(Particles& particles, std::vector<Vec2>& accelerations, std::int64_t& step);
  /// Saves or restores them; `present` has the sizes of its arrays.
  void visit(StateArchive& archive, const Particles& present);

 private:
  std::optional<State> last_, before_;
};

}  // namespace porosph
