// Who is near whom: one packed list per particle.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/space/parallel.hpp"
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

/// The lists of particles 0 to count - 1, to which append(a, list) adds that of particle a. Each thread makes
/// those of consecutive particles, which are put together in their order.
template <class Append>
NeighbourList collected(std::size_t count, Append&& append) {
  NeighbourList list;
  list.begin.assign(count + 1, 0);
  std::vector<std::vector<std::int32_t>> of_thread(static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel
  {
    std::vector<std::int32_t>& mine = of_thread[static_cast<std::size_t>(omp_get_thread_num())];
    const auto [first, last] = thread_range(count);
    for (std::size_t a = first; a < last; ++a) {
      // Room for as many as the first ones have: a vector that doubles holds three times the list for a
      // moment.
      if (a == first + 1024) mine.reserve(21 * mine.size() / (20 * 1024) * (last - first));
      const auto before = std::ssize(mine);
      append(a, mine);
      list.begin[a + 1] = std::ssize(mine) - before;
    }
  }
  for (std::size_t a = 0; a < count; ++a) list.begin[a + 1] += list.begin[a];
  list.index = std::move(of_thread[0]);
  for (std::size_t k = 1; k < of_thread.size(); ++k) {
    list.index.insert(list.index.end(), of_thread[k].begin(), of_thread[k].end());
    of_thread[k] = {};
  }
  return list;
}

/// Only those for which keep(a, b) holds.
template <class Keep>
NeighbourList kept(const NeighbourList& list, Keep&& keep) {
  return collected(list.begin.size() - 1, [&](std::size_t a, std::vector<std::int32_t>& out) {
    for (const std::int32_t b : list.of(a))
      if (keep(static_cast<std::int32_t>(a), b)) out.push_back(b);
  });
}

/// The neighbours within `radius` [m], among all points, of the first `count` points.
NeighbourList find_neighbours(std::span<const Vec2> points, std::size_t count, double radius);
NeighbourList find_neighbours(std::span<const Vec3> points, std::size_t count, double radius);

/// The neighbours of each centre among `points`, within `radius` [m].
NeighbourList find_neighbours(std::span<const Vec2> centres, std::span<const Vec2> points, double radius);

}  // namespace porosph
