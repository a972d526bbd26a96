#include "solver/run/probe.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

Probe::Probe(const ProbeCase& probe, const Model& model, std::int32_t soil)
    : name_(probe.name), start_(probe.position) {
  const Particles& p = model.particles;
  const Vec2 place = start_ - model.origin;
  const std::vector<Vec2> here = {place};
  particles_ = find_neighbours(here, p.position, 2 * model.smoothing_length).index;
  std::erase_if(particles_,
                [&](std::int32_t b) { return !model.visibility.sees_from(start_ - model.origin, b, p); });
  if (soil >= 0)
    std::erase_if(particles_, [&](std::int32_t b) { return model.soils[p.soil[b]].id() != soil; });
  if (particles_.empty())
    throw std::runtime_error(fmt::format("probe '{}' at ({:.12g}, {:.12g}) has no particle within {} m",
                                         name_, start_.x(), start_.y(), 2 * model.smoothing_length));
  std::vector<Vec2> near;
  std::vector<double> volumes;
  for (std::int32_t b : particles_) near.push_back(p.position[b]), volumes.push_back(p.volume(b));
  weights_ = linear_weights(place, near, volumes, model.smoothing_length);
}

Reading Probe::read(const Particles& p) const {
  Reading r;
  if (particles_.empty()) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{none, none, none, none}, none, Vec2::Constant(none)};
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const std::int32_t b = particles_[i];
    r.stress = r.stress + p.stress[b] * weights_[i];
    r.pore_pressure += weights_[i] * p.pore_pressure[b];
    r.displacement += weights_[i] * p.displacement(b);
  }
  return r;
}

}  // namespace porosph
