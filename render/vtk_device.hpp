// A canvas on VTK's two-dimensional context.
#pragma once

#include "render/canvas_device.hpp"

class vtkContext2D;
class vtkTextProperty;

namespace porosph::render {

/// `scale`: device pixels per pixel of the picture.
void apply(vtkTextProperty& property, const TextStyle& style, double scale);

class VtkDevice : public CanvasDevice {
 public:
  VtkDevice(vtkContext2D& context, double scale) : context_(context), scale_(scale) {}

  void polyline(std::span<const Pixel> points, Colour colour, double width) override;
  void polygon(std::span<const Pixel> points, const Fill& fill) override;
  void text(Pixel at, const std::string& text, const TextStyle& style) override;
  void clip(const Box& box) override;
  void unclip() override;

 private:
  vtkContext2D& context_;
  double scale_;
};

}  // namespace porosph::render
