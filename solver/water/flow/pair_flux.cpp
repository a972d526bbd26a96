#include "solver/water/flow/pair_flux.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/water/flow/conductances.hpp"

namespace porosph {
namespace {

double smaller_eigenvalue(const Mat2& m) {
  return (m.trace() - std::hypot(m(0, 0) - m(1, 1), 2 * m(0, 1))) / 2;
}

class Builder {
 public:
  Builder(const std::vector<SoilCase>& soils, const HydraulicOutline& outline, const Particles& p,
          double spacing, bool as_drawn)
      : soils_(soils),
        outline_(outline),
        p_(p),
        spacing_(spacing),
        as_drawn_(as_drawn),
        links_(soils, outline, p, spacing, as_drawn),
        conductances_(soils, p, links_, spacing, as_drawn) {}

  FlowPairs build() {
    fill();
    pair_up();
    if (as_drawn_)
      find_particles_beside_patches();
    else
      out_.beside_patch.assign(outline_.patches.size(), -1);
    return std::move(out_);
  }

 private:
  /// What makes the velocity of a uniform flow exact, from the sum of c_ab x (x) x over 2 V for k = 1.
  Mat2 correction(std::int32_t a, const Mat2& second) const {
    const Vec2 k = soils_[p_.soil[a]].permeability / Conductances::mean(soils_[p_.soil[a]].permeability);
    return second.determinant() > 0.1 ? Mat2(k.asDiagonal() * inverse(second)) : Mat2(Mat2::Identity());
  }

  /// What a particle in part of a cell, on the outline, passes to another, over what its own part of the cell
  /// passes. As drawn the outline mirrors the other one, and the rest passes to that image. Once it has moved
  /// it has no such image, and passes to the other one as much as that one to it.
  double share(std::int32_t a, std::int32_t b) const {
    return as_drawn_ ? 1 : std::max(p_.fill[a], p_.fill[b]) / p_.fill[a];
  }

  void fill() {
    const auto n = static_cast<std::int32_t>(links_.particles());
    for (std::int32_t a = 0; a < n; ++a) {
      out_.begin.push_back(std::ssize(out_.pairs));
      out_.volume.push_back(links_.volume(a));
      Mat2 second = Mat2::Zero(), around = Mat2::Zero();
      for (const FlowLink& l : links_.of(a)) {
        around += l.f * l.x * l.x.transpose();
        const double conductance = share(a, links_.root(l.to)) * conductances_.of(l);
        second += conductance / Conductances::mean(conductances_.permeability(l)) * l.x * l.x.transpose();
        if (l.to < n)
          out_.pairs.push_back({l.to, conductance});
        else
          out_.face_pairs.push_back(face_pair(l));
      }
      out_.enclosed.push_back(smaller_eigenvalue(around));
      out_.correction.push_back(correction(a, second / (2 * links_.volume(a))));
      if (as_drawn_) add_to_faces(a);
    }
    out_.begin.push_back(std::ssize(out_.pairs));
  }

  using Mirrored = std::array<std::int32_t, 4>;  ///< a, b and the stretches between them
  Mirrored key(const FacePair& p, bool turned) const {
    const auto stretch = [&](int i) {
      if (p.patch[i] < 0) return -1;
      const int there = outline_.patches[p.patch[i]].stretch;
      return turned ? outline_.way_back(there) : there;
    };
    return {turned ? p.to : p.from, turned ? p.from : p.to, stretch(0), stretch(1)};
  }

  /// What passes from a to the image of b comes back from b to the image of a, through the same stretch. At
  /// odd corners one of the two may be hidden: the other one is left out.
  void pair_up() {
    std::map<Mirrored, const FacePair*> known;
    std::vector<FacePair> before = std::move(out_.face_pairs);
    for (const FacePair& p : before) known.try_emplace(key(p, false), &p);
    const std::vector<std::int32_t>& on_face = out_.on_face;
    out_.face_pairs.clear();
    out_.face_begin.assign(links_.particles() + 1, 0);
    for (FacePair p : before) {
      const auto partner = known.find(key(p, true));
      if (partner != known.end()) {
        const FacePair& other = *partner->second;
        p.conductance = share(p.from, p.to) * p_.fill[p.from] / 2 *
                        (p.conductance / p_.fill[p.from] + other.conductance / p_.fill[other.from]);
        if (other.from < p.from) p.patch = other.patch, p.crossing = other.crossing;
      } else if (!std::ranges::binary_search(on_face, p.from)) {
        continue;
      }
      out_.face_pairs.push_back(p);
      ++out_.face_begin[p.from + 1];
    }
    std::partial_sum(out_.face_begin.begin(), out_.face_begin.end(), out_.face_begin.begin());
  }

  void find_particles_beside_patches() {
    std::vector<Vec2> middles;
    for (const HydraulicPatch& patch : outline_.patches) middles.push_back(outline_.middle(patch));
    const NeighbourList near = find_neighbours(middles, p_.position, 3 * CubicSpline<2>(spacing_).support());
    for (std::size_t i = 0; i < middles.size(); ++i) {
      std::int32_t nearest = -1;
      for (const std::int32_t b : near.of(i))
        if (nearest < 0 || (p_.position[b] - middles[i]).squaredNorm() <
                               (p_.position[nearest] - middles[i]).squaredNorm() - 1e-9 * spacing_ * spacing_)
          nearest = b;
      out_.beside_patch.push_back(nearest);
    }
  }

  FacePair face_pair(const FlowLink& l) const {
    const auto n = static_cast<std::int32_t>(links_.particles());
    FacePair pair{.from = l.from, .to = links_.root(l.to), .conductance = conductances_.of(l), .x = l.x};
    pair.images = links_.ghosts().stems_from_ghost(l.to - n) ? 2 : 1;
    const Vec2 &from = links_.place(l.from), &to = links_.place(l.to);
    std::size_t ghost = l.to - n;
    for (int i = pair.images - 1; i >= 0; --i) {
      const int stretch = links_.ghosts().image(ghost).wall;
      const Wall& wall = outline_.stretches[stretch];
      const Vec2 through = crossing(wall, from, to);
      pair.patch[i] = outline_.patch_at(stretch, outline_.along(stretch, through));
      pair.crossing[i] = through.y();
      const std::size_t parent = links_.ghosts().parent(ghost);
      pair.foot[i] = ((links_.place(parent) + links_.place(links_.particles() + ghost)) / 2).y();
      if (i > 0) ghost = parent - links_.particles();
    }
    return pair;
  }

  /// In a corner it lies on two.
  void add_to_faces(std::int32_t a) {
    const double slack = FlowLinks::on_outline * spacing_;
    for (std::size_t s = 0; s < outline_.stretches.size(); ++s) {
      const Wall& wall = outline_.stretches[s];
      const double at = outline_.along(static_cast<int>(s), links_.place(a));
      if (std::abs(wall.distance(links_.place(a))) > slack || at < -slack ||
          at > (wall.to - wall.from).norm() + slack)
        continue;
      out_.on_face.push_back(a);
      out_.patch_of_on_face.push_back(outline_.patch_at(static_cast<int>(s), at));
    }
  }

  static Vec2 crossing(const Wall& wall, const Vec2& from, const Vec2& to) {
    if (wall.is_periodic()) return from;  // it may lie beyond
    const double before = wall.distance(from), behind = -wall.distance(to);
    return from + before / (before + behind) * (to - from);
  }

  const std::vector<SoilCase>& soils_;
  const HydraulicOutline& outline_;
  const Particles& p_;
  double spacing_;
  bool as_drawn_;
  FlowLinks links_;
  Conductances conductances_;
  FlowPairs out_;
};

}  // namespace

double FlowPairs::conductance(std::int32_t a, std::int32_t b) const {
  for (auto k = begin[a]; k < begin[a + 1]; ++k)
    if (pairs[k].to == b) return pairs[k].conductance;
  return 0;
}

FlowPairs make_flow_pairs(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                          const Particles& particles, double spacing) {
  return Builder(soils, outline, particles, spacing, true).build();
}

FlowPairs make_flow_pairs_of_moved(const std::vector<SoilCase>& soils, const HydraulicOutline& walls,
                                   const Particles& particles, double spacing) {
  return Builder(soils, walls, particles, spacing, false).build();
}

}  // namespace porosph
