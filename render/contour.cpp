#include "render/contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "render/contour_layout.hpp"
#include "render/offscreen_window.hpp"
#include "render/particle_scene.hpp"
#include "render/picture.hpp"

namespace porosph {

namespace {

constexpr double padding = 18;  // room for the supports between soil and frame [pixels]
constexpr double figure_title_text = 19, panel_title_text = 15, subtitle_text = 13;

struct Extent {
  double x_low = std::numeric_limits<double>::infinity(), x_high = -x_low, y_low = x_low, y_high = -x_low;
  void include(double x, double y, double reach = 0) {
    x_low = std::min(x_low, x - reach);
    x_high = std::max(x_high, x + reach);
    y_low = std::min(y_low, y - reach);
    y_high = std::max(y_high, y + reach);
  }
  double width() const { return x_high - x_low; }
  double height() const { return y_high - y_low; }
  bool contains(const Point& p) const {
    return p.x() >= x_low && p.x() <= x_high && p.y() >= y_low && p.y() <= y_high;
  }
};

void check(const ContourPanel& panel) {
  const ParticleField& field = panel.particles;
  const std::size_t count = field.positions.size();
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("render: contour panel '{}': {}", panel.title, what));
  };
  if (count == 0) fail("no particles");
  if (field.values.size() != count)
    fail(fmt::format("{} values for {} particles", field.values.size(), count));
  if (field.sizes.size() != 1 && field.sizes.size() != count)
    fail(fmt::format("{} sizes for {} particles; allowed are 1 or one each", field.sizes.size(), count));
  if (!std::ranges::all_of(field.sizes, [](double size) { return size > 0 && std::isfinite(size); }))
    fail("a particle size that is not positive");
  if (!field.cells.empty() && field.cells.size() != count)
    fail(fmt::format("{} cells for {} particles; allowed are none or one each", field.cells.size(), count));
  if (!field.displacements.empty() && field.displacements.size() != count)
    fail(fmt::format("{} displacements for {} particles; allowed are none or one each",
                     field.displacements.size(), count));
}

std::vector<Point> drawn_positions(const ParticleField& field) {
  std::vector<Point> positions = field.positions;
  for (std::size_t i = 0; i < field.displacements.size(); ++i)
    positions[i] += field.displacement_factor * field.displacements[i];
  return positions;
}

Extent soil_extent(const Scenery& scenery) {
  Extent extent;
  for (const SoilOutline& soil : scenery.soils)
    for (const Point& corner : soil.polygon) extent.include(corner.x(), corner.y());
  return extent;
}

/// Soil and particles; where the soil is known, particles that have flown further than half its size do not
/// count.
Extent body_extent(const ContourPanel& panel, const std::vector<Point>& positions) {
  Extent extent = soil_extent(panel.scenery), limit = extent;
  const bool limited = !panel.scenery.soils.empty();
  const double reach = 0.5 * std::max(limit.width(), limit.height());
  limit.include(limit.x_low, limit.y_low, reach);
  limit.include(limit.x_high, limit.y_high, reach);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!positions[i].allFinite() || (limited && !limit.contains(positions[i]))) continue;
    const std::vector<double>& sizes = panel.particles.sizes;
    extent.include(positions[i].x(), positions[i].y(), 0.5 * (sizes.size() == 1 ? sizes[0] : sizes[i]));
  }
  if (!(extent.width() > 0 && extent.height() > 0))
    throw std::runtime_error(
        fmt::format("render: contour panel '{}': no particle has a finite position", panel.title));
  return extent;
}

/// How many times longer than true to scale the two directions are drawn, so that long and flat bodies, and
/// tall and narrow ones, can be read; 1 unless one side is more than twenty times the other.
struct Exaggeration {
  double x = 1, y = 1;
};

Exaggeration exaggeration_of(const Extent& world) {
  constexpr double extreme = 20, readable = 8;  // ratios of the sides
  const double ratio = world.width() / world.height();
  const auto whole = [](double factor) {  // 1, 2 or 5 times a power of ten, at least `factor`
    const double power = std::pow(10., std::floor(std::log10(factor)));
    for (const double step : {1., 2., 5.})
      if (step * power >= factor * (1 - 1e-9)) return step * power;
    return 10 * power;
  };
  if (ratio > extreme) return {1, whole(ratio / readable)};
  if (ratio < 1 / extreme) return {whole(1 / (ratio * readable)), 1};
  return {};
}

std::string axis_title(const char* name, double exaggeration) {
  return exaggeration == 1 ? fmt::format("{} [m]", name)
                           : fmt::format("{} [m], {:g} × larger", name, exaggeration);
}

struct Scene {
  const ContourPanel& panel;
  std::vector<Point> positions;
  Extent body;
  FixedScale scale;
  std::string note;  ///< on particles that cannot be seen
};

std::string missing_note(const std::vector<Point>& positions, const Extent& world) {
  const auto missing = std::ranges::count_if(positions, [&](const Point& p) { return !world.contains(p); });
  return missing == 0 ? ""
                      : fmt::format("{} particle{} outside the picture", missing, missing == 1 ? "" : "s");
}

FixedScale shared_scale(const ContourFigure& figure) {
  std::vector<double> values;
  for (const ContourPanel& panel : figure.panels)
    if (!panel.own_scale)
      values.insert(values.end(), panel.particles.values.begin(), panel.particles.values.end());
  return fix_scale(figure.scale, values);
}

std::vector<Scene> make_scenes(const ContourFigure& figure) {
  const FixedScale shared = shared_scale(figure);
  std::vector<Scene> scenes;
  for (const ContourPanel& panel : figure.panels) {
    check(panel);
    std::vector<Point> positions = drawn_positions(panel.particles);
    const Extent body = body_extent(panel, positions);
    scenes.push_back({panel, std::move(positions), body,
                      panel.own_scale ? fix_scale(*panel.own_scale, panel.particles.values) : shared, ""});
  }
  return scenes;
}

Extent common_world(const std::vector<Scene>& scenes) {
  Extent world;
  for (const Scene& scene : scenes) {
    world.include(scene.body.x_low, scene.body.y_low);
    world.include(scene.body.x_high, scene.body.y_high);
    for (const WaterStretch& stretch : scene.panel.scenery.water)
      world.include(scene.body.x_low, stretch.level);
  }
  return world;
}

std::string subtitle_of(const Scene& scene) {
  if (scene.note.empty() || scene.panel.subtitle.empty()) return scene.panel.subtitle + scene.note;
  return scene.panel.subtitle + " — " + scene.note;
}

double title_height(const std::vector<Scene>& scenes) {
  double height = 8;
  const auto any = [&](auto has) { return std::ranges::any_of(scenes, has); };
  if (any([](const Scene& scene) { return !scene.panel.title.empty(); })) height += 1.5 * panel_title_text;
  if (any([](const Scene& scene) { return !subtitle_of(scene).empty(); })) height += 1.5 * subtitle_text;
  return height;
}

double titles_width(const std::vector<Scene>& scenes) {
  constexpr double longest = 320;  // titles beyond are drawn smaller
  double width = 0;
  for (const Scene& scene : scenes)
    width = std::max({width, text_extent(scene.panel.title, panel_title_text).x,
                      text_extent(subtitle_of(scene), subtitle_text).x});
  return std::min(width + 4, longest);
}

ContourSpace needed_space(const ContourFigure& figure, const std::vector<Scene>& scenes, const Extent& world,
                          const Exaggeration& exaggeration) {
  constexpr double guess = 600;  // of a panel's length, good enough to find the width of its labels
  ContourSpace space;
  space.world_width = exaggeration.x * world.width();
  space.world_height = exaggeration.y * world.height();
  space.padding = padding;
  space.least_frame = std::max(100., titles_width(scenes));
  space.header = figure.title.empty() ? 0 : 1.7 * figure_title_text;
  space.margins = frame_margins({world.x_low, world.x_high, false, ""},
                                {world.y_low, world.y_high, false, ""}, guess, guess);
  space.margins.top = title_height(scenes);
  space.margins.bottom += 10;
  space.margins.right = 6;
  for (const Scene& scene : scenes) {
    space.own_scale.push_back(scene.panel.own_scale.has_value());
    space.bar_slot = std::max(space.bar_slot, colour_bar_width(scene.scale, guess));
  }
  return space;
}

Plot plot_of(const Box& frame, const Extent& world, double pixels_per_metre,
             const Exaggeration& exaggeration) {
  const auto axis = [&](double centre, double length, const char* name, double larger) {
    const double half = 0.5 * length / (larger * pixels_per_metre);
    return Axis{centre - half, centre + half, false, axis_title(name, larger)};
  };
  return {frame, axis(0.5 * (world.x_low + world.x_high), frame.width, "x", exaggeration.x),
          axis(0.5 * (world.y_low + world.y_high), frame.height, "y", exaggeration.y)};
}

void draw_titles(Canvas& canvas, const Scene& scene, const Box& frame) {
  double y = frame.top() + 8;
  const std::string subtitle = subtitle_of(scene);
  if (!subtitle.empty()) {
    canvas.text({frame.x, y}, subtitle,
                {.size = fitting_size(subtitle, subtitle_text, frame.width),
                 .colour = {80, 80, 80},
                 .horizontal = Align::low,
                 .vertical = Align::low});
    y += 1.5 * subtitle_text;
  }
  canvas.text({frame.x, y}, scene.panel.title,
              {.size = fitting_size(scene.panel.title, panel_title_text, frame.width),
               .horizontal = Align::low,
               .vertical = Align::low});
}

void draw_panel(Canvas& canvas, const Scene& scene, const Plot& plot) {
  canvas.clip(plot.box);
  draw_scenery(canvas, plot, scene.panel.scenery, scene.body.x_low, scene.body.x_high);
  canvas.unclip();
  draw_frame(canvas, plot);
  draw_titles(canvas, scene, plot.box);
}

void add_scenes(Picture& picture, const Scene& scene, const Plot& plot) {
  picture.add_scene(plot.box, water_scene(plot, scene.panel.scenery.water, scene.body.x_low,
                                          scene.body.x_high, scene.body.y_low));
  picture.add_scene(plot.box, particle_scene(plot, scene.positions, scene.panel.particles.sizes,
                                             scene.panel.particles.cells,
                                             colours_of(scene.panel.particles.values, scene.scale)));
}

}  // namespace

void save_contours(const ContourFigure& figure, const std::filesystem::path& path) {
  if (figure.panels.empty()) throw std::runtime_error("render: a contour figure without panels");
  const std::scoped_lock lock(render_mutex());
  std::vector<Scene> scenes = make_scenes(figure);
  const Extent world = common_world(scenes);
  for (Scene& scene : scenes) scene.note = missing_note(scene.positions, world);

  const double title_width = text_extent(figure.title, figure_title_text).x + 40;
  const Exaggeration exaggeration = exaggeration_of(world);
  const ContourLayout layout = lay_out(needed_space(figure, scenes, world, exaggeration),
                                       {figure.columns, figure.width, figure.height, title_width});
  std::vector<Plot> plots;
  for (const Box& frame : layout.frames)
    plots.push_back(plot_of(frame, world, layout.pixels_per_metre, exaggeration));

  Picture picture(layout.width, layout.height);
  for (std::size_t i = 0; i < scenes.size(); ++i) add_scenes(picture, scenes[i], plots[i]);
  picture.draw([&](Canvas& canvas) {
    for (std::size_t i = 0; i < scenes.size(); ++i) draw_panel(canvas, scenes[i], plots[i]);
    for (const BarPlace& bar : layout.bars) draw_colour_bar(canvas, bar.box, scenes[bar.panel].scale);
    canvas.text(
        {0.5 * layout.width, layout.height - 14.}, figure.title,
        {.size = fitting_size(figure.title, figure_title_text, layout.width - 20), .vertical = Align::high});
  });
  picture.save(path);
}

}  // namespace porosph
