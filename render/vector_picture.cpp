#include "render/vector_picture.hpp"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <memory>
#include <regex>
#include <stdexcept>

#include "render/canvas_device.hpp"
#include "render/font.hpp"

namespace porosph::render {
namespace {

struct Destroy {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(cairo_font_face_t* f) const { cairo_font_face_destroy(f); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;

/// The font that all pictures use, kept as long as the program runs: cairo holds it in its caches.
cairo_font_face_t* font_face() {
  static const std::unique_ptr<cairo_font_face_t, Destroy> face = [] {
    static FT_Library library = nullptr;
    static FT_Face font = nullptr;
    const std::string file = font_file();
    if (FT_Init_FreeType(&library) != 0 || FT_New_Face(library, file.c_str(), 0, &font) != 0)
      throw std::runtime_error(fmt::format("render: the font {} cannot be read", file));
    return std::unique_ptr<cairo_font_face_t, Destroy>(
        cairo_ft_font_face_create_for_ft_face(font, FT_LOAD_NO_HINTING));
  }();
  return face.get();
}

void set_colour(cairo_t* cairo, const Colour& colour, double opacity = 1) {
  cairo_set_source_rgba(cairo, colour[0] / 255., colour[1] / 255., colour[2] / 255., opacity);
}

class CairoDevice : public CanvasDevice {
 public:
  CairoDevice(cairo_surface_t* surface, double height) : cairo_(cairo_create(surface)), height_(height) {
    cairo_set_font_face(cairo_.get(), font_face());
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  }

  cairo_t* cairo() { return cairo_.get(); }

  void path(std::span<const Pixel> points, Pixel origin = {}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = origin.x + points[i].x, y = height_ - origin.y - points[i].y;
      i == 0 ? cairo_move_to(cairo(), x, y) : cairo_line_to(cairo(), x, y);
    }
  }
  void fill(const Colour& colour, double opacity = 1) {
    set_colour(cairo(), colour, opacity);
    cairo_fill(cairo());
  }

  void polyline(std::span<const Pixel> points, Colour colour, double width) override {
    path(points);
    set_colour(cairo(), colour);
    cairo_set_line_width(cairo(), width);
    cairo_stroke(cairo());
  }
  void polygon(std::span<const Pixel> points, const Fill& how) override {
    path(points);
    cairo_close_path(cairo());
    fill(how.colour, how.opacity);
  }
  void text(Pixel at, const std::string& text, const TextStyle& style) override {
    constexpr double ascent = 0.76,
                     descent = 0.24;  // of the size, as the other kind of pictures aligns lines
    cairo_set_font_size(cairo(), style.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo(), text.c_str(), &extents);
    const double across = style.vertical == Align::low      ? -descent * style.size
                          : style.vertical == Align::centre ? 0.5 * (ascent - descent) * style.size
                                                            : ascent * style.size;
    const double along = style.horizontal == Align::low      ? 0
                         : style.horizontal == Align::centre ? -0.5 * extents.x_advance
                                                             : -extents.x_advance;
    cairo_save(cairo());
    cairo_translate(cairo(), at.x, height_ - at.y);
    if (style.upright) cairo_rotate(cairo(), -0.5 * M_PI);
    cairo_move_to(cairo(), along, across);
    set_colour(cairo(), style.colour);
    cairo_show_text(cairo(), text.c_str());
    cairo_restore(cairo());
  }
  void clip(const Box& box) override {
    cairo_save(cairo());
    cairo_rectangle(cairo(), box.x, height_ - box.top(), box.width, box.height);
    cairo_clip(cairo());
  }
  void unclip() override { cairo_restore(cairo()); }

 private:
  std::unique_ptr<cairo_t, Destroy> cairo_;
  double height_;
};

void draw_patches(CairoDevice& device, const Patches& patches) {
  const Pixel origin{patches.area.x, patches.area.y};
  const double half = 0.5 * patches.dot;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto corners = patches.patch(i);
    if (patches.dot > 0) {
      const Pixel at = corners[0];
      device.path(std::vector<Pixel>{{at.x - half, at.y - half},
                                     {at.x + half, at.y - half},
                                     {at.x + half, at.y + half},
                                     {at.x - half, at.y + half}},
                  origin);
    } else {
      device.path(corners, origin);
    }
    device.fill(patches.colours[i]);
  }
}

void draw_regions(CairoDevice& device, const std::vector<FilledRegion>& regions, Pixel origin) {
  cairo_set_fill_rule(device.cairo(), CAIRO_FILL_RULE_EVEN_ODD);
  for (const FilledRegion& region : regions) {
    for (const auto& ring : region.rings) {
      device.path(ring, origin);
      cairo_close_path(device.cairo());
    }
    device.fill(region.colour);
  }
  cairo_set_fill_rule(device.cairo(), CAIRO_FILL_RULE_WINDING);
}

void draw(const Drawing& drawing, cairo_surface_t* surface, double scale) {
  CairoDevice device(surface, drawing.height);
  cairo_scale(device.cairo(), scale, scale);
  device.polygon(std::vector<Pixel>{{0, 0},
                                    {1. * drawing.width, 0},
                                    {1. * drawing.width, 1. * drawing.height},
                                    {0, 1. * drawing.height}},
                 {.colour = white});
  for (const FieldLayer& layer : drawing.layers) {
    device.clip(layer.patches.area);
    if (layer.regions)
      draw_regions(device, layer.regions(), {layer.patches.area.x, layer.patches.area.y});
    else
      draw_patches(device, layer.patches);
    device.unclip();
  }
  Canvas canvas(device);
  if (drawing.paint) drawing.paint(canvas);
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void finish(cairo_surface_t* surface) {
  cairo_surface_finish(surface);
  if (const cairo_status_t status = cairo_surface_status(surface); status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("render: {}", cairo_status_to_string(status)));
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
  std::string text;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &text, drawing.width, drawing.height));
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  draw(drawing, surface.get(), 1);
  finish(surface.get());
  static const std::regex number("id=\"surface[0-9]+\"");  // counts the surfaces of the whole process
  return std::regex_replace(text, number, "id=\"picture\"");
}

std::string pdf_of(const Drawing& drawing) {
  constexpr double points_per_pixel = 0.75;
  std::string text;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &text, points_per_pixel * drawing.width,
                                                            points_per_pixel * drawing.height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, drawing.title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "1970-01-01T00:00:00Z");  // same bytes
  draw(drawing, surface.get(), points_per_pixel);
  finish(surface.get());
  return text;
}

}  // namespace porosph::render
