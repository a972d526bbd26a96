// Diffusion of the stress in soil that shears as it yields.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"
#include "solver/sph/consistent/loose_particles.hpp"
#include "solver/sph/consistent/reference.hpp"
#include "solver/sph/kernels/consistent_kernels.hpp"

namespace porosph {

/// What of the stress is not linear from particle to particle is diffused with D = 10 h^2 times the shear
/// rate of the soil that yields: the law's return leaves an alternation that no velocity gradient sees.
/// Particles of one soil share their stress, across periodic sides as well; loose ones have none.
class StressDiffusion {
 public:
  static constexpr int steps_between = 2;  ///< what they shear is diffused at once

  StressDiffusion() = default;
  explicit StressDiffusion(std::size_t particles) : sheared_(particles, 0), has_sheared_(particles, 0) {}

  /// For a new reference; `correction` is L of eq. (10) of the particles, by the soil alone.
  void take(const ReferenceConfiguration& reference, const Model& model, const LooseParticles& loose,
            std::span<const Mat2> correction);

  /// Diffuses what the last steps have sheared, in one of some steps. Returns what the elastic energy has
  /// lost [J/m], counted in one of some steps, for all of them.
  double apply(Model& model, const ConsistentKernels& kernels, const ConsistentArrays& arrays);

  double* sheared() { return sheared_.data(); }  ///< as in FlowView
  /// As it yielded, since that was forgotten.
  bool has_sheared(std::size_t particle) const { return has_sheared_[particle] != 0; }
  bool has_sheared() const { return std::ranges::find(has_sheared_, 1) != has_sheared_.end(); }
  void forget_shear() { std::ranges::fill(has_sheared_, 0); }
  StressDiffusionView view(const Particles& particles);
  void visit(StateArchive& state);

 private:
  /// A ghost at a periodic side, where the soil continues.
  struct GoesOn {
    std::size_t ghost;
    std::int32_t root;
  };
  bool take_strain();

  std::vector<double> sheared_;
  std::vector<std::uint8_t> has_sheared_;
  std::vector<std::int32_t> soil_;   ///< and ghost; -1 for those that take no part
  std::vector<double> diffusivity_;  ///< and ghost
  std::vector<std::uint8_t> near_;
  std::vector<Mat2> correction_;
  std::vector<GoesOn> goes_on_;
  std::vector<Stress> stress_;    ///< of particles and ghosts where soil continues, or else of none [Pa]
  std::vector<Stress> gradient_;  ///< along x, then along y, of each particle, and ghost [Pa/m]
  std::vector<Stress> change_;    ///< [Pa]
  double length_squared_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace porosph
