"""What the scripts beside a series show, each in a pvpython of its own:
check_script.py check_range RUN OTHER_RUN PICTURE, or check_moving_level, check_section, check_marks, check_plugin or check_numpy
RUN PICTURE"""
import os
import sys

from paraview import servermanager
from paraview.simple import *


def expect(truth, what):
    if not truth:
        raise AssertionError(what)
    print("  " + what)


def start(script, *arguments):
    """Runs a script in here, as pvpython would; returns what it defines."""
    sys.argv = [script, *arguments]
    names = {"__file__": script}
    with open(script) as text:
        exec(text.read(), names)
    return names


def check_moving_level(folder, picture):
    """The level that the script draws, against that of the case, at the time of each frame."""
    names = start(os.path.join(folder, "open_in_paraview.py"), picture)
    (display, steps), = names["MOVING_LEVELS"]
    times = list(names["reader"].TimestepValues)
    for time in times:
        GetAnimationScene().AnimationTime = time
        drawn, level = display.Position[1], max(9 - 4 * time, 5)
        if abs(drawn - level) > 1e-6:
            raise AssertionError(f"at {time} s the level is drawn at {drawn} m, not at {level} m")
    expect(times[-1] > 1 and any(0 < t < 1 for t in times), f"the water level is where it was at {len(times)} times")
    GetAnimationScene().AnimationTime = times[len(times) // 4]
    SaveScreenshot(picture, GetLayout())


def first_block(data):
    while data.IsA("vtkCompositeDataSet"):
        data = data.GetBlock(0)
    return data


def check_range(run, other, picture):
    """The colours of the comparison, against the values of both runs at all times."""
    names = start(os.path.join(run, "compare_in_paraview.py"), other, picture)
    values = []
    for reader, shown, display, bounds in names["shown"]:
        for time in reader.TimestepValues:
            reader.UpdatePipeline(time)
            array = first_block(servermanager.Fetch(reader)).GetPointData().GetArray("EffectiveStress")
            values += [end / 1000 for end in array.GetRange(1)]
    points = GetColorTransferFunction("EffectiveStress_YY [kPa]").RGBPoints
    ends, step = (points[0], points[-4]), 0.11 * (max(values) - min(values))
    expect(0 <= min(values) - ends[0] < step and 0 <= ends[1] - max(values) < step,
            f"one range of colours for all times of both runs, {ends[0]:g} to {ends[1]:g} kPa, with round ends")
    last = min(max(reader.TimestepValues) for reader, *rest in names["shown"])
    expect(GetAnimationScene().AnimationTime == last, f"both runs are shown at {last:g} s, which both have")


def check_section(run, picture):
    """The section that the script prepares, against theory in its middle."""
    names = start(os.path.join(run, "open_in_paraview.py"), picture)
    expect(GetActiveSource() == names["values"], "what is shown is active, so that its colours can be changed")
    section = FindSource("Section")
    section.UpdatePipeline(GetAnimationScene().AnimationTime)
    line = first_block(servermanager.Fetch(section))
    middle = line.GetNumberOfPoints() // 2
    found = line.GetPointData().GetArray("EffectiveStress_YY [kPa]").GetValue(middle)
    wanted = -10.19 * (10 - line.GetPoint(middle)[1])  # submerged unit weight times depth
    expect(wanted < -40 and abs(found - wanted) < 0.02 * abs(wanted),
            f"the section has {found:.2f} kPa in its middle, theory {wanted:.2f} kPa")


def check_marks(run, picture):
    """Isolines and crosses that the script prepares."""
    start(os.path.join(run, "open_in_paraview.py"), picture)
    time, view = GetAnimationScene().AnimationTime, GetActiveView()
    isolines, crosses = FindSource("Isolines"), FindSource("Principal stresses")
    isolines.UpdatePipeline(time)
    data = first_block(servermanager.Fetch(isolines))
    values = data.GetPointData().GetArray("EffectiveStress_YY [kPa]")
    levels = sorted({round(values.GetValue(i), 6) for i in range(values.GetNumberOfTuples())})
    expect(len(levels) > 4, f"isolines at {len(levels)} levels")
    heights = {}
    for i in range(data.GetNumberOfPoints()):
        heights.setdefault(round(values.GetValue(i), 6), []).append(data.GetPoint(i)[1])
    middle = levels[len(levels) // 2]
    spread = max(heights[middle]) - min(heights[middle])
    expect(spread < 0.3, f"that of {middle:g} kPa is level within {spread:.2f} m, as the stress is")
    crosses.UpdatePipeline(time)
    lines = first_block(servermanager.Fetch(crosses))
    upright, stress = 0, lines.GetCellData().GetArray("PrincipalStress [kPa]")
    for i in range(lines.GetNumberOfCells()):
        cell = lines.GetCell(i)
        (x0, y0, _), (x1, y1, _) = (lines.GetPoint(cell.GetPointId(k)) for k in range(2))
        upright += abs(y1 - y0) > 10 * abs(x1 - x0) and stress.GetValue(i) < 0
    expect(lines.GetNumberOfCells() > 40 and upright > 0.4 * lines.GetNumberOfCells(),
            f"{lines.GetNumberOfCells() // 2} crosses, whose longer bars are upright")
    for source in (isolines, crosses):
        display = Show(source, view)
        display.AmbientColor = display.DiffuseColor = [0.1, 0.1, 0.1]
        display.ColorArrayName = ["POINTS", ""]
        display.Position = [0.0, 0.0, 0.01]
    SaveScreenshot(picture, GetLayout())


def check_plugin(run, picture):
    """The plugin for ParaView, against theory and the case."""
    import inspect
    if not hasattr(inspect, "getargspec"):  # ParaView 5.11 asks Python 3.11 for it
        inspect.getargspec = inspect.getfullargspec
    sys.argv = [""]
    folder = os.path.join(os.path.dirname(__file__), "..", "..", "python")
    LoadPlugin(os.path.abspath(os.path.join(folder, "porosph_paraview.py")), remote=False, ns=globals())
    reader = PVDReader(FileName=os.path.join(run, "particles.pvd"))
    time = reader.TimestepValues[-1]
    section = PorosphSection(Input=reader, From=[7.5, -1], To=[7.5, 11], Points=121)
    section.UpdatePipeline(time)
    line = servermanager.Fetch(section)
    worst, lowest = 0, 10
    for i in range(line.GetNumberOfPoints()):
        found = line.GetPointData().GetArray("EffectiveStress").GetTuple(i)[1] / 1000
        wanted = -10.19 * (10 - line.GetPoint(i)[1])
        if line.GetPoint(i)[1] < 8:  # in the uppermost rows the particles are off themselves
            worst = max(worst, abs(found - wanted))
        lowest = min(lowest, line.GetPoint(i)[1])
    expect(lowest < 0.06 and worst < 0.5, f"the section from {lowest:.2f} m up is within {worst:.2f} kPa of theory, also at the floor")
    invariants = PorosphInvariants(Input=reader)
    invariants.UpdatePipeline(time)
    data = first_block(servermanager.Fetch(invariants)).GetPointData()
    stress, p, q = (data.GetArray(name) for name in ("EffectiveStress", "p' [kPa]", "q [kPa]"))
    for i in range(0, stress.GetNumberOfTuples(), 97):
        xx, yy, zz, xy, *_ = (value / 1000 for value in stress.GetTuple(i))
        mises = (0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xy ** 2) ** 0.5
        if abs(p.GetValue(i) + (xx + yy + zz) / 3) > 1e-9 or abs(q.GetValue(i) - mises) > 1e-9:
            raise AssertionError("invariants are wrong")
    expect(True, "p' and q of the particles")
    case = PorosphCase(FileName=os.path.join(run, "case.toml"))
    case.UpdatePipeline()
    blocks = servermanager.Fetch(case)
    found = {blocks.GetMetaData(i).Get(blocks.NAME()): blocks.GetBlock(i).GetNumberOfCells() for i in range(blocks.GetNumberOfBlocks())}
    expect(found == {"outlines": 1, "supports": 3, "water": 1, "probes": 2}, f"the case's blocks: {found}")
    view = CreateView("RenderView")
    Show(case, view)
    view.ResetCamera()
    SaveScreenshot(picture, view)


def check_numpy(run, picture):
    """What Debian's own modules offer beside ParaView's."""
    import matplotlib
    import numpy
    expect(numpy.linalg.norm([3, 4]) == 5 and matplotlib.__version__ > "3", "numpy and matplotlib are there")


globals()[sys.argv[1]](*sys.argv[2:])
