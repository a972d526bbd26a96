// What each particle sees: other particles, and ghosts behind walls.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"
#include "solver/sph/consistent/pair_stencils.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

/// Particles, then ghosts, where they are, and those that each particle's kernel reaches and that it sees.
struct SeenNeighbours {
  std::vector<Vec2> points;  ///< [m]
  Ghosts ghosts;
  NeighbourList list;
};

/// Finds them again and again as the particles move. What may come near is searched for with a skin around
/// the kernel's support, and again only when some particle has moved by half of it (Verlet 1967); what is
/// found does not depend on when that was.
class Surroundings {
 public:
  Surroundings() = default;
  explicit Surroundings(const Model& model);

  SeenNeighbours find(const Model& model);

  /// True when two particles have come closer than the support, by a margin, that `stencils` do not have as
  /// neighbours.
  bool strangers_are_near(const Model& model, const PairStencils& stencils);

  std::int64_t searches() const { return searches_; }  ///< so far
  void visit(StateArchive& state, const Model& model);

 private:
  bool candidates_hold(const Model& model) const;
  void look_for_candidates(const Model& model);
  void search_where_they_were(const Model& model);
  SeenNeighbours found_anew(const Model& model);
  NeighbourList near_candidates(const SeenNeighbours& seen, std::size_t particles) const;

  double support_ = 0, reach_ = 0, skin_ = 0;  ///< [m]
  bool asked_before_ = false;
  std::vector<Vec2> searched_at_;  ///< where the particles were; empty before the first search with a skin
  NeighbourList candidates_;       ///< with the particle itself where its own ghost may come near
  std::int64_t searches_ = 0;
};

}  // namespace porosph
