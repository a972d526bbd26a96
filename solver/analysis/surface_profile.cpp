#include "solver/analysis/surface_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "solver/analysis/frame_values.hpp"

namespace porosph {
namespace {

/// The x that this part of the volume has not passed; particles are points, sorted by x.
double quantile(const std::vector<std::pair<double, double>>& sorted, double whole, double part) {
  double sum = 0;
  for (const auto& [x, volume] : sorted) {
    sum += volume;
    if (sum >= part * whole) return x;
  }
  return sorted.back().first;
}

}  // namespace

SurfaceProfile surface_profile(const Frame& frame, double width) {
  const std::vector<double> volumes = volumes_of(frame);
  if (volumes.empty()) throw std::runtime_error("profile: the frame has no particles");
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const double half = 0.5 * std::sqrt(volumes[i]), x = frame.points[3 * i];
    low = std::min(low, x - half), high = std::max(high, x + half);
  }
  constexpr double most_columns = 1e6;
  const double first = std::floor(low / width), count = std::ceil(high / width) - first;
  if (!(count >= 1 && count <= most_columns))
    throw std::runtime_error("profile: the soil spreads over too many columns");
  SurfaceProfile p;
  const auto columns = static_cast<std::size_t>(count);
  p.surface.assign(columns, std::numeric_limits<double>::quiet_NaN());
  p.thickness.assign(columns, 0);
  for (std::size_t k = 0; k < columns; ++k) p.x.push_back((first + 0.5 + static_cast<double>(k)) * width);
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const double side = std::sqrt(volumes[i]), x = frame.points[3 * i],
                 top = frame.points[3 * i + 1] + 0.5 * side;
    points.emplace_back(x, volumes[i]);
    p.area += volumes[i], p.mean_x += x * volumes[i];
    const auto column = [&](double at) {
      return static_cast<std::size_t>(std::clamp(std::floor(at / width) - first, 0.0, count - 1));
    };
    for (std::size_t k = column(x - 0.5 * side); k <= column(x + 0.5 * side); ++k) {
      const double overlap =
          std::min(x + 0.5 * side, p.x[k] + 0.5 * width) - std::max(x - 0.5 * side, p.x[k] - 0.5 * width);
      if (overlap > 0) p.thickness[k] += side * overlap / width;
      if (std::abs(p.x[k] - x) <= 0.5 * side && !(p.surface[k] >= top)) p.surface[k] = top;
    }
  }
  p.mean_x /= p.area;
  std::ranges::sort(points);
  p.quantile95 = quantile(points, p.area, 0.95), p.quantile99 = quantile(points, p.area, 0.99);
  return p;
}

}  // namespace porosph
