#include "app/stage_safety.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/find_safety.hpp"
#include "app/interruption.hpp"
#include "app/say.hpp"
#include "app/warnings.hpp"
#include "solver/case/safety_obstacle.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {

Summary::Safety find_stage_safety(StagedRun& stages, const std::filesystem::path& folder, bool quiet) {
  const std::string name = stages.plan().name();
  Case scene = stages.plan().scene();
  scene.title = fmt::format("{}, stage '{}'", scene.title, name);
  scene.time.end = stages.simulation().time();
  const HandedOver state = stages.simulation().hand_over();
  SafetyAnswer answer;
  if (!quiet) say(stdout, fmt::format("factor of safety of stage '{}'\n", name));
  try {
    answer = find_safety(scene, {.by_particles = true,
                                 .by_limit_equilibrium = limit_equilibrium_obstacle(scene).empty(),
                                 .bracket = stages.plan().table()->safety_bracket,
                                 .from = &state,
                                 .quiet = quiet});
  } catch (const std::runtime_error& error) {
    warn({fmt::format("stage '{}': {}", name, error.what())});
    return {.stable_at = 0, .fails_at = never, .limit_equilibrium = 0, .note = error.what()};
  }
  if (is_interrupted()) return {};
  const std::filesystem::path files = folder / safety_folder(name);
  make_folder(files);
  write_safety(scene, answer, fmt::format("porosph run {}", (folder / "case.toml").string()), files);
  warn(answer.warnings);
  return in_short(answer);
}

}  // namespace porosph::app
