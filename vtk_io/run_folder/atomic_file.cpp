#include "vtk_io/run_folder/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "vtk_io/run_folder/descriptor.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Removes the temporary unless it has become the file.
struct Temporary {
  explicit Temporary(const fs::path& file)
      : path(folder_of(file) / fmt::format(".{}.part", file.filename().string())) {
    remove();  // left by a job that was killed
  }
  ~Temporary() { remove(); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  void remove() const {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  fs::path path;
};

}  // namespace

void replace_file(const fs::path& file, const std::function<void(const fs::path& temporary)>& fill) {
  const Temporary temporary(file);
  fill(temporary.path);
  Descriptor(temporary.path, O_RDONLY, file).sync();
  std::error_code error;
  fs::rename(temporary.path, file, error);
  if (error) throw WriteError(file, error.message());
  Descriptor(folder_of(file), O_RDONLY | O_DIRECTORY, file).sync();  // the new name, too
}

void write_file(const fs::path& file, std::string_view content) {
  replace_file(file, [&](const fs::path& temporary) {
    Descriptor(temporary, O_WRONLY | O_CREAT | O_EXCL, file).write(content);
  });
}

bool make_folder(const fs::path& folder) {
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  return made;
}

std::string read_file(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);  // fails for folders, too
  if (error) throw ReadError(file, error.message());
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string content(size, '\0');
  if (!stream.read(content.data(), static_cast<std::streamsize>(size))) {
    throw ReadError(file, std::generic_category().message(errno));
  }
  return content;
}

}  // namespace porosph
