#include "render/colour_map.hpp"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>

#include "render/colour_map_tables.hpp"

namespace porosph::render {

namespace {

using Table = std::array<std::uint32_t, 52>;

Colour blend(std::uint32_t from, std::uint32_t to, double fraction) {
  Colour colour{};
  for (int channel = 0; channel < 3; ++channel) {
    const int shift = 16 - 8 * channel;
    const double a = (from >> shift) & 0xff, b = (to >> shift) & 0xff;
    colour[channel] = static_cast<std::uint8_t>(std::lround(a + fraction * (b - a)));
  }
  return colour;
}

Colour look_up(const Table& table, double fraction) {
  const double position = fraction * static_cast<double>(table.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), table.size() - 2);
  return blend(table[below], table[below + 1], position - static_cast<double>(below));
}

// K. Moreland (2009), Diverging color maps for scientific visualization, ISVC 2009: VTK's diverging colour
// space.
vtkNew<vtkColorTransferFunction> cool_warm_function() {
  vtkNew<vtkColorTransferFunction> function;
  function->SetColorSpaceToDiverging();
  function->AddRGBPoint(0, 0.230, 0.299, 0.754);
  function->AddRGBPoint(1, 0.706, 0.016, 0.150);
  return function;
}

}  // namespace

bool is_diverging(ColourMap map) { return map == ColourMap::cool_warm; }

std::vector<Colour> colour_table(ColourMap map, int count) {
  const vtkNew<vtkColorTransferFunction> diverging = cool_warm_function();
  std::vector<Colour> colours;
  for (int i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / (count - 1);
    if (map == ColourMap::viridis) {
      colours.push_back(look_up(viridis_table, fraction));
    } else if (map == ColourMap::cividis) {
      colours.push_back(look_up(cividis_table, fraction));
    } else {
      const unsigned char* rgb = diverging->MapValue(fraction);
      colours.push_back({rgb[0], rgb[1], rgb[2]});
    }
  }
  return colours;
}

std::vector<Colour> above_zero_table(ColourMap map, int count) {
  const Colour start = colour_table(map, 2).back();
  const std::array<std::uint32_t, 4> steps = {
      static_cast<std::uint32_t>(start[0] << 16 | start[1] << 8 | start[2]), 0xfd8d3c, 0xe31a1c, 0x800026};
  std::vector<Colour> colours;
  for (int i = 0; i < count; ++i) {
    const double position = 3. * i / (count - 1);
    const auto below = std::min(static_cast<std::size_t>(position), std::size_t{2});
    colours.push_back(blend(steps[below], steps[below + 1], position - static_cast<double>(below)));
  }
  return colours;
}

// Light for the sequential maps, whose low ends and cividis' middle are dark; dark where the middle is light.
Colour invalid_colour(ColourMap map) {
  return is_diverging(map) ? Colour{90, 90, 90} : Colour{190, 190, 190};
}

}  // namespace porosph::render
