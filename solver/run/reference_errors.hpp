// How far a run's state is from the exact solution that its case names.
#pragma once

#include <map>
#include <string>

#include "solver/output/frame.hpp"
#include "solver/reference/exact/column.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

struct ReferenceColumn {
  Column column;
  double bottom = 0;  ///< y of the column's fixed bottom [m]
};

/// The column that a case with a reference describes. Throws std::runtime_error where it has several soils.
ReferenceColumn reference_column(const Case& scene);

/// Effective stress of the exact solution at each particle's height at t = 0 [Pa]. Throws std::runtime_error
/// where the case names no reference, or is not one that the reference describes.
std::vector<Stress> reference_stress(const Simulation& simulation);

/// Field (EffectiveStress_YY, ..., Displacement_Y) -> norms over the particles, each at its height at t = 0;
/// empty where the case names no reference. Throws std::runtime_error where the case is not one that the
/// reference describes.
std::map<std::string, ErrorNorms> reference_errors(const Simulation& simulation);

}  // namespace porosph
