#include "render/colour_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "render/nice_ticks.hpp"

namespace porosph::render {

namespace {

constexpr double bar_width = 18, tick_length = 5, label_gap = 5, title_gap = 8, point_height = 14;
constexpr double swatch = 12, swatch_gap = 16;
constexpr double longest_name = 160;  // of a category; longer ones are drawn smaller
constexpr int colour_count = 256;
const std::string invalid_label = "no value";

/// What stands beside a pointed end, how far values go, to three digits: "to −205", "to 1530". In the unit of
/// the ticks.
std::string reach_text(double value, const AxisTicks& ticks) {
  const double size = std::abs(value) / ticks.unit;
  const bool is_whole = size >= 1000 && size < 1e6;
  const double last_digit = is_whole ? std::pow(10, std::floor(std::log10(size)) - 2) : 1;
  const std::string number = is_whole ? fmt::format("{:.0f}", last_digit * std::round(size / last_digit))
                                      : fmt::format("{:.3g}", size);
  return (value < 0 ? "to −" : "to ") + number;
}

Axis axis_of(const FixedScale& scale) {
  return {scale.range.low, scale.range.high, scale.logarithmic, scale.label};
}

ValueRange given_range(const ColourScale& scale) {
  const ValueRange range = *scale.range;
  if (!std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low < range.high))
    throw std::runtime_error(
        fmt::format("render: colour range {} to {} of {}; allowed are finite bounds, the lower first",
                    range.low, range.high, scale.label));
  return range;
}

/// The part of `box` that the linear scale takes, without points and swatch.
Box straight_part(const Box& box, const FixedScale& scale) {
  Box bar{box.x, box.y, bar_width, box.height};
  const double below =
      (scale.values_invalid ? swatch + swatch_gap : 0) + (scale.values_below ? point_height : 0);
  bar.y += below;
  bar.height -= below + (scale.values_above ? point_height : 0);
  return bar;
}

/// Low end first. Brown to green, pale enough for lines and names on them.
Colour category_colour(std::size_t i) {
  static constexpr std::array<Colour, 8> colours = {{{222, 200, 150},
                                                     {140, 170, 190},
                                                     {190, 140, 110},
                                                     {150, 180, 130},
                                                     {205, 205, 205},
                                                     {120, 120, 150},
                                                     {230, 170, 120},
                                                     {110, 150, 140}}};
  return colours[i % colours.size()];
}

/// From the low end of the bar to its high end.
std::vector<Colour> bar_colours(const FixedScale& scale) {
  if (!scale.categories.empty()) {
    std::vector<Colour> colours;
    for (std::size_t i = 0; i < scale.categories.size(); ++i) colours.push_back(category_colour(i));
    return colours;
  }
  const auto [low, high] = scale.range;
  if (is_diverging(scale.map) || !(low < 0 && high > 0)) return colour_table(scale.map, colour_count);
  const int below =
      std::clamp(static_cast<int>(std::lround(-low / (high - low) * colour_count)), 2, colour_count - 2);
  std::vector<Colour> colours = colour_table(scale.map, below);
  const std::vector<Colour> above = above_zero_table(scale.map, colour_count - below);
  colours.insert(colours.end(), above.begin(), above.end());
  return colours;
}

double label_width(const AxisTicks& ticks) {
  double width = 0;
  for (const std::string& label : ticks.labels) width = std::max(width, text_extent(label, tick_text).x);
  return width;
}

void draw_colours(Canvas& canvas, const Box& bar, const std::vector<Colour>& table) {
  const double step = bar.height / static_cast<double>(table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
    canvas.box({bar.x, bar.y + static_cast<double>(i) * step, bar.width, step}, {.colour = table[i]});
}

void draw_bands(Canvas& canvas, const Box& bar, const FixedScale& scale) {
  const std::vector<Colour> colours = band_colours(scale);
  const Axis axis = axis_of(scale);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double low = i == 0 ? 0 : axis.fraction(scale.levels[i - 1]),
                 high = i == scale.levels.size() ? 1 : axis.fraction(scale.levels[i]);
    canvas.box({bar.x, bar.y + low * bar.height, bar.width, (high - low) * bar.height},
               {.colour = colours[i]});
  }
}

void draw_point(Canvas& canvas, const Box& bar, double base, double tip, Colour colour) {
  const std::vector<Pixel> triangle = {{bar.x, base}, {bar.centre().x, tip}, {bar.right(), base}};
  canvas.polygon(triangle, {.colour = colour});
  canvas.line(triangle, {.colour = {60, 60, 60}});
}

/// 1, 2 and 5 times powers of ten within the range.
std::vector<double> one_two_five(const ValueRange& range) {
  std::vector<double> levels;
  for (int power = static_cast<int>(std::floor(std::log10(range.low))); std::pow(10, power) <= range.high;
       ++power)
    for (const double digit : {1, 2, 5})
      if (const double level = digit * std::pow(10, power); level >= range.low && level <= range.high)
        levels.push_back(level);
  return levels;
}

}  // namespace

FixedScale fix_scale(const ColourScale& scale, std::span<const double> values) {
  const ValueRange extent = finite_extent(values);
  FixedScale fixed{
      .label = scale.label, .map = scale.map, .range = {}, .extent = extent, .categories = scale.categories};
  if (!scale.categories.empty())
    fixed.range = {-0.5, static_cast<double>(scale.categories.size()) - 0.5};
  else if (scale.range)
    fixed.range = given_range(scale);
  else
    fixed.range = is_diverging(scale.map) ? centred_range(extent) : rounded_range(extent);
  const double hair = 1e-6 * (fixed.range.high - fixed.range.low);
  fixed.logarithmic = scale.logarithmic && fixed.range.low > 0;
  fixed.bands = scale.bands && scale.categories.empty();
  if (scale.categories.empty()) {
    constexpr int most_levels = 13;
    fixed.levels = fixed.logarithmic ? one_two_five(fixed.range)
                                     : linear_ticks(fixed.range.low, fixed.range.high, most_levels);
    std::erase_if(fixed.levels, [&](double level) {
      const double at = axis_of(fixed).fraction(level);
      return at < 1e-6 || at > 1 - 1e-6;
    });
  }
  fixed.values_below = extent.low < fixed.range.low - (fixed.logarithmic ? 1e-6 * fixed.range.low : hair);
  fixed.values_above = extent.high > fixed.range.high + hair;
  if (extent.low > extent.high) fixed.values_below = fixed.values_above = false;
  fixed.values_invalid = std::ranges::any_of(values, [](double value) { return !std::isfinite(value); });
  return fixed;
}

std::vector<Colour> band_colours(const FixedScale& scale) {
  std::vector<double> edges = scale.levels;
  edges.insert(edges.begin(), scale.range.low);
  edges.push_back(scale.range.high);
  std::vector<double> middles;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    middles.push_back(scale.logarithmic ? std::sqrt(edges[i] * edges[i + 1])
                                        : 0.5 * (edges[i] + edges[i + 1]));
  FixedScale continuous = scale;
  continuous.bands = false;
  return colours_of(middles, continuous);
}

std::vector<Colour> colours_of(std::span<const double> values, const FixedScale& scale) {
  if (scale.bands) {
    const std::vector<Colour> bands = band_colours(scale);
    std::vector<Colour> colours;
    colours.reserve(values.size());
    for (const double value : values)
      colours.push_back(std::isfinite(value)
                            ? bands[static_cast<std::size_t>(std::ranges::upper_bound(scale.levels, value) -
                                                             scale.levels.begin())]
                            : invalid_colour(scale.map));
    return colours;
  }
  const std::vector<Colour> table = bar_colours(scale);
  const auto count = static_cast<double>(table.size());
  const Axis axis = axis_of(scale);
  std::vector<Colour> colours;
  colours.reserve(values.size());
  for (const double value : values) {
    if (!std::isfinite(value)) {
      colours.push_back(invalid_colour(scale.map));
    } else {
      const double place = value > scale.range.low ? axis.fraction(value) : 0;
      const double index = std::clamp(place * count, 0., count - 1.);
      colours.push_back(table[static_cast<std::size_t>(index)]);
    }
  }
  return colours;
}

double colour_bar_width(const FixedScale& scale, double height) {
  const AxisTicks ticks = fitting_ticks(axis_of(scale), straight_part({0, 0, 0, height}, scale).height, true);
  double labels = label_width(ticks) + tick_length + label_gap;
  for (const std::string& name : scale.categories)
    labels = std::max(labels, label_gap + std::min(longest_name, text_extent(name, tick_text).x));
  if (scale.values_below)
    labels = std::max(labels, label_gap + text_extent(reach_text(scale.extent.low, ticks), tick_text).x);
  if (scale.values_above)
    labels = std::max(labels, label_gap + text_extent(reach_text(scale.extent.high, ticks), tick_text).x);
  if (scale.values_invalid) labels = std::max(labels, label_gap + text_extent(invalid_label, tick_text).x);
  return bar_width + labels + title_gap + 1.4 * title_text;
}

void draw_colour_bar(Canvas& canvas, const Box& box, const FixedScale& scale) {
  const Box bar = straight_part(box, scale);
  const std::vector<Colour> table = bar_colours(scale);
  const Pen edge{.colour = {60, 60, 60}};
  if (scale.bands)
    draw_bands(canvas, bar, scale);
  else
    draw_colours(canvas, bar, table);
  canvas.frame(bar, edge);
  if (const double zero = bar.y + bar.height * axis_of(scale).fraction(0); zero > bar.y && zero < bar.top())
    if (scale.categories.empty() && !scale.logarithmic) canvas.line({bar.x, zero}, {bar.right(), zero}, edge);
  if (scale.values_below) draw_point(canvas, bar, bar.y, bar.y - point_height, table.front());
  if (scale.values_above) draw_point(canvas, bar, bar.top(), bar.top() + point_height, table.back());
  const auto beside = [&](double y, const std::string& text) {
    canvas.text({bar.right() + label_gap, y}, text,
                {.size = fitting_size(text, tick_text, longest_name), .horizontal = Align::low});
  };
  const Axis axis = axis_of(scale);
  const AxisTicks ticks = scale.categories.empty() ? fitting_ticks(axis, bar.height, true) : AxisTicks{};
  if (scale.values_below) beside(bar.y - 0.8 * point_height, reach_text(scale.extent.low, ticks));
  if (scale.values_above) beside(bar.top() + 0.8 * point_height, reach_text(scale.extent.high, ticks));
  for (std::size_t i = 0; i < scale.categories.size(); ++i)
    beside(bar.y + bar.height * axis.fraction(static_cast<double>(i)), scale.categories[i]);
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double y = bar.y + bar.height * axis.fraction(ticks.major[i]);
    canvas.line({bar.right(), y}, {bar.right() + tick_length, y}, edge);
    canvas.text({bar.right() + tick_length + label_gap, y}, ticks.labels[i],
                {.size = tick_text, .horizontal = Align::low});
  }
  if (scale.values_invalid) {
    const Box box_of_swatch{bar.x, box.y, bar_width, swatch};
    canvas.box(box_of_swatch, {.colour = invalid_colour(scale.map)});
    canvas.frame(box_of_swatch, edge);
    canvas.text({bar.right() + label_gap, box_of_swatch.centre().y}, invalid_label,
                {.size = tick_text, .horizontal = Align::low});
  }
  const std::string title = ticks.factor.empty() ? scale.label : scale.label + "  " + ticks.factor;
  canvas.text({box.x + colour_bar_width(scale, box.height), bar.centre().y}, title,
              {.size = fitting_size(title, title_text, bar.height), .vertical = Align::low, .upright = true});
}

}  // namespace porosph::render
