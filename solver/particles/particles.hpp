// The soil's state, one entry per particle.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/particles/field.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

/// What a soil's law remembers of each particle: one number, 0 at the start and where the soil's law is
/// another.
struct HistoryField {
  Field field;
  std::vector<double> values;
};

/// Structure of arrays, all of the same length, SI units. Ghosts and virtual particles are not among them.
struct Particles {
  std::vector<Vec2> position, velocity;  ///< [m], [m/s]; between steps the velocity is half a step behind
  std::vector<Vec2> start;               ///< position as drawn, at t = 0 [m]
  std::vector<Stress> stress;            ///< effective [Pa]
  std::vector<double> pore_pressure;     ///< p_w <= 0 [Pa]
  std::vector<double> density;           ///< [kg/m3]
  std::vector<double> mass;              ///< per metre of thickness [kg/m]
  std::vector<double> fill;              ///< part of its cell that is soil: about 1/2 on a free surface
  std::vector<std::int32_t> soil;        ///< index into the model's soils
  std::vector<std::int32_t> id;          ///< number in the arrangement's order
  std::vector<HistoryField> history;     ///< of the soils' laws
  /// Stress along the interface where soils of different stiffness meet, beyond the soil's own [Pa]; empty in
  /// one soil.
  std::vector<double> interface_stress;
  std::vector<Vec2> uncounted;  ///< displacement before they were counted again from 0 [m]; empty: none

  std::size_t size() const { return position.size(); }
  double volume(std::size_t i) const { return mass[i] / density[i]; }  ///< [m2]
  Vec2 displacement(std::size_t i) const {
    const Vec2 moved = position[i] - start[i];
    return uncounted.empty() ? moved : Vec2(moved - uncounted[i]);
  }

  /// Calls use(name, values) for every array that changes from step to step: all that must be kept to
  /// continue from a state. The rest the case gives.
  template <class Use>
  void for_each_changing(Use&& use) {
    use("position", position);
    use("velocity", velocity);
    use("stress", stress);
    use("pore_pressure", pore_pressure);
    use("density", density);
    if (!interface_stress.empty()) use("interface_stress", interface_stress);
    for (HistoryField& h : history) use(h.field.name, h.values);
  }
};

}  // namespace porosph
