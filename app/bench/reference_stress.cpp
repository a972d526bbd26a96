#include "app/bench/reference_stress.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/run/reference_errors.hpp"

namespace porosph::bench {

bool counts(const Case& scene, const Point& place) {
  if (scene.reference != Reference::none) return true;
  struct Corner {
    Point at;
    double radius;
  };
  static const Corner corners[] = {{{10, 6}, 1}, {{33, 6}, 1}, {{15, 11}, 0.5}, {{20.5, 11}, 0.5}};
  for (const Corner& c : corners)
    if ((place - c.at).norm() < c.radius) return false;
  return true;
}

ReferenceStress::ReferenceStress(const Simulation& simulation, const FemSolution* fem) {
  const Case& scene = simulation.scene();
  const Particles& p = simulation.model().particles;
  stress_.assign(p.size(), std::numeric_limits<double>::quiet_NaN());
  if (scene.reference == Reference::column) {
    const auto [column, bottom] = reference_column(scene);
    const FiniteStrainColumn exact(column);
    for (std::size_t i = 0; i < p.size(); ++i)
      stress_[p.id[i]] = exact.vertical_stress(p.start[i].y() - bottom);
    return;
  }
  if (!fem) throw std::invalid_argument("a scene without an exact solution needs finite elements");
  for (std::size_t i = 0; i < p.size(); ++i)
    if (counts(scene, p.start[i])) stress_[p.id[i]] = fem->at(p.start[i]).effective_stress[1];
}

double ReferenceStress::error(const Simulation& simulation) const {
  const Particles& p = simulation.model().particles;
  double difference = 0, reference = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double exact = stress_[p.id[i]];
    if (std::isnan(exact)) continue;
    const double d = p.stress[i].yy - exact;
    difference += p.volume(i) * d * d;
    reference += p.volume(i) * exact * exact;
  }
  return std::sqrt(difference / reference);
}

}  // namespace porosph::bench
