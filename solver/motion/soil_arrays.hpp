// The soils' elasticity as plain arrays, for the kernels.
#pragma once

#include <vector>

#include "solver/model/model.hpp"

namespace porosph {

/// One entry per particle; one entry only where there is one soil.
struct SoilArrays {
  std::vector<double> shear_modulus, bulk_modulus;  ///< [Pa]
  std::vector<double> no_tension;                   ///< 1 or 0

  explicit SoilArrays(const Model& model) {
    if (model.soils.size() == 1)
      add(model.soils.front());
    else
      for (const std::int32_t soil : model.particles.soil) add(model.soils[soil]);
  }

 private:
  void add(const LinearElastic& soil) {
    shear_modulus.push_back(soil.shear_modulus);
    bulk_modulus.push_back(soil.bulk_modulus);
    no_tension.push_back(soil.no_tension ? 1.0 : 0.0);
  }
};

}  // namespace porosph
