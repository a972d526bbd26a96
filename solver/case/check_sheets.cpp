#include "solver/case/check_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

/// Whether there is soil beside any part of it.
bool touches_soil(const Case& c, const SheetCase& sheet) {
  constexpr int samples = 64;
  const Point way = sheet.to - sheet.from;
  const Point aside = 0.25 * c.particles.spacing * Point(-way.y(), way.x()).normalized();
  for (int k = 0; k < samples; ++k) {
    const Point at = sheet.from + (k + 0.5) / samples * way;
    for (const SoilCase& soil : c.soils)
      if (distance(Point(at + aside), soil) <= 0 || distance(Point(at - aside), soil) <= 0) return true;
  }
  return false;
}

std::string place_fault(const Case& c, const SheetCase& sheet) {
  const double spacing = c.particles.spacing, length = (sheet.to - sheet.from).norm();
  if (length < 2 * spacing) return fmt::format("is shorter than two spacings, {} m", 2 * spacing);
  const Point way = (sheet.to - sheet.from).cwiseAbs();
  if (way.minCoeff() > 1e-6 * spacing)
    return "must be level or upright: rows of particles begin on both of its sides";
  if (!touches_soil(c, sheet)) return "touches no soil";
  for (std::size_t i = 0; i < c.boundaries.size(); ++i) {
    const BoundaryCase& b = c.boundaries[i];
    const Point along = (sheet.to - sheet.from) / length, across(-along.y(), along.x());
    const bool in_line = std::abs(across.dot(b.from - sheet.from)) < spacing / 2 &&
                         std::abs(across.dot(b.to - sheet.from)) < spacing / 2;
    if (in_line && distance(sheet.from, sheet.to, b.from, b.to) < spacing / 2)
      return fmt::format("lies along boundary[{}], which holds the soil already", i);
  }
  return "";
}

}  // namespace

std::vector<CaseIssue> check_sheets(const Case& c) {
  std::vector<CaseIssue> issues;
  for (std::size_t i = 0; i < c.sheets.size(); ++i) {
    const SheetCase& sheet = c.sheets[i];
    const std::string key = fmt::format("sheet[{}]", i);
    if (const std::string fault = place_fault(c, sheet); !fault.empty()) issues.push_back({key, fault});
    if (c.formulation.motion != Motion::consistent)
      issues.push_back({key, "a sheet needs formulation.motion = \"consistent\""});
    if (c.particles.arrangement != Arrangement::surface && c.particles.arrangement != Arrangement::stretched)
      issues.push_back({key,
                        "a sheet needs particles.arrangement = \"surface\" or \"stretched\", whose rows end "
                        "at it"});
    if (c.water.flows())
      issues.push_back(
          {key, fmt::format("a sheet cannot be combined with water.mode = \"{}\"", name(c.water.mode))});
    for (std::size_t j = 0; j < i; ++j)
      if (distance(sheet.from, sheet.to, c.sheets[j].from, c.sheets[j].to) < 4 * c.smoothing_length())
        issues.push_back({key, fmt::format("must be {} m or more away from sheet '{}'",
                                           4 * c.smoothing_length(), c.sheets[j].name)});
    const auto has_its_name = [&](const auto& other) { return other.name == sheet.name; };
    if (std::ranges::any_of(c.probes, has_its_name))
      issues.push_back({key + ".name", fmt::format("'{}' is the name of a probe too", sheet.name)});
    if (std::ranges::any_of(c.footings, has_its_name))
      issues.push_back({key + ".name", fmt::format("'{}' is the name of a footing too", sheet.name)});
  }
  return issues;
}

}  // namespace porosph
