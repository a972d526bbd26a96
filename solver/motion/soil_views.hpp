// The soils of a model as the hot loops see them.
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "solver/motion/kernels/soil_view.hpp"

namespace porosph {

/// Refers to the model, whose particles keep their soils.
class SoilViews {
 public:
  explicit SoilViews(Model& model) : model_(model), ranges_(soil_ranges(model.particles.soil)) {}

  /// Of the model's present laws and their history.
  SoilView view();
  const std::vector<SoilRange>& ranges() const { return ranges_; }

 private:
  Model& model_;
  std::vector<SoilRange> ranges_;
  std::vector<std::vector<double*>> history_;
  std::vector<LawView> laws_;
};

}  // namespace porosph
