// What a run, or a stage of it, hands on to the next.
#pragma once

#include <map>
#include <string>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/run/sheets.hpp"

namespace porosph {

/// The state of the soil at one instant, and the case that it is of.
struct HandedOver {
  Case scene;
  Particles particles;                             ///< velocities at the present instant
  Point origin = Point::Zero();                    ///< of their positions [m]
  std::map<std::string, double> settlements = {};  ///< of the footings, by their names [m]
  std::map<std::string, SheetState> sheets = {};   ///< by their names
};

/// How a simulation begins, where it does not at rest at t = 0.
struct Beginning {
  double time = 0;                    ///< [s]
  const HandedOver* state = nullptr;  ///< null: as drawn
  bool reset_displacements = false;   ///< displacements count from here
};

/// Gives the particles of a model that was built from `scene` the state that was handed over: those of soils
/// of the same name that were drawn in the same place keep position, velocity, stress and what they remember.
/// Mass, and strength that the particles remember, change by as much as the cases differ in them. New
/// particles stand on the ground as it lies: they move with what is near them, and displacements count from
/// there. Throws std::runtime_error, naming the soil, where one of the same name has other particles.
void take_over(const Beginning& beginning, const Case& scene, Model& model);

}  // namespace porosph
