// The binary data at the end of a .vtp or .vtu, with every size in them checked before it is used.
#pragma once

#include <vtkDataCompressor.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "vtk_io/frame_head.hpp"

namespace porosph {

/// Borrows `text`, the whole content of `file`.
class AppendedData {
 public:
  /// Throws ReadError if the compressor is not one of VTK's ZLib or LZ4, or none.
  AppendedData(const std::filesystem::path& file, const FrameHead& head, std::string_view text);

  /// More bytes than an array can have, seeing the size of the file and what compressors achieve.
  std::uint64_t largest_array() const;

  /// Fills `out` with the array at `offset`. Throws ReadError naming `array` if the data are not of that
  /// size.
  void read(const std::string& array, std::uint64_t offset, std::span<unsigned char> out) const;

 private:
  class Cursor;
  void read_blocks(Cursor cursor, std::span<unsigned char> out) const;

  const std::filesystem::path& file_;
  std::string_view bytes_;
  int header_bytes_;
  vtkSmartPointer<vtkDataCompressor> compressor_;
};

}  // namespace porosph
