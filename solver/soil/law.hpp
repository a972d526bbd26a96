// What a soil's law has to offer. One law is one file; solver/soil/laws.hpp lists them.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "solver/particles/field.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

/// A law is a plain struct of parameters. Its step runs inside the loops over particles, once for each kind
/// of vector units, so it may only compute with plain numbers: no call out of line, no branch that selection
/// cannot replace, no loop that ends early.
///
/// What it remembers of a particle, History, is a struct of doubles that are 0 at the start, or what
/// `at_start(position)` or `at_start(position, stress)` says where a law has that. The array `history`
/// describes them in their order, and with that they are in checkpoints and output files.
template <class Law, class Space = Plane>
concept SoilLaw = std::is_trivially_copyable_v<Law> &&
    requires(const Law& law, const Symmetric<Space>& stress, const GradientIn<Space>& gradient, double dt,
             typename Law::History& q) {
  /// Effective stress after a step dt [s] from `stress` with the velocity gradient at its middle [1/s, Pa].
  { law.step(stress, gradient, dt, q) } -> std::same_as<Symmetric<Space>>;
  /// Modulus M of one-dimensional compression at this state: wave speed and time step [Pa].
  { law.constrained_modulus(stress, q) } -> std::same_as<double>;
  /// Elastic energy per volume [J/m3].
  { law.stored_energy(stress) } -> std::same_as<double>;
  /// Elastic shear modulus G and bulk modulus K, the largest that the law may have [Pa].
  { law.shear_modulus } -> std::convertible_to<double>;
  { law.bulk_modulus } -> std::convertible_to<double>;
  { Law::history.size() } -> std::convertible_to<std::size_t>;
};

/// A law with a limited shear strength.
template <class Law, class Space = Plane>
concept YieldingLaw = SoilLaw<Law, Space> &&
    requires(const Law& law, const Symmetric<Space>& stress, const typename Law::History& q) {
  /// Measure of the deviator, and the most of it that the law bears at this state [Pa].
  { law.shear_stress(stress) } -> std::same_as<double>;
  { law.shear_strength(stress, q) } -> std::same_as<double>;
  /// Sine of the friction angle at this state.
  { law.sin_friction(q) } -> std::same_as<double>;
};

/// Of a law that remembers nothing.
struct NoHistory {};

/// What the law remembers of a particle at t = 0 [m, Pa].
template <class Law>
typename Law::History history_at_start(const Law& law, const VectorIn<Plane>& position,
                                       const Symmetric<Plane>& stress) {
  if constexpr (requires { law.at_start(position, stress); })
    return law.at_start(position, stress);
  else if constexpr (requires { law.at_start(position); })
    return law.at_start(position);
  else
    return {};
}

/// How many numbers a law remembers.
template <class Law>
constexpr std::size_t history_size = Law::history.size();

}  // namespace porosph
