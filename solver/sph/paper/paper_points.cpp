#include "solver/sph/paper/paper_points.hpp"

#include <cmath>

namespace porosph {

void PaperPoints::find_ghosts(const Model& model, std::size_t first_roller, double range) {
  places_ = model.particles.position;
  ghosts_ = Ghosts(model.walls, first_roller, model.walls.size(), range, places_);
  const std::size_t all = places_.size();
  for (auto& x : position_) x.resize(all);
  for (auto& v : velocity_) v.resize(all);
  for (auto& s : stress_) s.resize(all);
  for (auto* numbers : {&volume_, &density_, &sound_, &pressure_}) numbers->resize(all);
}

void PaperPoints::take_positions(const Particles& p) {
  const std::size_t n = p.size();
  double *x = position_[0].data(), *y = position_[1].data();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    places_[a] = p.position[a];
    x[a] = p.position[a].x(), y[a] = p.position[a].y();
  }
  ghosts_.for_each([&](std::size_t i) {
    const Vec2 ghost = places_[n + i] = ghosts_.wall(i).mirrored(places_[ghosts_.parent(i)]);
    x[n + i] = ghost.x(), y[n + i] = ghost.y();
  });
}

void PaperPoints::take_volumes(const Model& model) {
  const Particles& p = model.particles;
  const double *mass = p.mass.data(), *rho = p.density.data();
  double *volume = volume_.data(), *density = density_.data(), *sound = sound_.data();
  std::vector<double> shear_moduli;
  for (const Soil& soil : model.soils) shear_moduli.push_back(soil.shear_modulus());
  const double* shear = shear_moduli.data();
  const std::int32_t* soil = p.soil.data();
#pragma omp parallel for simd schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    volume[a] = mass[a] / rho[a];
    density[a] = rho[a];
    sound[a] = std::sqrt(shear[soil[a]] / rho[a]);  // eq. (16)
  }
  for (std::vector<double>* scalars : {&volume_, &density_, &sound_}) ghosts_.fill<Mirrors::scalar>(*scalars);
}

void PaperPoints::take_velocities(const Particles& p) {
  const auto& v = p.velocity;
  double *x = velocity_[0].data(), *y = velocity_[1].data();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < v.size(); ++a) x[a] = v[a].x(), y[a] = v[a].y();
  ghosts_.fill<Mirrors::motion>([&](std::size_t k) { return Vec2(x[k], y[k]); },
                                [&](std::size_t k, const Vec2& u) { x[k] = u.x(), y[k] = u.y(); });
}

void PaperPoints::take_stress(const Model& model, bool over_density) {
  const Particles& p = model.particles;
  double *xx = stress_[0].data(), *yy = stress_[1].data(), *xy = stress_[2].data(),
         *pressure = pressure_.data();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Stress& s = p.stress[a];
    const double scale = over_density ? 1 / p.density[a] : 1;
    xx[a] = s.xx * scale, yy[a] = s.yy * scale, xy[a] = s.xy * scale;
    pressure[a] = p.pore_pressure[a];
  }
  ghosts_.fill<Mirrors::tensor>(
      [&](std::size_t k) { return (Mat2() << xx[k], xy[k], xy[k], yy[k]).finished(); },
      [&](std::size_t k, const Mat2& s) { xx[k] = s(0, 0), yy[k] = s(1, 1), xy[k] = s(0, 1); });
  const std::span<const Vec2> behind_rollers = std::span(places_).subspan(p.size());
  model.pore_water->fill_ghosts(model.water, p, ghosts_, behind_rollers, pressure_);
  if (over_density) return;
#pragma omp parallel for simd schedule(static)
  for (std::size_t i = 0; i < places_.size(); ++i) xx[i] += pressure[i], yy[i] += pressure[i];
}

void PaperPoints::connect(PaperPointsView& c) const {
  for (int k = 0; k < 2; ++k) c.position[k] = position_[k].data(), c.velocity[k] = velocity_[k].data();
  c.volume = volume_.data(), c.density = density_.data(), c.sound = sound_.data();
  for (int k = 0; k < 3; ++k) c.stress[k] = stress_[k].data();
  c.pressure = pressure_.data();
}

}  // namespace porosph
