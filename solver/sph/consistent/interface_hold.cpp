#include "solver/sph/consistent/interface_hold.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "solver/sph/consistent/along_interfaces.hpp"

namespace porosph {
namespace {

/// A ghost's displacement from that of the particle that it stems from.
Mat2 motion_of_ghost(const ReferenceConfiguration& r, std::size_t ghost) {
  Mat2 motion;
  for (int k = 0; k < 2; ++k) motion.col(k) = r.ghosts.from_root<Mirrors::motion>(ghost, Vec2(Vec2::Unit(k)));
  return motion;
}

}  // namespace

InterfaceHold::InterfaceHold(const ReferenceConfiguration& r, const Model& model) {
  for (const std::int32_t a : r.own_sides.particle) hold(r, model, a);
  if (!acts()) return;
  held_.push_back({-1, 0, shares_.size()});
  force_.resize(held_.size());
  find_pulls(r);
}

void InterfaceHold::hold(const ReferenceConfiguration& r, const Model& model, std::int32_t a) {
  constexpr double strength = 0.25;  // stable up to twice this with any Courant number: docs/theory.md
  constexpr double spans_the_plane = 0.02;
  const auto n = static_cast<std::int32_t>(r.particles());
  const auto root = [&](std::int32_t b) { return b < n ? b : r.ghosts.root(b - n); };
  const auto soil = [&](std::int32_t b) { return static_cast<std::size_t>(model.particles.soil[root(b)]); };
  const std::size_t own = soil(a);
  const auto at = [&](std::int32_t b) {
    const Vec2 way = (r.points[b] - r.points[a]) / model.spacing;
    return Eigen::Vector3d(1, way.x(), way.y());
  };
  const double modulus = model.soils[own].constrained_modulus();
  double softest = modulus, all = 0;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  const auto in_one_soil = [&](std::int32_t b) { return r.own_sides.kind[soil(b)] == r.own_sides.kind[own]; };
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    softest = std::min(softest, model.soils[soil(b)].constrained_modulus());
    if (in_one_soil(b)) moments += g.w * at(b) * at(b).transpose(), all += g.w;
  });
  if (modulus < much_stiffer * softest || model.soils[own].may_yield() || all == 0) return;
  moments /= all;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments, Eigen::EigenvaluesOnly);
  if (axes.eigenvalues()[0] < spans_the_plane) return;  // a lone row
  const Eigen::Vector3d fit = moments.inverse().col(0) / all;
  const std::size_t first = shares_.size();
  double squares = 0;
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    if (!in_one_soil(b)) return;
    const double c = g.w * fit.dot(at(b));
    squares += c * c;
    shares_.push_back({b, c});
  });
  const double area = model.spacing * model.spacing;
  held_.push_back({a, strength * modulus / (1 + squares) * model.particles.volume(a) / area, first});
}

void InterfaceHold::find_pulls(const ReferenceConfiguration& r) {
  const std::size_t n = r.particles();
  std::vector<std::vector<Share>> of_particle(n);
  for (std::size_t h = 0; h + 1 < held_.size(); ++h) {
    const auto place = static_cast<std::int32_t>(h);
    of_particle[held_[h].particle].push_back({place, -1});
    for (std::size_t m = held_[h].first; m < held_[h + 1].first; ++m) {
      const auto [b, c] = shares_[m];
      if (static_cast<std::size_t>(b) < n)
        of_particle[b].push_back({place, c});
      else
        mirrored_.push_back({r.ghosts.root(b - n), place, c * motion_of_ghost(r, b - n).transpose()});
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    if (of_particle[a].empty()) continue;
    pulled_.push_back({static_cast<std::int32_t>(a), pulls_.size()});
    pulls_.insert(pulls_.end(), of_particle[a].begin(), of_particle[a].end());
  }
  pulled_.push_back({-1, pulls_.size()});
}

void InterfaceHold::add_forces(const ReferenceConfiguration& r, const Particles& p,
                               std::span<Vec2> accelerations) {
  if (!acts()) return;
  const std::size_t n = r.particles();
  const auto moved = [&](std::size_t a) { return Vec2(p.position[a] - r.points[a]); };
#pragma omp parallel for schedule(static)
  for (std::size_t h = 0; h < held_.size() - 1; ++h) {
    Vec2 stretch = moved(held_[h].particle);
    for (std::size_t m = held_[h].first; m < held_[h + 1].first; ++m) {
      const auto b = static_cast<std::size_t>(shares_[m].of);
      const Vec2 u =
          b < n ? moved(b) : r.ghosts.from_root<Mirrors::motion>(b - n, moved(r.ghosts.root(b - n)));
      stretch -= shares_[m].weight * u;
    }
    force_[h] = held_[h].stiffness * stretch;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < pulled_.size() - 1; ++k) {
    Vec2 force = Vec2::Zero();
    for (std::size_t m = pulled_[k].first; m < pulled_[k + 1].first; ++m)
      force += pulls_[m].weight * force_[pulls_[m].of];
    const std::int32_t a = pulled_[k].particle;
    accelerations[a] += force / p.mass[a];
  }
  for (const Mirrored& m : mirrored_)
    accelerations[m.particle] += m.weight * force_[m.held] / p.mass[m.particle];
}

}  // namespace porosph
