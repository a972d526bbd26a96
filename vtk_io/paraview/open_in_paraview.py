# Opens the particles beside this script, ready to look at:
#     paraview --script=open_in_paraview.py
#     pvpython open_in_paraview.py picture.png
# Made for ParaView 5.11 and later.

from porosph_common import *  # Porosph writes the file's text in place of this line

RUN = {}  # what Porosph knows of the run

RUN["folders"] = [HERE, os.getcwd(), RUN["folder"]]
view = GetActiveViewOrCreate("RenderView")
start(GetLayout(view))
reader, values, display, bounds = show_run(RUN, view)
prepare_section(RUN, values)
to_last_time([reader])
one_range([display], RUN)
prepare_isolines(RUN, values, view)
prepare_crosses(RUN, values)
look_at(view, bounds)
SetActiveSource(values)
finish(GetLayout(view))
