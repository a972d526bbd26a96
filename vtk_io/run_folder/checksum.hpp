// Checksums by which a file is recognised.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace porosph {

/// CRC-32 of bytes that arrive in parts.
class Checksum {
 public:
  void add(std::string_view bytes) { crc_.process_bytes(bytes.data(), bytes.size()); }
  std::uint32_t value() const { return crc_.checksum(); }

 private:
  boost::crc_32_type crc_;
};

/// Of a whole file. Throws ReadError.
std::uint32_t checksum_of(const std::filesystem::path& file);

}  // namespace porosph
