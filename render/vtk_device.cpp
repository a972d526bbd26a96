#include "render/vtk_device.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextDevice2D.h>
#include <vtkPen.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/font.hpp"

namespace porosph::render {
namespace {

std::vector<float> on_device(std::span<const Pixel> points, double scale) {
  std::vector<float> coordinates;
  for (const Pixel& point : points) {
    coordinates.push_back(static_cast<float>(point.x * scale));
    coordinates.push_back(static_cast<float>(point.y * scale));
  }
  return coordinates;
}

}  // namespace

void apply(vtkTextProperty& property, const TextStyle& style, double scale) {
  static const std::string font = font_file();
  property.SetFontFamily(VTK_FONT_FILE);
  property.SetFontFile(font.c_str());
  property.SetFontSize(static_cast<int>(std::lround(style.size * scale)));
  property.SetColor(style.colour[0] / 255., style.colour[1] / 255., style.colour[2] / 255.);
  property.SetJustification(static_cast<int>(style.horizontal));  // VTK_TEXT_LEFT, _CENTERED, _RIGHT
  property.SetVerticalJustification(static_cast<int>(style.vertical));
  property.SetOrientation(style.upright ? 90 : 0);
  property.SetLineOffset(0);
}

void VtkDevice::polyline(std::span<const Pixel> points, Colour colour, double width) {
  vtkPen& pen = *context_.GetPen();
  pen.SetLineType(vtkPen::SOLID_LINE);
  pen.SetColor(colour[0], colour[1], colour[2]);
  pen.SetWidth(static_cast<float>(std::max(1L, std::lround(width * scale_))));
  std::vector<float> coordinates = on_device(points, scale_);
  context_.DrawPoly(coordinates.data(), static_cast<int>(points.size()));
}

void VtkDevice::polygon(std::span<const Pixel> points, const Fill& fill) {
  context_.GetPen()->SetLineType(vtkPen::NO_PEN);
  vtkBrush& brush = *context_.GetBrush();
  brush.SetColor(fill.colour[0], fill.colour[1], fill.colour[2]);
  brush.SetOpacityF(fill.opacity);
  std::vector<float> coordinates = on_device(points, scale_);
  context_.DrawPolygon(coordinates.data(), static_cast<int>(points.size()));
}

void VtkDevice::text(Pixel at, const std::string& text, const TextStyle& style) {
  apply(*context_.GetTextProp(), style, scale_);
  context_.DrawString(static_cast<float>(at.x * scale_), static_cast<float>(at.y * scale_),
                      vtkStdString(text));
}

void VtkDevice::clip(const Box& box) {
  int area[4];  // x, y, width, height
  area[0] = static_cast<int>(std::lround(box.x * scale_));
  area[1] = static_cast<int>(std::lround(box.y * scale_));
  area[2] = static_cast<int>(std::lround(box.width * scale_));
  area[3] = static_cast<int>(std::lround(box.height * scale_));
  context_.GetDevice()->SetClipping(area);
  context_.GetDevice()->EnableClipping(true);
}

void VtkDevice::unclip() { context_.GetDevice()->DisableClipping(); }

}  // namespace porosph::render
