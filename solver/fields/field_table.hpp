// The one table of the fields that a run can write: it drives output files, charts and documents.
#pragma once

#include <string>
#include <vector>

#include "solver/particles/field.hpp"

namespace porosph {

namespace particle_fields {

inline constexpr Field displacement{"Displacement",    "m", "u", "displacement", "from the position at t = 0",
                                    FieldKind::vector, true};
inline constexpr Field velocity{"Velocity",        "m/s", "v", "velocity", "at the frame's time",
                                FieldKind::vector, true};
inline constexpr Field effective_stress{
    "EffectiveStress",    "Pa", "σ'", "effective stress", "sigma', tension positive",
    FieldKind::symmetric, true};
inline constexpr Field total_stress{
    "TotalStress", "Pa", "σ", "total stress", "sigma = sigma' + p_w I (eq. 12)", FieldKind::symmetric, true};
inline constexpr Field pore_pressure{
    "PorePressure", "Pa", "p_w", "pore pressure", "p_w, negative in compression", FieldKind::scalar, true};
inline constexpr Field density{
    "Density", "kg/m3", "ρ", "density", "mass of soil and pore water per volume", FieldKind::scalar, true};
inline constexpr Field mass{"Mass", "kg/m", "m", "mass", "per metre of thickness", FieldKind::scalar, true};
inline constexpr Field smoothing_length{"SmoothingLength", "m", "h", "smoothing length", "h of the kernel",
                                        FieldKind::scalar, true};
inline constexpr Field soil_id{"SoilId",           "-", "", "soil", "number of the soil in the case, from 0",
                               FieldKind::integer, true};
inline constexpr Field particle_id{
    "ParticleId",       "-", "", "particle", "number of the particle, from 0, the same in all frames",
    FieldKind::integer, true};
inline constexpr Field principal_stress{
    "PrincipalStress",   "Pa", "σ'", "principal effective stress", "of sigma', the most tensile first",
    FieldKind::principal};
inline constexpr Field mean_stress{"MeanStress", "Pa", "tr σ' / 3", "mean effective stress",
                                   "tr(sigma') / 3"};
inline constexpr Field deviatoric_stress{
    "DeviatoricStress",  "Pa", "s", "deviatoric stress", "s = sigma' - tr(sigma') / 3 I, that of sigma too",
    FieldKind::symmetric};
inline constexpr Field von_mises_stress{"VonMisesStress", "Pa", "q", "von Mises stress", "sqrt(3/2 s : s)"};
inline constexpr Field strain{"Strain",
                              "-",
                              "ε",
                              "strain",
                              "Green-Lagrange strain since t = 0 (tensor shear, half of gamma)",
                              FieldKind::symmetric};
inline constexpr Field excess_stress{"ExcessStress",
                                     "Pa",
                                     "Δσ'",
                                     "effective stress in excess of theory",
                                     "sigma' less that of the case's exact solution at rest",
                                     FieldKind::symmetric};
inline constexpr Field yielding{"Yielding", "-", "", "yielding",
                                "1 where the stress is on the yield surface of the soil's law, or else 0"};
inline constexpr Field mobilised_friction{
    "MobilisedFriction", "degrees", "φ_m", "mobilised friction angle",
    "sin(phi_m) = sin(phi) times the share of the shear strength in use; 0 in soil without friction"};

inline constexpr Field head{"Head", "m", "h", "head",
                            "of the pore water: psi + y, in the case's coordinates"};
inline constexpr Field pressure_head{"PressureHead", "m", "ψ", "pressure head",
                                     "of the pore water, positive below the water table"};
inline constexpr Field saturation{"Saturation", "-", "S_e", "saturation",
                                  "effective degree of saturation, 1 below the water table"};
inline constexpr Field darcy_velocity{"DarcyVelocity",  "m/s",           "w",
                                      "Darcy velocity", "-K k_r grad h", FieldKind::vector};
inline constexpr Field hydraulic_gradient{
    "HydraulicGradient", "-", "i", "hydraulic gradient", "-grad h, the way that water is driven",
    FieldKind::vector};
inline constexpr Field gradient_ratio{"GradientRatio", "-", "i_y / i_c", "gradient ratio",
                                      "upward hydraulic gradient over the critical one, i_c = (gamma_sat - "
                                      "gamma_w) / gamma_w: soil floats at 1"};
inline constexpr Field pore_pressure_ratio{"PorePressureRatio", "-", "r_u", "pore pressure ratio",
                                           "-p_w / -(sigma'_yy + p_w), 0 where nothing presses"};

}  // namespace particle_fields

/// All fields, in the order of the documents: those above, then what the soils' laws remember.
const std::vector<Field>& field_table();

/// Names of those that are written where the case does not choose fields, or of those that must be chosen.
std::vector<std::string> standard_field_names();
std::vector<std::string> optional_field_names();

/// The field of this name, or null.
const Field* find_field(std::string_view name);

/// Its unit, such as "Pa"; empty for a plain number and for a field that the table does not have.
std::string field_unit(std::string_view name);

}  // namespace porosph
