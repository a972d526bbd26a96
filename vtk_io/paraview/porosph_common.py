"""What the scripts beside a series share. Porosph writes its text in place of the line that imports it, so that
each script stands alone."""
import ast
import math
import os
import sys

from paraview.simple import *

SCRIPTS = [s for s in [globals().get("__file__", "")] + sys.argv if s.endswith(".py")]
HERE = os.path.dirname(os.path.abspath(SCRIPTS[0])) if SCRIPTS else os.getcwd()
PICTURES = [a for a in sys.argv[1:] if a.endswith(".png")]
DARK = [0.15, 0.15, 0.15]
WHITE = [1.0, 1.0, 1.0]
WATER = [0.12, 0.47, 0.71]
NAMES = [0.85, 0.0, 0.15]  # to be read on the white around the soil as well as on its colours
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


def show_lines(points, view, width, closed=False):
    """A polyline through x, y, x, y, ..., in front of the particles."""
    corners = [c for x, y in zip(points[::2], points[1::2]) for c in (x, y, 0.0)]
    display = Show(PolyLineSource(Points=corners, Closed=closed), view)
    display.AmbientColor = display.DiffuseColor = DARK
    display.LineWidth = width
    display.Position = [0.0, 0.0, 1e-3]
    return display


def show_scene(run, view, bounds):
    """Outlines, supports, water levels and probes, as the case describes them."""
    for ring in run["outlines"]:
        show_lines(ring, view, 1.5, closed=True)
    for kind, *ends in run["supports"]:
        show_lines(ends, view, 5 if kind == "fixed" else 2)
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
        label.Color = NAMES
        label.FontSize = 16
        label.Bold = 1


def coloured_values(run, particles):
    """The field in the unit that people read, as an array of its own, and that array's name."""
    if not run["field"]:
        return particles, ""
    name = run["field"] + ("_" + run["component"] if run["component"] else "")
    if not run["unit"]:
        return particles, ""
    shown = name + " [" + run["unit"] + "]"
    values = Calculator(registrationName=shown, Input=particles, ResultArrayName=shown, Function="%s*%g" % (name, run["factor"]))
    values.UpdatePipeline()
    return values, shown


def show_run(run, view):
    """The particles of a run with everything around them: returns the reader, what is shown of it with its
    representation, and the bounds of all of it."""
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
    values, shown = coloured_values(run, particles)
    run["shown"] = shown or run["field"]
    display = Show(values, view)
    information = particles.GetDataInformation()
    bounds = information.GetBounds()
    area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2])
    size = run["spacing"] or (area / max(information.GetNumberOfPoints(), 1)) ** 0.5
    bounds = [end + (-0.5 if i % 2 == 0 else 0.5) * size for i, end in enumerate(bounds)]
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    if size > 0:
        display.GaussianRadius = 0.72 * size  # the circles reach the middle of four particles: no gaps
    if run["shown"]:
        at = [run["shown"]] if shown or not run["component"] else [run["field"], run["component"]]
        ColorBy(display, ["POINTS"] + at)
        display.SetScalarBarVisibility(view, True)
        colours = GetColorTransferFunction(run["shown"])
        colours.ApplyPreset("Viridis (matplotlib)", True)
        bar = GetScalarBar(colours, view)
        bar.Orientation = "Vertical"
        bar.WindowLocation = "Lower Right Corner"
        bar.ScalarBarLength = 0.6
        bar.Title = " ".join(at)
        bar.ComponentTitle = ""
        bar.AddRangeLabels = 0  # the range ends on ticks
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
    return reader, values, display, bounds


def prepare_section(run, values):
    """A vertical section through the middle, not computed until it is shown: select it, move its line, press
    Apply. Stress along it is right inside, and too small within two smoothing lengths of walls and surfaces."""
    if not run["smoothing_length"]:
        return
    bounds = values.GetDataInformation().GetBounds()
    x = 0.5 * (bounds[0] + bounds[1])
    section = SPHLineInterpolator(registrationName="Section", Input=values, Kernel="SPHCubicKernel", Source="Line")
    section.Source.Point1, section.Source.Point2 = [x, bounds[2], 0.0], [x, bounds[3], 0.0]
    section.Source.Resolution = 200
    section.Kernel.SpatialStep = run["smoothing_length"]
    section.Kernel.Dimension = 2
    section.DensityArray, section.MassArray = "Density", "Mass"


def prepare_isolines(run, values, view):
    """Lines of equal value over triangles between the particles, not computed until they are shown."""
    colours = GetColorTransferFunction(run["shown"]) if run["shown"] and run["unit"] else None
    if colours is None or not run["spacing"]:
        return
    low, high = colours.RGBPoints[0], colours.RGBPoints[-4]
    triangles = Delaunay2D(registrationName="Triangles", Input=values, Alpha=2 * run["spacing"])
    isolines = Contour(registrationName="Isolines", Input=triangles)
    isolines.ContourBy = ["POINTS", run["shown"]]
    isolines.Isosurfaces = [low + (high - low) * i / 10 for i in range(11)]


CROSSES = """
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkCellArray
particles = self.GetInput()
while particles.IsA("vtkCompositeDataSet"):  # a run that wrote its boundary has it as a second block
    particles = particles.GetBlock(0)
points = vtk_to_numpy(particles.GetPoints().GetData())[:, :2]
stress = vtk_to_numpy(particles.GetPointData().GetArray("EffectiveStress")) / 1000.0  # kPa
cells, chosen = set(), []
for i, cell in enumerate(map(tuple, numpy.floor(points / (3 * %(spacing)r)).astype(int))):
    if cell not in cells:
        cells.add(cell)
        chosen.append(i)
values, directions = numpy.linalg.eigh(numpy.array([[[xx, xy], [xy, yy]] for xx, yy, zz, xy, yz, xz in stress[chosen]]))
longest = numpy.max(numpy.abs(values)) or 1.0
lines, ends, principal = vtkCellArray(), vtkPoints(), vtkDoubleArray()
principal.SetName("PrincipalStress [kPa]")
for place, value, direction in zip(points[chosen], values, directions):
    for k in range(2):
        half = 1.4 * %(spacing)r * abs(value[k]) / longest * direction[:, k]
        lines.InsertNextCell(2, [ends.InsertNextPoint(*(place + s * half), 0.001) for s in (-1, 1)])
        principal.InsertNextValue(value[k])
output = self.GetPolyDataOutput()
output.Initialize()  # of the particles' vertices
output.SetPoints(ends)
output.SetLines(lines)
output.GetCellData().SetScalars(principal)
"""


def prepare_crosses(run, particles):
    """Principal effective stresses in the plane, at every third particle, not computed until they are shown."""
    if run["field"] != "EffectiveStress" or not run["spacing"]:
        return
    crosses = ProgrammableFilter(registrationName="Principal stresses", Input=particles, OutputDataSetType="vtkPolyData")
    crosses.Script = CROSSES % run


def look_at(view, bounds):
    """Looks from the front at all of it, with room for the colour bar on the right and text at the top."""
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
    """The last time that all of them have."""
    animation = GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    move_levels(animation)
    ends = [max(reader.TimestepValues) for reader in readers if reader.TimestepValues]
    if ends:
        animation.AnimationTime = min(ends)


def round_ends(low, high):
    """The range widened to whole steps of about a twentieth, of 1, 2 or 5 times a power of ten."""
    step = (high - low) / 20
    power = 10.0 ** math.floor(math.log10(step))
    step = next(s * power for s in (1, 2, 5, 10) if s * power >= step * (1 - 1e-9))
    return step * math.floor(low / step + 1e-6), step * math.ceil(high / step - 1e-6)


def one_range(displays, run):
    """The colours of all times of all runs; a field that is the same everywhere keeps ParaView's range."""
    if not run["shown"]:
        return
    colours, ends = GetColorTransferFunction(run["shown"]), []
    for display in displays:
        display.RescaleTransferFunctionToDataRangeOverTime()
        ends += [colours.RGBPoints[0], colours.RGBPoints[-4]]
    if min(ends) < max(ends):
        colours.RescaleTransferFunction(*round_ends(min(ends), max(ends)))


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
