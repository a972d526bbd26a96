#include "render/contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "render/bands.hpp"
#include "render/contour_layout.hpp"
#include "render/drawing.hpp"
#include "render/field_marks.hpp"
#include "render/offscreen_window.hpp"
#include "render/particle_patches.hpp"
#include "render/picture.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::render {

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
  for (const auto& [name, size] :
       {std::pair{"arrows", panel.arrows.size()}, std::pair{"crosses", panel.crosses.size()}})
    if (size != 0 && size != count)
      fail(fmt::format("{} {} for {} particles; allowed are none or one each", size, name, count));
  if (panel.smooth && panel.smooth->values.size() != panel.smooth->points.size())
    fail(fmt::format("{} values for {} points of triangles", panel.smooth->values.size(),
                     panel.smooth->points.size()));
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

/// What hangs together: the middle of the particles, all but 0.5 % at either end in each direction, and
/// beyond it those that follow each other without a gap wider than `gap` [m]: all that has slid or run out,
/// not what was thrown off.
Extent bulk_of(const std::vector<Point>& positions, double gap) {
  Extent bulk;
  std::vector<double> along;
  const auto ends = [&](int axis) {
    along.clear();
    for (const Point& p : positions)
      if (p.allFinite()) along.push_back(p[axis]);
    std::ranges::sort(along);
    const std::size_t left_out = std::min((along.size() + 199) / 200, (along.size() - 1) / 2);
    std::size_t low = left_out, high = along.size() - 1 - left_out;
    while (low > 0 && along[low] - along[low - 1] <= gap) --low;
    while (high + 1 < along.size() && along[high + 1] - along[high] <= gap) ++high;
    return std::pair(along[low], along[high]);
  };
  if (std::ranges::none_of(positions, [](const Point& p) { return p.allFinite(); })) return bulk;
  const auto [left, right] = ends(0);
  const auto [bottom, top] = ends(1);
  bulk.include(left, bottom);
  bulk.include(right, top);
  return bulk;
}

constexpr double widest_gap = 0.1;  // between particles that run out together, over the size of the soil

/// Soil and particles. Where the soil is known, single particles that have flown further than half its size
/// do not count, and nothing does beyond three times its size.
Extent body_extent(const ContourPanel& panel, const std::vector<Point>& positions) {
  Extent extent = soil_extent(panel.scenery), limit = extent;
  const bool limited = !panel.scenery.soils.empty();
  const double size = std::max(limit.width(), limit.height());
  Extent furthest = limit;
  for (auto [box, reach] : {std::pair(&limit, 0.5 * size), std::pair(&furthest, 3 * size)}) {
    const Extent soil = *box;
    box->include(soil.x_low, soil.y_low, reach);
    box->include(soil.x_high, soil.y_high, reach);
  }
  if (const Extent bulk = bulk_of(positions, widest_gap * size); limited && bulk.width() >= 0) {
    const auto within = [&](double x, double y) {
      limit.include(std::clamp(x, furthest.x_low, furthest.x_high),
                    std::clamp(y, furthest.y_low, furthest.y_high));
    };
    within(bulk.x_low, bulk.y_low);
    within(bulk.x_high, bulk.y_high);
  }
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
  ColourScale scale = figure.scale;
  scale.bands = figure.style == FieldStyle::bands;
  return fix_scale(scale, values);
}

std::vector<Scene> make_scenes(const ContourFigure& figure) {
  const FixedScale shared = shared_scale(figure);
  const auto own_scale = [&](const ContourPanel& panel) {
    ColourScale scale = *panel.own_scale;
    scale.bands = figure.style == FieldStyle::bands;
    return fix_scale(scale, panel.particles.values);
  };
  std::vector<Scene> scenes;
  for (const ContourPanel& panel : figure.panels) {
    check(panel);
    std::vector<Point> positions = drawn_positions(panel.particles);
    const Extent body = body_extent(panel, positions);
    scenes.push_back({panel, std::move(positions), body, panel.own_scale ? own_scale(panel) : shared, ""});
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
    for (const SoilOutline& soil : scene.panel.before)
      for (const Point& corner : soil.polygon) world.include(corner.x(), corner.y());
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

/// The smooth field in pixels from the lower left corner of the plot's box, or of the picture.
TriangleField on_picture(const SmoothField& smooth, const Plot& plot, bool in_box) {
  TriangleField field{.points = {}, .values = smooth.values, .triangles = smooth.triangles};
  field.points.reserve(smooth.points.size());
  const Pixel origin = in_box ? Pixel{plot.box.x, plot.box.y} : Pixel{};
  for (const Point& p : smooth.points) {
    const Pixel at = plot.at(p.x(), p.y());
    field.points.push_back({at.x - origin.x, at.y - origin.y});
  }
  return field;
}

FieldLayer bands_of(const SmoothField& smooth, const Plot& plot, const FixedScale& scale) {
  const TriangleField field = on_picture(smooth, plot, true);
  const std::vector<Colour> colours = band_colours(scale);
  FieldLayer layer{.patches = {.area = plot.box, .dot = 0, .corners = {}, .ends = {}, .colours = {}},
                   .regions = {}};
  for (const BandPiece& piece : band_pieces(field, scale.levels))
    layer.patches.add(std::span(piece.corners).first(static_cast<std::size_t>(piece.count)),
                      colours[static_cast<std::size_t>(piece.band)]);
  layer.regions = [field, colours, levels = scale.levels] {
    std::vector<FilledRegion> regions = {
        {region_above(field, -std::numeric_limits<double>::infinity()), colours.front()}};
    for (std::size_t i = 0; i < levels.size(); ++i)
      regions.push_back({region_above(field, levels[i]), colours[i + 1]});
    return regions;
  };
  return layer;
}

/// Those that the triangles do not cover, or whose triangles have a corner without a value.
std::vector<bool> drawn_beneath(const SmoothField& smooth, std::size_t particles) {
  std::vector<bool> drawn = smooth.uncovered;
  for (const auto& t : smooth.triangles) {
    const auto value = [&](int i) { return smooth.values[static_cast<std::size_t>(i)]; };
    if (std::ranges::all_of(t, [&](int i) { return std::isfinite(value(i)); })) continue;
    for (const int i : t)
      if (static_cast<std::size_t>(i) < particles) drawn[static_cast<std::size_t>(i)] = true;
  }
  return drawn;
}

FieldLayer particles_of(const Scene& scene, const Plot& plot, FieldStyle style) {
  const ParticleField& field = scene.panel.particles;
  std::vector<Point> positions = scene.positions;
  if (style == FieldStyle::bands && scene.panel.smooth) {
    const std::vector<bool> drawn = drawn_beneath(*scene.panel.smooth, positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (!drawn[i]) positions[i] = Point::Constant(std::numeric_limits<double>::quiet_NaN());  // left out
  }
  return {particle_patches(plot, positions, field.sizes, field.cells, colours_of(field.values, scene.scale)),
          {}};
}

void draw_panel(Canvas& canvas, const Scene& scene, const Plot& plot, FieldStyle style) {
  const ContourPanel& panel = scene.panel;
  canvas.clip(plot.box);
  if (style != FieldStyle::particles && panel.smooth)
    draw_isolines(canvas, plot.box, on_picture(*panel.smooth, plot, false), scene.scale.levels,
                  probe_boxes(plot, panel.scenery));
  draw_outlines_before(canvas, plot, panel.before);
  if (!panel.crosses.empty()) draw_crosses(canvas, plot, scene.positions, panel.crosses);
  if (!panel.arrows.empty()) draw_arrows(canvas, plot, scene.positions, panel.arrows);
  draw_scenery(canvas, plot, panel.scenery, scene.body.x_low, scene.body.x_high);
  canvas.unclip();
  draw_frame(canvas, plot);
  draw_titles(canvas, scene, plot.box);
}

void add_layers(Drawing& drawing, const Scene& scene, const Plot& plot, FieldStyle style) {
  drawing.layers.push_back(
      {water_patches(plot, scene.panel.scenery.water, scene.body.x_low, scene.body.x_high, scene.body.y_low),
       {}});
  drawing.layers.push_back(particles_of(scene, plot, style));
  if (style == FieldStyle::bands && scene.panel.smooth)
    drawing.layers.push_back(bands_of(*scene.panel.smooth, plot, scene.scale));
}

/// A figure with all that its drawing needs.
struct PreparedFigure {
  std::vector<Scene> scenes;
  ContourLayout layout;
  std::vector<Plot> plots;
};

PreparedFigure prepare(const ContourFigure& figure) {
  const std::scoped_lock lock(render_mutex());  // texts are measured
  PreparedFigure p{.scenes = make_scenes(figure), .layout = {}, .plots = {}};
  Extent world = common_world(p.scenes);
  for (const Point& place : figure.include) world.include(place.x(), place.y());
  for (Scene& scene : p.scenes) scene.note = missing_note(scene.positions, world);
  const double title_width = text_extent(figure.title, figure_title_text).x + 40;
  const Exaggeration exaggeration = exaggeration_of(world);
  p.layout = lay_out(needed_space(figure, p.scenes, world, exaggeration),
                     {figure.columns, figure.width, figure.height, title_width});
  for (const Box& frame : p.layout.frames)
    p.plots.push_back(plot_of(frame, world, p.layout.pixels_per_metre, exaggeration));
  return p;
}

/// Hands the figure's drawing, which lives as long as the call, to `use`.
template <class Use>
void with_drawing(const ContourFigure& figure, Use&& use) {
  if (figure.panels.empty()) throw std::runtime_error("render: a contour figure without panels");
  const PreparedFigure p = prepare(figure);
  Drawing drawing{
      .width = p.layout.width, .height = p.layout.height, .title = figure.title, .layers = {}, .paint = {}};
  for (std::size_t i = 0; i < p.scenes.size(); ++i)
    add_layers(drawing, p.scenes[i], p.plots[i], figure.style);
  drawing.paint = [&](Canvas& canvas) {
    for (std::size_t i = 0; i < p.scenes.size(); ++i)
      draw_panel(canvas, p.scenes[i], p.plots[i], figure.style);
    for (const BarPlace& bar : p.layout.bars) draw_colour_bar(canvas, bar.box, p.scenes[bar.panel].scale);
    canvas.text({0.5 * p.layout.width, p.layout.height - 14.}, figure.title,
                {.size = fitting_size(figure.title, figure_title_text, p.layout.width - 20),
                 .vertical = Align::high});
  };
  use(drawing);
}

}  // namespace

std::array<Point, 2> shown_box(const ContourPanel& panel) {
  const Extent body = body_extent(panel, drawn_positions(panel.particles));
  return {Point(body.x_low, body.y_low), Point(body.x_high, body.y_high)};
}

void save_contours(const ContourFigure& figure, const std::filesystem::path& path) {
  with_drawing(figure, [&](const Drawing& drawing) { save_drawing(drawing, path); });
}

void save_each_panel(const ContourFigure& figure, int width,
                     const std::vector<std::filesystem::path>& paths) {
  const std::vector<Scene> scenes = make_scenes(figure);
  const Extent world = common_world(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    ContourFigure one{.title = figure.title,
                      .panels = {figure.panels[i]},
                      .scale = figure.scale,
                      .style = figure.style,
                      .include = figure.include,
                      .columns = 1,
                      .width = width,
                      .height = 0};
    one.include.emplace_back(world.x_low, world.y_low);
    one.include.emplace_back(world.x_high, world.y_high);
    if (!figure.panels[i].own_scale) one.scale.range = scenes[i].scale.range;
    save_contours(one, paths.at(i));
  }
}

void save_film(std::size_t count, const std::function<ContourFigure(std::size_t)>& figure,
               double pictures_per_second, const std::filesystem::path& path) {
  int width = 0, height = 0;
  with_drawing(figure(count - 1), [&](const Drawing& d) { width = d.width, height = d.height; });
  Film film(pictures_per_second);
  for (std::size_t i = 0; i < count; ++i) {
    ContourFigure one = figure(i);
    one.width = width;
    one.height = height;
    with_drawing(one, [&](const Drawing& drawing) {
      const std::scoped_lock lock(render_mutex());
      film.add(pixels_of(drawing));
    });
  }
  write_file(path, film.finish());
}

}  // namespace porosph::render
