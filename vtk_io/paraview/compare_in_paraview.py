# Shows two runs side by side: linked cameras, the same time, one range of colours.
#     paraview --script=compare_in_paraview.py
#     pvpython compare_in_paraview.py picture.png
# Where this script does not name the other run, say which: pvpython compare_in_paraview.py OTHER_RUN, or
#     OTHER_RUN=../other paraview --script=compare_in_paraview.py
# Made for ParaView 5.11 and later.

from porosph_common import *  # Porosph writes the file's text in place of this line

FOLDERS = []  # of the runs
WRITTEN_IN = ""


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
to_last_time([reader for reader, values, display, bounds in shown])
one_range([display for reader, values, display, bounds in shown], runs[0])
AddCameraLink(first, second, "both runs")
both = list(zip(*[bounds for reader, values, display, bounds in shown]))
look_at(first, [min(ends) if i % 2 == 0 else max(ends) for i, ends in enumerate(both)])
SetActiveView(first)
SetActiveSource(shown[0][1])
finish(layout)
