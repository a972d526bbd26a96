// Readings at a point that moves with the soil.
#pragma once

#include <string>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/sph/kernel/linear_weights.hpp"

namespace porosph {

/// What a probe reads, in the order of probe_quantities().
struct Reading {
  Stress stress;                     ///< effective [Pa]
  double pore_pressure = 0;          ///< [Pa]
  Vec2 displacement = Vec2::Zero();  ///< [m]

  std::vector<double> values() const {
    return {stress.xx, stress.yy, stress.zz, stress.xy, pore_pressure, displacement.x(), displacement.y()};
  }
};

inline const std::vector<std::string>& probe_quantities() {
  static const std::vector<std::string> names = {
      "EffectiveStress_XX", "EffectiveStress_YY", "EffectiveStress_ZZ", "EffectiveStress_XY",
      "PorePressure",       "Displacement_X",     "Displacement_Y"};
  return names;
}

/// Weights over the particles around the probe at t = 0, exact for linear fields (moving least squares); they
/// stay with those particles.
class Probe {
 public:
  /// `soil`: number in the case file of the one soil that is read, as displacements of soils that were placed
  /// at different times jump between them; -1: all. Throws std::runtime_error where no particle is within the
  /// kernel's support.
  Probe(const ProbeCase& probe, const Model& model, std::int32_t soil = -1);

  /// One in soil that is not there, which reads what is not a number.
  static Probe nowhere(const ProbeCase& probe) { return Probe(probe); }

  Reading read(const Particles& particles) const;
  const std::string& name() const { return name_; }
  const Vec2& start() const { return start_; }  ///< [m]

 private:
  explicit Probe(const ProbeCase& probe) : name_(probe.name), start_(probe.position) {}
  std::string name_;
  Vec2 start_;
  std::vector<std::int32_t> particles_;
  std::vector<double> weights_;
};

}  // namespace porosph
