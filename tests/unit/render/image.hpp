// A picture read back from its file.
#pragma once

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "render/colour_map.hpp"

namespace porosph::render {

struct Patch {
  int left = std::numeric_limits<int>::max(), right = -1, bottom = left, top = -1;
  long pixels = 0;
  int width() const { return right - left + 1; }
  int height() const { return top - bottom + 1; }
};

class Image {
 public:
  explicit Image(const std::filesystem::path& path) {
    reader_->SetFileName(path.c_str());
    reader_->Update();
  }
  int width() const { return reader_->GetOutput()->GetDimensions()[0]; }
  int height() const { return reader_->GetOutput()->GetDimensions()[1]; }
  Colour at(int x, int y) const {
    const auto* rgb = static_cast<const unsigned char*>(reader_->GetOutput()->GetScalarPointer(x, y, 0));
    return {rgb[0], rgb[1], rgb[2]};
  }
  /// All pixels of exactly this colour with x < x_end.
  Patch find(const Colour& colour, int x_end) const {
    Patch patch;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < x_end; ++x) {
        if (at(x, y) != colour) continue;
        ++patch.pixels;
        patch.left = std::min(patch.left, x);
        patch.right = std::max(patch.right, x);
        patch.bottom = std::min(patch.bottom, y);
        patch.top = std::max(patch.top, y);
      }
    }
    return patch;
  }
  Patch find(const Colour& colour) const { return find(colour, width()); }

 private:
  vtkNew<vtkPNGReader> reader_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of its own for each test program, removed at the end.
inline std::filesystem::path picture_path(const std::string& name) {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::string pattern = (std::filesystem::temp_directory_path() / "porosph_render_XXXXXX").string();
      path = mkdtemp(pattern.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
  };
  static const Folder folder;
  return folder.path / name;
}

}  // namespace porosph::render
