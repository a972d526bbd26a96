#include "solver/simulation/apply_materials.hpp"

#include "solver/motion/soil_step.hpp"

namespace porosph {

void apply_materials(const Materials& materials, Model& model, Dynamics& dynamics, double dt) {
  Particles& p = model.particles;
  std::vector<Mat2> gradients(p.size());
  dynamics.velocity_gradients(gradients);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    Material* material = materials[p.soil[a]].get();
    if (material == nullptr) continue;
    const LinearElastic& elastic = model.soils[p.soil[a]];
    const Gradient gradient = mid_step_gradient(gradients[a], dt);
    const MaterialStep step{a, p.stress[a], elastic.update(p.stress[a], gradient, dt), gradient, dt};
    p.stress[a] = elastic.before(material->stress(step), gradient, dt);
  }
}

}  // namespace porosph
