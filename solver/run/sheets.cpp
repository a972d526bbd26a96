#include "solver/run/sheets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solver/run/surface_loads.hpp"
#include "solver/sph/consistent/wall_friction.hpp"

namespace porosph {
namespace {

constexpr double some = 0.05;  // of the spacing: the least area of a strip

std::size_t elements_of(const SheetCase& sheet, double spacing) {
  return static_cast<std::size_t>(std::max(2L, std::lround((sheet.to - sheet.from).norm() / spacing)));
}

/// The particles of one side whose surface is on the sheet, and how much of it [m].
std::vector<double> areas_on(const SheetCase& sheet, const Vec2& facing, const Case& scene,
                             const Model& model, std::span<const Vec2> own, std::span<const Vec2> outer) {
  const Particles& p = model.particles;
  const Vec2 way = (sheet.to - sheet.from).normalized();
  const double length = (sheet.to - sheet.from).norm(), reach = 4 * model.smoothing_length;
  const auto is_here = [&](std::size_t a) { return (p.position[a] - sheet.from).dot(facing) < 0; };
  std::vector<double> areas(p.size(), 0);
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Vec2 place = p.position[a] - sheet.from;
    const double along = place.dot(way);
    if (!is_here(a) || -place.dot(facing) > reach || along < -reach || along > length + reach) continue;
    areas[a] = own[a].dot(facing);
  }
  const StretchOfParticles exposed =
      particles_on(sheet.from, sheet.to, facing, scene, model, outer, Ends::sharp);
  for (std::size_t k = 0; k < exposed.particles.size(); ++k)
    if (is_here(exposed.particles[k])) areas[exposed.particles[k]] += exposed.areas[k];
  return areas;
}

}  // namespace

Sheet::Sheet(const SheetCase& sheet, const Case& scene, const Model& model, std::span<const Vec2> own,
             std::span<const Vec2> outer)
    : case_(sheet),
      along_((sheet.to - sheet.from).normalized()),
      across_(-along_.y(), along_.x()),
      beam_((sheet.to - sheet.from).norm(), elements_of(sheet, model.spacing), sheet.bending_stiffness,
            sheet.axial_stiffness, sheet.mass),
      memory_(friction_memory(model)) {
  for (const int side : {1, -1})
    make_strips(side, model, areas_on(sheet, -side * across_, scene, model, own, outer));
  if (strips_.empty())
    throw std::runtime_error(fmt::format("sheet '{}': no particle is near it", sheet.name));
  q_.assign(beam_.size(), 0), velocity_.assign(beam_.size(), 0);
  now_ = {.q = q_,
          .velocity = velocity_,
          .force = std::vector<Vec2>(strips_.size(), Vec2::Zero()),
          .slip = std::vector<Vec2>(strips_.size(), Vec2::Zero()),
          .pressure = std::vector<double>(strips_.size(), -1),
          .spread = std::vector<Vec2>(beam_.nodes() - 1, Vec2::Zero())};
}

/// Row by row. What lies beyond the ends and is parted by the sheet belongs to its first and last row.
void Sheet::make_strips(int side, const Model& model, const std::vector<double>& areas) {
  const double length = (case_.to - case_.from).norm(), spacing = model.spacing;
  std::vector<Beside> beside;
  double low = never, high = -never;  // of rows on the sheet
  for (std::size_t a = 0; a < areas.size(); ++a) {
    if (std::abs(areas[a]) < 1e-6 * spacing) continue;
    const double along = (model.particles.position[a] - case_.from).dot(along_);
    beside.push_back({static_cast<std::int32_t>(a), along, areas[a]});
    if (along > -1e-6 * spacing && along < length + 1e-6 * spacing)
      low = std::min(low, along), high = std::max(high, along);
  }
  if (low > high) return;
  for (Beside& b : beside) b.along = std::clamp(b.along, low, high);
  std::ranges::stable_sort(beside, {}, &Beside::along);
  const auto area = [&](std::size_t first, std::size_t last) {
    return std::accumulate(beside.begin() + static_cast<std::ptrdiff_t>(first),
                           beside.begin() + static_cast<std::ptrdiff_t>(last), 0.0,
                           [](double sum, const Beside& b) { return sum + b.area; });
  };
  std::size_t first = 0;
  for (std::size_t last = 1; last <= beside.size(); ++last) {
    const bool in_row = last < beside.size() && beside[last].along - beside[first].along < 0.5 * spacing;
    const bool rest_is_little = last < beside.size() && area(last, beside.size()) < some * spacing;
    if (in_row || rest_is_little || area(first, last) < some * spacing) continue;
    add_strip(side, model, std::span(beside).subspan(first, last - first));
    first = last;
  }
}

void Sheet::add_strip(int side, const Model& model, std::span<const Beside> row) {
  Strip strip{.side = side,
              .first = particles_.size(),
              .last = particles_.size() + row.size(),
              .along = 0,
              .area = 0,
              .compliance = 0,
              .place = {}};
  for (const Beside& b : row) strip.area += b.area;
  for (const Beside& b : row) {
    const double weight = b.area / strip.area;
    strip.along += weight * b.along;
    strip.compliance += weight * weight / model.particles.mass[b.particle];
    particles_.push_back(b.particle), weights_.push_back(weight);
  }
  strip.place = beam_.place(strip.along);
  strips_.push_back(strip);
}

Vec2 Sheet::mean(const Strip& strip, std::span<const Vec2> values) const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = strip.first; k < strip.last; ++k) sum += weights_[k] * values[particles_[k]];
  return local(sum);
}

/// Displacement of the soil less that of the sheet.
Vec2 Sheet::offset(const Strip& strip, const Particles& p, const std::vector<double>& q) const {
  return mean(strip, p.position) - mean(strip, p.start) - strip.place.of(q);
}

/// Weight, and water that stands at other levels on the two sides.
std::vector<Vec2> Sheet::spread_forces(const Model& model) const {
  const double apart = 1e-6 * beam_.element_length();
  const auto push = [&](double s) {
    const Vec2 at = case_.from + s * along_, left = at + apart * across_, right = at - apart * across_;
    return model.water.pore_pressure(left.x(), left.y()) - model.water.pore_pressure(right.x(), right.y());
  };
  std::vector<Vec2> forces(beam_.nodes() - 1, local(case_.mass * model.gravity));
  for (std::size_t e = 0; model.water.present() && e < forces.size(); ++e) {
    const double s = static_cast<double>(e) * beam_.element_length();
    forces[e].y() += 0.5 * (push(s) + push(s + beam_.element_length()));
  }
  return forces;
}

Sheet::Free Sheet::free_motion(const Model& model, Kick kick, double dt,
                               std::span<const Vec2> accelerations) {
  const Particles& p = model.particles;
  Free free{.displacement = {}, .give = {}, .heavy = 1 / (dt * kick.gain), .pull = {}};
  for (const Strip& strip : strips_) {
    const Vec2 velocity = kick.keep * mean(strip, p.velocity) + kick.gain * mean(strip, accelerations);
    free.displacement.push_back(mean(strip, p.position) - mean(strip, p.start) - strip.before +
                                dt * velocity);
    free.give.push_back(dt * kick.gain * strip.compliance);
  }
  std::vector<double> then = q_;
  for (std::size_t i = 0; i < then.size(); ++i) then[i] += dt * kick.keep * velocity_[i];
  free.pull = beam_.mass_times(then);
  for (double& pull : free.pull) pull *= free.heavy;
  now_.spread = spread_forces(model);
  beam_.add_spread(now_.spread, free.pull);
  return free;
}

/// What friction and adhesion bear [N/m].
double Sheet::most_shear(const Strip& strip) const {
  if (case_.bonded || strip.pressure < 0) return never;
  return (case_.friction * strip.pressure + case_.adhesion) / reduction_ * strip.area;
}

/// The beam at the end of the step, with the strips that touch it and those that slide along it.
std::vector<double> Sheet::solve(const Free& free) const {
  BandMatrix matrix(beam_.size());
  beam_.add_stiffness(1, matrix), beam_.add_mass(free.heavy, matrix);
  std::vector<double> right = free.pull;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    const Strip& strip = strips_[k];
    if (!strip.touches) continue;
    const double stiff = 1 / free.give[k];
    const std::size_t first = Beam::per_node * strip.place.element;
    for (std::size_t i = 0; i < Beam::per_element; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double entry = strip.place.across[i] * strip.place.across[j];
        if (strip.slides == 0) entry += strip.place.along[i] * strip.place.along[j];
        matrix.add(first + i, first + j, stiff * entry);
      }
    Vec2 pull = stiff * free.displacement[k];
    if (strip.slides != 0) pull.x() = -strip.slides * most_shear(strip);
    Beam::add_force(strip.place, pull, right);
  }
  const auto hold_end = [&](SheetEnd end, std::size_t node) {
    const std::size_t held = end == SheetEnd::free ? 0 : end == SheetEnd::pinned ? 2 : 3;
    for (std::size_t i = 0; i < held; ++i)
      matrix.hold(Beam::per_node * node + i), right[Beam::per_node * node + i] = 0;
  };
  hold_end(case_.from_end, 0), hold_end(case_.to_end, beam_.nodes() - 1);
  matrix.solve(right);
  return right;
}

Vec2 Sheet::force_on(std::size_t k, const Free& free, const std::vector<double>& q) const {
  const Strip& strip = strips_[k];
  if (!strip.touches) return Vec2::Zero();
  Vec2 force = (strip.place.of(q) - free.displacement[k]) / free.give[k];
  if (strip.slides != 0) force.x() = strip.slides * most_shear(strip);
  return force;
}

/// Where the solution contradicts what it was found with: tension, soil within the sheet, more shear than
/// friction bears, or soil that the sheet drags and overtakes.
bool Sheet::change_contacts(const Free& free, const std::vector<double>& q) {
  if (case_.bonded) return false;
  bool changed = false;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    Strip& strip = strips_[k];
    const Vec2 force = force_on(k, free, q), sheet = strip.place.of(q);
    const bool touches =
        strip.touches ? strip.side * force.y() >= 0 : strip.side * (free.displacement[k].y() - sheet.y()) < 0;
    int slides = strip.touches && touches ? strip.slides : 0;
    if (strip.touches && touches && slides == 0 && std::abs(force.x()) > most_shear(strip))
      slides = force.x() > 0 ? 1 : -1;
    else if (slides * (free.displacement[k].x() + free.give[k] * force.x() - sheet.x()) > 0)
      slides = 0;
    changed |= touches != strip.touches || slides != strip.slides;
    strip.touches = touches, strip.slides = slides;
  }
  return changed;
}

void Sheet::hold(const Model& model, Kick kick, double dt, std::span<Vec2> accelerations) {
  constexpr int most_turns = 30;
  const Particles& p = model.particles;
  const Free free = free_motion(model, kick, dt, accelerations);
  std::vector<double> q = solve(free);
  for (int turn = 0; turn < most_turns && change_contacts(free, q); ++turn) q = solve(free);
  now_.squares = 0;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    const Strip& strip = strips_[k];
    Vec2 force = force_on(k, free, q);
    if (!case_.bonded && strip.side * force.y() < 0) force = Vec2::Zero();
    force.x() = std::clamp(force.x(), -most_shear(strip), most_shear(strip));
    now_.force[k] = force;
    now_.slip[k].x() = free.displacement[k].x() + free.give[k] * force.x() - strip.place.of(q).x();
    const double pressure = strip.side * force.y() / strip.area;
    now_.pressure[k] = strip.pressure < 0
                           ? std::max(0.0, pressure)
                           : strip.pressure + (pressure - strip.pressure) * std::min(1.0, dt / memory_);
    const Vec2 global = force.x() * along_ + force.y() * across_;
    for (std::size_t i = strip.first; i < strip.last; ++i) {
      accelerations[particles_[i]] += weights_[i] / p.mass[particles_[i]] * global;
      now_.squares += weights_[i] * weights_[i] * global.squaredNorm();
    }
  }
  for (std::size_t i = 0; i < q.size(); ++i) now_.velocity[i] = (q[i] - q_[i]) / dt;
  now_.q = std::move(q);
}

void Sheet::take_step() {
  q_ = now_.q, velocity_ = now_.velocity;
  for (std::size_t k = 0; k < strips_.size(); ++k) {
    strips_[k].before += now_.slip[k];
    strips_[k].pressure = now_.pressure[k];
  }
}

void Sheet::place(const Particles& p, const SheetState* before) {
  if (before) q_ = before->displacement, velocity_ = before->velocity;
  for (Strip& strip : strips_) {
    strip.before = offset(strip, p, q_);
    if (!before) continue;
    const auto same = std::ranges::find_if(before->contacts, [&](const SheetState::Contact& c) {
      return c.side == strip.side && std::abs(c.along - strip.along) < 0.3 * beam_.element_length();
    });
    if (same == before->contacts.end()) continue;
    strip.before.y() -= strip.side * same->gap;
    strip.touches = same->gap == 0;
    strip.pressure = same->pressure;
  }
}

SheetState Sheet::state(const Particles& p) const {
  SheetState state{q_, velocity_, {}};
  for (const Strip& strip : strips_) {
    const double gap = strip.side * (offset(strip, p, q_) - strip.before).y();
    state.contacts.push_back(
        {strip.side, strip.along, strip.touches ? 0 : std::max(0.0, gap), strip.pressure});
  }
  return state;
}

Sheet::Profile Sheet::profile() const {
  Profile profile;
  const std::size_t n = beam_.nodes();
  for (std::size_t i = 0; i < n; ++i) {
    const double s = static_cast<double>(i) * beam_.element_length();
    profile.along.push_back(s);
    profile.drawn.push_back(case_.from + s * along_);
    profile.moved.push_back(now_.q[Beam::per_node * i] * along_ + now_.q[Beam::per_node * i + 1] * across_);
  }
  std::vector<Beam::PointForce> forces;
  for (std::size_t k = 0; k < strips_.size(); ++k) forces.push_back({strips_[k].place, -now_.force[k]});
  profile.sections = beam_.sections(now_.q, forces, now_.spread);
  return profile;
}

Sheet::Extremes extremes_of(const Sheet::Profile& profile) {
  Sheet::Extremes most;
  const auto take = [](double value, double& largest) {
    if (std::abs(value) > std::abs(largest)) largest = value;
  };
  for (const Beam::Section& section : profile.sections) {
    take(section.axial, most.section.axial), take(section.shear, most.section.shear);
    take(section.moment, most.section.moment);
  }
  for (const Vec2& u : profile.moved) most.displacement = std::max(most.displacement, u.norm());
  return most;
}

void Sheet::visit(StateArchive& state) {
  state.array("sheet_displacement", q_);
  state.array("sheet_velocity", velocity_);
  for (Strip& strip : strips_) {
    state.value("sheet_before", strip.before.x()), state.value("sheet_before", strip.before.y());
    state.value("sheet_pressure", strip.pressure);
    state.value("sheet_touches", strip.touches), state.value("sheet_slides", strip.slides);
  }
}

std::vector<Sheet> make_sheets(const Case& scene, const Model& model) {
  if (scene.sheets.empty()) return {};
  const std::vector<Vec2> outer = surface_vectors(scene, model);
  std::vector<Vec2> own = vectors_with_sheets(scene, model);
  for (std::size_t a = 0; a < own.size(); ++a) own[a] -= outer[a];
  std::vector<Sheet> sheets;
  std::vector<char> held(model.particles.size(), 0);
  for (const SheetCase& sheet : scene.sheets) {
    sheets.emplace_back(sheet, scene, model, own, outer);
    for (const std::int32_t a : sheets.back().particles())
      if (std::exchange(held[a], 1))
        throw std::runtime_error(fmt::format(
            "sheet '{}' holds a particle that another sheet holds: they must be further apart", sheet.name));
  }
  return sheets;
}

}  // namespace porosph
