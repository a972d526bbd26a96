#include "solver/output/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "solver/fields/field_table.hpp"
#include "solver/output/invariants.hpp"
#include "solver/output/strain.hpp"
#include "solver/run/reference_errors.hpp"

namespace porosph {
namespace {

using Values = decltype(FrameField::values);

/// A field and how it is read.
struct Reader {
  std::string_view field;
  std::function<Values(Simulation&)> values;
};

/// One value per particle.
template <class T, class Value>
std::vector<T> scalars(const Particles& p, Value value) {
  std::vector<T> out(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) out[i] = static_cast<T>(value(i));
  return out;
}

template <class Value>
std::vector<double> vectors(const Particles& p, Value value) {
  std::vector<double> out;
  out.reserve(3 * p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 v = value(i);
    out.insert(out.end(), {v.x(), v.y(), 0.0});
  }
  return out;
}

template <class Value>
std::vector<double> tensors(const Particles& p, Value value) {
  std::vector<double> out;
  out.reserve(6 * p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto s = value(i);
    out.insert(out.end(), {s.xx, s.yy, s.zz, s.xy, 0.0, 0.0});
  }
  return out;
}

Stress total_stress(const Particles& p, std::size_t i) {  // eq. (12)
  const double w = p.pore_pressure[i];
  return p.stress[i] + Stress{w, w, w, 0};
}

std::vector<double> principal(const Particles& p) {
  std::vector<double> out;
  out.reserve(3 * p.size());
  for (const Stress& s : p.stress) {
    const auto values = principal_stresses(s);
    out.insert(out.end(), values.begin(), values.end());
  }
  return out;
}

/// -p_w / gamma_w where the water stands.
double pressure_head(const Simulation& s, std::size_t i) {
  const Particles& p = s.model().particles;
  const FlowRecord* flow = s.model().pore_water->record();
  return flow != nullptr ? flow->head[i] - p.position[i].y()
                         : -p.pore_pressure[i] / s.scene().water.unit_weight;
}

/// Part of the vertical total stress that the pore water carries.
double pore_pressure_ratio(const Particles& p, std::size_t i) {
  const double total = total_stress(p, i).yy;
  return total < 0 && p.pore_pressure[i] < 0 ? p.pore_pressure[i] / total : 0;
}

/// What flows, zero where the water stands.
template <class Value>
std::vector<double> flow_vectors(Simulation& s, Value value) {
  const FlowRecord* flow = s.model().pore_water->record();
  return vectors(s.model().particles,
                 [&](auto i) { return flow != nullptr ? Vec2(value(*flow)[i]) : Vec2(Vec2::Zero()); });
}

/// Of the flow upwards, over the one that carries the buoyant weight of the soil.
double gradient_ratio(const Simulation& s, std::size_t i) {
  const FlowRecord* flow = s.model().pore_water->record();
  if (flow == nullptr) return 0;
  const double weight = s.scene().soils[s.model().particles.soil[i]].unit_weight_saturated;
  const double water = s.scene().water.unit_weight;
  return flow->gradient[i].y() / ((weight - water) / water);
}

const Particles& particles(Simulation& s) { return s.model().particles; }

const Soil& soil_of(Simulation& s, std::size_t i) { return s.model().soils[particles(s).soil[i]]; }

std::vector<Reader> readers_of_particles() {
  return {
      {particle_fields::displacement.name,
       [](Simulation& s) {
         return vectors(particles(s), [&](auto i) { return particles(s).displacement(i); });
       }},
      {particle_fields::velocity.name,
       [](Simulation& s) {
         const std::vector<Vec2> v = s.velocities();
         return vectors(particles(s), [&](auto i) { return v[i]; });
       }},
      {particle_fields::effective_stress.name,
       [](Simulation& s) { return tensors(particles(s), [&](auto i) { return particles(s).stress[i]; }); }},
      {particle_fields::total_stress.name,
       [](Simulation& s) {
         return tensors(particles(s), [&](auto i) { return total_stress(particles(s), i); });
       }},
      {particle_fields::pore_pressure.name, [](Simulation& s) { return particles(s).pore_pressure; }},
      {particle_fields::density.name, [](Simulation& s) { return particles(s).density; }},
      {particle_fields::mass.name, [](Simulation& s) { return particles(s).mass; }},
      {particle_fields::smoothing_length.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto) { return s.model().smoothing_length; });
       }},
      {particle_fields::soil_id.name,
       [](Simulation& s) {
         return scalars<std::int32_t>(particles(s),
                                      [&](auto i) { return s.model().soils[particles(s).soil[i]].id(); });
       }},
      {particle_fields::particle_id.name, [](Simulation& s) { return particles(s).id; }},
  };
}

std::vector<Reader> readers_of_stress_and_strain() {
  return {
      {particle_fields::principal_stress.name, [](Simulation& s) { return principal(particles(s)); }},
      {particle_fields::mean_stress.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) { return particles(s).stress[i].mean(); });
       }},
      {particle_fields::deviatoric_stress.name,
       [](Simulation& s) {
         return tensors(particles(s), [&](auto i) { return deviator(particles(s).stress[i]); });
       }},
      {particle_fields::von_mises_stress.name,
       [](Simulation& s) {
         return scalars<double>(particles(s),
                                [&](auto i) { return von_mises_stress(particles(s).stress[i]); });
       }},
      {particle_fields::strain.name,
       [](Simulation& s) {
         const std::vector<Strain> strain = strain_since_start(s.model());
         return tensors(particles(s), [&](auto i) { return strain[i]; });
       }},
      {particle_fields::excess_stress.name,
       [](Simulation& s) {
         const std::vector<Stress> exact = reference_stress(s);
         return tensors(particles(s), [&](auto i) { return particles(s).stress[i] + exact[i] * -1.0; });
       }},
      {particle_fields::yielding.name,
       [](Simulation& s) {
         constexpr double on_surface = 1 - 1e-9;
         return scalars<double>(particles(s), [&](auto i) {
           return soil_of(s, i).mobilised_strength(particles(s), i) > on_surface ? 1 : 0;
         });
       }},
      {particle_fields::mobilised_friction.name,
       [](Simulation& s) {
         return scalars<double>(particles(s),
                                [&](auto i) { return soil_of(s, i).mobilised_friction(particles(s), i); });
       }},
  };
}

std::vector<Reader> readers_of_water() {
  return {
      {particle_fields::head.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) {
           return pressure_head(s, i) + particles(s).position[i].y() + s.model().origin.y();
         });
       }},
      {particle_fields::pressure_head.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) { return pressure_head(s, i); });
       }},
      {particle_fields::saturation.name,
       [](Simulation& s) {
         const FlowRecord* flow = s.model().pore_water->record();
         return scalars<double>(particles(s), [&](auto i) {
           return flow != nullptr ? flow->saturation[i] : particles(s).pore_pressure[i] < 0 ? 1.0 : 0.0;
         });
       }},
      {particle_fields::darcy_velocity.name,
       [](Simulation& s) {
         return flow_vectors(
             s, [](const FlowRecord& f) -> const auto& { return f.velocity; });
       }},
      {particle_fields::hydraulic_gradient.name,
       [](Simulation& s) {
         return flow_vectors(
             s, [](const FlowRecord& f) -> const auto& { return f.gradient; });
       }},
      {particle_fields::gradient_ratio.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) { return gradient_ratio(s, i); });
       }},
      {particle_fields::pore_pressure_ratio.name,
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) { return pore_pressure_ratio(particles(s), i); });
       }},
  };
}

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = [] {
    std::vector<Reader> readers = readers_of_particles();
    for (const auto& of : {readers_of_stress_and_strain(), readers_of_water()})
      readers.insert(readers.end(), of.begin(), of.end());
    return readers;
  }();
  return all;
}

/// What the soils' laws remember: zero where no soil has such a law.
Values history(const Particles& p, std::string_view name) {
  const auto found =
      std::ranges::find_if(p.history, [&](const HistoryField& h) { return h.field.name == name; });
  return found != p.history.end() ? found->values : std::vector<double>(p.size(), 0.0);
}

/// One of the table, or one that a law from outside remembers.
FrameField read(Simulation& s, const std::string& name) {
  const auto& all = readers();
  if (const auto found = std::ranges::find(all, name, &Reader::field); found != all.end())
    return {name, component_names(find_field(name)->kind), found->values(s)};
  const auto& kept = particles(s).history;
  const bool is_kept = std::ranges::any_of(kept, [&](const HistoryField& h) { return h.field.name == name; });
  if (find_field(name) == nullptr && !is_kept)
    throw std::invalid_argument(fmt::format("no field is called '{}'", name));
  return {name, {}, history(particles(s), name)};
}

}  // namespace

Frame make_frame(Simulation& simulation, const std::vector<std::string>& names) {
  Frame frame;
  frame.step = simulation.step();
  frame.time = simulation.time();
  const Model& model = simulation.model();
  frame.points =
      vectors(model.particles, [&](auto i) { return Vec2(model.particles.position[i] + model.origin); });
  for (const std::string& name : names) frame.fields.push_back(read(simulation, name));
  return frame;
}

}  // namespace porosph
