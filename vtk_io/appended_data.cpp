#include "vtk_io/appended_data.hpp"

#include <fmt/format.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <bit>
#include <cstring>

#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace {

static_assert(std::endian::native == std::endian::little, "words are read as they stand in the file");

constexpr std::uint64_t best_compression = 1100;   // zlib 1032 : 1, LZ4 255 : 1
constexpr std::uint64_t largest_block = 1u << 30;  // VTK's own are 32 KiB

vtkSmartPointer<vtkDataCompressor> compressor_of(const std::filesystem::path& file, const std::string& name) {
  if (name.empty()) return nullptr;
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  throw ReadError(
      file, fmt::format("compressor '{}' is neither vtkZLibDataCompressor nor vtkLZ4DataCompressor", name));
}

}  // namespace

/// Walks over the bytes of one array and does not leave the file.
class AppendedData::Cursor {
 public:
  Cursor(const std::filesystem::path& file, const std::string& array, std::string_view bytes,
         std::uint64_t offset)
      : file_(file), array_(array), rest_(bytes) {
    take(offset);
  }

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) fail("the file ends within its data");
    const auto taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::uint64_t word(int bytes) {
    std::uint64_t value = 0;
    std::memcpy(&value, take(bytes).data(), bytes);
    return value;
  }

  [[noreturn]] void fail(std::string_view reason) const {
    throw ReadError(file_, fmt::format("array {}: {}", array_, reason));
  }

 private:
  const std::filesystem::path& file_;
  const std::string& array_;
  std::string_view rest_;
};

AppendedData::AppendedData(const std::filesystem::path& file, const FrameHead& head, std::string_view text)
    : file_(file),
      bytes_(text.substr(head.data_begin)),
      header_bytes_(head.header_bytes),
      compressor_(compressor_of(file, head.compressor)) {}

std::uint64_t AppendedData::largest_array() const {
  return compressor_ == nullptr ? bytes_.size() : bytes_.size() * best_compression;
}

void AppendedData::read(const std::string& array, std::uint64_t offset, std::span<unsigned char> out) const {
  Cursor cursor(file_, array, bytes_, offset);
  if (compressor_ != nullptr) return read_blocks(cursor, out);
  if (cursor.word(header_bytes_) != out.size()) cursor.fail("its size does not fit the number of particles");
  const auto bytes = cursor.take(out.size());
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size());
}

void AppendedData::read_blocks(Cursor cursor, std::span<unsigned char> out) const {
  const auto blocks = cursor.word(header_bytes_);
  const auto block_size = cursor.word(header_bytes_);
  const auto partial_size = cursor.word(header_bytes_);  // of the last block; 0: it is full, too
  if (block_size > largest_block || partial_size > block_size) cursor.fail("its block sizes make no sense");
  if (blocks > bytes_.size()) cursor.fail("it has more blocks than the file has bytes");
  const auto total = blocks * block_size - (blocks > 0 && partial_size > 0 ? block_size - partial_size : 0);
  if (total != out.size()) cursor.fail("its size does not fit the number of particles");

  auto sizes = cursor;
  cursor.take(blocks * header_bytes_);
  vtkNew<VtkErrors> errors;
  errors->watch(*compressor_);
  while (!out.empty()) {
    const auto packed = cursor.take(sizes.word(header_bytes_));
    const auto size = std::min<std::size_t>(block_size, out.size());
    const auto* source = reinterpret_cast<const unsigned char*>(packed.data());
    if (compressor_->Uncompress(source, packed.size(), out.data(), size) != size || errors->any()) {
      cursor.fail("its compressed data are damaged");
    }
    out = out.subspan(size);
  }
}

}  // namespace porosph
