#include "solver/sph/paper/pair_lists.hpp"

#include <algorithm>

namespace porosph {
namespace {

constexpr std::int64_t filled_up(std::int64_t count) {
  return (count + PairLists::widest - 1) / PairLists::widest * PairLists::widest;
}

/// The list of b is that of a, shifted.
bool repeats(const NeighbourList& list, std::int32_t a, std::int32_t b) {
  return std::ranges::equal(list.of(a), list.of(b),
                            [&](std::int32_t c, std::int32_t d) { return d - b == c - a; });
}

class Builder {
 public:
  explicit Builder(const NeighbourList& list)
      : list_(list), count_(static_cast<std::int32_t>(list.begin.size()) - 1) {}

  PairLists build() {
    find_runs();
    fill_own();
    place_weights();
    return std::move(result_);
  }

 private:
  void find_runs() {
    std::int32_t own = 0;  // where particles with lists of their own begin
    for (std::int32_t first = 0, last = 0; first < count_; first = last) {
      last = first + 1;
      while (last < count_ && repeats(list_, last - 1, last)) ++last;
      if (last - first < PairLists::widest) continue;
      cut(own, first, false);
      cut(first, last, true);
      own = last;
    }
    cut(own, count_, false);
  }

  /// Into equal parts, none of them longer than the longest.
  void cut(std::int32_t first, std::int32_t last, bool shared) {
    const std::int32_t size = last - first, parts = (size + PairLists::longest - 1) / PairLists::longest;
    if (size == 0) return;
    const auto pairs = static_cast<std::int32_t>(result_.offset.size());
    if (shared)
      for (const std::int32_t b : list_.of(first)) result_.offset.push_back(b - first);
    const auto pairs_end = static_cast<std::int32_t>(result_.offset.size());
    for (std::int32_t i = 0; i < parts; ++i)
      result_.stretches.push_back(
          {first + size * i / parts, first + size * (i + 1) / parts, shared, pairs, pairs_end, 0});
  }

  void fill_own() {
    result_.begin.assign(static_cast<std::size_t>(count_) + 1, 0);
    for (const PairLists::Stretch& stretch : result_.stretches)
      for (std::int32_t a = stretch.first; a < stretch.last; ++a) {
        const auto neighbours = list_.of(a);
        if (!stretch.shared) result_.index.insert(result_.index.end(), neighbours.begin(), neighbours.end());
        result_.index.resize(static_cast<std::size_t>(filled_up(std::ssize(result_.index))), a);
        result_.begin[a + 1] = std::ssize(result_.index);
      }
  }

  void place_weights() {
    result_.weights = std::ssize(result_.index);
    for (PairLists::Stretch& stretch : result_.stretches) {
      stretch.weights = result_.weights;
      result_.weights += filled_up(stretch.last - stretch.first) * (stretch.pairs_end - stretch.pairs);
    }
  }

  const NeighbourList& list_;
  std::int32_t count_;
  PairLists result_;
};

}  // namespace

PairLists make_pair_lists(const NeighbourList& list) { return Builder(list).build(); }

}  // namespace porosph
