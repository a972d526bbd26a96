#include "solver/sph/consistent/interface_gradients.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <utility>

namespace porosph {
namespace {

using Mat4 = Eigen::Matrix4d;
using Mat24 = Eigen::Matrix<double, 2, 4>;

/// C over xx, xy, yx, yy in plane strain [Pa].
Mat4 stiffness(const Elasticity& soil) {
  const double g = soil.shear_modulus, l = soil.bulk_modulus - 2 * g / 3;
  Mat4 c = Mat4::Zero();
  c(0, 0) = c(3, 3) = l + 2 * g, c(0, 3) = c(3, 0) = l;
  c(1, 1) = c(1, 2) = c(2, 1) = c(2, 2) = g;
  return c;
}

/// m n, of m over xx, xy, yx, yy.
Mat24 onto(const Vec2& n) {
  Mat24 m = Mat24::Zero();
  m(0, 0) = m(1, 2) = n.x(), m(0, 1) = m(1, 3) = n.y();
  return m;
}

/// B: the bend c = B : G of a gradient G of the soil `own` at an interface with `other`.
Mat24 bend(const Mat4& own, const Mat4& other, const Vec2& n) {
  const Mat24 p = onto(n);
  const Mat2 acoustic = p * other * p.transpose();
  return acoustic.inverse() * p * (own - other);
}

/// A neighbour in another soil, and the interface between it and the particle.
struct Beyond {
  std::int32_t neighbour;
  PairGeometry pair;
  Vec2 normal;  ///< unit, either way
  Vec2 at;      ///< a point of the interface, from the particle [m]
};

class Finder {
 public:
  Finder(const ReferenceConfiguration& reference, const Model& model)
      : r_(reference), model_(model), count_(static_cast<std::int32_t>(reference.particles())) {
    for (const Soil& soil : model.soils) stiffness_.push_back(stiffness(soil.elastic()));
    for (std::size_t s = 0; s < stiffness_.size(); ++s)
      kind_.push_back(
          static_cast<std::int32_t>(std::ranges::find(stiffness_, stiffness_[s]) - stiffness_.begin()));
  }

  const std::vector<std::int32_t>& kinds() const { return kind_; }
  bool one_stiffness() const { return std::ranges::count(kind_, 0) == std::ssize(kind_); }

  bool sees_another_soil(std::int32_t a) const {
    bool mixed = false;
    r_.stencils.for_neighbours(
        a, [&](std::int32_t b, const PairGeometry&) { mixed = mixed || soil_of(b) != soil_of(a); });
    return mixed;
  }

  /// T of particle a and the normal of its interface; T = I where none is found.
  struct Smearing {
    Mat4 t = Mat4::Identity();
    Vec2 normal = Vec2::UnitY();
  };
  Smearing smearing(std::int32_t a) const {
    Smearing found;
    const std::vector<Beyond> beyond = neighbours_beyond(a);
    if (beyond.empty()) return found;
    found.normal = common_normal(beyond);
    const Mat2 l = r_.correction[a];
    for (const Beyond& q : beyond) {
      const Vec2 way = r_.points[q.neighbour] - r_.points[a];
      const Vec2 n = found.normal.dot(q.normal) < 0 ? Vec2(-found.normal) : found.normal;
      const double past = std::min(way.dot(n), (way - q.at).dot(n));
      if (past <= 0) continue;
      Vec2 gradient = l * Vec2(q.pair.x, q.pair.y);
      if (r_.closed()) gradient += q.pair.w * (r_.kappa[q.neighbour] - r_.kappa[a]);
      const Vec2 along_n = past * n * n.dot(gradient);
      const Mat24 b = bend(stiffness_[soil_of(a)], stiffness_[soil_of(q.neighbour)], n);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) found.t.row(2 * i + j) += along_n[j] * b.row(i);
    }
    limit(found.t);
    return found;
  }

  const Mat4& stiffness_of(std::int32_t a) const { return stiffness_[soil_of(a)]; }

 private:
  std::int32_t root(std::int32_t b) const { return b < count_ ? b : r_.ghosts.root(b - count_); }
  /// Soils of equal stiffness count as one.
  std::int32_t soil_of(std::int32_t b) const { return kind_[model_.particles.soil[root(b)]]; }

  /// In disorder a particle may see little of the other side: no more than 4 times the summed gradient.
  static void limit(Mat4& t) {
    constexpr double least = 0.25;
    for (int k = 0; k < 8 && t.eigenvalues().real().minCoeff() < least; ++k) t = 0.5 * (t + Mat4::Identity());
  }

  std::vector<Beyond> neighbours_beyond(std::int32_t a) const {
    std::vector<std::int32_t> near{a};
    r_.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) { near.push_back(b); });
    std::vector<Beyond> found;
    r_.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (soil_of(b) == soil_of(a)) return;
      if (auto beyond = interface(a, b, near)) found.push_back({b, g, beyond->first, beyond->second});
    });
    return found;
  }

  /// Normal and middle of the points that lie between mutually nearest particles of the two soils.
  std::optional<std::pair<Vec2, Vec2>> interface(std::int32_t a, std::int32_t b,
                                                 const std::vector<std::int32_t>& near) const {
    const Vec2 way = r_.points[b] - r_.points[a];
    Vec2 middle = Vec2::Zero();
    Mat2 moments = Mat2::Zero();
    double count = 0;
    for (const std::int32_t c : near) {
      if (soil_of(c) != soil_of(a)) continue;
      const std::int32_t d = nearest_of_soil(c, soil_of(b), way, near);
      if (d < 0 || !is_nearest(c, d, near)) continue;
      const double share = r_.volume[c] / (r_.volume[c] + r_.volume[d]);
      const Vec2 q = r_.points[c] + (r_.points[d] - r_.points[c]) * share - r_.points[a];
      middle += q, moments += q * q.transpose(), count += 1;
    }
    if (count == 0) return std::nullopt;
    middle /= count;
    moments = moments / count - middle * middle.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat2> axes(moments);
    Vec2 normal = axes.eigenvectors().col(0);
    if (axes.eigenvalues()[1] < 0.2 * model_.spacing * model_.spacing) {  // too few points for a line
      const Mat2 mirror = reflections(b);
      normal = -(mirror * towards(root(b), soil_of(a), mirror * Vec2(-way)));
    }
    return std::pair(normal.dot(way) < 0 ? Vec2(-normal) : normal, middle);
  }

  /// Of the particles of `soil` on the side of `way`, the nearest to c within 1.7 dx, or -1.
  std::int32_t nearest_of_soil(std::int32_t c, std::int32_t soil, const Vec2& way,
                               const std::vector<std::int32_t>& near) const {
    std::int32_t nearest = -1;
    double least = 1.7 * model_.spacing;
    for (const std::int32_t d : near) {
      if (soil_of(d) != soil) continue;
      const Vec2 between = r_.points[d] - r_.points[c];
      if (between.dot(way) > 0 && between.norm() < least - tie_breaking())
        least = between.norm(), nearest = d;
    }
    return nearest;
  }

  /// No particle of c's soil is nearer to d.
  bool is_nearest(std::int32_t c, std::int32_t d, const std::vector<std::int32_t>& near) const {
    const double distance = (r_.points[d] - r_.points[c]).norm();
    return std::none_of(near.begin(), near.end(), [&](std::int32_t e) {
      return soil_of(e) == soil_of(c) && (r_.points[d] - r_.points[e]).norm() < distance - tie_breaking();
    });
  }
  double tie_breaking() const { return 1e-9 * model_.spacing; }

  /// From a ghost's directions to those of its root.
  Mat2 reflections(std::int32_t b) const {
    Mat2 r = Mat2::Identity();
    for (; b >= count_; b = static_cast<std::int32_t>(r_.ghosts.parent(b - count_)))
      r = r * r_.ghosts.reflection(b - count_);
    return r;
  }

  /// At a particle, the direction towards a soil; `side` chooses where a thin layer has that soil on both.
  Vec2 towards(std::int32_t particle, std::int32_t soil, const Vec2& side) const {
    Vec2 sum = Vec2::Zero();
    Mat2 spread = Mat2::Zero();
    double all = 0;
    r_.stencils.for_neighbours(particle, [&](std::int32_t c, const PairGeometry& g) {
      if (soil_of(c) != soil) return;
      const Vec2 way(g.x, g.y);
      sum += way, all += way.norm(), spread += way * way.transpose() / g.w;
    });
    if (all > 0 && sum.norm() > 0.3 * all) return sum.normalized();
    const Vec2 axis = Eigen::SelfAdjointEigenSolver<Mat2>(spread).eigenvectors().col(1);
    return axis.dot(side) < 0 ? Vec2(-axis) : axis;
  }

  static Vec2 common_normal(const std::vector<Beyond>& beyond) {
    Vec2 sum = Vec2::Zero();
    for (const Beyond& q : beyond)
      sum += q.normal * (q.normal.dot(beyond.front().normal) < 0 ? -q.pair.w : q.pair.w);
    return sum.normalized();
  }

  const ReferenceConfiguration& r_;
  const Model& model_;
  std::int32_t count_;
  std::vector<Mat4> stiffness_;     ///< of each soil
  std::vector<std::int32_t> kind_;  ///< of each soil: the first of the same stiffness
};

/// What makes C A symmetric, of the own side's gradient; n and t are the axes.
Eigen::RowVector4d tie(const Mat4& c, const Mat4& t, const Mat4& own, const Vec2& normal) {
  Mat2 turn;
  turn << normal.x(), normal.y(), -normal.y(), normal.x();
  Mat4 frame;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) frame(i, j) = turn(i / 2, j / 2) * turn(i % 2, j % 2);
  const Mat4 felt = frame * c * own * frame.transpose();
  return (felt.col(3).transpose() - felt.row(3)) * frame * t;
}

}  // namespace

Mat2 OwnSides::of(std::size_t k, const Mat2& m) const {
  const double v[4] = {m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
  Mat2 out = Mat2::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out(i / 2, i % 2) += gradient[4 * i + j][k] * v[j];
  return out;
}

Mat2 OwnSides::rate_of(std::size_t k, const Mat2& m) const {
  const Mat2 own = of(k, m);
  const double shear = 0.5 * (own(0, 1) + own(1, 0)), spin = 0.5 * (m(1, 0) - m(0, 1));
  return (Mat2() << own(0, 0), shear - spin, shear + spin, own(1, 1)).finished();
}

void OwnSides::connect(OwnSideView& view) const {
  for (std::size_t i = 0; i < 16; ++i) view.gradient[i] = gradient[i].data();
  for (std::size_t i = 0; i < 4; ++i) view.tie[i] = tie[i].data();
  for (std::size_t i = 0; i < 2; ++i) view.along[i] = along[i].data();
}

OwnSides find_own_sides(const ReferenceConfiguration& reference, const Model& model) {
  OwnSides sides;
  const Finder finder(reference, model);
  if (finder.one_stiffness()) return sides;
  sides.kind = finder.kinds();
  const auto n = static_cast<std::int32_t>(reference.particles());
  sides.place.assign(n, -1);
  for (std::int32_t a = 0; a < n; ++a)
    if (finder.sees_another_soil(a)) {
      sides.place[a] = static_cast<std::int32_t>(sides.particle.size());
      sides.particle.push_back(a);
    }
  const std::size_t count = sides.particle.size();
  for (auto& numbers : sides.gradient) numbers.resize(count);
  for (auto& numbers : sides.tie) numbers.resize(count);
  for (auto& numbers : sides.along) numbers.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t a = sides.particle[k];
    const Finder::Smearing smearing = finder.smearing(a);
    const Mat4 own = smearing.t.inverse();
    const Eigen::RowVector4d rate = tie(finder.stiffness_of(a), smearing.t, own, smearing.normal);
    for (int i = 0; i < 16; ++i) sides.gradient[i][k] = own(i / 4, i % 4);
    for (int i = 0; i < 4; ++i) sides.tie[i][k] = rate[i];
    sides.along[0][k] = -smearing.normal.y(), sides.along[1][k] = smearing.normal.x();
  }
  return sides;
}

}  // namespace porosph
