#include "solver/reference/fem/compare.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "solver/reference/fem/elasticity.hpp"
#include "solver/reference/fem/rough_points.hpp"

namespace porosph {
namespace {

constexpr double tolerable = 0.05, tolerable_in_a_patch = 0.1;
/// Of the field's norm, below which a component is measured by the field; displacements of a patch, which
/// begin at walls, below half of it.
constexpr double least_share = 0.2, least_share_of_patch = 0.5;
constexpr double side_of_patch = 4;  // spacings

constexpr int stresses = 4, quantities = 6;
constexpr std::array<const char*, quantities> names{"EffectiveStress_XX", "EffectiveStress_YY",
                                                    "EffectiveStress_ZZ", "EffectiveStress_XY",
                                                    "Displacement_X",     "Displacement_Y"};
using Values = Eigen::Array<double, quantities, 1>;

/// Places that do not count.
class LeftOut {
 public:
  LeftOut(const Case& scene, double spacing) : points_(rough_points(scene, mesh_lines(scene))) {
    for (const RoughPoint& p : points_) {
      const double wanted = (p.kind == RoughPoint::singular ? 5 : 2.5) * spacing;
      radii_.push_back(std::min(wanted, std::max(1.5 * spacing, p.shortest / 2)));
    }
  }
  bool contain(const Point& x) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((x - points_[i].at).norm() < radii_[i]) return true;
    return false;
  }

 private:
  std::vector<RoughPoint> points_;
  std::vector<double> radii_;
};

/// Squares of both over some particles.
struct Squares {
  Values difference = Values::Zero(), reference = Values::Zero();
  Point moment = Point::Zero();
  double weight = 0;
  std::int64_t particles = 0;

  void add(const Values& off, const Values& fem, const Point& x, double volume) {
    difference += volume * off.square();
    reference += volume * fem.square();
    moment += volume * x;
    weight += volume;
    ++particles;
  }
};

/// Those of small squares of ground, in which a place may be wrong that the whole soil hides.
class Patches {
 public:
  explicit Patches(double side) : side_(side) {}
  void add(const Values& off, const Values& fem, const Point& x, double volume) {
    const Point cell = (x / side_).array().floor();
    patches_[{cell.x(), cell.y()}].add(off, fem, x, volume);
  }
  /// Marks the worst patch in `found`; a component smaller than `least` is measured by that.
  void find_worst(int quantity, double least, FemDifference& found) const {
    for (const auto& [cell, patch] : patches_) {
      if (patch.particles < enough_particles) continue;
      const double size = std::max(std::sqrt(patch.reference[quantity] / patch.weight), least);
      const double off = std::sqrt(patch.difference[quantity] / patch.weight) / size;
      if (off <= found.local) continue;
      const Point centre = patch.moment / patch.weight;
      found.local = off, found.local_x = centre.x(), found.local_y = centre.y();
      if (std::isnan(off)) return;
    }
  }

 private:
  static constexpr int enough_particles = 4;
  double side_;  // [m]
  std::map<std::pair<double, double>, Squares> patches_;
};

/// Sums over the particles of one soil.
struct Sums {
  /// `weight`: unit weight of the soil [N/m3].
  Sums(double weight, double spacing)
      : patches(side_of_patch * spacing), least_stress(weight * side_of_patch * spacing) {
    where.fill(Point::Zero());
  }

  Squares all;
  Patches patches;
  Values largest = Values::Zero();
  std::array<Point, quantities> where{};
  double least_stress;  ///< stress of a patch is not measured by less: the weight over its height [Pa]
  double volume = 0, strain = 0;
  std::int64_t left_out = 0;

  void add(const Values& run, const Values& fem, const Point& x, double weight) {
    const Values d = run - fem;
    all.add(d, fem, x, weight);
    patches.add(d, fem, x, weight);
    for (int q = 0; q < quantities; ++q)
      if (!(std::abs(d[q]) <= largest[q])) largest[q] = std::abs(d[q]), where[q] = x;
  }

  FemSoilCheck finished() const {
    FemSoilCheck soil{all.particles, left_out, std::sqrt(strain / volume), {}};
    if (all.particles == 0) return soil;
    for (int q = 0; q < quantities; ++q) {
      const double field = std::sqrt(q < stresses ? all.reference.head<stresses>().sum()
                                                  : all.reference.tail<quantities - stresses>().sum());
      const double off = std::sqrt(all.difference[q]), size = std::sqrt(all.reference[q]);
      const bool is_zero = size <= 1e-9 * field;
      FemDifference& found = soil.fields[names[q]] = {
          .relative_l2 = is_zero ? std::numeric_limits<double>::quiet_NaN() : off / size,
          .relative = off / std::max(size, least_share * field),
          .max_abs = largest[q],
          .x = where[q].x(),
          .y = where[q].y()};
      const double mean = field / std::sqrt(all.weight);
      patches.find_worst(
          q, q < stresses ? std::max(least_share * mean, least_stress) : least_share_of_patch * mean, found);
    }
    return soil;
  }
};

Values values_of(const Particles& p, std::size_t i) {
  const Stress& s = p.stress[i];
  const Vec2 u = p.displacement(i);
  return {s.xx, s.yy, s.zz, s.xy, u.x(), u.y()};
}

Values values_of(const FemPoint& p) {
  Values v;
  v << p.effective_stress.array(), p.displacement.array();
  return v;
}

}  // namespace

FemCheck compare_with_fem(const Case& scene, const Particles& p, const FemSolution& fem) {
  const LeftOut left_out(scene, scene.particles.spacing);
  std::vector<Sums> sums;
  for (const SoilCase& soil : scene.soils)
    sums.emplace_back(soil.unit_weight_saturated, scene.particles.spacing);
  for (std::size_t i = 0; i < p.size(); ++i) {
    Sums& of_soil = sums[p.soil[i]];
    const auto reference = fem.in_soil(p.soil[i], p.start[i]);
    if (!reference) continue;
    const double strain = largest_strain(lame(scene.soils[p.soil[i]]), reference->effective_stress);
    of_soil.volume += p.volume(i), of_soil.strain += p.volume(i) * strain * strain;
    if (left_out.contain(p.start[i]))
      ++of_soil.left_out;
    else
      of_soil.add(values_of(p, i), values_of(*reference), p.start[i], p.volume(i));
  }
  FemCheck check;
  check.unknowns = fem.unknowns;
  double strain = 0;
  std::int64_t particles = 0;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    if (sums[s].volume == 0) continue;
    const FemSoilCheck& soil = check.soils[scene.soils[s].name] = sums[s].finished();
    strain = std::max(strain, soil.strain), particles += soil.particles;
  }
  for (const ProbeCase& probe : scene.probes) {
    const Values there = values_of(fem.at(probe.position));
    for (int q = 0; q < quantities; ++q) check.probes[probe.name][names[q]] = there[q];
  }
  if (particles == 0) throw std::runtime_error("every particle is near a point where stress is singular");
  check.limit = tolerable + strain, check.local_limit = tolerable_in_a_patch + strain;
  return check;
}

std::string short_name(const std::string& field) {
  std::string component = field.substr(field.find('_') + 1);
  for (char& c : component) c = static_cast<char>(std::tolower(c));
  return (field.starts_with("EffectiveStress") ? "sigma'_" : "u_") + component;
}

}  // namespace porosph
