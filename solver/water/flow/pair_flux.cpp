#include "solver/water/flow/pair_flux.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "solver/space/parallel.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/water/flow/outline_sight.hpp"

namespace porosph {
namespace {

constexpr double on_outline = 1e-6;  // spacings
constexpr int corrections = 3;       // of M in disorder

/// A pair before its conductance is known. `to` counts particles, then images.
struct Link {
  std::int32_t from, to;
  Vec2 x;
  double f;  ///< V_b F_ab [1/m2]
};

/// M for permeability 1 along x alone, and along y alone.
struct Moments {
  Mat2 of_x, of_y;
  Mat2 of(const Vec2& k) const { return k.x() * of_x + k.y() * of_y; }
};

double across(const Mat2& m, const Vec2& x) { return x.dot(m * x) / x.squaredNorm(); }

double harmonic(double a, double b) { return 2 * a * b / (a + b); }

class Builder {
 public:
  Builder(const std::vector<SoilCase>& soils, const HydraulicOutline& outline, const Particles& p,
          double spacing, bool as_drawn)
      : as_drawn_(as_drawn),
        soils_(soils),
        outline_(outline),
        p_(p),
        spacing_(spacing),
        kernel_(spacing),
        points_(p.position) {
    ghosts_ = Ghosts(outline.stretches, 0, outline.stretches.size(), kernel_.support(), points_);
    for (std::size_t a = 0; a < p.size(); ++a) cell_.push_back(p.volume(a) / p.fill[a]);
    ghosts_.fill<Mirrors::scalar>(cell_);
  }

  FlowPairs build() {
    link();
    make_moments();
    for (int i = 0; as_drawn_ && close() && i < corrections; ++i) correct_moments();
    fill();
    pair_up();
    if (as_drawn_)
      find_particles_beside_patches();
    else
      out_.beside_patch.assign(outline_.patches.size(), -1);
    return std::move(out_);
  }

 private:
  std::size_t particles() const { return p_.size(); }
  std::int32_t root(std::int32_t point) const {
    const auto n = static_cast<std::int32_t>(particles());
    return point < n ? point : ghosts_.root(point - n);
  }

  void link() {
    const OutlineSight sight(soils_, kernel_.support(), spacing_);
    const NeighbourList all = find_neighbours(points_, particles(), (1 - 1e-9) * kernel_.support());
    const auto n = static_cast<std::int32_t>(particles());
    links_begin_ = {0};
    for (std::int32_t a = 0; a < n; ++a) {
      for (const std::int32_t b : all.of(a)) {
        const bool seen =
            b < n ? first_stretch_between(points_[a], points_[b]) < 0 : sees_ghost(sight, a, b - n);
        const Vec2 x = points_[b] - points_[a];
        const double f = -cell_[b] * kernel_.slope(x.norm());
        if (seen && f > 0) links_.push_back({a, b, x, f});
      }
      links_begin_.push_back(std::ssize(links_));
    }
  }

  /// The stretch that a line from one point to another meets first, -1 where it stays in the soil. Water
  /// does not pass around the outside of a corner.
  int first_stretch_between(const Vec2& from, const Vec2& to) const {
    const double slack = on_outline * spacing_;
    int first = -1;
    double nearest = 2;
    for (std::size_t s = 0; s < outline_.stretches.size(); ++s) {
      const Wall& wall = outline_.stretches[s];
      const double before = wall.distance(from), after = wall.distance(to);
      if (!(before > slack && after < -slack) && !(before < -slack && after > slack)) continue;
      const double t = before / (before - after);
      const double at = along(static_cast<int>(s), from + t * (to - from));
      if (at < -slack || at > (wall.to - wall.from).norm() + slack || t >= nearest) continue;
      nearest = t, first = static_cast<int>(s);
    }
    return first;
  }

  /// Two stretches may lie in one line, with a notch between them: what is beside the one has no image in the
  /// other.
  bool is_beside_its_stretch(std::size_t ghost) const {
    if (ghosts_.stems_from_ghost(ghost)) return is_beside_its_stretch(ghosts_.parent(ghost) - particles());
    const int stretch = ghosts_.image(ghost).wall;
    const Wall& wall = outline_.stretches[stretch];
    const double at = along(stretch, points_[ghosts_.parent(ghost)]), slack = on_outline * spacing_;
    return at > -slack && at < (wall.to - wall.from).norm() + slack;
  }

  /// Images of images lie in corners, where the line to them may pass either stretch.
  bool sees_ghost(const OutlineSight& sight, std::int32_t a, std::size_t ghost) const {
    if (!is_beside_its_stretch(ghost)) return false;
    if (lies_on_mirror(a, ghost)) return true;
    if (ghosts_.stems_from_ghost(ghost)) return !as_drawn_ || sight.sees_ghost(a, ghost, ghosts_, p_);
    return first_stretch_between(points_[a], points_[particles() + ghost]) == ghosts_.image(ghost).wall;
  }
  static Vec2 crossing(const Wall& wall, const Vec2& from, const Vec2& to) {
    const double before = wall.distance(from), behind = -wall.distance(to);
    return from + before / (before + behind) * (to - from);
  }

  /// From a particle on the outline, all that is mirrored in that stretch is in sight.
  bool lies_on_mirror(std::int32_t a, std::size_t ghost) const {
    const Wall& last = ghosts_.wall(ghost);
    const bool on_last = std::abs(last.distance(points_[a])) < on_outline * spacing_;
    return on_last ||
           (ghosts_.stems_from_ghost(ghost) && lies_on_mirror(a, ghosts_.parent(ghost) - particles()));
  }

  std::span<const Link> links_of(std::size_t a) const {
    return {links_.data() + links_begin_[a], links_.data() + links_begin_[a + 1]};
  }

  /// The M whose second moment, sum_b V_b F_ab (x.M x / |x|^2) x (x) x, is `wanted`.
  class SecondMoment {
   public:
    explicit SecondMoment(std::span<const Link> links) {
      double xxxx = 0, xxxy = 0, xxyy = 0, xyyy = 0, yyyy = 0;
      for (const Link& l : links) {
        const double w = l.f / l.x.squaredNorm(), x = l.x.x(), y = l.x.y();
        xxxx += w * x * x * x * x, xxxy += w * x * x * x * y, xxyy += w * x * x * y * y;
        xyyy += w * x * y * y * y, yyyy += w * y * y * y * y;
      }
      factors_.compute(
          (Eigen::Matrix3d() << xxxx, xxyy, xxxy, xxyy, yyyy, xyyy, xxxy, xyyy, xxyy).finished());
    }
    bool spans_the_plane() const { return factors_.isPositive() && factors_.vectorD().minCoeff() > 0.02; }
    Mat2 matrix(const Mat2& wanted) const {
      const Eigen::Vector3d m = factors_.solve(Eigen::Vector3d(wanted(0, 0), wanted(1, 1), wanted(0, 1)));
      return (Mat2() << m[0], m[2] / 2, m[2] / 2, m[1]).finished();
    }

   private:
    Eigen::LDLT<Eigen::Matrix3d> factors_;
  };

  /// Where the kernel sees too little of the plane (an acute toe), M is that of a whole plane.
  void make_moments() {
    const Mat2 x = Vec2(1, 0).asDiagonal(), y = Vec2(0, 1).asDiagonal();
    moments_.resize(particles());
    held_.resize(particles());
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles(); ++a) {
      const SecondMoment second(links_of(a));
      held_[a] = second.spans_the_plane();
      if (held_[a])
        moments_[a] = {second.matrix(x), second.matrix(y)};
      else
        moments_[a] = {Vec2(1.5, -0.5).asDiagonal(), Vec2(-0.5, 1.5).asDiagonal()};
    }
  }

  /// Corrects M by what taking the mean of two and closing have changed, which lattices do without.
  void correct_moments() {
    std::vector<Moments> corrected = moments_;
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles(); ++a) {
      if (!held_[a]) continue;
      const Mat2 left = Mat2::Identity() - second_moment(a);
      const SecondMoment second(links_of(a));
      corrected[a].of_x +=
          second.matrix((Mat2() << left(0, 0), left(0, 1) / 2, left(0, 1) / 2, 0).finished());
      corrected[a].of_y +=
          second.matrix((Mat2() << 0, left(0, 1) / 2, left(0, 1) / 2, left(1, 1)).finished());
    }
    moments_ = std::move(corrected);
  }

  /// sum_b c_ab x (x) x / 2 V_a of permeability 1.
  Mat2 second_moment(std::size_t a) const {
    Mat2 sum = Mat2::Zero();
    for (const Link& l : links_of(a)) sum += (weight(l, Vec2(1, 1)) + closing(l)) * l.x * l.x.transpose();
    return sum / (2 * volume(static_cast<std::int32_t>(a)));
  }

  Mat2 reflected(std::int32_t point, const Mat2& m) const {
    const auto n = static_cast<std::int32_t>(particles());
    return point < n ? m : ghosts_.from_root<Mirrors::tensor>(point - n, m);
  }
  Vec2 reflected(std::int32_t point, const Vec2& v) const {
    const auto n = static_cast<std::int32_t>(particles());
    return point < n ? v : ghosts_.from_root<Mirrors::direction>(point - n, v);
  }
  double volume(std::int32_t a) const { return p_.fill[a] * cell_[a]; }

  /// c_ab of permeability k without mu.
  double weight(const Link& l, const Vec2& k) const {
    const std::int32_t b = root(l.to);
    const Mat2 of_b = reflected(l.to, moments_[b].of(k));
    return volume(l.from) * l.f * across(moments_[l.from].of(k) + of_b, l.x);
  }

  /// sum_b c_ab x_ab for k = 1, over V_a, of what is to vanish.
  std::vector<Vec2> imbalance() const {
    std::vector<Vec2> out(particles(), Vec2::Zero());
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles(); ++a)
      if (held_[a])
        for (const Link& l : links_of(a)) out[a] += weight(l, Vec2(1, 1)) * l.x;
    return out;
  }

  /// The change of that by mu.
  void change(const std::vector<Vec2>& mu, std::vector<Vec2>& out) const {
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles(); ++a) {
      out[a].setZero();
      if (!held_[a]) continue;
      for (const Link& l : links_of(a))
        out[a] -= volume(l.from) * l.f * (reflected(l.to, mu[root(l.to)]) - mu[a]).dot(l.x) * l.x;
    }
  }

  static double dot(const std::vector<Vec2>& x, const std::vector<Vec2>& y) {
    return deterministic_sum(x.size(), [&](std::size_t a) { return x[a].dot(y[a]); });
  }

  /// Conjugate gradients for mu; returns false in a lattice, where nothing is to do.
  bool close() {
    constexpr double lattice = 1e-9, closed = 1e-9;
    constexpr int most_iterations = 1000;
    std::vector<Vec2> residual = imbalance();
    double size = 0;
    for (std::size_t a = 0; a < particles(); ++a) size = std::max(size, residual[a].norm() / cell_[a]);
    if (mu_.empty() && size * spacing_ < lattice) return false;
    mu_.assign(particles(), Vec2::Zero());
    std::vector<Vec2> direction = residual, image(particles());
    double slope = dot(residual, residual);
    const double start = slope;
    for (int k = 0; k < most_iterations && slope > closed * closed * start; ++k) {
      change(direction, image);
      const double step = slope / dot(direction, image);
      for (std::size_t a = 0; a < particles(); ++a)
        mu_[a] += step * direction[a], residual[a] -= step * image[a];
      const double next = dot(residual, residual);
      for (std::size_t a = 0; a < particles(); ++a) direction[a] = residual[a] + next / slope * direction[a];
      slope = next;
    }
    return true;
  }

  Vec2 permeability(const Link& l) const {
    const Vec2 &a = soils_[p_.soil[l.from]].permeability, &b = soils_[p_.soil[root(l.to)]].permeability;
    return {harmonic(a.x(), b.x()), harmonic(a.y(), b.y())};
  }

  static double mean(const Vec2& k) { return std::sqrt(k.x() * k.y()); }

  /// What makes the velocity of a uniform flow exact, from the sum of c_ab x (x) x over 2 V for k = 1.
  Mat2 correction(std::int32_t a, const Mat2& second) const {
    const Vec2 k = soils_[p_.soil[a]].permeability / mean(soils_[p_.soil[a]].permeability);
    return second.determinant() > 0.1 ? Mat2(k.asDiagonal() * inverse(second)) : Mat2(Mat2::Identity());
  }

  /// The part of c_ab with mu, for permeability 1.
  double closing(const Link& l) const {
    if (mu_.empty()) return 0;
    return volume(l.from) * l.f * (reflected(l.to, mu_[root(l.to)]) - mu_[l.from]).dot(l.x);
  }
  /// Among moved particles some see so little of the plane that a pair would lead water uphill.
  double conductance(const Link& l) const {
    const Vec2 k = permeability(l);
    const double c = weight(l, k) + mean(k) * closing(l);
    return as_drawn_ ? c : std::max(0.0, c);
  }

  void fill() {
    const auto n = static_cast<std::int32_t>(particles());
    for (std::int32_t a = 0; a < n; ++a) {
      out_.begin.push_back(std::ssize(out_.pairs));
      out_.volume.push_back(volume(a));
      Mat2 second = Mat2::Zero();
      for (const Link& l : links_of(a)) {
        second += conductance(l) / mean(permeability(l)) * l.x * l.x.transpose();
        if (l.to < n)
          out_.pairs.push_back({l.to, conductance(l)});
        else
          out_.face_pairs.push_back(face_pair(l));
      }
      out_.correction.push_back(correction(a, second / (2 * volume(a))));
      if (as_drawn_) add_to_faces(a);
    }
    out_.begin.push_back(std::ssize(out_.pairs));
  }

  using Mirrored = std::array<std::int32_t, 4>;  ///< a, b and the stretches between them
  Mirrored key(const FacePair& p, bool turned) const {
    const auto stretch = [&](int i) { return p.patch[i] < 0 ? -1 : outline_.patches[p.patch[i]].stretch; };
    return {turned ? p.to : p.from, turned ? p.from : p.to, stretch(0), stretch(1)};
  }

  /// What passes from a to the image of b comes back from b to the image of a, through the same patch. At
  /// odd corners one of the two may be hidden: the other one is left out.
  void pair_up() {
    std::map<Mirrored, const FacePair*> known;
    std::vector<FacePair> before = std::move(out_.face_pairs);
    for (const FacePair& p : before) known.try_emplace(key(p, false), &p);
    const std::vector<std::int32_t>& on_face = out_.on_face;
    out_.face_pairs.clear();
    out_.face_begin.assign(particles() + 1, 0);
    for (FacePair p : before) {
      const auto partner = known.find(key(p, true));
      if (partner != known.end()) {
        const FacePair& other = *partner->second;
        p.conductance =
            p_.fill[p.from] / 2 * (p.conductance / p_.fill[p.from] + other.conductance / p_.fill[other.from]);
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
    const NeighbourList near = find_neighbours(middles, p_.position, 3 * kernel_.support());
    for (std::size_t i = 0; i < middles.size(); ++i) {
      std::int32_t nearest = -1;
      for (const std::int32_t b : near.of(i))
        if (nearest < 0 || (p_.position[b] - middles[i]).squaredNorm() <
                               (p_.position[nearest] - middles[i]).squaredNorm() - 1e-9 * spacing_ * spacing_)
          nearest = b;
      out_.beside_patch.push_back(nearest);
    }
  }

  double along(int stretch, const Vec2& p) const {
    const Wall& w = outline_.stretches[stretch];
    return (p - w.from).dot((w.to - w.from).normalized());
  }

  FacePair face_pair(const Link& l) const {
    const auto n = static_cast<std::int32_t>(particles());
    FacePair pair{.from = l.from, .to = root(l.to), .conductance = conductance(l), .x = l.x};
    pair.images = ghosts_.stems_from_ghost(l.to - n) ? 2 : 1;
    const Vec2 &from = points_[l.from], &to = points_[l.to];
    std::size_t ghost = l.to - n;
    for (int i = pair.images - 1; i >= 0; --i) {
      const int stretch = ghosts_.image(ghost).wall;
      const Wall& wall = outline_.stretches[stretch];
      const Vec2 through = crossing(wall, from, to);
      pair.patch[i] = outline_.patch_at(stretch, along(stretch, through));
      pair.crossing[i] = through.y();
      const std::size_t parent = ghosts_.parent(ghost);
      pair.foot[i] = ((points_[parent] + points_[particles() + ghost]) / 2).y();
      if (i > 0) ghost = parent - particles();
    }
    return pair;
  }

  /// In a corner it lies on two.
  void add_to_faces(std::int32_t a) {
    const double slack = on_outline * spacing_;
    for (std::size_t s = 0; s < outline_.stretches.size(); ++s) {
      const Wall& wall = outline_.stretches[s];
      const double at = along(static_cast<int>(s), points_[a]);
      if (std::abs(wall.distance(points_[a])) > slack || at < -slack ||
          at > (wall.to - wall.from).norm() + slack)
        continue;
      out_.on_face.push_back(a);
      out_.patch_of_on_face.push_back(outline_.patch_at(static_cast<int>(s), at));
    }
  }

  bool as_drawn_;
  const std::vector<SoilCase>& soils_;
  const HydraulicOutline& outline_;
  const Particles& p_;
  double spacing_;
  CubicSpline<2> kernel_;
  std::vector<Vec2> points_;  ///< particles, then images
  Ghosts ghosts_;
  std::vector<double> cell_;  ///< whole cells of particles and images [m2]
  std::vector<Link> links_;
  std::vector<std::int64_t> links_begin_;
  std::vector<Moments> moments_;
  std::vector<std::uint8_t> held_;
  std::vector<Vec2> mu_;
  FlowPairs out_;
};

}  // namespace

FlowPairs make_flow_pairs(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                          const Particles& particles, double spacing) {
  return Builder(soils, outline, particles, spacing, true).build();
}

FlowPairs make_flow_pairs_of_moved(const std::vector<SoilCase>& soils, const HydraulicOutline& walls,
                                   const Particles& particles, double spacing) {
  return Builder(soils, walls, particles, spacing, false).build();
}

}  // namespace porosph
