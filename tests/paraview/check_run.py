"""What a user does with a run in ParaView, done by pvpython: check_run.py RUN OTHER_RUN DRAWDOWN PICTURE_FOLDER

RUN is a submerged foundation at rest in the consistent form, with all fields and its boundary as a second block;
OTHER_RUN is one without; in DRAWDOWN the water level falls from 9 m to 5 m within a second. Writes pictures to look at, and ends with an error at the first thing that is not as it should be."""
import math
import os
import subprocess
import sys
import xml.etree.ElementTree

from paraview import servermanager
from paraview.simple import *

COMPONENTS = {
    "Displacement": "X Y Z", "Velocity": "X Y Z", "PorePressure": "", "Density": "", "Mass": "", "SmoothingLength": "",
    "SoilId": "", "ParticleId": "", "MeanStress": "", "VonMisesStress": "", "PrincipalStress": "S1 S2 S3",
    **dict.fromkeys(["EffectiveStress", "TotalStress", "DeviatoricStress", "Strain", "ExcessStress"], "XX YY ZZ XY YZ XZ")}


def require(truth, what):
    if not truth:
        raise AssertionError(what)
    print("  " + what)


def data_of(proxy):
    data = servermanager.Fetch(proxy)
    while data.IsA("vtkCompositeDataSet"):
        data = data.GetBlock(0)
    return data


def column(data, name, component=0):
    array = data.GetPointData().GetArray(name)
    require_array(array, name)
    return [array.GetComponent(i, component) for i in range(array.GetNumberOfTuples())]


def require_array(array, name):
    if array is None:
        raise AssertionError("no array " + name)


def series_times(pvd):
    return [float(e.get("timestep")) for e in xml.etree.ElementTree.parse(pvd).iter("DataSet") if e.get("part") == "0"]


def colours(picture):
    """How many colours a PNG has, a sign of whether there is anything on it."""
    from vtkmodules.vtkIOImage import vtkPNGReader
    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    step = max(1, scalars.GetNumberOfTuples() // 20000)
    return len({scalars.GetTuple(i) for i in range(0, scalars.GetNumberOfTuples(), step)})


def check_data(run, fields):
    pvd = os.path.join(run, "particles.pvd")
    reader = PVDReader(FileName=pvd)
    times = list(reader.TimestepValues)
    require(times == series_times(pvd) and times[0] == 0 and len(times) > 2, f"times are the seconds of the .pvd, 0 to {times[-1]:g} s")
    reader.UpdatePipeline(times[-1])
    particles = reader
    if not data_is_single(reader):
        particles = ExtractBlock(Input=reader, Selectors=["/Root/particles"])
        boundary = ExtractBlock(Input=reader, Selectors=["/Root/boundary"])
        boundary.UpdatePipeline(times[-1])
        require(boundary.GetDataInformation().GetNumberOfPoints() > 0, "the boundary is a second block")
        particles = MergeBlocks(Input=particles)
        particles.UpdatePipeline(times[-1])
    data = data_of(particles)
    for name in fields:
        array = data.GetPointData().GetArray(name)
        require_array(array, name)
        names = [array.GetComponentName(c) or "" for c in range(array.GetNumberOfComponents())]
        wanted = COMPONENTS[name].split() or [""]
        finite = all(math.isfinite(v) for c in range(len(names)) for v in array.GetRange(c))
        if names != wanted or not finite or array.GetNumberOfTuples() != data.GetNumberOfPoints():
            raise AssertionError(f"{name}: components {names}, finite: {finite}")
    require(True, f"{len(fields)} arrays with component names and finite ranges")
    return particles, data, times


def data_is_single(reader):
    return not servermanager.Fetch(reader).IsA("vtkCompositeDataSet")


def check_filters(particles, data, time, pictures):
    vertical = column(data, "EffectiveStress", 1)
    calculator = Calculator(Input=particles, ResultArrayName="Vertical", Function="EffectiveStress_YY")
    threshold = Threshold(Input=calculator, Scalars=["POINTS", "Vertical"], LowerThreshold=-1e9, UpperThreshold=-50e3)
    threshold.UpdatePipeline()
    wanted = sum(v <= -50e3 for v in vertical)
    found = threshold.GetDataInformation().GetNumberOfPoints()
    require(found == wanted and 0 < wanted < len(vertical), f"Threshold on EffectiveStress_YY keeps {found} of {len(vertical)}")
    pressure = column(data, "PorePressure")
    middle = 0.5 * (min(pressure) + max(pressure))
    threshold = Threshold(Input=particles, Scalars=["POINTS", "PorePressure"], LowerThreshold=middle, UpperThreshold=0)
    threshold.UpdatePipeline()
    require(threshold.GetDataInformation().GetNumberOfPoints() == sum(p >= middle for p in pressure), "Threshold on PorePressure")

    difference = Calculator(Input=particles, ResultArrayName="q", Function="EffectiveStress_YY - EffectiveStress_XX")
    difference.UpdatePipeline()
    q, lateral = column(data_of(difference), "q"), column(data, "EffectiveStress", 0)
    require(all(abs(a - (b - c)) < 1e-6 for a, b, c in zip(q, vertical, lateral)), "Calculator on tensor components")
    length = Calculator(Input=particles, ResultArrayName="u", Function="mag(Displacement)")
    length.UpdatePipeline()
    require(max(column(data_of(length), "u")) > 0, "Calculator on vectors")

    bounds = data.GetBounds()
    x = 0.5 * (bounds[0] + bounds[1]) + 0.01
    line = SPHLineInterpolator(Input=particles, Kernel="SPHCubicKernel", Source="Line")
    line.Source.Point1, line.Source.Point2 = [x, bounds[2] + 1, 0], [x, bounds[3] - 1, 0]
    line.Source.Resolution = 40
    line.Kernel.SpatialStep = column(data, "SmoothingLength")[0]
    line.Kernel.Dimension = 2
    line.DensityArray, line.MassArray = "Density", "Mass"
    line.UpdatePipeline()
    sampled = data_of(line)
    points = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]
    stress = column(sampled, "EffectiveStress", 1)
    worst = 0
    for i, value in enumerate(stress):
        place = sampled.GetPoint(i)
        near = min(range(len(points)), key=lambda k: math.dist(points[k], place))
        worst = max(worst, abs(value - vertical[near]))
    require(len(stress) == 41 and worst < 0.05 * max(map(abs, vertical)), f"Plot Over Line by the SPH interpolator: within {worst:.0f} Pa of the nearest particle")
    chart = CreateView("XYChartView")
    shown = Show(line, chart)
    shown.SeriesVisibility = ["EffectiveStress_YY"]
    shown.UseIndexForXAxis = 0
    shown.XArrayName = "Points_Y"
    chart.ViewSize = [1000, 600]
    chart.ViewTime = time
    Render(chart)
    SaveScreenshot(os.path.join(pictures, "line.png"), chart)
    require(colours(os.path.join(pictures, "line.png")) > 3, "its plot is drawn")
    Delete(chart)


def check_gaussians(particles, time, pictures):
    view = CreateView("RenderView")
    view.ViewSize = [800, 500]
    view.ViewTime = time
    shown = Show(particles, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.GaussianRadius = 0.1
    ColorBy(shown, ["POINTS", "EffectiveStress", "XX"])
    view.ResetCamera()
    picture = os.path.join(pictures, "gaussians.png")
    SaveScreenshot(picture, view)
    require(colours(picture) > 30, "Point Gaussian is drawn in colour")


def check_scripts(run, other, drawdown, pictures):
    """As a user starts them: programs of their own."""
    for folder, script, arguments, picture in [(run, "open_in_paraview.py", [], "open.png"),
                                               (other, "open_in_paraview.py", [], "open_other.png"),
                                               (drawdown, "open_in_paraview.py", [], "drawn_down.png"),
                                               (run, "compare_in_paraview.py", [other], "compare.png")]:
        picture = os.path.join(pictures, picture)
        program = os.environ["PVPYTHON"]
        done = subprocess.run([program, os.path.join(folder, script), *arguments, picture], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        require(done.returncode == 0 and "Traceback" not in done.stdout and "ERR|" not in done.stdout,
                f"{script} runs without complaints" + ("" if done.returncode == 0 else ": " + done.stdout[-2000:]))
        require(colours(picture) > 30, f"{os.path.basename(picture)} shows something")


run, other, drawdown, pictures = sys.argv[1:5]
os.makedirs(pictures, exist_ok=True)
print("A run with all fields and its boundary")
particles, data, times = check_data(run, list(COMPONENTS))
check_filters(particles, data, times[-1], pictures)
check_gaussians(particles, times[-1], pictures)
print("A run with what is written by default")
check_data(other, [f for f in COMPONENTS if f in "Displacement Velocity EffectiveStress TotalStress PorePressure Density Mass SmoothingLength SoilId ParticleId".split()])
print("The scripts beside them")
check_scripts(run, other, drawdown, pictures)
for arguments in (["check_range", run, other, os.path.join(pictures, "compare.png")],
                  ["check_moving_level", drawdown, os.path.join(pictures, "falling.png")],
                  ["check_section", run, os.path.join(pictures, "section.png")],
                  ["check_marks", run, os.path.join(pictures, "marks.png")],
                  ["check_plugin", run, os.path.join(pictures, "case.png")],
                  ["check_numpy", run, os.path.join(pictures, "none.png")]):
    subprocess.run([os.environ["PVPYTHON"], os.path.join(os.path.dirname(__file__), "check_script.py"), *arguments], check=True)
print("ParaView shows all of it; look at the pictures in " + pictures)
