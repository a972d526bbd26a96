#include "solver/sph/consistent/stress_diffusion.hpp"

#include <algorithm>
#include <utility>

#include "solver/space/parallel.hpp"
#include "solver/sph/consistent/rows_at_walls.hpp"

namespace porosph {
namespace {

constexpr double per_strain = 10;  // D dt over h^2
constexpr double most = 0.1;       // of that in a step
constexpr double negligible = 1e-6;
constexpr int steps_between_counts = 16;  // of the energy

}  // namespace

void StressDiffusion::take(const ReferenceConfiguration& r, const Model& model, const LooseParticles& loose,
                           std::span<const Mat2> correction) {
  const Particles& p = model.particles;
  const std::size_t n = r.particles();
  soil_.assign(r.points.size(), -1);
  for (std::size_t a = 0; a < n; ++a)
    if (model.soils[p.soil[a]].flows() && !loose.is(a)) soil_[a] = p.soil[a];
  diffusivity_.assign(r.points.size(), 0);
  length_squared_ = model.smoothing_length * model.smoothing_length;
  near_.assign(n, 0);
  correction_.assign(correction.begin(), correction.end());
  goes_on_.clear();
  for (std::size_t i = n; i < r.points.size(); ++i)
    if (is_soil(r, static_cast<std::int32_t>(i))) goes_on_.push_back({i, r.ghosts.root(i - n)});
  for (const auto& [ghost, root] : goes_on_) soil_[ghost] = soil_[root];
  stress_.assign(goes_on_.empty() ? 0 : r.points.size(), Stress{});
  gradient_.assign(2 * (goes_on_.empty() ? n : r.points.size()), Stress{});
  change_.assign(n, Stress{});
}

/// D dt of what has been sheared; false where nothing has.
bool StressDiffusion::take_strain() {
  bool any = false;
  for (std::size_t a = 0; a < sheared_.size(); ++a) {
    const double share = per_strain * std::exchange(sheared_[a], 0);
    const bool shears = share > negligible && soil_[a] >= 0;
    diffusivity_[a] = shears ? share * length_squared_ : 0;
    has_sheared_[a] |= shears, any = any || shears;
  }
  for (const auto& [ghost, root] : goes_on_) diffusivity_[ghost] = diffusivity_[root];
  return any;
}

double StressDiffusion::apply(Model& model, const ConsistentKernels& kernels, const ConsistentArrays& c) {
  const bool due = steps_ % steps_between == 0, counted = steps_ % steps_between_counts == 0;
  ++steps_;
  if (!due || !take_strain()) return 0;
  Particles& p = model.particles;
  if (!goes_on_.empty()) std::ranges::copy(p.stress, stress_.begin());
  for (const auto& [ghost, root] : goes_on_) stress_[ghost] = p.stress[root];
  const std::int32_t tiles = c.reference.stencils->tiles();
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < tiles; ++tile) kernels.stress_gradients(c, tile);
  for (const auto& [ghost, root] : goes_on_)
    for (int d = 0; d < 2; ++d) gradient_[2 * ghost + d] = gradient_[2 * root + d];
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < tiles; ++tile) kernels.diffuse(c, tile);
  const auto energy = [&] {
    return deterministic_sum(p.size(), [&](std::size_t a) {
      return near_[a] ? p.volume(a) * model.soils[p.soil[a]].stored_energy(p.stress[a]) : 0.0;
    });
  };
  const double before = counted ? energy() : 0;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a)
    if (near_[a]) p.stress[a] = p.stress[a] + change_[a];
  return counted ? steps_between_counts / steps_between * (before - energy()) : 0;
}

StressDiffusionView StressDiffusion::view(const Particles& p) {
  const std::vector<Stress>& stress = stress_.empty() ? p.stress : stress_;
  return {.soil = soil_.data(),
          .stress = stress.empty() ? nullptr : &stress.data()->xx,
          .diffusivity = diffusivity_.data(),
          .most = most * length_squared_,
          .near = near_.data(),
          .correction = correction_.empty() ? nullptr : correction_.data()->data(),
          .gradient = gradient_.empty() ? nullptr : &gradient_.data()->xx,
          .change = change_.empty() ? nullptr : &change_.data()->xx};
}

void StressDiffusion::visit(StateArchive& state) {
  state.array("sheared", sheared_);
  state.array("has_sheared", has_sheared_);
  state.value("diffusion_steps", steps_);
}

}  // namespace porosph
