// How far two states are apart, field by field.
#pragma once

#include <vector>

#include "solver/analysis/field_norms.hpp"
#include "vtk_io/finished_run/fem_reference.hpp"
#include "vtk_io/finished_run/material_points.hpp"

namespace porosph {

/// All comparable fields, b the reference.
std::vector<FieldNorms> run_norms(const Frame& a, const Frame& b, const MaterialPoints& points);

/// A place where a reference is not to be trusted, such as a toe, where its stress is singular.
struct LeftOut {
  Point at;
  double radius = 0;  ///< [m]
};

/// Throws std::runtime_error, naming what differs, if the reference is of another soil, outline or water than
/// the run.
void require_same_problem(const FinishedRun& run, const FemReference& fem);

/// One field of the run's particles against the finite-element reference, as fem_norms.
FieldNorms fem_norm(const Frame& frame, const FemReference& fem, const FieldSelection& field,
                    const std::vector<LeftOut>& left_out);

/// The run's particles against the finite-element reference, without those near `left_out` or outside of its
/// mesh. Throws std::runtime_error if no particle is left.
std::vector<FieldNorms> fem_norms(const Frame& frame, const FemReference& fem,
                                  const std::vector<LeftOut>& left_out);

}  // namespace porosph
