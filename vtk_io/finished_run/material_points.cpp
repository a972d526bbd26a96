#include "vtk_io/finished_run/material_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "solver/analysis/frame_values.hpp"

namespace porosph {
namespace {

/// The particles in the order of their numbers, or as they come where the frame has none.
std::vector<std::size_t> in_order(const Frame& frame) {
  std::vector<std::size_t> order(frame.points.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!has_field(frame, "ParticleId")) return order;
  const std::vector<double> ids = values_of(frame, {"ParticleId", ""});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return ids[i] < ids[j]; });
  return order;
}

template <class T>
std::vector<T> ordered(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> out;
  out.reserve(order.size());
  for (std::size_t i : order) out.push_back(values[i]);
  return out;
}

bool same(const std::vector<Point>& a, const std::vector<Point>& b) {
  constexpr double rounding = 1e-9;  // positions less displacements [m]
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [&](const Point& p, const Point& q) { return (p - q).cwiseAbs().maxCoeff() < rounding; });
}

double smoothing_length(const FinishedRun& run) {
  if (!run.scene)
    throw std::runtime_error(
        fmt::format("{}: without its case.toml the run can only be compared particle by particle", run.name));
  return run.scene->smoothing_length();
}

}  // namespace

MaterialPoints common_points(const FinishedRun& a, const Frame& frame_a, const FinishedRun& b,
                             const Frame& frame_b) {
  const auto order_a = in_order(frame_a), order_b = in_order(frame_b);
  const auto starts_a = ordered(starts_of(frame_a), order_a), starts_b = ordered(starts_of(frame_b), order_b);
  if (same(starts_a, starts_b))
    return {starts_a, ordered(volumes_of(frame_b), order_b), true, Sampler(order_a), Sampler(order_b)};
  const bool a_is_coarser = starts_a.size() < starts_b.size();
  const auto& points = a_is_coarser ? starts_a : starts_b;
  return {points,
          a_is_coarser ? ordered(volumes_of(frame_a), order_a) : ordered(volumes_of(frame_b), order_b), false,
          Sampler(points, starts_of(frame_a), smoothing_length(a)),
          Sampler(points, starts_of(frame_b), smoothing_length(b))};
}

std::string obstacle(const FinishedRun& a, const FinishedRun& b) {
  if (!a.scene || !b.scene) return "";
  const auto &soils_a = a.scene->soils, &soils_b = b.scene->soils;
  if (soils_a.size() != soils_b.size())
    return fmt::format("{} has {} soils, {} has {}", a.name, soils_a.size(), b.name, soils_b.size());
  for (std::size_t i = 0; i < soils_a.size(); ++i)
    if (soils_a[i].polygon != soils_b[i].polygon || soils_a[i].holes != soils_b[i].holes)
      return fmt::format("the outlines of soil '{}' differ: they are not the same body", soils_a[i].name);
  return "";
}

}  // namespace porosph
