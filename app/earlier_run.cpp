#include "app/earlier_run.hpp"

#include <fmt/format.h>

#include "app/command.hpp"
#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"

namespace porosph::app {
namespace {

std::optional<Case> case_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "case.toml";
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return std::nullopt;
  try {
    return read_case(file);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<std::string> adopt_earlier_run(const std::filesystem::path& folder, Case& scene) {
  const std::optional<Case> earlier = case_in(folder);
  if (!earlier) return std::nullopt;
  if (!scene.stages.empty() && scene.time.end != earlier->time.end) return std::nullopt;
  const bool names_step = scene.time.step > 0;
  Case same = scene;
  same.time.end = earlier->time.end;
  if (!names_step) same.time.step = earlier->time.step;
  const std::string text = write_case(*earlier);
  if (write_case(same) != text) return std::nullopt;
  if (!names_step) scene.time.step = earlier->time.step;
  if (scene.time.end == earlier->time.end) return std::nullopt;
  if (scene.time.end < earlier->time.end)
    throw UsageError(fmt::format(
        "time.end = {:g} s: the run in {} goes to {:g} s, and is only resumed to that time or a later one",
        scene.time.end, folder.string(), earlier->time.end));
  if (!(scene.time.step > 0)) scene.time.step = Simulation(*earlier).time_step();
  return text;
}

}  // namespace porosph::app
