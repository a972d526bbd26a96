// An open file of the operating system, closed by its owner.
#pragma once

#include <filesystem>
#include <string_view>

namespace porosph {

/// Owns a POSIX file descriptor. Errors are WriteErrors that name `blamed`, the file the user knows.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags, std::filesystem::path blamed);
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  void write(std::string_view bytes);  ///< all of them
  void sync();                         ///< to the disk
  long size() const;                   ///< [bytes]; fails for a file that was removed meanwhile
  void truncate(long size);            ///< [bytes]
  /// Locks the file until this is closed; false where another descriptor has. True where there are no locks.
  bool lock();

 private:
  [[noreturn]] void fail() const;
  std::filesystem::path blamed_;
  int descriptor_ = -1;
};

}  // namespace porosph
