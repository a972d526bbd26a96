#include "render/drawing.hpp"

#include <fmt/format.h>

#include <mutex>
#include <stdexcept>

#include "render/offscreen_window.hpp"
#include "render/picture.hpp"
#include "render/vector_picture.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::render {
namespace {

void check_size(const Drawing& drawing) {
  constexpr int largest = 8000;
  if (drawing.width < 1 || drawing.height < 1 || drawing.width > largest || drawing.height > largest)
    throw std::runtime_error(
        fmt::format("render: a picture of {} x {} pixels cannot be drawn; allowed are 1 to {}", drawing.width,
                    drawing.height, largest));
}

}  // namespace

bool is_picture_file(const std::filesystem::path& path) {
  const std::string extension = path.extension();
  return extension == ".png" || extension == ".svg" || extension == ".pdf";
}

void save_drawing(const Drawing& drawing, const std::filesystem::path& path) {
  check_size(drawing);
  if (!is_picture_file(path))
    throw std::runtime_error(
        fmt::format("render: {}: the name of a picture must end in .png, .svg or .pdf", path.string()));
  const std::scoped_lock lock(render_mutex());
  if (path.extension() == ".png")
    write_file(path, png_of(drawing));
  else
    write_file(path, path.extension() == ".svg" ? svg_of(drawing) : pdf_of(drawing));
}

}  // namespace porosph::render
