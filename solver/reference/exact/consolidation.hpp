// Consolidation with closed solutions: layers under a sudden load, and Mandel's specimen between two plates.
#pragma once

#include <vector>

namespace porosph {

/// A layer of height 1 that drains at its top under a sudden uniform load: excess pressure over the load, at
/// a depth and at T = c_v t / H^2. Source: Terzaghi, Theoretical Soil Mechanics (1943).
double terzaghi_pressure(double depth, double factor);
/// Its settlement over the last one.
double terzaghi_degree(double factor);
/// The same where the load is the layer's own weight: over gamma' H, it grows with depth.
double own_weight_pressure(double depth, double factor);
double own_weight_degree(double factor);

/// Two layers, the upper one drained at its top, the lower one closed at its bottom, under a sudden uniform
/// load. Eigenfunctions X of k X'' + (lambda^2 / M) gamma_w X = 0, which keep pressure and flow where they
/// meet. Source: Gray, Trans. ASCE 110 (1945).
class TwoLayers {
 public:
  struct Layer {
    double thickness;     ///< [m]
    double permeability;  ///< k [m/s]
    double modulus;       ///< M [Pa]
  };
  TwoLayers(const Layer& upper, const Layer& lower, double unit_weight_water);

  /// Excess pressure over the load, `depth` [m] below the top at a time > 0 [s].
  double pressure(double depth, double time) const;
  /// Settlement of the top over its last one.
  double degree(double time) const;

 private:
  struct Term {
    double lambda;                  ///< [1/sqrt s]
    double amplitude;               ///< of the load's expansion
    double at_joint;                ///< sin a / cos b
    double upper_area, lower_area;  ///< integrals of X over each layer [m]
  };
  Layer upper_, lower_;
  double root_c1_, root_c2_;  ///< of c_v [m/sqrt s]
  std::vector<Term> terms_;
};

/// A specimen of width 2a between two rigid smooth plates, which are pressed together by a sudden force 2F
/// and stay so; its sides drain. Grains and water keep their volume. The pressure in the middle rises at
/// first. Sources: Mandel, Geotechnique 3 (1953); Abousleiman et al., Geotechnique 46 (1996).
class Mandel {
 public:
  explicit Mandel(double poissons_ratio);

  /// Excess pressure over F / a, at x / a from the middle, at T = c_v t / a^2 > 0.
  double pressure(double x, double factor) const;
  /// Total vertical stress over -F / a there.
  double vertical_stress(double x, double factor) const;
  /// Vertical strain over -F / (2 G a).
  double strain(double factor) const;

 private:
  double nu_;
  std::vector<double> roots_;  ///< tan b = b (1 - nu) / (1/2 - nu)
};

}  // namespace porosph
