// One picture in the making: world scenes below, drawing in pixels on top, saved as PNG.
#pragma once

#include <vtkProp.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>

#include "render/canvas.hpp"

namespace porosph {

/// The caller holds render_mutex() for the whole life of a picture.
class Picture {
 public:
  /// Supersampled: drawn at twice the size and averaged, which smooths text, lines and particles alike.
  static constexpr int supersampling = 2;

  /// Size in pixels, 1 to 8000 each way. Throws std::runtime_error otherwise.
  Picture(int width, int height);

  /// Shows `prop`, whose coordinates are pixels from the lower left corner of `area`, inside of `area`.
  void add_scene(const Box& area, vtkProp* prop);
  /// `paint` is called when the picture is saved, on top of all scenes.
  void draw(std::function<void(Canvas&)> paint);
  /// The file is the old or the complete new one. Throws WriteError.
  void save(const std::filesystem::path& path);

 private:
  int width_, height_;
  vtkSmartPointer<vtkRenderWindow> window_;
};

}  // namespace porosph
