// Fields that several soil laws remember.
#pragma once

#include "solver/particles/field.hpp"

namespace porosph::law_fields {

inline constexpr Field plastic_strain{.name = "PlasticStrain",
                                      .unit = "-",
                                      .symbol = "εᵖ",
                                      .words = "plastic strain",
                                      .meaning = "sum of sqrt(2/3 de : de), e the deviatoric plastic strain",
                                      .kind = FieldKind::scalar};
inline constexpr Field opening{
    .name = "Opening",
    .unit = "-",
    .symbol = "εᵍ",
    .words = "opening",
    .meaning = "volume strain by which soil has come apart; it closes before the soil bears again",
    .kind = FieldKind::scalar};
inline constexpr Field undrained_strength{.name = "UndrainedStrength",
                                          .unit = "Pa",
                                          .symbol = "c_u",
                                          .words = "undrained shear strength",
                                          .meaning = "c_u of the case where the particle was at t = 0",
                                          .kind = FieldKind::scalar};

}  // namespace porosph::law_fields
