// The step of the soil laws over a tile of particles: F, stress, density, and what the next forces read. For
// the kernels only, which are compiled for each kind of vector units.
#pragma once

#include <cmath>

#include "solver/sph/kernels/matrices.hpp"
#include "solver/sph/kernels/mid_step.hpp"
#include "solver/sph/kernels/soil_step.hpp"
#include "solver/sph/kernels/tile.hpp"
#include "solver/sph/stabilisation/bulk_viscosity.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// The arrays of a tile, each from the tile's first particle on, and what a step does with them. All of it
/// must be inlined, or the loops over particles do not become vector code.
template <class Space>
struct TileStep {
  static constexpr int matrix = matrix_size<Space>, gradients = gradient_size<Space>;
  using Stress = Symmetric<Space>;
  using Gradient = GradientIn<Space>;

  TileStep(const ConsistentArraysIn<Space>& c, const TileRange& tile, const Row* rates, Row* piola_rows,
           double step)
      : particle(tile.first),
        reference(c.reference),
        state(c.state),
        fluxes(c.fluxes),
        control(c.control),
        flow(c.flow),
        excess_share(c.state.excess ? 1 : 0),
        dt(step),
        half(0.5 * step) {
    if (!c.state.excess) state.excess = c.reference.fill;
    const auto begin = [&](auto&... of_all) { ((of_all += of_all ? particle : 0), ...); };
    begin(reference.density, reference.fill, reference.radius, fluxes.hoop);
    begin(state.density, state.yields, state.excess);
    begin(flow.viscosity, flow.sheared, flow.bears, flow.deforms, flow.mass);
    state.stress += stress_size<Space> * particle;
    for (int d = 0; d < Space::dim; ++d) velocity[d] = c.motion.velocity[d] + particle;
    for (int k = 0; k < gradients; ++k) rate[k] = rates[k].value, begin(state.deformation[k]);
    for (int k = 0; k < matrix; ++k)
      piola[k] = piola_rows[k].value, begin(reference.correction[k], fluxes.flux[k]);
  }

  /// Velocity gradient at the middle of the step.
  [[gnu::always_inline]] Gradient gradient(std::int32_t i) const {
    const Gradient r = gradient_at<Space>(rate, i);
    return mid_step_gradient(r, plus(gradient_at<Space>(state.deformation, i), half, r));
  }
  /// The same where soil flows, also of particles whose F is not carried by their rate.
  [[gnu::always_inline]] Gradient gradient_in_flow(std::int32_t i) const {
    const Gradient r = gradient_at<Space>(rate, i);
    return mid_step_gradient(r, plus(gradient_at<Space>(state.deformation, i), half * flow.deforms[i], r));
  }
  [[gnu::always_inline]] Stress old_stress(std::int32_t i) const {
    const double* s = state.stress + stress_size<Space> * i;
    if constexpr (Space::dim == 3)
      return {s[0], s[1], s[2], s[3], s[4], s[5]};
    else
      return {s[0], s[1], s[2], s[3]};
  }
  [[gnu::always_inline]] void store_stress(std::int32_t i, const Stress& s) const {
    double* to = state.stress + stress_size<Space> * i;
    to[0] = s.xx, to[1] = s.yy, to[2] = s.zz, to[3] = s.xy;
    if constexpr (Space::dim == 3) to[4] = s.yz, to[5] = s.xz;
  }

  /// F after the step.
  [[gnu::always_inline]] Gradient deformed(std::int32_t i) const {
    const Gradient f = plus(gradient_at<Space>(state.deformation, i), dt, gradient_at<Space>(rate, i));
    put(state.deformation, i, f);
    return f;
  }
  /// The same where soil flows, but of particles whose F is not carried by their rate.
  [[gnu::always_inline]] Gradient deformed_in_flow(std::int32_t i) const {
    const Gradient f =
        plus(gradient_at<Space>(state.deformation, i), dt * flow.deforms[i], gradient_at<Space>(rate, i));
    put(state.deformation, i, f);
    return f;
  }
  /// The density there.
  [[gnu::always_inline]] double compressed(std::int32_t i, const Gradient& f, double& strain,
                                           double& speed_squared) const {
    const double rho = reference.density[i] / determinant(f);
    state.density[i] = rho;
    strain = larger(strain, largest_strain(f));
    double squared = velocity[0][i] * velocity[0][i] + velocity[1][i] * velocity[1][i];
    if constexpr (Space::dim == 3) squared += velocity[2][i] * velocity[2][i];
    speed_squared = larger(speed_squared, squared);
    return rho;
  }

  /// dF/dt + k (F - I), which the zero-energy control acts on.
  [[gnu::always_inline]] MatrixOf<Space> controlled(std::int32_t i, const Gradient& f, double k) const {
    return plus_strain(matrix_at<Space>(rate, i), k, matrix_of(f));
  }

  /// P, and the flux fill P L less the zero-energy control, of the effective stress `s` and p_e.
  [[gnu::always_inline]] void write_flux(std::int32_t i, const Stress& s, const Gradient& f, double rho,
                                         double modulus, double dilatation, const MatrixOf<Space>& controlled,
                                         double viscosity) const {
    const double q = bulk_viscosity(control.bulk_length, std::sqrt(modulus * rho), dilatation);
    const Gradient p = first_piola(s.plus_isotropic(q).plus_isotropic(excess_share * state.excess[i]), f);
    put(piola, i, matrix_of(p));
    const MatrixOf<Space> of_fill =
        product(matrix_of(p), scaled(reference.fill[i], matrix_at<Space>(reference.correction, i)));
    const MatrixOf<Space> net = less(of_fill, viscosity, controlled);
    if constexpr (has_hoop<Space>) {
      fluxes.hoop[i] = p.zz;
      put(fluxes.flux, i, scaled(reference.radius[i], net));
    } else {
      put(fluxes.flux, i, net);
    }
  }

  /// mu of FlowView.
  [[gnu::always_inline]] double bounded_viscosity(std::int32_t i, const Gradient& g, double density_now,
                                                  double strength, double sin_phi, double yielding) const {
    const double gamma = shear_rate_of(g);
    const double least = sin_phi * density_now * flow.weight, k = strength > least ? strength : least;
    // As k / gamma may be too large for a number: compared as products.
    const double inertial = density_now * flow.length_squared * gamma;
    const bool bounded = flow.bears[i] > 0 && 0.1 * k < (control.viscosity - inertial) * gamma;
    const double bound = 0.1 * k / (bounded ? gamma : 1) + inertial;
    flow.sheared[i] += dt * yielding * gamma;
    return flow.viscosity[i] = bounded ? bound : control.viscosity;
  }

  std::int32_t particle;  ///< the tile's first
  ReferenceViewIn<Space> reference;
  SoilStateViewIn<Space> state;
  FluxViewIn<Space> fluxes;
  StabilisationView control;
  FlowView flow;
  double excess_share;  ///< 0: the soil carries none, and `excess` is any array
  double dt, half;
  const double *velocity[Space::dim], *rate[gradients];
  double* piola[matrix];
};

/// 1 where the law's stress is not that of an elastic step, or else 0.
template <class Space>
[[gnu::always_inline]] inline double departs(const Symmetric<Space>& s, const Symmetric<Space>& elastic) {
  return size_of(s + elastic * -1.0) > 1e-9 * size_of(elastic) ? 1 : 0;
}

/// What a step finds out beyond stress: nothing, which particles yield, or also what flow asks for.
enum class Watch { nothing, yielding, flow };

/// mu of the control; the soil of a law without end keeps the common one.
template <class Space, SoilLaw<Space> Law>
[[gnu::always_inline]] inline double control_viscosity(const TileStep<Space>& t, std::int32_t i,
                                                       const Law& law, const Symmetric<Space>& s,
                                                       const typename Law::History& q,
                                                       const GradientIn<Space>& g, double density,
                                                       double yields) {
  // Where stiffness follows the state, stress alternates from particle to particle in elastic soil as well.
  constexpr bool always = requires { Law::stiffness_varies; };
  if constexpr (YieldingLaw<Law, Space>)
    return t.bounded_viscosity(i, g, density, law.shear_strength(s, q), law.sin_friction(q),
                               always ? 1 : yields);
  return t.flow.viscosity[i] = t.control.viscosity;
}

/// What flow asks for of a particle's step.
struct FlowTerms {
  double mu;                ///< of the control [Pa s]
  double plastic, viscous;  ///< dissipated by the law and by bulk viscosity [J/m]
};

template <class Space, SoilLaw<Space> Law>
[[gnu::always_inline]] inline FlowTerms flow_terms(const TileStep<Space>& t, std::int32_t i, const Law& law,
                                                   const Symmetric<Space>& old, const Symmetric<Space>& s,
                                                   const typename Law::History& q, const GradientIn<Space>& g,
                                                   double density, double modulus, double yields) {
  const double work = 0.5 * t.dt * power(old + s, g);
  const double trace = g.trace(), volume = t.flow.mass[i] / density;
  const double resisted =
      t.dt * bulk_viscosity(t.control.bulk_length, std::sqrt(modulus * density), trace) * trace;
  return {.mu = control_viscosity(t, i, law, s, q, g, density, yields),
          .plastic = volume * (work - law.stored_energy(s) + law.stored_energy(old)),
          .viscous = volume * resisted};
}

/// What the loops over a tile's particles find: a maximum of each of the first two, a sum of the others.
struct Found {
  double &strain, &speed_squared, &plastic, &viscous;
};

/// What a step does with the gradient where no other soil is near; OwnSideStep does it elsewhere.
template <class Space>
struct OneSoilStep {
  [[gnu::always_inline]] const GradientIn<Space>& gradient(std::int32_t, const GradientIn<Space>& g) const {
    return g;
  }
  [[gnu::always_inline]] const Symmetric<Space>& tied(std::int32_t, const Symmetric<Space>& s,
                                                      const GradientIn<Space>&, double, double) const {
    return s;
  }
  [[gnu::always_inline]] MatrixOf<Space> controlled(const TileStep<Space>& t, std::int32_t i, std::int32_t,
                                                    const GradientIn<Space>& f) const {
    return t.controlled(i, f, elastic);
  }

  double elastic;  ///< k of the control in this soil [1/s]
};

/// Particle i of the tile, and j of those with this law. In a function of its own, because what a loop's body
/// itself declares and hands on by reference, such as the history, stays in memory, and the loop does not
/// become vector code.
template <class Space, SoilLaw<Space> Law, Watch watch, class Side>
[[gnu::always_inline]] inline void particle_step(const TileStep<Space>& t, const Side& side, std::int32_t i,
                                                 std::int32_t j, const Law& law, double* const* history,
                                                 const Found& found) {
  const GradientIn<Space> gradient =
      side.gradient(j, watch == Watch::flow ? t.gradient_in_flow(i) : t.gradient(i));
  typename Law::History q = load_history<Law>(history, i);
  const double bears = watch == Watch::flow ? t.flow.bears[i] : 1;
  const Symmetric<Space> old = t.old_stress(i), s = law.step(old, gradient, t.dt, q) * bears;
  const bool watched = watch != Watch::nothing;
  const double yields = watched ? departs(s, law.elastic_step(old, gradient, t.dt)) : 0;
  if (watched) t.state.yields[i] = yields;
  store_history<Law>(history, i, q);
  t.store_stress(i, s);
  const GradientIn<Space> f = watch == Watch::flow ? t.deformed_in_flow(i) : t.deformed(i);
  const double density = t.compressed(i, f, found.strain, found.speed_squared);
  const double modulus = law.constrained_modulus(s, q);
  double mu = t.control.viscosity;
  if (watch == Watch::flow) {
    const FlowTerms flow = flow_terms(t, i, law, old, s, q, gradient, density, modulus, yields);
    mu = flow.mu;
    found.plastic += flow.plastic, found.viscous += flow.viscous;
  }
  t.write_flux(i, side.tied(j, s, gradient, t.dt, yields), f, density, modulus, gradient.trace(),
               side.controlled(t, i, j, f), mu);
}

/// Particles first to last - 1 of the tile, which have this law.
template <class Space, SoilLaw<Space> Law, Watch watch, class Side>
LargestChange material_step(const TileStep<Space>& tile, const Side& side, std::int32_t first,
                            std::int32_t last, const LawView& view) {
  const TileStep<Space> t = tile;  // of this function's own: nothing that is written can be part of it
  const Side own = side;
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k] + t.particle;
  double strain = 0, speed_squared = 0, plastic = 0, viscous = 0;
#pragma omp simd reduction(max : strain, speed_squared) reduction(+ : plastic, viscous)
  for (std::int32_t i = first; i < last; ++i)
    particle_step<Space, Law, watch>(t, own, i, i - first, law, history,
                                     {strain, speed_squared, plastic, viscous});
  return {strain, speed_squared, plastic, viscous};
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
