#include "vtk_io/paraview_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "solver/particles/field_table.hpp"

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

/// " [Pa]"; empty for a field that is not one of ours.
std::string unit_of(const std::string& field) {
  const Field* known = find_field(field);
  return known == nullptr || known->unit == "-" ? "" : fmt::format(" [{}]", known->unit);
}

/// A Python literal: JSON's escapes, numbers and lists are also Python's.
std::string python(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

constexpr const char* open_head = R"(# Opens the particles beside this script, ready to look at:
#     paraview --script=open_in_paraview.py
#     pvpython open_in_paraview.py picture.png
# Made for ParaView 5.11 and later.
)";

constexpr const char* compare_head =
    R"(# Shows two runs side by side: linked cameras, the same time, one range of colours.
#     paraview --script=compare_in_paraview.py
#     pvpython compare_in_paraview.py picture.png
# Where this script does not name the other run, say which: pvpython compare_in_paraview.py OTHER_RUN, or
#     OTHER_RUN=../other paraview --script=compare_in_paraview.py
# Made for ParaView 5.11 and later.
)";

constexpr const char* common = R"py(
import ast
import os
import sys

from paraview.simple import *

SCRIPTS = [s for s in [globals().get("__file__", "")] + sys.argv if s.endswith(".py")]
HERE = os.path.dirname(os.path.abspath(SCRIPTS[0])) if SCRIPTS else os.getcwd()
PICTURES = [a for a in sys.argv[1:] if a.endswith(".png")]
DARK = [0.15, 0.15, 0.15]
WHITE = [1.0, 1.0, 1.0]
WATER = [0.12, 0.47, 0.71]
MOVING_LEVELS = []  # lines at y = 0, and the times and levels that they are moved to


def series_path(run):
    """The series of a run, wherever its folder has been moved to."""
    for folder in run["folders"]:
        path = os.path.join(folder, run["series"])
        if os.path.exists(path):
            return path
    raise RuntimeError(run["series"] + " is not beside this script")


def show_text(text, view, place, size):
    display = Show(Text(Text=text), view)
    display.WindowLocation = place
    display.FontSize = size
    display.Color = DARK


def show_water(x_from, x_to, level, view):
    display = Show(Line(Point1=[x_from, level, 0.0], Point2=[x_to, level, 0.0], Resolution=1), view)
    display.AmbientColor = display.DiffuseColor = WATER
    display.LineWidth = 3
    display.RenderLinesAsTubes = 0
    return display


def show_scene(run, view, bounds):
    """Water levels and probes, as the case describes them."""
    for x_from, x_to, level in run["water"]:
        show_water(max(x_from, bounds[0]), min(x_to, bounds[1]), level, view)
    if run["level_over_time"]:
        MOVING_LEVELS.append((show_water(bounds[0], bounds[1], 0.0, view), run["level_over_time"]))
    mark = 0.006 * max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    for name, x, y in run["probes"]:
        for radius, depth, colour in [(mark, 0.0, DARK), (0.7 * mark, mark, WHITE)]:
            probe = Show(Sphere(Center=[x, y, depth], Radius=radius, ThetaResolution=32, PhiResolution=32), view)
            probe.AmbientColor = probe.DiffuseColor = colour
            probe.Ambient, probe.Diffuse, probe.Specular = 1.0, 0.0, 0.0
        label = Show(Text(Text=name), view)
        label.TextPropMode = "Billboard 3D Text"
        label.BillboardPosition = [x + mark, y + mark, 2 * mark]
        label.Color = WHITE
        label.Shadow = 1
        label.FontSize = 16
        label.Bold = 1


def show_run(run, view):
    """The particles of a run with everything around them; returns reader and representation."""
    reader = PVDReader(registrationName=run["title"] or run["series"], FileName=series_path(run))
    reader.UpdatePipeline(reader.TimestepValues[-1] if reader.TimestepValues else 0.0)
    particles = reader
    if run["boundary"]:
        particles = ExtractBlock(Input=reader, Selectors=["/Root/particles"])
        behind = Show(ExtractBlock(Input=reader, Selectors=["/Root/boundary"]), view)
        behind.SetRepresentationType("Points")
        behind.AmbientColor = behind.DiffuseColor = [0.6, 0.6, 0.6]
        behind.PointSize = 3
        behind.ColorArrayName = ["POINTS", ""]
        particles.UpdatePipeline()
    display = Show(particles, view)
    information = particles.GetDataInformation()
    bounds = information.GetBounds()
    area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2])
    size = run["spacing"] or (area / max(information.GetNumberOfPoints(), 1)) ** 0.5
    bounds = [end + (-0.5 if i % 2 == 0 else 0.5) * size for i, end in enumerate(bounds)]
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    if size > 0:
        display.GaussianRadius = 0.72 * size  # the circles reach the middle of four particles: no gaps
    if run["field"]:
        at = [run["field"], run["component"]] if run["component"] else [run["field"]]
        ColorBy(display, ["POINTS"] + at)
        display.SetScalarBarVisibility(view, True)
        colours = GetColorTransferFunction(run["field"])
        colours.ApplyPreset("Viridis (matplotlib)", True)
        bar = GetScalarBar(colours, view)
        bar.Orientation = "Vertical"
        bar.WindowLocation = "Lower Right Corner"
        bar.ScalarBarLength = 0.6
        bar.Title = " ".join(at) + run["unit"]
        bar.ComponentTitle = ""
        bar.TitleColor = bar.LabelColor = DARK
    show_scene(run, view, bounds)
    show_text(run["title"], view, "Upper Center", 16)
    time = Show(AnnotateTimeFilter(Input=reader, Format="t = {time:.3f} s"), view)
    time.WindowLocation = "Upper Left Corner"
    time.FontSize = 14
    time.Color = DARK
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = WHITE
    levels = [level for x_from, x_to, level in run["water"]] + [level for time, level in run["level_over_time"]]
    bounds[3] = max([bounds[3]] + levels)
    return reader, display, bounds


def look_at(view, bounds):
    """From the front, all of it, with room for the colour bar on the right and text at the top."""
    Render(view)  # the first one of a session would move the camera
    width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
    aspect = view.ViewSize[0] / view.ViewSize[1]
    room = min(130 / view.ViewSize[0], 0.45)
    scale = 0.5 * max(width / aspect / (0.94 - room), height / 0.84) or 1.0
    centre = [(bounds[0] + bounds[1]) / 2 + room * scale * aspect, (bounds[2] + bounds[3]) / 2 + 0.06 * scale]
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre + [0.0]
    view.CameraPosition = centre + [width + height]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelScale = scale


def level_at(steps, time):
    """Linear between the steps, constant before and after."""
    for (t0, level0), (t1, level1) in zip(steps, steps[1:]):
        if time < t1:
            return level0 + (level1 - level0) * max(time - t0, 0.0) / (t1 - t0)
    return steps[-1][1]


def move_levels(animation):
    """Key frames, so that water that rises and falls stands where it was at the time shown."""
    start, end = animation.StartTime, animation.EndTime
    for display, steps in MOVING_LEVELS:
        display.Position = [0.0, level_at(steps, end), 0.0]
        if start == end:
            continue
        times = [start] + [time for time, level in steps if start < time < end] + [end]
        track = GetAnimationTrack("Position", index=1, proxy=display)
        track.KeyFrames = [CompositeKeyFrame(KeyTime=(time - start) / (end - start), KeyValues=[level_at(steps, time)])
                           for time in times]


def to_last_time(readers):
    animation = GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    move_levels(animation)
    times = [t for reader in readers for t in reader.TimestepValues]
    if times:
        animation.AnimationTime = max(times)


def one_range(displays, field):
    """The colours of all times of all runs; a field that is the same everywhere keeps ParaView's range."""
    if not field:
        return
    colours, ends = GetColorTransferFunction(field), []
    for display in displays:
        display.RescaleTransferFunctionToDataRangeOverTime()
        ends += [colours.RGBPoints[0], colours.RGBPoints[-4]]
    if min(ends) < max(ends):
        colours.RescaleTransferFunction(min(ends), max(ends))


def start(layout):
    """A picture's size; in ParaView itself the window has its own."""
    if PICTURES:
        layout.SetSize(1600, 900)


def finish(layout):
    """A picture where the command line names one; without one pvpython shows a window until it is closed."""
    RenderAllViews()
    if PICTURES:
        SaveScreenshot(PICTURES[0], layout)
    elif SCRIPTS and sys.argv and sys.argv[0] in SCRIPTS and os.environ.get("DISPLAY"):
        Interact()
)py";

constexpr const char* open_tail = R"(
RUN = {run}

RUN["folders"] = [HERE, os.getcwd(), RUN["folder"]]
view = GetActiveViewOrCreate("RenderView")
start(GetLayout(view))
reader, display, bounds = show_run(RUN, view)
to_last_time([reader])
one_range([display], RUN["field"])
look_at(view, bounds)
finish(GetLayout(view))
)";

constexpr const char* compare_tail = R"(
FOLDERS = {folders}
WRITTEN_IN = {written_in}  # ParaView does not tell a script of --script where it is


def run_in(folder):
    """What open_in_paraview.py says of the run in this folder."""
    places = [os.path.normpath(os.path.join(place, folder)) for place in (HERE, WRITTEN_IN)]
    found = [place for place in places if os.path.exists(os.path.join(place, "open_in_paraview.py"))]
    if not found:
        raise RuntimeError("no run in " + " nor in ".join(places))
    folder = found[0]
    with open(os.path.join(folder, "open_in_paraview.py")) as script:
        line = next(text for text in script if text.startswith("RUN = "))
    run = ast.literal_eval(line[len("RUN = "):])
    run["folders"] = [folder]
    run["title"] = os.path.basename(folder)
    return run


others = [a for a in sys.argv[1:] if os.path.isdir(a)] + [os.environ.get("OTHER_RUN", "")]
folders = [folder or os.path.abspath(others[0]) for folder in FOLDERS if folder or others[0]]
if len(folders) < 2:
    raise RuntimeError("say which run to compare with: pvpython compare_in_paraview.py OTHER_RUN")

first = GetActiveViewOrCreate("RenderView")
layout = GetLayout(first)
layout.SplitHorizontal(0, 0.5)
second = CreateRenderView()
AssignViewToLayout(second, layout, 2)
start(layout)
runs = [run_in(folder) for folder in folders]
shown = [show_run(run, view) for run, view in zip(runs, [first, second])]
to_last_time([reader for reader, display, bounds in shown])
one_range([display for reader, display, bounds in shown], runs[0]["field"])
AddCameraLink(first, second, "both runs")
both = list(zip(*[bounds for reader, display, bounds in shown]))
look_at(first, [min(ends) if i % 2 == 0 else max(ends) for i, ends in enumerate(both)])
finish(layout)
)";

}  // namespace

ScriptScene script_scene(const Case& scene) {
  return {scene.title, scene.particles.spacing, scene.output.boundary, scene.probes, scene.water};
}

std::string paraview_script(const std::filesystem::path& folder, const std::string& pvd, const Frame& frame,
                            const ScriptScene& scene) {
  const auto [field, component] = colouring_of(frame);
  nlohmann::json run = {{"series", pvd},
                        {"folder", folder.string()},
                        {"title", scene.title},
                        {"spacing", scene.spacing},
                        {"field", field},
                        {"component", component},
                        {"unit", unit_of(field)},
                        {"boundary", scene.boundary ? 1 : 0},
                        {"probes", nlohmann::json::array()},
                        {"water", nlohmann::json::array()},
                        {"level_over_time", nlohmann::json::array()}};
  for (const ProbeCase& probe : scene.probes)
    run["probes"].push_back({probe.name, probe.position.x(), probe.position.y()});
  constexpr double far = 1e30;  // JSON has no infinity; the script cuts lines at the particles
  for (const Point& step : scene.water.level_over_time)
    run["level_over_time"].push_back({step.x(), step.y()});
  if (run["level_over_time"].empty())
    for (const WaterStretch& s : scene.water.stretches)
      run["water"].push_back({std::max(s.x_from, -far), std::min(s.x_to, far), s.level});
  return std::string(open_head) + common + fmt::format(fmt::runtime(open_tail), fmt::arg("run", python(run)));
}

std::string paraview_comparison_script(const std::filesystem::path& folder, const std::filesystem::path& a,
                                       const std::filesystem::path& b) {
  return std::string(compare_head) + common +
         fmt::format(fmt::runtime(compare_tail),
                     fmt::arg("folders", python({a.generic_string(), b.generic_string()})),
                     fmt::arg("written_in", python(folder.generic_string())));
}

}  // namespace porosph
