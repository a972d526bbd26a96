// One process at a time writes into a folder.
#pragma once

#include <filesystem>

#include "vtk_io/run_folder/descriptor.hpp"

namespace porosph {

/// Keeps a folder to this process while it lives. The operating system lets go of it however the process
/// ends, so nothing is left to clear away. Where the file system has no locks (some over a network) it keeps
/// nobody out.
class FolderLock {
 public:
  /// Makes the folder where there is none. Throws WriteError where that fails or another process has it.
  explicit FolderLock(std::filesystem::path folder);
  /// Removes the folder if it was made here and is still empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path folder_;
  bool made_;
  Descriptor descriptor_;
};

}  // namespace porosph
