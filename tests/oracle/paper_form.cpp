#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/points.hpp"

namespace porosph::oracle {
namespace {

/// A point as the sums over b need it.
struct Point {
  Vec2 x, v;
  Mat2 stress;                              // effective
  double volume, density, pressure, sound;  // sound: c of eq. (16)
};

/// R of the artificial stress: -epsilon sigma / rho^2 on each principal stress in tension.
Mat2 artificial_stress(const Point& b, double epsilon) {
  const Eigen::SelfAdjointEigenSolver<Mat2> principal(b.stress);
  Mat2 r = Mat2::Zero();
  for (int i = 0; i < 2; ++i) {
    const double sigma = principal.eigenvalues()[i];
    const Vec2 n = principal.eigenvectors().col(i);
    if (sigma > 0) r -= epsilon * sigma / (b.density * b.density) * n * n.transpose();
  }
  return r;
}

class PaperForm {
 public:
  PaperForm(const FormulationCase& formulation, const Model& start, const Model& now)
      : formulation_(formulation),
        start_(start),
        now_(now),
        points_(all_points(now.walls, start.particles.position)) {}

  Result result() const {
    Result r;
    for (std::size_t a = 0; a < now_.particles.size(); ++a) {
      r.acceleration.push_back(acceleration(a));
      r.velocity_gradient.push_back(velocity_gradient(a));
    }
    return r;
  }

 private:
  Point particle(std::size_t a) const {
    const Particles& p = now_.particles;
    const Stress& s = p.stress[a];
    Point point{.x = p.position[a],
                .v = p.velocity[a],
                .stress = Mat2::Zero(),
                .volume = p.mass[a] / p.density[a],
                .density = p.density[a],
                .pressure = p.pore_pressure[a],
                .sound = std::sqrt(now_.soils[p.soil[a]].shear_modulus() / p.density[a])};
    point.stress << s.xx, s.xy, s.xy, s.yy;
    return point;
  }

  /// A virtual particle of a fixed wall stays in place and is what the particle that looks at it makes of it.
  Point virtual_particle(const SeenParticle& seen, const Wall& fixed, const Point& a) const {
    Point b = a;
    b.x = place_behind(seen.walls, start_.particles.position[seen.particle]);
    b.volume = start_.particles.mass[seen.particle] / start_.particles.density[seen.particle];
    b.pressure = now_.water.pore_pressure(start_.particles.position[seen.particle].x(), b.x.y());
    const double d_a = (a.x - fixed.from).dot(fixed.normal), d_b = -(b.x - fixed.from).dot(fixed.normal);
    b.v = -std::min(d_b / d_a, 0.5) * a.v;
    return b;
  }

  Point ghost(const SeenParticle& seen) const {
    Point b = particle(seen.particle);
    const Mat2 turn = turn_behind(seen.walls);
    b.pressure = pressure_of_image(now_.water, b.x, place_behind(seen.walls, b.x));
    b.x = place_behind(seen.walls, b.x);
    b.v = turn * b.v;
    b.stress = turn * b.stress * turn.transpose();
    return b;
  }

  Point seen_from(const Point& a, const SeenParticle& seen) const {
    const Wall* fixed = nullptr;
    for (const Wall* wall : seen.walls)
      if (wall->kind == BoundaryKind::fixed) fixed = wall;
    if (fixed) return virtual_particle(seen, *fixed, a);
    return seen.real() ? particle(seen.particle) : ghost(seen);
  }

  std::vector<Point> others(std::size_t a) const {
    std::vector<Point> all;
    for (const SeenParticle& seen : points_)
      if (!(seen.real() && seen.particle == a)) all.push_back(seen_from(particle(a), seen));
    return all;
  }

  /// L of eq. (10), with the sign that makes a linear field's gradient exact.
  Mat2 correction(std::size_t a) const {
    if (!formulation_.kernel_correction) return Mat2::Identity();
    Mat2 sum = Mat2::Zero();
    for (const Point& b : others(a))
      sum += b.volume * gradient(now_.particles.position[a] - b.x) *
             (b.x - now_.particles.position[a]).transpose();
    return sum.inverse();
  }

  Vec2 gradient(const Vec2& apart) const { return kernel_gradient(apart, now_.smoothing_length); }

  /// C_ab: artificial viscosity and artificial stress.
  Mat2 stabilisation(const Point& a, const Point& b) const {
    const double h = now_.smoothing_length;
    const Vec2 x = a.x - b.x, v = a.v - b.v;
    double viscosity = 0;
    if (v.dot(x) < 0) {
      const double phi = h * v.dot(x) / (x.squaredNorm() + 0.01 * h * h);
      viscosity = (-formulation_.artificial_viscosity_alpha * (a.sound + b.sound) / 2 * phi +
                   formulation_.artificial_viscosity_beta * phi * phi) /
                  ((a.density + b.density) / 2);
    }
    const Vec2 one_spacing(now_.spacing, 0);
    const double n = kernel(Vec2::Zero(), h) / kernel(one_spacing, h);
    const double f = kernel(x, h) / kernel(one_spacing, h), epsilon = formulation_.artificial_stress;
    return -viscosity * Mat2::Identity() +
           std::pow(f, n) * (artificial_stress(a, epsilon) + artificial_stress(b, epsilon));
  }

  Vec2 acceleration(std::size_t index) const {
    const Point a = particle(index);
    const Mat2 l = correction(index);
    Vec2 sum = now_.gravity;
    for (const Point& b : others(index)) {
      const double mass = b.density * b.volume;
      const Mat2 stress = formulation_.motion == Motion::rho_squared
                              ? Mat2(a.stress / std::pow(a.density, 2) + b.stress / std::pow(b.density, 2))
                              : Mat2((a.stress + b.stress) / (a.density * b.density));
      const double pressure =
          formulation_.motion == Motion::conventional ? b.pressure + a.pressure : b.pressure - a.pressure;
      const Vec2 g = l * gradient(a.x - b.x);
      sum += mass * (stress + stabilisation(a, b)) * g + mass / (a.density * b.density) * pressure * g;
    }
    return sum;
  }

  /// Of which eqs. (29) and (31) are the halves.
  Mat2 velocity_gradient(std::size_t index) const {
    const Point a = particle(index);
    const Mat2 l = correction(index);
    Mat2 sum = Mat2::Zero();
    for (const Point& b : others(index))
      sum += b.volume * (b.v - a.v) * (l * gradient(a.x - b.x)).transpose();
    return sum;
  }

  FormulationCase formulation_;
  const Model& start_;
  const Model& now_;
  std::vector<SeenParticle> points_;
};

}  // namespace

Result paper_form(const FormulationCase& formulation, const Model& start, const Model& now) {
  return PaperForm(formulation, start, now).result();
}

}  // namespace porosph::oracle
