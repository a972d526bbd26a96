// Any bytes as the tables and the checkpoint of a run: contents or a ReadError.
#include <cstdlib>

#include "tests/fuzz/memory_file.hpp"
#include "vtk_io/run_folder/checkpoint.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/history_csv.hpp"
#include "vtk_io/run_folder/summary_json.hpp"
#include "vtk_io/run_folder/verdict_table.hpp"

namespace {

template <class Read>
void read(const Read& read_it) {
  try {
    read_it();
  } catch (const porosph::ReadError&) {
  }
}

/// The items in front of a state, and one that is not there.
void read_state(std::string_view content) {
  porosph::StateReader reader(content);
  std::int64_t step = 0;
  std::vector<double> numbers(4);
  try {
    reader.value("step", step);
    reader.array("position", numbers);
    reader.finish();
  } catch (const porosph::StateError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const porosph::MemoryFile file(data, size);
  read([&] { porosph::read_history(file.path()); });
  read([&] { porosph::read_summary(file.path()); });
  read([&] { porosph::read_verdicts(file.path()); });
  read([&] { porosph::read_checkpoint(file.path(), "title = \"Seed\"\n"); });
  read_state({reinterpret_cast<const char*>(data), size});
  return 0;
}
