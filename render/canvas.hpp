// Drawing on a picture in its own pixels: origin at the lower left corner, y upwards.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/colour_map.hpp"

namespace porosph::render {

class CanvasDevice;

struct Pixel {
  double x = 0, y = 0;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double top() const { return y + height; }
  Pixel centre() const { return {x + 0.5 * width, y + 0.5 * height}; }
};

inline constexpr Colour black{20, 20, 20}, white{255, 255, 255};

struct Pen {
  Colour colour = black;
  double width = 1;                 ///< [pixels]
  std::vector<double> dashes = {};  ///< lengths drawn and skipped in turn [pixels]; empty: solid
};

struct Fill {
  Colour colour = white;
  double opacity = 1;
};

enum class Align { low, centre, high };  ///< left or bottom, centre, right or top

struct TextStyle {
  double size = 13;  ///< [pixels]
  Colour colour = black;
  Align horizontal = Align::centre, vertical = Align::centre;
  bool upright = false;  ///< turned by 90 degrees, read from below
  bool halo = false;     ///< a white rim, to be read on any colour
};

/// Texts may hold subscripts, "σ'_{yy}": drawn smaller and lower, without the signs around them.

/// Width and height of the text when drawn horizontally [pixels].
Pixel text_extent(const std::string& text, double size);

/// The size, at most `size`, at which the text is no wider than `width`.
double fitting_size(const std::string& text, double size, double width);

/// The parts of a polyline that a dash pattern draws. Lengths in the polyline's own unit.
std::vector<std::vector<Pixel>> dashed(std::span<const Pixel> line, std::span<const double> pattern);

class Canvas {
 public:
  explicit Canvas(CanvasDevice& device) : device_(device) {}

  void line(std::span<const Pixel> points, const Pen& pen);
  void line(Pixel from, Pixel to, const Pen& pen);
  void polygon(std::span<const Pixel> points, const Fill& fill);
  void box(const Box& box, const Fill& fill);
  void frame(const Box& box, const Pen& pen);
  void disc(Pixel centre, double radius, const Fill& fill, const Pen& edge);
  /// For a text that is upright, `horizontal` aligns along the text and `vertical` across it.
  void text(Pixel at, const std::string& text, const TextStyle& style);

  /// Nothing is drawn outside `box` until `unclip`.
  void clip(const Box& box);
  void unclip();

 private:
  void plain_text(Pixel at, const std::string& text, const TextStyle& style);

  CanvasDevice& device_;
};

}  // namespace porosph::render
