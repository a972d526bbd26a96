// Neighbour lists in the order in which sums over the present configuration read them.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

/// Stretches of consecutive particles, which are summed alike. In a body that began as a lattice the list of
/// a particle is mostly that of the particle before it, shifted by one, wherever the particles have moved to
/// since. Stretches of such particles share one list, and neighbouring particles are summed at once, from
/// consecutive memory; all others have lists of their own, each of whose pairs are summed some at once.
///
/// Each pair has a place for one number, its weight. In a shared stretch that of pair k and particle i of a
/// block of `width` particles is at weights + (block * pairs + k) * width + i; the last block ends with the
/// stretch and may begin within the one before.
struct PairLists {
  static constexpr std::int32_t widest =
      8;  ///< most that vector units take at once: no shared stretch is shorter
  static constexpr std::int32_t longest = 128;

  struct Stretch {
    std::int32_t first, last;  ///< particles first to last - 1
    bool shared;
    std::int32_t pairs, pairs_end;  ///< of a shared stretch, in offset
    std::int64_t weights;           ///< of a shared stretch
  };
  std::vector<Stretch> stretches;    ///< of all particles, in order
  std::vector<std::int32_t> offset;  ///< of shared stretches: the neighbour's number minus the particle's

  std::vector<std::int64_t> begin;  ///< of each particle's own list; nothing where it shares one
  std::vector<std::int32_t> index;  ///< of own lists, each filled up to a multiple of `widest` with itself;
                                    ///< a pair's weight is at the same place
  std::int64_t weights = 0;         ///< how many there are

  std::int32_t count() const { return static_cast<std::int32_t>(stretches.size()); }
};

PairLists make_pair_lists(const NeighbourList& list);

}  // namespace porosph
