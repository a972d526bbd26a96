// What the XML of a .vtp or .vtu says about the binary data after it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace porosph {

struct ArrayHead {
  std::string section;  ///< Points, PointData or FieldData
  std::string name;
  std::string type;                          ///< Float64, Int32, ...
  std::uint64_t components = 1, tuples = 0;  ///< tuples: of particle data the number of points
  std::vector<std::string> component_names;  ///< as many as components, or none
  std::uint64_t offset = 0;                  ///< of its data behind the mark that begins them [bytes]
};

struct FrameHead {
  std::string compressor;  ///< VTK's class name; empty: not compressed
  int header_bytes = 4;    ///< size of the words that give block sizes
  std::uint64_t points = 0;
  std::vector<ArrayHead> arrays;
  std::size_t data_begin = 0;  ///< place of the first byte of data in the file
};

/// `text` is the whole content of `file`. Throws ReadError if it is not a PolyData or UnstructuredGrid of one
/// piece with little-endian data appended raw.
FrameHead read_head(const std::filesystem::path& file, std::string_view text);

}  // namespace porosph
