#include "vtk_io/run_folder/folder_lock.hpp"

#include <fcntl.h>

#include <system_error>
#include <utility>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {

FolderLock::FolderLock(std::filesystem::path folder)
    : folder_(std::move(folder)),
      made_(make_folder(folder_)),
      descriptor_(folder_, O_RDONLY | O_DIRECTORY, folder_) {
  if (!descriptor_.lock())
    throw WriteError(
        folder_,
        "another process computes into it; wait until it has ended, or choose another folder with --out");
}

FolderLock::~FolderLock() {
  if (!made_) return;
  std::error_code not_empty;
  std::filesystem::remove(folder_, not_empty);
}

}  // namespace porosph
