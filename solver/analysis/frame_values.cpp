#include "solver/analysis/frame_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"
#include "solver/case/nearest.hpp"

namespace porosph {
namespace {

[[noreturn]] void refuse(const Frame& frame, const std::string& name) {
  std::vector<std::string> stored, computed = derivable_fields(frame);
  for (const FrameField& field : frame.fields) stored.push_back(field.name);
  std::vector<std::string> all = stored;
  all.insert(all.end(), computed.begin(), computed.end());
  const std::string meant = nearest(name, all);
  std::string text = fmt::format("the series has no field '{}'", name);
  if (const std::string sources = sources_of_field(name); !sources.empty())
    text += fmt::format(", and not {}, from which it is computed", sources);
  else if (!meant.empty())
    text += fmt::format(" (did you mean '{}'?)", meant);
  text += fmt::format("; it has {}", fmt::join(stored, ", "));
  if (!computed.empty()) text += fmt::format("; from these are computed {}", fmt::join(computed, ", "));
  throw std::runtime_error(text);
}

const FrameField* find_stored(const Frame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.fields, name, &FrameField::name);
  return found == frame.fields.end() ? nullptr : &*found;
}

std::vector<double> as_doubles(const FrameField& field) {
  return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                    field.values);
}

std::vector<double> magnitudes(const std::vector<double>& values, std::size_t width) {
  std::vector<double> out(values.size() / width);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t c = 0; c < width; ++c) out[i] = std::hypot(out[i], values[i * width + c]);
  return out;
}

}  // namespace

FieldSelection parse_selection(const std::string& text) {
  const auto colon = text.find(':');
  FieldSelection selection{text.substr(0, colon), colon == std::string::npos ? "" : text.substr(colon + 1)};
  if (selection.name.empty() || (colon != std::string::npos && selection.component.empty()) ||
      selection.component.find(':') != std::string::npos)
    throw std::runtime_error(
        fmt::format("field '{}': must be NAME or NAME:COMPONENT, such as EffectiveStress:YY", text));
  return selection;
}

std::vector<double> values_of(const Frame& frame, const FieldSelection& selection) {
  std::optional<FrameField> computed;
  const FrameField* stored = find_stored(frame, selection.name);
  if (stored == nullptr) {
    computed = derived_field(frame, selection.name);
    if (!computed) refuse(frame, selection.name);
    stored = &*computed;
  }
  const FrameField& field = *stored;
  std::vector<double> values = as_doubles(field);
  const auto width = static_cast<std::size_t>(field.width());
  const auto& names = field.components;
  if (selection.component.empty()) {
    if (width > 1 && names.front() != "X")
      throw std::runtime_error(fmt::format("field '{0}' is not a vector: choose a component, {0}:{1}",
                                           field.name, fmt::join(names, fmt::format(", {}:", field.name))));
    return width == 1 ? values : magnitudes(values, width);
  }
  const auto found = std::find(names.begin(), names.end(), selection.component);
  if (found == names.end())
    throw std::runtime_error(names.empty()
                                 ? fmt::format("field '{}' is a scalar: it has no components", field.name)
                                 : fmt::format("field '{}' has no component '{}'; it has {}", field.name,
                                               selection.component, fmt::join(names, ", ")));
  std::vector<double> out(values.size() / width);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = values[i * width + static_cast<std::size_t>(found - names.begin())];
  return out;
}

bool has_field(const Frame& frame, const std::string& name) { return find_stored(frame, name) != nullptr; }

bool can_show(const Frame& frame, const std::string& name) {
  const auto computed = derivable_fields(frame);
  return has_field(frame, name) || std::ranges::find(computed, name) != computed.end();
}

std::vector<Point> starts_of(const Frame& frame) {
  if (!has_field(frame, "Displacement"))
    throw std::runtime_error("comparing needs the field Displacement, which the series does not have");
  const auto x = values_of(frame, {"Displacement", "X"}), y = values_of(frame, {"Displacement", "Y"});
  std::vector<Point> starts(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    starts[i] = {frame.points[3 * i] - x[i], frame.points[3 * i + 1] - y[i]};
  return starts;
}

std::vector<double> volumes_of(const Frame& frame) {
  if (!has_field(frame, "Mass") || !has_field(frame, "Density"))
    return std::vector<double>(frame.points.size() / 3, 1.0);
  std::vector<double> volumes = values_of(frame, {"Mass", ""});
  const std::vector<double> densities = values_of(frame, {"Density", ""});
  for (std::size_t i = 0; i < volumes.size(); ++i) volumes[i] /= densities[i];
  return volumes;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (double v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

}  // namespace porosph
