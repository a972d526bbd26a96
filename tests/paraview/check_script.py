"""What the scripts beside a series show, each in a pvpython of its own:
check_script.py check_range RUN OTHER_RUN PICTURE, or check_moving_level, check_section or check_numpy RUN PICTURE"""
import os
import sys

from paraview import servermanager
from paraview.simple import *


def require(truth, what):
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
    require(times[-1] > 1 and any(0 < t < 1 for t in times), f"the water level is where it was at {len(times)} times")
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
    require(0 <= min(values) - ends[0] < step and 0 <= ends[1] - max(values) < step,
            f"one range of colours for all times of both runs, {ends[0]:g} to {ends[1]:g} kPa, with round ends")
    last = min(max(reader.TimestepValues) for reader, *rest in names["shown"])
    require(GetAnimationScene().AnimationTime == last, f"both runs are shown at {last:g} s, which both have")


def check_section(run, picture):
    """The section that the script prepares, against theory in its middle."""
    names = start(os.path.join(run, "open_in_paraview.py"), picture)
    require(GetActiveSource() == names["values"], "what is shown is active, so that its colours can be changed")
    section = FindSource("Section")
    section.UpdatePipeline(GetAnimationScene().AnimationTime)
    line = first_block(servermanager.Fetch(section))
    middle = line.GetNumberOfPoints() // 2
    found = line.GetPointData().GetArray("EffectiveStress_YY [kPa]").GetValue(middle)
    wanted = -10.19 * (10 - line.GetPoint(middle)[1])  # submerged unit weight times depth
    require(wanted < -40 and abs(found - wanted) < 0.02 * abs(wanted),
            f"the section has {found:.2f} kPa in its middle, theory {wanted:.2f} kPa")


def check_numpy(run, picture):
    """What Debian's own modules offer beside ParaView's."""
    import matplotlib
    import numpy
    require(numpy.linalg.norm([3, 4]) == 5 and matplotlib.__version__ > "3", "numpy and matplotlib are there")


globals()[sys.argv[1]](*sys.argv[2:])
