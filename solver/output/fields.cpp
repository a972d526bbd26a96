#include "solver/output/fields.hpp"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>

#include "solver/output/invariants.hpp"
#include "solver/output/strain.hpp"
#include "solver/simulation/reference_errors.hpp"

namespace porosph {
namespace {

const std::vector<std::string> vector_components = {"X", "Y", "Z"};
const std::vector<std::string> tensor_components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

struct Field {
  FieldDescription description;
  std::function<decltype(FrameField::values)(Simulation&)> values;
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

const Particles& particles(Simulation& s) { return s.model().particles; }

const std::vector<Field>& registry() {
  static const std::vector<Field> fields = {
      {{"Displacement", "m", "from the position at t = 0", vector_components},
       [](Simulation& s) {
         return vectors(particles(s), [&](auto i) { return particles(s).displacement(i); });
       }},
      {{"Velocity", "m/s", "at the frame's time", vector_components},
       [](Simulation& s) {
         const std::vector<Vec2> v = s.velocities();
         return vectors(particles(s), [&](auto i) { return v[i]; });
       }},
      {{"EffectiveStress", "Pa", "sigma', tension positive", tensor_components},
       [](Simulation& s) { return tensors(particles(s), [&](auto i) { return particles(s).stress[i]; }); }},
      {{"TotalStress", "Pa", "sigma = sigma' + p_w I (eq. 12)", tensor_components},
       [](Simulation& s) {
         return tensors(particles(s), [&](auto i) { return total_stress(particles(s), i); });
       }},
      {{"PorePressure", "Pa", "p_w, negative in compression", {}},
       [](Simulation& s) { return particles(s).pore_pressure; }},
      {{"Density", "kg/m3", "mass of soil and pore water per volume", {}},
       [](Simulation& s) { return particles(s).density; }},
      {{"Mass", "kg/m", "per metre of thickness", {}}, [](Simulation& s) { return particles(s).mass; }},
      {{"SmoothingLength", "m", "h of the kernel", {}},
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto) { return s.model().smoothing_length; });
       }},
      {{"SoilId", "-", "number of the soil in the case, from 0", {}},
       [](Simulation& s) { return particles(s).soil; }},
      {{"ParticleId", "-", "number of the particle, from 0, the same in all frames", {}},
       [](Simulation& s) { return particles(s).id; }},
      {{"PrincipalStress", "Pa", "of sigma', the most tensile first", {"S1", "S2", "S3"}},
       [](Simulation& s) { return principal(particles(s)); }},
      {{"MeanStress", "Pa", "tr(sigma') / 3", {}},
       [](Simulation& s) {
         return scalars<double>(particles(s), [&](auto i) { return particles(s).stress[i].mean(); });
       }},
      {{"DeviatoricStress", "Pa", "s = sigma' - tr(sigma') / 3 I, that of sigma too", tensor_components},
       [](Simulation& s) {
         return tensors(particles(s), [&](auto i) { return deviator(particles(s).stress[i]); });
       }},
      {{"VonMisesStress", "Pa", "sqrt(3/2 s : s)", {}},
       [](Simulation& s) {
         return scalars<double>(particles(s),
                                [&](auto i) { return von_mises_stress(particles(s).stress[i]); });
       }},
      {{"Strain", "-", "Green-Lagrange strain since t = 0 (tensor shear, half of gamma)", tensor_components},
       [](Simulation& s) {
         const std::vector<Strain> strain = strain_since_start(s.model());
         return tensors(particles(s), [&](auto i) { return strain[i]; });
       }},
      {{"ExcessStress", "Pa", "sigma' less that of the case's exact solution at rest", tensor_components},
       [](Simulation& s) {
         const std::vector<Stress> exact = reference_stress(s);
         return tensors(particles(s), [&](auto i) { return particles(s).stress[i] + exact[i] * -1.0; });
       }},
  };
  return fields;
}

}  // namespace

const std::vector<FieldDescription>& known_fields() {
  static const std::vector<FieldDescription> all = [] {
    std::vector<FieldDescription> list;
    for (const Field& f : registry()) list.push_back(f.description);
    return list;
  }();
  return all;
}

Frame make_frame(Simulation& simulation, const std::vector<std::string>& names) {
  Frame frame;
  frame.step = simulation.step();
  frame.time = simulation.time();
  const Model& model = simulation.model();
  frame.points =
      vectors(model.particles, [&](auto i) { return Vec2(model.particles.position[i] + model.origin); });
  for (const std::string& name : names) {
    const auto& all = registry();
    const auto field =
        std::find_if(all.begin(), all.end(), [&](const Field& f) { return f.description.name == name; });
    if (field == all.end()) throw std::invalid_argument(fmt::format("no field is called '{}'", name));
    frame.fields.push_back({name, field->description.components, field->values(simulation)});
  }
  return frame;
}

}  // namespace porosph
