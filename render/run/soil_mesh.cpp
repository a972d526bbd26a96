#include "render/run/soil_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/run/delaunay.hpp"
#include "solver/case/shapes.hpp"
#include "solver/geometry/region.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph::render {
namespace {

/// The soil that a particle started in: the first that holds it, else the nearest.
std::vector<std::vector<std::size_t>> particles_of_soils(const Case& scene,
                                                         const std::vector<Point>& starts) {
  std::vector<Region> regions;
  for (const SoilCase& soil : scene.soils) regions.emplace_back(soil.polygon, soil.holes);
  std::vector<std::vector<std::size_t>> particles(regions.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    auto own = std::ranges::find_if(regions, [&](const Region& r) { return r.contains(starts[i]); });
    if (own == regions.end())
      own = std::ranges::min_element(regions, {},
                                     [&](const Region& r) { return r.distance_to_outline(starts[i]); });
    particles[static_cast<std::size_t>(own - regions.begin())].push_back(i);
  }
  return particles;
}

/// Points on a ring, half a spacing apart or less, its corners among them.
void append_ring(std::vector<Point>& out, const Polygon& ring, double spacing) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point along = ring[(i + 1) % ring.size()] - ring[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil(2 * along.norm() / spacing)));
    for (int k = 0; k < pieces; ++k) out.push_back(ring[i] + static_cast<double>(k) / pieces * along);
  }
}

/// Without those that a particle stands on already.
std::vector<Point> border_points(const SoilCase& soil, const std::vector<Point>& particles, double spacing) {
  std::vector<Point> all;
  append_ring(all, soil.polygon, spacing);
  for (const Polygon& hole : soil.holes) append_ring(all, hole, spacing);
  const NeighbourList near = find_neighbours(all, particles, 0.05 * spacing);
  std::vector<Point> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (near.of(i).empty()) kept.push_back(all[i]);
  return kept;
}

std::vector<Point> chosen(const std::vector<Point>& points, const std::vector<std::size_t>& which) {
  std::vector<Point> out;
  out.reserve(which.size());
  for (const std::size_t i : which) out.push_back(points[i]);
  return out;
}

}  // namespace

SoilMesh::SoilMesh(const Case* scene, const std::vector<Point>& starts, const std::vector<Point>& positions,
                   double spacing)
    : particle_count_(starts.size()) {
  if (scene == nullptr) {
    std::vector<std::size_t> all(starts.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    add_soil(nullptr, all, starts, spacing, spacing);
  } else {
    const auto particles = particles_of_soils(*scene, starts);
    for (std::size_t k = 0; k < particles.size(); ++k)
      if (!particles[k].empty())
        add_soil(&scene->soils[k], particles[k], starts, spacing, scene->smoothing_length());
  }
  remove_torn(starts, positions, spacing);
}

void SoilMesh::add_soil(const SoilCase* soil, const std::vector<std::size_t>& particles,
                        const std::vector<Point>& starts, double spacing, double smoothing_length) {
  std::vector<Point> points = chosen(starts, particles);
  const std::vector<Point> border =
      soil == nullptr ? std::vector<Point>{} : border_points(*soil, points, spacing);
  std::size_t first = particle_count_;  // of this soil's corners on its outline
  for (const Border& b : borders_) first += b.starts.size();
  borders_.push_back({particles, border, Sampler(border, points, smoothing_length)});
  const std::size_t own = points.size();
  points.insert(points.end(), border.begin(), border.end());
  const auto number = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    return static_cast<int>(k < own ? particles[k] : first + k - own);
  };
  const std::optional<Region> region =
      soil == nullptr ? std::nullopt : std::optional<Region>(std::in_place, soil->polygon, soil->holes);
  for (const auto& t : delaunay(points)) {
    const Point &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
                &c = points[static_cast<std::size_t>(t[2])];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    constexpr double farthest = 2.2;  // neighbours in a soil without outline [spacings]
    const bool few_particles =
        std::ranges::count_if(t, [&](int i) { return static_cast<std::size_t>(i) < own; }) <= 1;
    if (!region && longest > farthest * spacing) continue;
    if (region && (few_particles || longest > farthest * spacing) && !region->contains((a + b + c) / 3))
      continue;
    triangles_.push_back({number(t[0]), number(t[1]), number(t[2])});
  }
}

/// Where particles that were neighbours are far from each other, or have changed sides.
void SoilMesh::remove_torn(const std::vector<Point>& starts, const std::vector<Point>& positions,
                           double spacing) {
  const std::vector<Point> before = at_corners(starts, starts), after = at_corners(positions, starts);
  constexpr double most = 3;  // times as long as before
  const auto is_torn = [&](const std::array<int, 3>& t) {
    double area = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t[i]), b = static_cast<std::size_t>(t[(i + 1) % 3]);
      const Point p = after[a] - after[static_cast<std::size_t>(t[0])],
                  q = after[b] - after[static_cast<std::size_t>(t[0])];
      area += p.x() * q.y() - q.x() * p.y();
      if (!((q - p).norm() <= most * std::max(0.5 * spacing, (before[b] - before[a]).norm()))) return true;
    }
    return !(area >= 0);
  };
  std::vector<bool> covered(particle_count_, false), beside_torn(particle_count_, false);
  std::vector<std::array<int, 3>> whole;
  whole.reserve(triangles_.size());
  for (const auto& t : triangles_) {
    const bool torn = is_torn(t);
    for (const int i : t)
      if (static_cast<std::size_t>(i) < particle_count_)
        (torn ? beside_torn : covered)[static_cast<std::size_t>(i)] = true;
    if (!torn) whole.push_back(t);
  }
  triangles_ = std::move(whole);
  uncovered_.resize(particle_count_);
  for (std::size_t i = 0; i < particle_count_; ++i) uncovered_[i] = !covered[i] || beside_torn[i];
}

std::vector<double> SoilMesh::at_corners(const std::vector<double>& values) const {
  std::vector<double> all = values;
  for (const Border& border : borders_) {
    std::vector<double> own;
    own.reserve(border.particles.size());
    for (const std::size_t i : border.particles) own.push_back(values[i]);
    const std::vector<double> there = border.sample(own);
    all.insert(all.end(), there.begin(), there.end());
  }
  return all;
}

/// Where soil comes to that was at the corners at the start: displacements are interpolated.
std::vector<Point> SoilMesh::at_corners(const std::vector<Point>& places,
                                        const std::vector<Point>& starts) const {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < places.size(); ++i)
    x.push_back(places[i].x() - starts[i].x()), y.push_back(places[i].y() - starts[i].y());
  x = at_corners(x);
  y = at_corners(y);
  std::vector<Point> all = places;
  std::size_t next = places.size();
  for (const Border& border : borders_)
    for (const Point& start : border.starts) {
      all.push_back(start + Point(x[next], y[next]));
      ++next;
    }
  return all;
}

}  // namespace porosph::render
