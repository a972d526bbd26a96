// What a canvas draws with: the few things that every kind of picture can do.
#pragma once

#include <span>
#include <string>

#include "render/canvas.hpp"

namespace porosph::render {

/// In the picture's own pixels: origin at the lower left corner, y upwards.
class CanvasDevice {
 public:
  CanvasDevice() = default;
  CanvasDevice(const CanvasDevice&) = delete;
  CanvasDevice& operator=(const CanvasDevice&) = delete;
  virtual ~CanvasDevice() = default;

  virtual void polyline(std::span<const Pixel> points, Colour colour, double width) = 0;
  virtual void polygon(std::span<const Pixel> points, const Fill& fill) = 0;
  virtual void text(Pixel at, const std::string& text, const TextStyle& style) = 0;
  virtual void clip(const Box& box) = 0;
  virtual void unclip() = 0;
};

}  // namespace porosph::render
