// The state of rest of a soil column, with the settlement's effect on buoyancy.
#pragma once

#include <vector>

#include "solver/reference/exact/column.hpp"

namespace porosph {

/// Exact for the hypo-elastic law that the particles obey in one dimension, sigma' = M ln(stretch).
///
/// Weight goes with mass, so per initial height Y it stays gamma; the water pushes per present height dy =
/// stretch dY. With s = sigma'/M, equilibrium is
///     ds/dY = a - b exp(s),   a = gamma/M,  b = gamma_w/M below the water level, 0 above.
/// In w = exp(-s) this is linear, dw/dY = b - a w, and a depth D below a place with s = s_0
///     s = s_0 - ln(1 + (1 - (b/a) exp(s_0)) (exp(a D) - 1)).
/// Heights follow from the equation itself: b exp(s) dY = a dY - ds.
///
/// Soil above the water level before loading has gamma_unsat, below gamma_sat. What sinks below the level in
/// settling keeps its weight and becomes buoyant; the initial height of that place is the root of one
/// equation.
class FiniteStrainColumn {
 public:
  /// surface_stress: vertical effective stress at the ground [Pa]. Throws std::invalid_argument, see check().
  explicit FiniteStrainColumn(const Column& column, double surface_stress = 0);

  double vertical_stress(double initial_height) const;  ///< sigma'_yy [Pa]
  double lateral_stress(double initial_height) const;   ///< sigma'_xx = sigma'_zz = lambda/M sigma'_yy [Pa]
  double displacement(double initial_height) const;     ///< upwards [m]
  double settlement() const { return -displacement(column_.height); }  ///< of the ground, downwards [m]

 private:
  /// A stretch of initial heights of one weight, buoyant or not.
  struct Layer {
    double bottom = 0, top = 0;  // initial heights [m]
    double a = 0, b = 0;         // gamma / M and gamma_w / M [1/m]
    double s_top = 0;            // sigma' / M at its top [-]
    double present_bottom = 0;   // height of its bottom at rest [m]
    double s(double initial_height) const;
    double present_thickness(double initial_height) const;  // from its bottom to there [m]
  };
  void build(double surface_s, double wetted_height);
  const Layer& layer_at(double initial_height) const;
  double present_height(double initial_height) const;

  Column column_;
  std::vector<Layer> layers_;  // from the top down
};

}  // namespace porosph
