// Any bytes as a case file: a case or a CaseError. A case that is accepted is written and read back the same.
#include <cstdlib>

#include "solver/case/case_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace porosph;
  try {
    const Case scene = parse_case({reinterpret_cast<const char*>(data), size}, "case.toml");
    const std::string written = write_case(scene);
    if (write_case(parse_case(written, "written.toml")) != written) std::abort();
  } catch (const CaseError&) {
  }
  return 0;
}
