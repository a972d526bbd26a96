#include "vtk_io/run_folder/descriptor.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {

Descriptor::Descriptor(const std::filesystem::path& file, int flags, std::filesystem::path blamed)
    : blamed_(std::move(blamed)), descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail();
}

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : blamed_(std::move(other.blamed_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(blamed_, other.blamed_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void Descriptor::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      fail();
    }
  }
}

void Descriptor::sync() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail();  // EINVAL: not a kind of file that can be synced
}

long Descriptor::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail();
  if (status.st_nlink == 0) throw WriteError(blamed_, "it was removed");
  return status.st_size;
}

void Descriptor::truncate(long size) {
  if (::ftruncate(descriptor_, size) != 0) fail();
}

bool Descriptor::lock() {
  int failed = 0;
  do {
    failed = ::flock(descriptor_, LOCK_EX | LOCK_NB);
  } while (failed != 0 && errno == EINTR);
  return failed == 0 || errno != EWOULDBLOCK;
}

void Descriptor::fail() const { throw WriteError(blamed_, std::generic_category().message(errno)); }

}  // namespace porosph
