// Who is near whom: one packed list per particle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/space/tensor.hpp"

namespace porosph {

/// Neighbours of particle a: index[begin[a]] .. index[begin[a + 1] - 1], never a itself, in increasing order.
struct NeighbourList {
  std::vector<std::int64_t> begin = {0};
  std::vector<std::int32_t> index;

  std::span<const std::int32_t> of(std::size_t a) const {
    return {index.data() + begin[a], index.data() + begin[a + 1]};
  }
};

/// Only those for which keep(a, b) holds.
template <class Keep>
NeighbourList kept(const NeighbourList& list, Keep&& keep) {
  NeighbourList out;
  for (std::size_t a = 0; a + 1 < list.begin.size(); ++a) {
    for (const std::int32_t b : list.of(a))
      if (keep(static_cast<std::int32_t>(a), b)) out.index.push_back(b);
    out.begin.push_back(std::ssize(out.index));
  }
  return out;
}

/// The neighbours within `radius` [m], among all points, of the first `count` points.
NeighbourList find_neighbours(std::span<const Vec2> points, std::size_t count, double radius);
NeighbourList find_neighbours(std::span<const Vec3> points, std::size_t count, double radius);

/// The neighbours of each centre among `points`, within `radius` [m].
NeighbourList find_neighbours(std::span<const Vec2> centres, std::span<const Vec2> points, double radius);

}  // namespace porosph
