#include "vtk_io/paraview_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace porosph {
namespace {

struct Colouring {
  std::string field, component;
};

Colouring colouring_of(const Frame& frame) {
  for (const auto& field : frame.fields) {
    if (field.name == "EffectiveStress" && std::ranges::count(field.components, "YY") == 1)
      return {field.name, "YY"};
  }
  if (frame.fields.empty()) return {};
  const auto& first = frame.fields.front();
  return {first.name, first.components.empty() ? "" : first.components.front()};
}

/// A Python string literal: JSON's escapes are also Python's.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

constexpr const char* script = R"(# Opens the particles beside this script, coloured:
#     paraview --script=open_in_paraview.py
# Made for ParaView 5.11 and later.
import os
import sys

from paraview.simple import *

SERIES = {series}
WRITTEN_IN = {folder}
FIELD = {field}
COMPONENT = {component}


def series_path():
    """The series beside this script, wherever the folder has been moved to."""
    scripts = [globals().get("__file__", "")] + sys.argv
    folders = [os.path.dirname(os.path.abspath(s)) for s in scripts if s.endswith(".py")]
    for folder in folders + [os.getcwd(), WRITTEN_IN]:
        path = os.path.join(folder, SERIES)
        if os.path.exists(path):
            return path
    raise RuntimeError(SERIES + " is not beside this script")


reader = PVDReader(registrationName=SERIES, FileName=series_path())
view = GetActiveViewOrCreate("RenderView")
display = Show(reader, view)

times = reader.TimestepValues
if times:
    animation = GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    animation.AnimationTime = times[-1]
    view.ViewTime = times[-1]

display.SetRepresentationType("Point Gaussian")
display.ShaderPreset = "Plain circle"
# The particles fill the area they stand for: half the mean spacing in the bounding box is their radius.
bounds = reader.GetDataInformation().GetBounds()
count = max(reader.GetDataInformation().GetNumberOfPoints(), 1)
area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2])
if area > 0:
    display.GaussianRadius = 0.5 * (area / count) ** 0.5

if FIELD:
    ColorBy(display, ("POINTS", FIELD, COMPONENT) if COMPONENT else ("POINTS", FIELD))
    display.RescaleTransferFunctionToDataRange(True, False)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(GetColorTransferFunction(FIELD), view)
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"

view.InteractionMode = "2D"
view.OrientationAxesVisibility = 0
view.ResetCamera()
Render()
)";

}  // namespace

std::string paraview_script(const std::filesystem::path& folder, const std::string& pvd, const Frame& frame) {
  const auto [field, component] = colouring_of(frame);
  return fmt::format(fmt::runtime(script), fmt::arg("series", quoted(pvd)),
                     fmt::arg("folder", quoted(folder.string())), fmt::arg("field", quoted(field)),
                     fmt::arg("component", quoted(component)));
}

}  // namespace porosph
