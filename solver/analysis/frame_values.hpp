// Numbers of particle data, field by field.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"

namespace porosph {

/// A scalar field, one component of a field, or the magnitude of a vector (no component).
struct FieldSelection {
  std::string name, component;
  std::string text() const {
    return component.empty() ? name : name + "_" + component;
  }  ///< fit for file names
};

/// "EffectiveStress:YY", "Displacement", "PorePressure". Throws std::runtime_error if it is not NAME or
/// NAME:COMPONENT.
FieldSelection parse_selection(const std::string& text);

/// One value per particle, as in the file (SI units), or computed from fields of the frame
/// (derived_fields.hpp). Throws std::runtime_error, naming what the frame has and what can be computed from
/// it, for an unknown field or component, and for a tensor without a component.
std::vector<double> values_of(const Frame& frame, const FieldSelection& selection);

/// Whether the frame itself has the field, and whether it has it or what it is computed from.
bool has_field(const Frame& frame, const std::string& name);
bool can_show(const Frame& frame, const std::string& name);

/// Where the particles were at t = 0. Throws std::runtime_error if the frame has no Displacement.
std::vector<Point> starts_of(const Frame& frame);

/// Mass / Density, or all equal where the frame lacks them [m2].
std::vector<double> volumes_of(const Frame& frame);

/// Largest absolute finite value; 0 if there is none.
double largest_of(const std::vector<double>& values);

}  // namespace porosph
