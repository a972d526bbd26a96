#include "solver/run/footings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "solver/boundary/traction.hpp"
#include "solver/run/surface_loads.hpp"

namespace porosph {

Footing::Footing(const FootingCase& footing, const Case& scene, const Model& model,
                 std::span<const Vec2> surface_vectors)
    : case_(footing),
      into_(-outward_normal(scene, footing.from, footing.to)),
      along_((footing.to - footing.from).normalized()) {
  constexpr double apart = 0.5, some = 0.05;  // of the spacing: columns; their least area
  const StretchOfParticles on =
      particles_on(footing.from, footing.to, -into_, scene, model, surface_vectors, Ends::sharp);
  if (on.particles.empty())
    throw std::runtime_error(
        fmt::format("footing '{}': no particle is near its stretch of the outline", footing.name));
  std::vector<std::size_t> order(on.particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return on.along[i]; });
  for (std::size_t first = 0; first < order.size();) {
    double area = 0;
    std::size_t last = first;
    const auto in_column = [&] {
      return on.along[order[last]] - on.along[order[first]] < apart * model.spacing ||
             area < some * model.spacing;
    };
    for (; last < order.size() && in_column(); ++last) area += on.areas[order[last]];
    if (area < some * model.spacing) break;  // the rest of a column that ends at the edge
    Strip strip{.first = particles_.size(), .last = particles_.size() + last - first, .compliance = 0};
    for (std::size_t k = first; k < last; ++k) {
      const std::int32_t a = on.particles[order[k]];
      particles_.push_back(a), weights_.push_back(on.areas[order[k]] / area);
      strip.compliance += weights_.back() * weights_.back() / model.particles.mass[a];
    }
    strips_.push_back(strip);
    width_ += area;
    first = last;
  }
}

Vec2 Footing::mean(const Strip& strip, std::span<const Vec2> values) const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = strip.first; k < strip.last; ++k) sum += weights_[k] * values[particles_[k]];
  return sum;
}

Vec2 Footing::mean_displacement(const Strip& strip, const Particles& p) const {
  return mean(strip, p.position) - mean(strip, p.start) - strip.before;
}

void Footing::place(const Particles& p, double settlement) {
  for (Strip& strip : strips_)
    strip.before = mean(strip, p.position) - mean(strip, p.start) - settlement * into_;
}

void Footing::visit(StateArchive& state) {
  for (Strip& strip : strips_)
    state.value("footing_before", strip.before.x()), state.value("footing_before", strip.before.y());
}

double Footing::settlement(const Particles& p) const {
  double sum = 0;
  for (const Strip& strip : strips_) sum += mean_displacement(strip, p).dot(into_);
  return sum / static_cast<double>(strips_.size());
}

void Footing::hold(const Particles& p, Kick kick, double dt, double then, std::span<Vec2> accelerations) {
  const double factor = factor_at(case_.over_time, then);
  // Each strip's acceleration that brings it to the plate's present place, and the plate's own on top of it.
  std::vector<Vec2> needed(strips_.size());
  double held = 0, stiffness = 0;
  force_ = shear_ = squares_ = 0;
  const double place = case_.settlement < never ? factor * case_.settlement : settlement(p);
  double velocity = 0;
  for (const Strip& strip : strips_) velocity += mean(strip, p.velocity).dot(into_);
  velocity = case_.settlement < never ? 0 : velocity / static_cast<double>(strips_.size());
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    const Strip& strip = strips_[k];
    const Vec2 behind = place * into_ - mean_displacement(strip, p);
    const Vec2 target = (behind / dt + kick.keep * (velocity * into_ - mean(strip, p.velocity))) / kick.gain;
    const Vec2 soil = mean(strip, accelerations);
    needed[k] = target - soil;
    force_ -= soil.dot(into_) / strip.compliance, shear_ -= soil.dot(along_) / strip.compliance;
    held += needed[k].dot(into_) / strip.compliance, stiffness += 1 / strip.compliance;
  }
  const bool driven_by_force = !(case_.settlement < never);
  const double own = driven_by_force ? (factor * case_.force - held) / stiffness : 0;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    Vec2 force = (needed[k].dot(into_) + own) / strips_[k].compliance * into_;
    if (case_.rough) force += needed[k].dot(along_) / strips_[k].compliance * along_;
    for (std::size_t i = strips_[k].first; i < strips_[k].last; ++i) {
      accelerations[particles_[i]] += weights_[i] / p.mass[particles_[i]] * force;
      squares_ += weights_[i] * weights_[i] * force.squaredNorm();
    }
  }
  if (!case_.rough) shear_ = 0;
}

void Footing::hold_alike(const Particles& p, std::span<Vec2> accelerations) const {
  std::vector<Vec2> of_strips;
  double sum = 0, stiffness = 0;
  for (const Strip& strip : strips_) {
    of_strips.push_back(mean(strip, accelerations));
    sum += of_strips.back().dot(into_) / strip.compliance, stiffness += 1 / strip.compliance;
  }
  const double own = case_.settlement < never ? 0 : sum / stiffness;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    Vec2 taken = (of_strips[k].dot(into_) - own) * into_;
    if (case_.rough) taken += of_strips[k].dot(along_) * along_;
    for (std::size_t i = strips_[k].first; i < strips_[k].last; ++i)
      accelerations[particles_[i]] -= weights_[i] / (p.mass[particles_[i]] * strips_[k].compliance) * taken;
  }
}

std::vector<Footing> make_footings(const Case& scene, const Model& model) {
  if (scene.footings.empty()) return {};
  const std::vector<Vec2> vectors = surface_vectors(scene, model);
  std::vector<Footing> footings;
  std::vector<int> held(model.particles.size(), 0);
  for (const FootingCase& footing : scene.footings) {
    footings.emplace_back(footing, scene, model, vectors);
    for (const std::int32_t a : footings.back().particles())
      if (++held[a] > 1)
        throw std::runtime_error(fmt::format(
            "footing '{}' holds a particle that another footing holds: they must be further apart",
            footing.name));
  }
  return footings;
}

}  // namespace porosph
