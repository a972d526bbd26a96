// What each particle sees: other particles, and ghosts behind walls.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
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
/// found does not depend on when that was. Bodies that were apart at the start do not see each other.
class Surroundings {
 public:
  Surroundings() = default;
  explicit Surroundings(const Model& model);

  SeenNeighbours find(const Model& model);

  /// True when two particles have come closer than the support, by a margin, that `stencils` do not have as
  /// neighbours; `points`: where they were when those were made.
  bool strangers_are_near(const Model& model, const PairStencils& stencils, std::span<const Vec2> points);

  bool bodies_are_apart() const { return !body_.empty(); }  ///< there is more than one

  /// Pairs of particles of different bodies, all that may be within the support of each other now; none where
  /// there is one body (body_contact.hpp).
  const std::vector<std::pair<std::int32_t, std::int32_t>>& strangers(const Model& model);

  std::int64_t searches() const { return searches_; }  ///< so far
  void visit(StateArchive& state, const Model& model);

 private:
  bool candidates_hold(const Model& model) const;
  void look_for_candidates(const Model& model);
  void search_where_they_were(const Model& model);
  SeenNeighbours found_by_search(const Model& model);
  NeighbourList near_candidates(const SeenNeighbours& seen, const Particles& particles) const;
  bool of_one_body(std::int32_t a, std::int32_t b, const Particles& p) const {
    return body_.empty() || body_[p.soil[a]] == body_[p.soil[b]];
  }

  double support_ = 0, reach_ = 0, skin_ = 0;  ///< [m]
  bool asked_before_ = false;
  std::vector<Vec2> searched_at_;   ///< where the particles were; empty before the first search with a skin
  NeighbourList candidates_;        ///< with the particle itself where its own ghost may come near
  std::vector<std::int32_t> body_;  ///< of soils; empty where there is one body
  std::vector<std::pair<std::int32_t, std::int32_t>> strangers_;  ///< among the candidates
  std::int64_t searches_ = 0;
};

}  // namespace porosph
