#include "render/category_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "render/drawing.hpp"
#include "render/offscreen_window.hpp"

namespace porosph::render {
namespace {

constexpr double edge = 16, title_size = 18, axis_size = 14, label_size = 13, text_size = 13, small_size = 11,
                 cell_height = 40, least_cell_width = 58, legend_row = 22, sample = 16, note_row = 18;
const Pen grid_pen{.colour = {255, 255, 255}, .width = 2};
const Pen mark_pen{.colour = black, .width = 3};

/// Text on a colour: dark on light ones and light on dark ones.
Colour readable_on(const Colour& c) {
  const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  return luminance > 110 ? black : white;
}

double widest(const std::vector<std::string>& texts, double size) {
  double width = 0;
  for (const std::string& text : texts) width = std::max(width, text_extent(text, size).x);
  return width;
}

/// Words of `text` in lines no wider than `width`.
std::vector<std::string> wrapped(const std::string& text, double size, double width) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, end - from);
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (!lines.back().empty() && text_extent(longer, size).x > width)
      lines.push_back(word);
    else
      lines.back() = longer;
    from = end + 1;
  }
  return lines;
}

struct Layout {
  int width = 0, height = 0;
  Box grid;
  double cell_width = 0, legend_top = 0;
  std::vector<std::string> notes;
  int legend_columns = 1;

  Box cell(std::size_t column, std::size_t row) const {
    return {grid.x + static_cast<double>(column) * cell_width,
            grid.y + static_cast<double>(row) * cell_height, cell_width, cell_height};
  }
};

std::vector<std::string> legend_labels(const CategoryMap& map) {
  std::vector<std::string> labels;
  for (const MapCategory& c : map.categories) labels.push_back(c.label);
  if (!map.mark_label.empty()) labels.push_back(map.mark_label);
  return labels;
}

Layout lay_out(const CategoryMap& map) {
  Layout l;
  const auto columns = static_cast<double>(map.x.labels.size()),
             rows = static_cast<double>(map.y.labels.size());
  std::vector<std::string> texts, small;
  for (const MapCell& cell : map.cells) texts.push_back(cell.text), small.push_back(cell.small_text);
  l.cell_width = std::ceil(std::max({least_cell_width, widest(map.x.labels, label_size) + 14,
                                     widest(texts, text_size) + 12, widest(small, small_size) + 10}));
  const double left =
      edge + (map.y.title.empty() ? 0 : 1.6 * axis_size) + widest(map.y.labels, label_size) + 10;
  const std::vector<std::string> labels = legend_labels(map);
  const double entry = sample + 8 + widest(labels, label_size) + 18;
  const double wanted = std::max({left + columns * l.cell_width + edge, 560.0,
                                  std::min(text_extent(map.title, title_size).x + 2 * edge, 900.0)});
  l.width = static_cast<int>(std::ceil(wanted));
  l.legend_columns = std::max(1, static_cast<int>((l.width - 2 * edge) / entry));
  const double legend_rows = std::ceil(static_cast<double>(labels.size()) / l.legend_columns);
  for (const std::string& note : map.notes)
    for (std::string& line : wrapped(note, label_size, l.width - 2 * edge))
      l.notes.push_back(std::move(line));

  const double below_grid = 10 + label_size + 8 + axis_size + 14,
               notes = note_row * static_cast<double>(l.notes.size());
  const double legend = legend_row * legend_rows + 6;
  l.height = static_cast<int>(
      std::ceil(edge + notes + legend + below_grid + rows * cell_height + 14 + title_size + edge));
  l.legend_top = edge + notes + legend;
  const double free = l.width - left - edge - columns * l.cell_width;
  l.grid = {std::round(left + 0.5 * std::max(0.0, free)), std::round(l.legend_top + below_grid),
            columns * l.cell_width, rows * cell_height};
  return l;
}

void draw_cells(Canvas& canvas, const CategoryMap& map, const Layout& l) {
  const std::size_t columns = map.x.labels.size();
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const MapCell& cell = map.cells[i];
    const Box box = l.cell(i % columns, i / columns);
    if (cell.category < 0) {
      canvas.line({box.x, box.y}, {box.right(), box.top()}, {.colour = {200, 200, 200}});
      continue;
    }
    const Colour colour = map.categories[static_cast<std::size_t>(cell.category)].colour;
    canvas.box(box, {.colour = colour});
    const Pixel centre = box.centre();
    const bool two = !cell.small_text.empty();
    canvas.text({centre.x, centre.y + (two ? 7 : 0)}, cell.text,
                {.size = text_size, .colour = readable_on(colour)});
    canvas.text({centre.x, centre.y - 9}, cell.small_text,
                {.size = small_size, .colour = readable_on(colour)});
  }
  for (std::size_t c = 0; c <= columns; ++c) {
    const double x = l.grid.x + static_cast<double>(c) * l.cell_width;
    canvas.line({x, l.grid.y}, {x, l.grid.top()}, grid_pen);
  }
  for (std::size_t r = 0; r <= map.y.labels.size(); ++r) {
    const double y = l.grid.y + static_cast<double>(r) * cell_height;
    canvas.line({l.grid.x, y}, {l.grid.right(), y}, grid_pen);
  }
}

bool any(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

/// Frames around the marked places: a cell, or a whole row or column where one axis alone is marked.
void draw_marks(Canvas& canvas, const CategoryMap& map, const Layout& l) {
  const bool by_x = any(map.x.usual), by_y = any(map.y.usual);
  if (!by_x && !by_y) return;
  for (std::size_t c = 0; c < (by_x ? map.x.labels.size() : 1); ++c)
    for (std::size_t r = 0; r < (by_y ? map.y.labels.size() : 1); ++r) {
      if ((by_x && !map.x.usual[c]) || (by_y && !map.y.usual[r])) continue;
      Box box = l.cell(c, r);
      if (!by_x) box.width = l.grid.width;
      if (!by_y) box.height = l.grid.height;
      canvas.frame(box, mark_pen);
    }
}

void draw_axes(Canvas& canvas, const CategoryMap& map, const Layout& l) {
  const double below = l.grid.y - 8;
  for (std::size_t c = 0; c < map.x.labels.size(); ++c)
    canvas.text({l.cell(c, 0).centre().x, below}, map.x.labels[c],
                {.size = label_size, .vertical = Align::high});
  canvas.text({l.grid.centre().x, below - label_size - 8}, map.x.title,
              {.size = fitting_size(map.x.title, axis_size, l.width - 2 * edge), .vertical = Align::high});
  for (std::size_t r = 0; r < map.y.labels.size(); ++r)
    canvas.text({l.grid.x - 8, l.cell(0, r).centre().y}, map.y.labels[r],
                {.size = label_size, .horizontal = Align::high});
  if (map.y.labels.size() < 2) return;  // one row needs no title, and has no room for it
  canvas.text({l.grid.x - 14 - widest(map.y.labels, label_size), l.grid.centre().y}, map.y.title,
              {.size = fitting_size(map.y.title, axis_size, l.grid.height + 24),
               .vertical = Align::low,
               .upright = true});
}

void draw_legend_below(Canvas& canvas, const CategoryMap& map, const Layout& l) {
  const std::vector<std::string> labels = legend_labels(map);
  const double entry = (l.width - 2 * edge) / l.legend_columns;
  const auto columns = static_cast<std::size_t>(l.legend_columns);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const double x = edge + entry * static_cast<double>(column);
    const double y = l.legend_top - 6 - legend_row * (0.5 + static_cast<double>(row));
    const Box box{x, y - 0.5 * sample, sample, sample};
    if (i < map.categories.size()) {
      canvas.box(box, {.colour = map.categories[i].colour});
      canvas.frame(box, {.colour = {120, 120, 120}});
    } else {
      canvas.frame(box, mark_pen);
    }
    canvas.text({x + sample + 8, y}, labels[i], {.size = label_size, .horizontal = Align::low});
  }
}

}  // namespace

void save_category_map(const CategoryMap& map, const std::filesystem::path& path) {
  if (map.x.labels.empty() || map.cells.size() != map.x.labels.size() * map.y.labels.size())
    throw std::runtime_error(fmt::format("render: map '{}' has {} cells for {} x {} labels", map.title,
                                         map.cells.size(), map.x.labels.size(), map.y.labels.size()));
  Layout l;
  {
    const std::scoped_lock lock(render_mutex());  // texts are measured
    l = lay_out(map);
  }
  const auto paint = [&](Canvas& canvas) {
    canvas.text({0.5 * l.width, l.height - edge}, map.title,
                {.size = fitting_size(map.title, title_size, l.width - 2 * edge), .vertical = Align::high});
    draw_cells(canvas, map, l);
    draw_marks(canvas, map, l);
    draw_axes(canvas, map, l);
    draw_legend_below(canvas, map, l);
    for (std::size_t i = 0; i < l.notes.size(); ++i)
      canvas.text({edge, edge + note_row * (static_cast<double>(l.notes.size() - i) - 0.5)}, l.notes[i],
                  {.size = label_size, .colour = {70, 70, 70}, .horizontal = Align::low});
  };
  save_drawing({.width = l.width, .height = l.height, .title = map.title, .layers = {}, .paint = paint},
               path);
}

}  // namespace porosph::render
