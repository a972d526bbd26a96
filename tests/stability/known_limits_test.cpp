// Each limit that the program warns of, held against the sweep that it was read from.
#include "solver/case/known_limits.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "solver/case/case_file.hpp"
#include "solver/sweep/run_sweep.hpp"

using namespace porosph;

namespace {

/// A shipped sweep along one axis, the other one held at a label.
Sweep row(const std::string& name, bool along_x, const std::string& held) {
  const auto folder = std::filesystem::path(POROSPH_SOURCE_DIR) / "cases" / "stability";
  Sweep sweep = read_sweep(folder / (name + ".toml"), false);
  auto& other = (along_x ? sweep.y : sweep.x).values;
  std::erase_if(other, [&](const SweepValue& v) { return v.label != held; });
  REQUIRE(other.size() == 1);
  if (!along_x) std::swap(sweep.x, sweep.y);
  return sweep;
}

bool is_warned_of(const Sweep& sweep, std::size_t i, const std::string& key) {
  const auto warnings = known_failures(read_case(sweep.case_file, sweep.settings_of(i)));
  return std::ranges::any_of(warnings,
                             [&](const std::string& w) { return w.find(key) != std::string::npos; });
}

std::vector<StabilityClass> outcomes(Sweep sweep, const std::vector<std::size_t>& places) {
  std::vector<SweepValue> chosen;
  for (const std::size_t i : places) chosen.push_back(sweep.x.values[i]);
  sweep.x.values = chosen;
  const auto measure = sweep.reference == SweepReference::weight_above ? weight_measure
                       : sweep.reference == SweepReference::energy     ? energy_measure
                                                                       : exact_measure;
  const auto verdicts = run_sweep(sweep, measure, static_cast<int>(std::thread::hardware_concurrency()), {});
  std::vector<StabilityClass> out;
  for (const auto& v : verdicts) out.push_back(v.value().outcome);
  return out;
}

/// Along a row that ends (or with `downwards` begins) with failures: what is the last without a warning
/// holds, and one of the next two with a warning does not.
void check_limit(const Sweep& sweep, const std::string& key, bool downwards = false) {
  std::vector<std::size_t> order(sweep.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = downwards ? order.size() - 1 - i : i;
  const auto first = std::ranges::find_if(order, [&](std::size_t i) { return is_warned_of(sweep, i, key); });
  REQUIRE(first != order.begin());
  REQUIRE(first != order.end());
  for (auto i = first; i != order.end(); ++i) CHECK(is_warned_of(sweep, *i, key));
  const auto end = order.end() - first > 2 ? first + 2 : order.end();
  const std::vector<std::size_t> places(first - 1, end);
  const std::vector<StabilityClass> found = outcomes(sweep, places);
  CAPTURE(sweep.name, sweep.x.values[places[0]].label, sweep.x.values[places[1]].label);
  CHECK(found[0] != StabilityClass::unstable);
  CHECK(found[0] != StabilityClass::thrown_out);
  CHECK(std::any_of(found.begin() + 1, found.end(),
                    [](StabilityClass c) { return c != StabilityClass::accurate; }));
}

}  // namespace

TEST_CASE("limits of the time step are those of the maps", "[limits]") {
  check_limit(row("courant_control", true, "0.2"), "time.courant");
  check_limit(row("courant_control", false, "0.9"), "zero_energy_control");
  check_limit(row("courant_formulation", true, "eq. (24)"), "time.courant");
  check_limit(row("courant_formulation", true, "eq. (25)"), "time.courant");
}

TEST_CASE("the least density ratio of two soils is that of the map", "[limits]") {
  Sweep sweep = row("density_ratio", true, "eq. (14)");
  sweep.x.values.resize(9);  // the lighter soil above
  check_limit(sweep, "density ratio", true);
}

TEST_CASE("the least viscosity of an undamped run is that of the map", "[limits]") {
  Sweep sweep = row("viscosity_undamped", false, "100");
  sweep.x.values.resize(4);  // of eq. (24), alpha from 0 to 0.1
  check_limit(sweep, "artificial_viscosity_alpha", true);
}

TEST_CASE("the largest disorder without closed gradients is that of the map", "[limits]") {
  check_limit(row("disorder", true, "eq. (24), seed 1"), "particles.disorder");
  check_limit(row("disorder", true, "consistent, not closed"), "particles.disorder");
}

TEST_CASE("how high water may stand with the conventional form is what the map says", "[limits]") {
  check_limit(row("water_formulation", true, "eq. (17)"), "suction");
}

TEST_CASE("how far soil that flows may dilate is what the map says", "[limits]") {
  check_limit(row("failure_dilation_limit", true, "30"), "dilation_limit");
}
