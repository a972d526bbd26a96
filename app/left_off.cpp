#include "app/left_off.hpp"

#include <fmt/format.h>

#include "app/command.hpp"
#include "solver/case/case_file.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/checkpoint.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph::app {

HandedOver last_state(const std::filesystem::path& folder) {
  const std::filesystem::path case_file = folder / "case.toml";
  if (!has_checkpoint(folder) || !std::filesystem::exists(case_file))
    throw UsageError(
        fmt::format("start_from = \"{}\": the folder does not hold the last state of a run (case.toml and "
                    "checkpoint.bin), as a run leaves it that came to rest, to its end or was interrupted",
                    printable(folder.string())));
  const Case scene = read_case(case_file);
  const auto found = find_state(folder, write_case(scene));
  StagedRun run(scene);
  try {
    StateReader reader(found->state);
    LeftOff().visit(reader, run);
    reader.finish();
  } catch (const StateError& error) {
    throw ReadError(folder / "checkpoint.bin", error.what());
  }
  return run.simulation().hand_over();
}

}  // namespace porosph::app
