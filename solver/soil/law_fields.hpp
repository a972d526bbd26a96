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
inline constexpr Field dilation{.name = "Dilation",
                                .unit = "-",
                                .symbol = "ε_vᵖ",
                                .words = "plastic dilation",
                                .meaning = "volume strain of plastic flow by the dilation angle",
                                .kind = FieldKind::scalar};
inline constexpr Field compaction{
    .name = "Compaction",
    .unit = "-",
    .symbol = "ε_vd",
    .words = "compaction",
    .meaning = "volume strain by which cycles of shear have compacted the grains",
    .kind = FieldKind::scalar};
inline constexpr Field cyclic_strain{.name = "CyclicStrain",
                                     .unit = "-",
                                     .symbol = "γ_xy",
                                     .words = "cyclic shear strain",
                                     .meaning = "shear strain 2 e_xy, whose cycles compact the soil",
                                     .kind = FieldKind::scalar};
inline constexpr Field turning_strain{.name = "TurningStrain",
                                      .unit = "-",
                                      .symbol = "γ_t",
                                      .words = "turning strain",
                                      .meaning = "cyclic shear strain where it last turned",
                                      .kind = FieldKind::scalar};
inline constexpr Field farthest_strain{.name = "FarthestStrain",
                                       .unit = "-",
                                       .symbol = "γ_f",
                                       .words = "farthest strain",
                                       .meaning = "cyclic shear strain that is farthest since it last turned",
                                       .kind = FieldKind::scalar};
inline constexpr Field void_ratio{.name = "VoidRatio",
                                  .unit = "-",
                                  .symbol = "e",
                                  .words = "void ratio",
                                  .meaning = "volume of pores over that of grains, without what has opened",
                                  .kind = FieldKind::scalar};
inline constexpr Field preconsolidation{
    .name = "Preconsolidation",
    .unit = "Pa",
    .symbol = "p_c",
    .words = "preconsolidation pressure",
    .meaning = "mean effective pressure at which soil yields without shear",
    .kind = FieldKind::scalar};
inline constexpr Field undrained_strength{.name = "UndrainedStrength",
                                          .unit = "Pa",
                                          .symbol = "c_u",
                                          .words = "undrained shear strength",
                                          .meaning = "c_u of the case where the particle was at t = 0",
                                          .kind = FieldKind::scalar};

}  // namespace porosph::law_fields
