#include "solver/water/flow/conductances.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

constexpr int corrections = 3;  // of M in disorder

double across(const Mat2& m, const Vec2& x) { return x.dot(m * x) / x.squaredNorm(); }

double harmonic(double a, double b) { return 2 * a * b / (a + b); }

double dot(const std::vector<Vec2>& x, const std::vector<Vec2>& y) {
  return deterministic_sum(x.size(), [&](std::size_t a) { return x[a].dot(y[a]); });
}

/// The M whose second moment, sum_b V_b F_ab (x.M x / |x|^2) x (x) x, is `wanted`.
class SecondMoment {
 public:
  explicit SecondMoment(std::span<const FlowLink> links) {
    double xxxx = 0, xxxy = 0, xxyy = 0, xyyy = 0, yyyy = 0;
    for (const FlowLink& l : links) {
      const double w = l.f / l.x.squaredNorm(), x = l.x.x(), y = l.x.y();
      xxxx += w * x * x * x * x, xxxy += w * x * x * x * y, xxyy += w * x * x * y * y;
      xyyy += w * x * y * y * y, yyyy += w * y * y * y * y;
    }
    factors_.compute((Eigen::Matrix3d() << xxxx, xxyy, xxxy, xxyy, yyyy, xyyy, xxxy, xyyy, xxyy).finished());
  }
  bool spans_the_plane() const { return factors_.isPositive() && factors_.vectorD().minCoeff() > 0.02; }
  Mat2 matrix(const Mat2& wanted) const {
    const Eigen::Vector3d m = factors_.solve(Eigen::Vector3d(wanted(0, 0), wanted(1, 1), wanted(0, 1)));
    return (Mat2() << m[0], m[2] / 2, m[2] / 2, m[1]).finished();
  }

 private:
  Eigen::LDLT<Eigen::Matrix3d> factors_;
};

}  // namespace

Conductances::Conductances(const std::vector<SoilCase>& soils, const Particles& particles,
                           const FlowLinks& links, double spacing, bool closed)
    : soils_(soils), p_(particles), links_(links), spacing_(spacing), closed_(closed) {
  make_moments();
  for (int i = 0; closed && close() && i < corrections; ++i) correct_moments();
}

/// Where the kernel sees too little of the plane (an acute toe), M is that of a whole plane.
void Conductances::make_moments() {
  const Mat2 x = Vec2(1, 0).asDiagonal(), y = Vec2(0, 1).asDiagonal();
  moments_.resize(links_.particles());
  held_.resize(links_.particles());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < links_.particles(); ++a) {
    const SecondMoment second(links_.of(a));
    held_[a] = second.spans_the_plane();
    if (held_[a])
      moments_[a] = {second.matrix(x), second.matrix(y)};
    else
      moments_[a] = {Vec2(1.5, -0.5).asDiagonal(), Vec2(-0.5, 1.5).asDiagonal()};
  }
}

/// Corrects M by what taking the mean of two and closing have changed, which lattices do without.
void Conductances::correct_moments() {
  std::vector<Moments> corrected = moments_;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < links_.particles(); ++a) {
    if (!held_[a]) continue;
    const Mat2 left = Mat2::Identity() - second_moment(a);
    const SecondMoment second(links_.of(a));
    corrected[a].of_x += second.matrix((Mat2() << left(0, 0), left(0, 1) / 2, left(0, 1) / 2, 0).finished());
    corrected[a].of_y += second.matrix((Mat2() << 0, left(0, 1) / 2, left(0, 1) / 2, left(1, 1)).finished());
  }
  moments_ = std::move(corrected);
}

/// sum_b c_ab x (x) x / 2 V_a of permeability 1.
Mat2 Conductances::second_moment(std::size_t a) const {
  Mat2 sum = Mat2::Zero();
  for (const FlowLink& l : links_.of(a)) sum += (weight(l, Vec2(1, 1)) + closing(l)) * l.x * l.x.transpose();
  return sum / (2 * links_.volume(a));
}

/// c_ab of permeability k without mu.
double Conductances::weight(const FlowLink& l, const Vec2& k) const {
  const std::int32_t b = links_.root(l.to);
  const Mat2 of_b = links_.reflected(l.to, moments_[b].of(k));
  return links_.volume(l.from) * l.f * across(moments_[l.from].of(k) + of_b, l.x);
}

/// sum_b c_ab x_ab for k = 1, over V_a, of what is to vanish.
std::vector<Vec2> Conductances::imbalance() const {
  std::vector<Vec2> out(links_.particles(), Vec2::Zero());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < links_.particles(); ++a)
    if (held_[a])
      for (const FlowLink& l : links_.of(a)) out[a] += weight(l, Vec2(1, 1)) * l.x;
  return out;
}

/// The change of that by mu.
void Conductances::change(const std::vector<Vec2>& mu, std::vector<Vec2>& out) const {
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < links_.particles(); ++a) {
    out[a].setZero();
    if (!held_[a]) continue;
    for (const FlowLink& l : links_.of(a))
      out[a] -= links_.volume(l.from) * l.f *
                (links_.reflected(l.to, mu[links_.root(l.to)]) - mu[a]).dot(l.x) * l.x;
  }
}

/// Conjugate gradients for mu; returns false in a lattice, where nothing is to do.
bool Conductances::close() {
  constexpr double lattice = 1e-9, closed = 1e-9;
  constexpr int most_iterations = 1000;
  std::vector<Vec2> residual = imbalance();
  double size = 0;
  for (std::size_t a = 0; a < links_.particles(); ++a)
    size = std::max(size, residual[a].norm() / links_.cell(a));
  if (mu_.empty() && size * spacing_ < lattice) return false;
  mu_.assign(links_.particles(), Vec2::Zero());
  std::vector<Vec2> direction = residual, image(links_.particles());
  double slope = dot(residual, residual);
  const double start = slope;
  for (int k = 0; k < most_iterations && slope > closed * closed * start; ++k) {
    change(direction, image);
    const double step = slope / dot(direction, image);
    for (std::size_t a = 0; a < links_.particles(); ++a)
      mu_[a] += step * direction[a], residual[a] -= step * image[a];
    const double next = dot(residual, residual);
    for (std::size_t a = 0; a < links_.particles(); ++a)
      direction[a] = residual[a] + next / slope * direction[a];
    slope = next;
  }
  return true;
}

Vec2 Conductances::permeability(const FlowLink& l) const {
  const Vec2 &a = soils_[p_.soil[l.from]].permeability, &b = soils_[p_.soil[links_.root(l.to)]].permeability;
  return {harmonic(a.x(), b.x()), harmonic(a.y(), b.y())};
}

/// The part of c_ab with mu, for permeability 1.
double Conductances::closing(const FlowLink& l) const {
  if (mu_.empty()) return 0;
  return links_.volume(l.from) * l.f *
         (links_.reflected(l.to, mu_[links_.root(l.to)]) - mu_[l.from]).dot(l.x);
}
/// Without mu, among moved particles, some see so little of the plane that a pair would lead water uphill.
double Conductances::of(const FlowLink& l) const {
  const Vec2 k = permeability(l);
  const double c = weight(l, k) + mean(k) * closing(l);
  return closed_ ? c : std::max(0.0, c);
}

}  // namespace porosph
