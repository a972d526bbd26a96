// Cell-linked search for neighbours.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace porosph {

/// Points sorted into square cells of at least the given size, so that all within that distance lie in
/// adjacent cells.
template <int dim>
class CellGrid {
 public:
  using Vec = Eigen::Matrix<double, dim, 1>;

  CellGrid(std::span<const Vec> points, double cell_size) : points_(points) {
    if (points.empty()) return;
    Vec low = points[0], high = points[0];
    for (const Vec& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    origin_ = low;
    // Far-flung points must not make an enormous grid: then the cells grow instead.
    const double cells_wanted = 4.0 * static_cast<double>(points.size()) + 64;
    size_ = cell_size;
    while (cell_total(low, high) > cells_wanted) size_ *= 2;
    std::int64_t total = 1;
    for (int d = 0; d < dim; ++d) {
      count_[d] = static_cast<std::int64_t>((high[d] - low[d]) / size_) + 1;
      total *= count_[d];
    }
    sort_points(total);
  }

  /// Calls visit(numbers, places) for the points of each row of cells around `centre`: all within the cell
  /// size, and some beyond it.
  template <class Visit>
  void around(const Vec& centre, Visit&& visit) const {
    std::array<std::int64_t, dim> low, high;
    for (int d = 0; d < dim; ++d) {
      const auto c = static_cast<std::int64_t>(std::floor((centre[d] - origin_[d]) / size_));
      low[d] = std::clamp<std::int64_t>(c - 1, 0, count_[d]);
      high[d] = std::clamp<std::int64_t>(c + 1, -1, count_[d] - 1);
    }
    visit_block(low, high, visit);
  }

 private:
  double cell_total(const Vec& low, const Vec& high) const {
    double total = 1;
    for (int d = 0; d < dim; ++d) total *= std::floor((high[d] - low[d]) / size_) + 1;
    return total;
  }

  std::int64_t cell_of(const Vec& p) const {
    std::int64_t cell = 0;
    for (int d = dim - 1; d >= 0; --d)
      cell = cell * count_[d] + static_cast<std::int64_t>((p[d] - origin_[d]) / size_);
    return cell;
  }

  void sort_points(std::int64_t total) {
    begin_.assign(static_cast<std::size_t>(total) + 1, 0);
    std::vector<std::int64_t> cell(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) ++begin_[(cell[i] = cell_of(points_[i])) + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    sorted_.resize(points_.size());
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    place_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::int32_t k = next[cell[i]]++;
      sorted_[k] = static_cast<std::int32_t>(i), place_[k] = points_[i];
    }
  }

  template <class Visit>
  void visit_block(const std::array<std::int64_t, dim>& low, const std::array<std::int64_t, dim>& high,
                   Visit& visit) const {
    const std::int64_t z_low = dim == 3 ? low[dim - 1] : 0, z_high = dim == 3 ? high[dim - 1] : 0;
    for (std::int64_t z = z_low; z <= z_high; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        if (low[0] > high[0]) continue;
        const std::int64_t row = (z * count_[1] + y) * count_[0];
        const std::int32_t first = begin_[row + low[0]], last = begin_[row + high[0] + 1];
        visit(std::span(sorted_).subspan(first, last - first), place_.data() + first);
      }
    }
  }

  std::span<const Vec> points_;
  Vec origin_ = Vec::Zero();
  double size_ = 1;
  std::array<std::int64_t, dim> count_{};
  std::vector<std::int32_t> begin_, sorted_;
  std::vector<Vec> place_;  ///< of those in sorted_
};

}  // namespace porosph
