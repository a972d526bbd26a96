// A frame with every field that a run can write.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/output/frame.hpp"

namespace porosph::test {

inline const std::vector<std::string> tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};  // VTK's order

inline FrameField field(const std::string& name, const std::vector<std::string>& components, int particles) {
  FrameField result{name, components, {}};
  std::vector<double> values(particles * result.width());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 1e5 * std::sin(1.7 * static_cast<double>(i)) / 3;
  result.values = values;
  return result;
}

inline Frame example_frame(double time = 0, int particles = 123) {
  Frame frame;
  frame.step = std::llround(1000 * time);
  frame.time = time;
  for (int i = 0; i < particles; ++i)
    frame.points.insert(frame.points.end(), {0.2 * (i % 20), 0.2 * (i / 20), 0.0});
  frame.fields = {field("Displacement", {"X", "Y", "Z"}, particles),
                  field("EffectiveStress", tensor, particles), field("PorePressure", {}, particles)};
  std::vector<std::int32_t> ids(particles);
  for (int i = 0; i < particles; ++i) ids[i] = i - 5;
  frame.fields.push_back({"ParticleId", {}, ids});
  return frame;
}

inline bool same(const FrameField& a, const FrameField& b) {
  return a.name == b.name && a.components == b.components && a.values == b.values;
}

inline bool same(const Frame& a, const Frame& b) {
  if (a.fields.size() != b.fields.size()) return false;
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    if (!same(a.fields[i], b.fields[i])) return false;
  }
  return a.step == b.step && a.time == b.time && a.points == b.points;
}

}  // namespace porosph::test
