// How far two states are apart at the same material points, field by field.
#pragma once

#include <string>
#include <vector>

#include "solver/analysis/frame_values.hpp"

namespace porosph {

struct FieldNorms {
  FieldSelection field;
  double relative_l2 = 0;  ///< ||value - reference|| / ||reference||, volume-weighted; NaN: reference is zero
  double max_abs = 0;      ///< in the field's SI unit
  Point where = Point::Zero();  ///< of max_abs, at t = 0 [m]
};

/// Values at material points. `scale`: size of the whole field [SI]; a reference of less than 1e-9 of it
/// counts as zero.
FieldNorms norms(const FieldSelection& field, const std::vector<double>& values,
                 const std::vector<double>& reference, const std::vector<Point>& at,
                 const std::vector<double>& volumes, double scale);

/// Displacement, effective stress, total vertical stress and pore pressure, of those that both frames have.
std::vector<FieldSelection> comparable_fields(const Frame& a, const Frame& b);

/// The largest value of all components of the field that are compared [SI].
double largest_component(const Frame& frame, const std::string& name);

}  // namespace porosph
