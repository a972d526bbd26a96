// The keys of the momentum equation and its artificial terms.
#include <array>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"

namespace porosph {
namespace {

constexpr std::array<std::string_view, 4> motions{"conventional", "proposed", "rho_squared", "consistent"};

}  // namespace

std::string_view motion_name(Motion motion) { return motions[static_cast<std::size_t>(motion)]; }

// Strengths of the artificial terms as in Bui et al. 2008 (Int. J. Numer. Anal. Meth. Geomech. 32).
FormulationCase default_formulation(Motion motion) {
  FormulationCase c;
  c.motion = motion;
  if (motion == Motion::consistent) {
    c.bulk_viscosity = -1;
    c.zero_energy_control = 0.2;  // by the map cases/stability/refresh_zero_energy.toml
    c.refresh_strain = -1;
  } else {
    c.artificial_viscosity_alpha = 0.1;
  }
  return c;
}

void declare(Fields& f, FormulationCase& c) {
  f.choice(
      Key("motion", "",
          "Momentum equation. `conventional`: eq. (17), `proposed`: eq. (24), `rho_squared`: eq. (25) of the "
          "paper; `consistent`: each stress with its own correction matrix."),
      c.motion, motions);
  f.set_defaults([&] { c = default_formulation(c.motion); });
  f.flag(Key("kernel_correction", "", "Gradients exact for linear fields, eqs. (9) and (10)."),
         c.kernel_correction);
  const bool consistent = c.motion == Motion::consistent;
  const auto key = [&](std::string_view name, std::string_view meaning) {
    return Key(name, "", meaning).only_if(!consistent, "motion = one of the paper's forms");
  };
  const FormulationCase paper = default_formulation(Motion::proposed);
  f.number(key("artificial_viscosity_alpha", "Linear term of the viscosity between pairs; 0: off.")
               .otherwise(fmt::to_string(paper.artificial_viscosity_alpha)),
           c.artificial_viscosity_alpha, between(0, 10));
  f.number(key("artificial_viscosity_beta", "Quadratic term of the viscosity between pairs; 0: off."),
           c.artificial_viscosity_beta, between(0, 10));
  f.number(key("artificial_stress", "Strength of the artificial stress against clumping; 0: off.")
               .otherwise(fmt::to_string(paper.artificial_stress)),
           c.artificial_stress, between(0, 1));

  const auto key_of_consistent = [&](std::string_view name, std::string_view meaning) {
    return Key(name, "", meaning).only_if(consistent, "motion = \"consistent\"");
  };
  const FormulationCase usual = default_formulation(Motion::consistent);
  f.number(key_of_consistent("bulk_viscosity", "Viscosity of each particle in compression; 0: off.")
               .otherwise("0.06, but 0 where a soil yields"),
           c.bulk_viscosity, between(0, 10));
  f.number(key_of_consistent("zero_energy_control",
                             "Viscosity on the part of the motion that no gradient sees; 0: off.")
               .otherwise(fmt::to_string(usual.zero_energy_control)),
           c.zero_energy_control, between(0, 1));
  f.number(key_of_consistent("zero_energy_stiffness",
                             "Elastic part of that control: a spring of this times the control's strength "
                             "times the constrained modulus of the softest soil in reach; 0: viscous only.")
               .otherwise(
                   "0.2 where soils of different stiffness meet, 0.1 where outlines cut cells, footings "
                   "press elastic soil, or loads an elastic `lattice`; 0.05 where either press elastic soil "
                   "at rest whose water is coupled or undrained, and 0.01 where that soil may yield; 0.6 "
                   "where walls turn corners, slits "
                   "part the soil, bodies are apart or gradients had to be closed; 0.1 in place of these "
                   "if soil may yield; else 0"),
           c.zero_energy_stiffness, between(0, 10));
  f.number(key_of_consistent("refresh_strain",
                             "Strain or rotation after which kernel gradients are rebuilt; 0: every step.")
               .otherwise("0.02, but 0.05 in soil that has flowed and 0.1 where elastic bodies are apart"),
           c.refresh_strain, between(0, 0.1));
  f.flag(key_of_consistent(
             "closed_gradients",
             "Change the gradients of disordered particles so that a uniform stress is in balance."),
         c.closed_gradients);
  f.flag(key_of_consistent(
             "single_precision",
             "Store kernel gradients in single precision: less memory where particles lie irregularly."),
         c.single_precision);
}

}  // namespace porosph
