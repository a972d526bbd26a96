// Materials other than linear elastic in a step that is made for linear elasticity.
#pragma once

#include <memory>
#include <vector>

#include "solver/constitutive/material.hpp"
#include "solver/model/model.hpp"
#include "solver/motion/dynamics.hpp"

namespace porosph {

/// One per soil; null where the soil is linear elastic.
using Materials = std::vector<std::shared_ptr<Material>>;

/// To be called before dynamics.strain(dt): asks the materials for the stress at the end of the step and
/// gives their particles the stress from which the linear elastic step leads there. So the motion equations
/// need not know of materials, and a soil without one costs nothing.
void apply_materials(const Materials& materials, Model& model, Dynamics& dynamics, double dt);

}  // namespace porosph
