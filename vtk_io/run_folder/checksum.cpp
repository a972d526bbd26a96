#include "vtk_io/run_folder/checksum.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {

std::uint32_t checksum_of(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  Checksum sum;
  std::array<char, 64 * 1024> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
    sum.add({block.data(), static_cast<std::size_t>(stream.gcount())});
  if (!stream.eof()) throw ReadError(file, std::generic_category().message(errno));
  return sum.value();
}

}  // namespace porosph
