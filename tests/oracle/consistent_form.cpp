#include <algorithm>
#include <cmath>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/points.hpp"

namespace porosph::oracle {
namespace {

class ConsistentForm {
 public:
  ConsistentForm(const FormulationCase& formulation, const Model& start, const Model& reference,
                 const Model& now, double last_step)
      : formulation_(formulation),
        start_(start),
        reference_(reference),
        now_(now),
        points_(all_points(reference.walls, reference.particles.position)) {
    const std::size_t n = now.particles.size();
    for (std::size_t a = 0; a < n; ++a) {
      correction_.push_back(correction(a));
      rate_.push_back(gradient_of(a, now.particles.velocity));
      std::vector<Vec2> displacement(n);
      for (std::size_t b = 0; b < n; ++b)
        displacement[b] = now.particles.position[b] - reference.particles.position[b];
      deformation_.push_back(Mat2::Identity() + gradient_of(a, displacement));
      const Mat2 mid_step = deformation_[a] - last_step / 2 * rate_[a];
      stress_.push_back(first_piola_kirchhoff(a, rate_[a] * mid_step.inverse()));
    }
    for (std::size_t a = 0; a < n; ++a) stress_slope_.push_back(one_sided_slope(a));
  }

  Result result() const {
    Result r;
    for (std::size_t a = 0; a < rate_.size(); ++a) {
      r.acceleration.push_back(acceleration(a));
      r.velocity_gradient.push_back(rate_[a] * deformation_[a].inverse());
    }
    return r;
  }

 private:
  Vec2 place(const SeenParticle& b) const {
    return place_behind(b.walls, reference_.particles.position[b.particle]);
  }
  double density(std::size_t a) const { return reference_.particles.density[a]; }
  double volume(std::size_t a) const { return reference_.particles.mass[a] / density(a); }

  /// Calls use(b, X_b - X_a, V_b grad_a W_ab) for every other point b.
  template <class Use>
  void for_others(std::size_t a, Use use) const {
    for (const SeenParticle& b : points_) {
      if (b.real() && b.particle == a) continue;
      const Vec2 to_b = place(b) - reference_.particles.position[a];
      use(b, to_b, Vec2(volume(b.particle) * kernel_gradient(-to_b, reference_.smoothing_length)));
    }
  }

  Mat2 correction(std::size_t a) const {
    if (!formulation_.kernel_correction) return Mat2::Identity();
    Mat2 sum = Mat2::Zero();
    for_others(a, [&](const SeenParticle&, const Vec2& to_b, const Vec2& g) { sum += g * to_b.transpose(); });
    return sum.inverse();
  }

  /// sum_b V_b (u_b - u_a) (x) L_a grad W_ab of a motion u.
  Mat2 gradient_of(std::size_t a, const std::vector<Vec2>& u) const {
    Mat2 sum = Mat2::Zero();
    for_others(a, [&](const SeenParticle& b, const Vec2&, const Vec2& g) {
      sum += (motion_behind(b.walls) * u[b.particle] - u[a]) * (correction_[a] * g).transpose();
    });
    return sum;
  }

  /// P = J (sigma' + q I) F^-T, q the bulk viscosity.
  Mat2 first_piola_kirchhoff(std::size_t a, const Mat2& velocity_gradient) const {
    const Stress& s = now_.particles.stress[a];
    const double rho = now_.particles.density[a];
    const double c_p = std::sqrt(now_.soils[now_.particles.soil[a]].constrained_modulus() / rho);
    const double q = formulation_.bulk_viscosity * rho * c_p * now_.smoothing_length *
                     std::min(0.0, velocity_gradient.trace());
    Mat2 cauchy;
    cauchy << s.xx + q, s.xy, s.xy, s.yy + q;
    return deformation_[a].determinant() * cauchy * deformation_[a].inverse().transpose();
  }

  static bool behind_bearing_wall(const SeenParticle& b) {
    return std::any_of(b.walls.begin(), b.walls.end(), [](const Wall* w) { return w->bears_weight; });
  }

  /// dP/dx and dP/dy at a particle from the soil and its images in walls that bear no weight, exact where P
  /// is linear.
  std::array<Mat2, 2> one_sided_slope(std::size_t a) const {
    Mat2 sum = Mat2::Zero();
    std::array<Mat2, 2> raw = {Mat2::Zero(), Mat2::Zero()};
    for_others(a, [&](const SeenParticle& b, const Vec2& to_b, const Vec2& g) {
      if (behind_bearing_wall(b)) return;
      sum += g * to_b.transpose();
      const Mat2 turn = turn_behind(b.walls);
      const Mat2 difference = turn * stress_[b.particle] * turn.transpose() - stress_[a];
      raw[0] += difference * g.x(), raw[1] += difference * g.y();
    });
    const Mat2 l = sum.inverse();
    return {Mat2(l(0, 0) * raw[0] + l(0, 1) * raw[1]), Mat2(l(1, 0) * raw[0] + l(1, 1) * raw[1])};
  }

  /// P of a point: mirrored by rollers that bear no weight; linear behind the others, where rollers carry no
  /// shear.
  Mat2 stress(const SeenParticle& b) const {
    const auto first_free =
        std::find_if(b.walls.begin(), b.walls.end(), [](const Wall* w) { return !w->bears_weight; });
    const std::vector<const Wall*> bearing(b.walls.begin(), first_free), free(first_free, b.walls.end());
    Mat2 p = stress_[b.particle];
    if (!bearing.empty()) {
      const Vec2& from = reference_.particles.position[b.particle];
      const Vec2 way = place_behind(bearing, from) - from;
      p += stress_slope_[b.particle][0] * way.x() + stress_slope_[b.particle][1] * way.y();
      if (bearing.back()->kind == BoundaryKind::roller)
        p = with_opposite_shear(p, stress_[b.particle], *bearing.back());
    }
    const Mat2 turn = turn_behind(free);
    return turn * p * turn.transpose();
  }

  /// In the wall's own axes: the diagonal of `p`, and minus the shear of the particle in front.
  static Mat2 with_opposite_shear(const Mat2& p, const Mat2& in_front, const Wall& wall) {
    Mat2 axes;
    axes.col(0) = (wall.to - wall.from).normalized();
    axes.col(1) = Vec2(-axes(1, 0), axes(0, 0));
    Mat2 local = axes.transpose() * p * axes;
    const Mat2 local_in_front = axes.transpose() * in_front * axes;
    local(0, 1) = -local_in_front(0, 1);
    local(1, 0) = -local_in_front(1, 0);
    return axes * local * axes.transpose();
  }

  double zero_energy_viscosity() const {
    const auto& density = start_.particles.density;
    const double lightest = *std::min_element(density.begin(), density.end());
    const double fastest = start_.wave_speed;  // which sets the time step
    return formulation_.zero_energy_control * lightest * fastest * reference_.smoothing_length;
  }

  Vec2 acceleration(std::size_t a) const {
    const double mu = zero_energy_viscosity();
    Vec2 force = Vec2::Zero(), pressure = Vec2::Zero();
    for_others(a, [&](const SeenParticle& b, const Vec2& to_b, const Vec2& g) {
      const Mat2 turn = turn_behind(b.walls), motion = motion_behind(b.walls);
      const Mat2 l_b = turn * correction_[b.particle] * turn.transpose();
      force += (stress_[a] * correction_[a] + stress(b) * l_b) * g;

      const Mat2 rate_b = motion * rate_[b.particle] * turn.transpose();
      const Vec2 linear = (rate_[a] + rate_b) / 2 * to_b;
      const Vec2 rest = motion * now_.particles.velocity[b.particle] - now_.particles.velocity[a] - linear;
      force += 2 * mu * g.norm() / to_b.norm() * rest;

      const Vec2& in_front = now_.particles.position[b.particle];
      const double p_b = b.real() ? now_.particles.pore_pressure[b.particle]
                                  : pressure_of_image(now_.water, in_front, place_behind(b.walls, in_front));
      pressure += (p_b - now_.particles.pore_pressure[a]) * g;
    });
    const Mat2& f = deformation_[a];
    force += f.determinant() * f.inverse().transpose() * correction_[a] * pressure;
    return force / density(a) + now_.gravity;
  }

  FormulationCase formulation_;
  const Model& start_;
  const Model& reference_;
  const Model& now_;
  std::vector<SeenParticle> points_;
  std::vector<Mat2> correction_;   // L
  std::vector<Mat2> rate_;         // dF/dt
  std::vector<Mat2> deformation_;  // F
  std::vector<Mat2> stress_;       // P
  std::vector<std::array<Mat2, 2>> stress_slope_;
};

}  // namespace

Result consistent_form(const FormulationCase& formulation, const Model& start, const Model& reference,
                       const Model& now, double last_step) {
  return ConsistentForm(formulation, start, reference, now, last_step).result();
}

}  // namespace porosph::oracle
