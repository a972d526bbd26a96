#include "vtk_io/finished_run/norms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph {

std::vector<FieldNorms> run_norms(const Frame& a, const Frame& b, const MaterialPoints& points) {
  std::vector<FieldNorms> all;
  for (const FieldSelection& f : comparable_fields(a, b))
    all.push_back(norms(f, points.sample_a(values_of(a, f)), points.sample_b(values_of(b, f)), points.at,
                        points.volumes, largest_component(b, f.name)));
  return all;
}

void require_same_problem(const FinishedRun& run, const FemReference& fem) {
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{} cannot be compared with these finite elements: {} differs",
                                         run.folder.string(), what));
  };
  if (!run.scene)
    throw std::runtime_error(run.folder.string() + " holds no case.toml to hold against finite elements");
  const Case &a = *run.scene, &b = fem.scene();
  if (a.soils.size() != b.soils.size()) refuse("the number of soils");
  for (std::size_t i = 0; i < a.soils.size(); ++i) {
    const SoilCase &s = a.soils[i], &t = b.soils[i];
    if (s.polygon != t.polygon || s.holes != t.holes) refuse("the outline of soil '" + s.name + "'");
    if (s.youngs_modulus != t.youngs_modulus || s.poissons_ratio != t.poissons_ratio)
      refuse("the stiffness of soil '" + s.name + "'");
    if (s.unit_weight_saturated != t.unit_weight_saturated ||
        s.unit_weight_unsaturated != t.unit_weight_unsaturated)
      refuse("the weight of soil '" + s.name + "'");
  }
  const auto same = [](const WaterStretch& s, const WaterStretch& t) {
    return s.x_from == t.x_from && s.x_to == t.x_to && s.level == t.level;
  };
  if (a.water.unit_weight != b.water.unit_weight ||
      !std::equal(a.water.stretches.begin(), a.water.stretches.end(), b.water.stretches.begin(),
                  b.water.stretches.end(), same))
    refuse("the water");
}

namespace {

/// Particles that count against finite elements.
struct Counted {
  std::vector<std::size_t> particles;
  std::vector<Point> at;
  std::vector<double> volumes;
};

Counted counted(const Frame& frame, const FemReference& fem, const std::vector<LeftOut>& left_out) {
  const std::vector<Point> starts = starts_of(frame);
  const std::vector<double> volumes = volumes_of(frame);
  Counted c;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto hides = [&](const LeftOut& o) { return (starts[i] - o.at).norm() < o.radius; };
    if (!fem.covers(starts[i]) || std::ranges::any_of(left_out, hides)) continue;
    c.particles.push_back(i);
    c.at.push_back(starts[i]);
    c.volumes.push_back(volumes[i]);
  }
  if (c.particles.empty())
    throw std::runtime_error("no particle lies in the finite-element mesh and outside of what is left out");
  return c;
}

FieldNorms norm_at(const Counted& c, const Frame& frame, const FemReference& fem, const FieldSelection& field,
                   double scale) {
  const std::vector<double> values = Sampler(c.particles)(values_of(frame, field));
  return norms(field, values, fem.values(field, c.at), c.at, c.volumes, scale);
}

}  // namespace

FieldNorms fem_norm(const Frame& frame, const FemReference& fem, const FieldSelection& field,
                    const std::vector<LeftOut>& left_out) {
  return norm_at(counted(frame, fem, left_out), frame, fem, field, largest_of(values_of(frame, field)));
}

std::vector<FieldNorms> fem_norms(const Frame& frame, const FemReference& fem,
                                  const std::vector<LeftOut>& left_out) {
  const Counted c = counted(frame, fem, left_out);
  std::vector<FieldNorms> all;
  for (const FieldSelection& f : comparable_fields(frame, frame))
    all.push_back(norm_at(c, frame, fem, f, largest_component(frame, f.name)));
  return all;
}

}  // namespace porosph
