// The soils of a model as the hot loops see them.
#pragma once

#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/sph/kernels/soil_view.hpp"

namespace porosph {

/// Refers to the model, whose particles keep their soils.
class SoilViews {
 public:
  explicit SoilViews(Model& model) : model_(model) { set_own_sides({}); }

  /// `place` of each particle as in OwnSides; empty where all soils are alike.
  void set_own_sides(std::span<const std::int32_t> place);

  /// Of the model's present laws and their history.
  SoilView view();

 private:
  Model& model_;
  std::vector<SoilRange> ranges_;
  std::vector<std::vector<double*>> history_;
  std::vector<LawView> laws_;
};

}  // namespace porosph
