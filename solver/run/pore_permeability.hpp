// Permeability that follows the pores of saturated soil as it deforms.
#pragma once

#include <span>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/particles/state.hpp"
#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

class PorePermeability {
 public:
  /// Of particles as they were drawn.
  PorePermeability(const std::vector<SoilCase>& soils, const Particles& particles);

  /// Whether that of any soil does.
  bool follows() const { return !porosity_.empty(); }
  /// By the volume that each particle has gained since [m2]. Throws std::runtime_error where a soil has no
  /// pores left.
  void follow(std::span<const double> gained);
  /// k of each particle over that at the start; empty where none follows.
  const std::vector<double>& ratio() const { return ratio_; }
  double ratio(std::size_t a) const { return ratio_.empty() ? 1 : ratio_[a]; }
  void visit(StateArchive& state) { state.array("permeability_ratio", ratio_); }

 private:
  std::vector<double> porosity_;  ///< at the start; 0 where k stays
  std::vector<double> volume_;    ///< at the start [m2]
  std::vector<double> ratio_;
};

}  // namespace porosph
