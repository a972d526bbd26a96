// The step of the soil laws over a tile of particles: F, stress, density, and what the next forces read. For
// the kernels only, which are compiled for each kind of vector units.
#pragma once

#include <cmath>

#include "solver/sph/kernels/mid_step.hpp"
#include "solver/sph/kernels/soil_step.hpp"
#include "solver/sph/kernels/tile.hpp"
#include "solver/sph/stabilisation/bulk_viscosity.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// By value: std::max keeps the loop from becoming vector code.
inline double larger(double a, double b) { return a > b ? a : b; }

/// The arrays of a tile, each from the tile's first particle on, and what a step does with them. All of it
/// must be inlined, or the loops over particles do not become vector code.
struct TileStep {
  TileStep(const ConsistentArrays& c, const TileRange& tile, const Row* rates, Row* piola_rows, double step)
      : particle(tile.first),
        vx(c.motion.velocity[0] + tile.first),
        vy(c.motion.velocity[1] + tile.first),
        reference_density(c.reference.density + tile.first),
        fill(c.reference.fill + tile.first),
        stress(c.state.stress + 4 * tile.first),
        density(c.state.density + tile.first),
        yields(c.state.yields ? c.state.yields + tile.first : nullptr),
        viscosity(c.flow.viscosity ? c.flow.viscosity + tile.first : nullptr),
        shear_rate(c.flow.viscosity ? c.flow.shear_rate + tile.first : nullptr),
        mass(c.flow.mass + (c.flow.viscosity ? tile.first : 0)),
        mu(c.control.viscosity),
        length_squared(c.flow.length_squared),
        weight(c.flow.weight),
        bulk_length(c.control.bulk_length),
        dt(step),
        half(0.5 * step) {
    for (int k = 0; k < 4; ++k) {
      rate[k] = rates[k].value, piola[k] = piola_rows[k].value;
      deformation[k] = c.state.deformation[k] + tile.first;
      correction[k] = c.reference.correction[k] + tile.first;
      flux[k] = c.fluxes.flux[k] + tile.first;
    }
  }

  /// Velocity gradient at the middle of the step.
  [[gnu::always_inline]] Gradient gradient(std::int32_t i) const {
    const double rxx = rate[xx][i], rxy = rate[xy][i], ryx = rate[yx][i], ryy = rate[yy][i];
    return mid_step_gradient({rxx, rxy, ryx, ryy},
                             {deformation[xx][i] + half * rxx, deformation[xy][i] + half * rxy,
                              deformation[yx][i] + half * ryx, deformation[yy][i] + half * ryy});
  }
  [[gnu::always_inline]] Stress old_stress(std::int32_t i) const {
    return {stress[4 * i], stress[4 * i + 1], stress[4 * i + 2], stress[4 * i + 3]};
  }
  [[gnu::always_inline]] void store_stress(std::int32_t i, const Stress& s) const {
    stress[4 * i] = s.xx, stress[4 * i + 1] = s.yy, stress[4 * i + 2] = s.zz, stress[4 * i + 3] = s.xy;
  }

  /// F and density after the step.
  struct Deformed {
    double xx, xy, yx, yy, density;
  };
  [[gnu::always_inline]] Deformed deform(std::int32_t i, double& strain, double& speed_squared) const {
    const double fxx = deformation[xx][i] + dt * rate[xx][i], fxy = deformation[xy][i] + dt * rate[xy][i];
    const double fyx = deformation[yx][i] + dt * rate[yx][i], fyy = deformation[yy][i] + dt * rate[yy][i];
    deformation[xx][i] = fxx, deformation[xy][i] = fxy, deformation[yx][i] = fyx, deformation[yy][i] = fyy;
    const double rho = reference_density[i] / (fxx * fyy - fxy * fyx);
    density[i] = rho;
    strain = larger(
        strain, larger(larger(std::abs(fxx - 1), std::abs(fyy - 1)), larger(std::abs(fxy), std::abs(fyx))));
    speed_squared = larger(speed_squared, vx[i] * vx[i] + vy[i] * vy[i]);
    return {fxx, fxy, fyx, fyy, rho};
  }

  /// dF/dt + k (F - I), which the zero-energy control acts on.
  [[gnu::always_inline]] Gradient controlled(std::int32_t i, const Deformed& f, double k) const {
    return {rate[xx][i] + k * (f.xx - 1), rate[xy][i] + k * f.xy, rate[yx][i] + k * f.yx,
            rate[yy][i] + k * (f.yy - 1)};
  }

  /// P, and the flux fill P L less the zero-energy control, of the stress `s`.
  [[gnu::always_inline]] void write_flux(std::int32_t i, const Stress& s, const Deformed& f, double modulus,
                                         double dilatation, const Gradient& control,
                                         double viscosity_of_control) const {
    const double q = bulk_viscosity(bulk_length, std::sqrt(modulus * f.density), dilatation);
    const double txx = s.xx + q, tyy = s.yy + q;  // J F^-T is the cofactor matrix of F
    const double pxx = txx * f.yy - s.xy * f.xy, pxy = s.xy * f.xx - txx * f.yx;
    const double pyx = s.xy * f.yy - tyy * f.xy, pyy = tyy * f.xx - s.xy * f.yx;
    piola[xx][i] = pxx, piola[xy][i] = pxy, piola[yx][i] = pyx, piola[yy][i] = pyy;
    const double sxx = fill[i] * correction[xx][i], sxy = fill[i] * correction[xy][i],
                 syx = fill[i] * correction[yx][i], syy = fill[i] * correction[yy][i];
    flux[xx][i] = pxx * sxx + pxy * syx - viscosity_of_control * control.xx;
    flux[xy][i] = pxx * sxy + pxy * syy - viscosity_of_control * control.xy;
    flux[yx][i] = pyx * sxx + pyy * syx - viscosity_of_control * control.yx;
    flux[yy][i] = pyx * sxy + pyy * syy - viscosity_of_control * control.yy;
  }

  /// mu of FlowView, and gamma for those who ask.
  [[gnu::always_inline]] double bounded_viscosity(std::int32_t i, const Gradient& g, double density_now,
                                                  double strength, double sin_phi) const {
    const double stretch = g.xx - g.yy, slip = g.xy + g.yx;
    const double gamma = std::sqrt(stretch * stretch + slip * slip);
    const double least = sin_phi * density_now * weight, k = strength > least ? strength : least;
    // As k / gamma may be too large for a number: compared as products.
    const double inertial = density_now * length_squared * gamma;
    const bool bounded = 0.1 * k < (mu - inertial) * gamma;
    const double bound = 0.1 * k / (bounded ? gamma : 1) + inertial;
    shear_rate[i] = gamma;
    return viscosity[i] = bounded ? bound : mu;
  }

  std::int32_t particle;  ///< the tile's first
  const double *vx, *vy, *reference_density, *fill;
  double *stress, *density, *yields, *viscosity, *shear_rate;
  const double* mass;
  double mu, length_squared, weight, bulk_length, dt, half;
  const double *rate[4], *correction[4];
  double *piola[4], *deformation[4], *flux[4];
};

/// 1 where the law's stress is not that of an elastic step, or else 0.
[[gnu::always_inline]] inline double departs(const Stress& s, const Stress& elastic) {
  const double off = std::abs(s.xx - elastic.xx) + std::abs(s.yy - elastic.yy) + std::abs(s.xy - elastic.xy);
  return off > 1e-9 * (std::abs(elastic.xx) + std::abs(elastic.yy) + std::abs(elastic.xy)) ? 1 : 0;
}

/// What a step finds out beyond stress: nothing, which particles yield, or also what flow asks for.
enum class Watch { nothing, yielding, flow };

/// mu of the control; the soil of a law without end keeps the common one.
template <SoilLaw Law>
[[gnu::always_inline]] inline double control_viscosity(const TileStep& t, std::int32_t i, const Law& law,
                                                       const Stress& s, const typename Law::History& q,
                                                       const Gradient& g, double density) {
  if constexpr (YieldingLaw<Law>)
    return t.bounded_viscosity(i, g, density, law.shear_strength(s, q), law.sin_friction(q));
  t.shear_rate[i] = 0;
  return t.viscosity[i] = t.mu;
}

/// What flow asks for of a particle's step.
struct FlowTerms {
  double mu;                ///< of the control [Pa s]
  double plastic, viscous;  ///< dissipated by the law and by bulk viscosity [J/m]
};

template <SoilLaw Law>
[[gnu::always_inline]] inline FlowTerms flow_terms(const TileStep& t, std::int32_t i, const Law& law,
                                                   const Stress& old, const Stress& s,
                                                   const typename Law::History& q, const Gradient& g,
                                                   double density, double modulus) {
  const double work =
      0.5 * t.dt * ((old.xx + s.xx) * g.xx + (old.yy + s.yy) * g.yy + (old.xy + s.xy) * (g.xy + g.yx));
  const double trace = g.trace(), volume = t.mass[i] / density;
  const double resisted = t.dt * bulk_viscosity(t.bulk_length, std::sqrt(modulus * density), trace) * trace;
  return {.mu = control_viscosity(t, i, law, s, q, g, density),
          .plastic = volume * (work - law.stored_energy(s) + law.stored_energy(old)),
          .viscous = volume * resisted};
}

/// What the loops over a tile's particles find: a maximum of each of the first two, a sum of the others.
struct Found {
  double &strain, &speed_squared, &plastic, &viscous;
};

/// Particle i of the tile. In a function of its own, because what a loop's body itself declares and hands on
/// by reference, such as the history, stays in memory, and the loop does not become vector code.
template <SoilLaw Law, Watch watch>
[[gnu::always_inline]] inline void particle_step(const TileStep& t, std::int32_t i, const Law& law,
                                                 double* const* history, double elastic, const Found& found) {
  const Gradient gradient = t.gradient(i);
  typename Law::History q = load_history<Law>(history, i);
  const Stress old = t.old_stress(i), s = law.step(old, gradient, t.dt, q);
  if (watch != Watch::nothing) t.yields[i] = departs(s, law.elastic_step(old, gradient, t.dt));
  store_history<Law>(history, i, q);
  t.store_stress(i, s);
  const TileStep::Deformed f = t.deform(i, found.strain, found.speed_squared);
  const double modulus = law.constrained_modulus(s, q);
  double mu = t.mu;
  if (watch == Watch::flow) {
    const FlowTerms flow = flow_terms(t, i, law, old, s, q, gradient, f.density, modulus);
    mu = flow.mu;
    found.plastic += flow.plastic, found.viscous += flow.viscous;
  }
  t.write_flux(i, s, f, modulus, gradient.trace(), t.controlled(i, f, elastic), mu);
}

/// Particles first to last - 1 of the tile, which have this law. `elastic`: k of the control in this soil.
template <SoilLaw Law, Watch watch>
LargestChange material_step(const TileStep& tile, std::int32_t first, std::int32_t last, const LawView& view,
                            double elastic) {
  const TileStep t = tile;  // of this function's own: nothing that is written can be part of it
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k] + t.particle;
  double strain = 0, speed_squared = 0, plastic = 0, viscous = 0;
#pragma omp simd reduction(max : strain, speed_squared) reduction(+ : plastic, viscous)
  for (std::int32_t i = first; i < last; ++i)
    particle_step<Law, watch>(t, i, law, history, elastic, {strain, speed_squared, plastic, viscous});
  return {strain, speed_squared, plastic, viscous};
}

/// What a step at an interface does with the gradient of a particle's own side.
struct OwnSideStep {
  OwnSideStep(const ConsistentArrays& c, std::int32_t first_particle, std::int32_t place)
      : interface_stress(c.state.interface_stress + first_particle),
        along_x(c.state.own_sides.along[0] + place),
        along_y(c.state.own_sides.along[1] + place),
        elastic(c.state.own_sides.rate + place) {
    for (int k = 0; k < 16; ++k) a[k] = c.state.own_sides.gradient[k] + place;
    for (int k = 0; k < 4; ++k) tie[k] = c.state.own_sides.tie[k] + place;
  }

  /// A : m for the particle j of this stretch.
  [[gnu::always_inline]] Gradient own(std::int32_t j, double mxx, double mxy, double myx, double myy) const {
    return {a[0][j] * mxx + a[1][j] * mxy + a[2][j] * myx + a[3][j] * myy,
            a[4][j] * mxx + a[5][j] * mxy + a[6][j] * myx + a[7][j] * myy,
            a[8][j] * mxx + a[9][j] * mxy + a[10][j] * myx + a[11][j] * myy,
            a[12][j] * mxx + a[13][j] * mxy + a[14][j] * myx + a[15][j] * myy};
  }
  /// The own side's strain rate with the rotation of the sum.
  [[gnu::always_inline]] Gradient gradient(std::int32_t j, const Gradient& summed) const {
    const Gradient g = own(j, summed.xx, summed.xy, summed.yx, summed.yy);
    const double shear = 0.5 * (g.xy + g.yx), spin = 0.5 * (summed.yx - summed.xy);
    return {g.xx, shear - spin, shear + spin, g.yy};
  }
  /// Carries tau over the step and adds tau t (x) t to the stress. Soil that yields does not hold it: half of
  /// it goes in each step.
  [[gnu::always_inline]] Stress tied(std::int32_t j, const Stress& s, const Gradient& g, double dt,
                                     double yields) const {
    const double grown = dt * (tie[0][j] * g.xx + tie[1][j] * g.xy + tie[2][j] * g.yx + tie[3][j] * g.yy);
    const double tau = (1 - 0.5 * yields) * interface_stress[j] + (1 - yields) * grown;
    interface_stress[j] = tau;
    const double x = along_x[j], y = along_y[j];
    return {s.xx + tau * x * x, s.yy + tau * y * y, s.zz, s.xy + tau * x * y};
  }
  /// What the zero-energy control acts on at particle i of the tile.
  [[gnu::always_inline]] Gradient controlled(const TileStep& t, std::int32_t i, std::int32_t j,
                                             const TileStep::Deformed& f) const {
    const Gradient c = t.controlled(i, f, elastic[j]);
    return own(j, c.xx, c.xy, c.yx, c.yy);
  }

  double* interface_stress;
  const double *along_x, *along_y, *elastic;
  const double *a[16], *tie[4];
};

/// As particle_step where another soil is near: particle i of the tile, and j of the stretch.
template <SoilLaw Law, Watch watch>
[[gnu::always_inline]] inline void particle_step_at_interface(const TileStep& t, const OwnSideStep& side,
                                                              std::int32_t i, std::int32_t j, const Law& law,
                                                              double* const* history, const Found& found) {
  const Gradient gradient = side.gradient(j, t.gradient(i));
  typename Law::History q = load_history<Law>(history, i);
  const Stress old = t.old_stress(i), s = law.step(old, gradient, t.dt, q);
  const bool watched = watch != Watch::nothing;
  const double yields = watched ? departs(s, law.elastic_step(old, gradient, t.dt)) : 0;
  if (watched) t.yields[i] = yields;
  store_history<Law>(history, i, q);
  t.store_stress(i, s);
  const TileStep::Deformed f = t.deform(i, found.strain, found.speed_squared);
  const double modulus = law.constrained_modulus(s, q);
  double mu = t.mu;
  if (watch == Watch::flow) {
    const FlowTerms flow = flow_terms(t, i, law, old, s, q, gradient, f.density, modulus);
    mu = flow.mu;
    found.plastic += flow.plastic, found.viscous += flow.viscous;
  }
  t.write_flux(i, side.tied(j, s, gradient, t.dt, yields), f, modulus, gradient.trace(),
               side.controlled(t, i, j, f), mu);
}

/// As material_step where another soil is near. `place` of the first particle in the own sides.
template <SoilLaw Law, Watch watch>
LargestChange interface_step(const ConsistentArrays& c, const TileStep& tile, std::int32_t first,
                             std::int32_t last, const LawView& view, std::int32_t place) {
  const TileStep t = tile;
  const OwnSideStep side(c, t.particle + first, place);
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k] + t.particle;
  double strain = 0, speed_squared = 0, plastic = 0, viscous = 0;
#pragma omp simd reduction(max : strain, speed_squared) reduction(+ : plastic, viscous)
  for (std::int32_t j = 0; j < last - first; ++j)
    particle_step_at_interface<Law, watch>(t, side, first + j, j, law, history,
                                           {strain, speed_squared, plastic, viscous});
  return {strain, speed_squared, plastic, viscous};
}

/// Either of them for a law that is called for all particles at once; `place` < 0: no other soil is near.
LargestChange external_step(const ConsistentArrays& c, const TileStep& tile, std::int32_t first,
                            std::int32_t last, const LawView& view, double elastic, std::int32_t place) {
  const TileStep t = tile;
  const OwnSideStep side(c, place < 0 ? 0 : t.particle + first, place < 0 ? 0 : place);
  const auto& law = *static_cast<const ExternalLaw*>(view.law);
  Row gradient[4];
  std::array<Stress, PairStencils::tile> elastic_stress;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient summed = t.gradient(i), g = place < 0 ? summed : side.gradient(i - first, summed);
    elastic_stress[i - first] = law.elastic().elastic_step(t.old_stress(i), g, t.dt);
    gradient[xx].value[i] = g.xx, gradient[xy].value[i] = g.xy;
    gradient[yx].value[i] = g.yx, gradient[yy].value[i] = g.yy;
  }
  double* history[LawView::most_history];
  for (std::size_t k = 0; k < view.history_count; ++k) history[k] = view.history[k] + t.particle + first;
  SoilTile soil{.count = last - first,
                .dt = t.dt,
                .gradient = {},
                .stress = t.stress + 4 * first,
                .history = {history, view.history_count}};
  for (int k = 0; k < 4; ++k) soil.gradient[k] = gradient[k].value + first;
  law.step(soil);
  const double modulus = law.elastic().constrained_modulus();
  double strain = 0, speed_squared = 0;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient g(gradient[xx].value[i], gradient[xy].value[i], gradient[yx].value[i],
                     gradient[yy].value[i]);
    const TileStep::Deformed f = t.deform(i, strain, speed_squared);
    const std::int32_t j = i - first;
    const double yields = departs(t.old_stress(i), elastic_stress[j]);
    if (t.yields) t.yields[i] = yields;
    if (t.viscosity) t.viscosity[i] = t.mu, t.shear_rate[i] = 0;
    if (place < 0)
      t.write_flux(i, t.old_stress(i), f, modulus, g.trace(), t.controlled(i, f, elastic), t.mu);
    else
      t.write_flux(i, side.tied(j, t.old_stress(i), g, t.dt, yields), f, modulus, g.trace(),
                   side.controlled(t, i, j, f), t.mu);
  }
  return {strain, speed_squared};
}

template <SoilLaw Law, Watch watch>
LargestChange step_of(const ConsistentArrays& c, const TileStep& tile, std::int32_t first, std::int32_t last,
                      const LawView& law, double elastic, std::int32_t place) {
  return place < 0 ? material_step<Law, watch>(tile, first, last, law, elastic)
                   : interface_step<Law, watch>(c, tile, first, last, law, place);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
