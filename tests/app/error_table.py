#!/usr/bin/env python3
"""Makes the mistakes of docs/errors.md and compares what the program says with what stands there.

Usage: error_table.py PROGRAM [--write]      --write updates the document
"""
import fcntl
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "errors.md"
HEAD = """# Error messages

A test makes every mistake below and compares the message with this page. To update the page:

```sh long
cmake --preset tests && cmake --build --preset tests --target porosph
tests/app/error_table.py build/tests/bin/porosph --write
```

The program reports all errors of a case at once, in the order of the file; here each stands alone. Lines and columns refer to
this case:

"""
CASE = """title = "Box"
[particles]
spacing = 0.5
[[soil]]
name = "sand"
polygon = [[0, 0], [4, 0], [4, 2], [0, 2]]
youngs_modulus = 1e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [4, 0]
[time]
end = 0.1
[[probe]]
name = "A"
position = [2, 1]
"""
CLAY = """[[soil]]
name = "clay"
polygon = [[4.2, 0], [9, 0], [9, 2], [4.2, 2]]
youngs_modulus = 1e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
"""
LOAD = """[[load]]
name = "strip"
from = [1, 2]
to = [3, 2]
pressure = 1e4
"""
FOOTING = """[[footing]]
name = "plate"
from = [1, 2]
to = [3, 2]
force = 1e4
"""
SHEET = """[[sheet]]
name = "wall"
from = [2, 2]
to = [2, 0.5]
bending_stiffness = 1e6
axial_stiffness = 1e8
mass = 100
"""
OUTLINE = "[[0, 0], [4, 0], [4, 2], [0, 2]]"

# What is wrong, as a person would say it; then the text of the case that is replaced, and by what.
IN_THE_CASE = [
    ("a slip in the TOML", "end = 0.1", "end = 0.1 s"),
    ("a key with a typing mistake", "youngs_modulus", "young_modulus"),
    ("a key that is missing", "poissons_ratio = 0.3\n", ""),
    ("a value out of range", "poissons_ratio = 0.3", "poissons_ratio = 0.5"),
    ("text for a number", "end = 0.1", 'end = "0.1"'),
    ("a unit of another dimension", "end = 0.1", 'end = "0.1 kPa"'),
    ("a unit that nobody knows", "youngs_modulus = 1e6", 'youngs_modulus = "1 Mpa"'),
    ("a unit where none belongs", "poissons_ratio = 0.3", 'poissons_ratio = "0.3 m"'),
    ("a number that is not finite", "end = 0.1", "end = nan"),
    ("text with control characters", '"Box"', '"Box\\u001b[31m"'),
    ("a word that is not offered", '"fixed"', '"fixd"'),
    ("a setting that would not be used", "[time]", "[formulation]\nmotion = \"proposed\"\nbulk_viscosity = 0.1\n[time]"),
    ("a name given twice", "[[boundary]]", CLAY.replace("clay", "sand").replace("4.2", "4") + "[[boundary]]"),
    ("water twice", "[time]", "[water]\nlevel = 3\nstretches = [{level = 3}]\n[time]"),
    ("a spacing that no computer can hold", "spacing = 0.5", "spacing = 1e-9"),
    ("an end that no run reaches", "end = 0.1", "end = 1e9\ncourant = 1e-6"),
    ("finite elements for what is not linear", "[[boundary]]", "no_tension = true\n[check]\nfinite_elements = true\n[[boundary]]"),
    ("inertia beyond its mass for soil whose way to rest matters", "[time]",
     '[loading]\ndamping = "adaptive"\ndamping_until = 0.05\nscaled_inertia = true\n[time]'),
    ("a law without its strength", "[[boundary]]", 'law = "mohr_coulomb"\ncohesion = 5e3\n[[boundary]]'),
    ("strength that the law has not", "[[boundary]]", 'cohesion = 5e3\n[[boundary]]'),
    ("Cam-clay with a swelling line as steep as the virgin one", "[[boundary]]",
     'law = "modified_cam_clay"\ncritical_state_ratio = 1\nlambda = 0.1\nkappa = 0.1\nvoid_ratio = 1\n'
     'preconsolidation_pressure = 1e5\n[[boundary]]'),
    ("Cam-clay without its preconsolidation", "[[boundary]]",
     'law = "modified_cam_clay"\ncritical_state_ratio = 1\nlambda = 0.1\nkappa = 0.02\nvoid_ratio = 1\n[[boundary]]'),
    ("a wall with friction without its coefficient", 'kind = "fixed"', 'kind = "friction"'),
    ("a coefficient of a wall without friction", 'kind = "fixed"', 'kind = "fixed"\ncoefficient = 0.3'),
    ("a wall with friction in the paper's forms", '[[boundary]]\nkind = "fixed"',
     '[formulation]\nmotion = "proposed"\n[[boundary]]\nkind = "friction"\ncoefficient = 0.3'),
    ("more dilation than friction", "[[boundary]]",
     'law = "mohr_coulomb"\ncohesion = 5e3\nfriction_angle = 20\ndilation_angle = 25\n[[boundary]]'),
    ("finite elements for soil that yields", "[[boundary]]",
     'law = "tresca"\nundrained_strength = 20e3\n[check]\nfinite_elements = true\n[[boundary]]'),
    ("more frames than anyone wants", "[time]", "[output]\ninterval = 1e-9\n[time]"),
]
WEIGHT = "unit_weight_saturated = 20e3\n"
PERMEABLE = WEIGHT + "permeability = 1e-5\n"
STEADY = '[water]\nmode = "steady"\n'
TRANSIENT = '[water]\nmode = "transient"\n'
CLOSED = '[[water.face]]\nkind = "closed"\n'
ON_TOP = '[[water.face]]\nkind = "head"\nlevel = 3\nfrom = [0, 2]\nto = [4, 2]\n'
IN_THE_FLOW = [
    ("permeability of soil whose water stands", WEIGHT, PERMEABLE + "[water]\nlevel = 3\n"),
    ("porosity of soil whose water stands", WEIGHT, WEIGHT + "porosity = 0.5\n[water]\nlevel = 3\n"),
    ("flow in soil without permeability", WEIGHT, WEIGHT + STEADY + CLOSED + ON_TOP),
    ("a part of the outline without a face", WEIGHT, PERMEABLE + STEADY + ON_TOP),
    ("a face beside the soil", WEIGHT, PERMEABLE + STEADY + CLOSED + ON_TOP.replace("2]", "2.5]")),
    ("a face with one end", WEIGHT, PERMEABLE + STEADY + CLOSED + ON_TOP.replace("to = [4, 2]\n", "")),
    ("a head without its level", WEIGHT, PERMEABLE + STEADY + CLOSED + ON_TOP.replace("level = 3\n", "")),
    ("flow that no head drives", WEIGHT, PERMEABLE + STEADY + CLOSED),
    ("a water level beside faces", WEIGHT, PERMEABLE + STEADY + "level = 3\n" + CLOSED + ON_TOP),
    ("retention without all its numbers", WEIGHT,
     PERMEABLE + 'retention = { model = "van_genuchten", alpha = 2 }\n' + STEADY + CLOSED + ON_TOP),
    ("consolidation of soil above the water", WEIGHT, PERMEABLE + '[water]\nmode = "coupled"\nlevel = 1\n'),
    ("undrained soil above the water", WEIGHT, WEIGHT + '[water]\nmode = "undrained"\nlevel = 1\n'),
    ("stabilisation of water that stands", WEIGHT, WEIGHT + '[water]\nlevel = 3\nstabilisation = 0.1\n'),
    ("damping of soil that is at rest", WEIGHT,
     PERMEABLE + '[water]\nmode = "coupled"\nlevel = 3\n[loading]\ndamping = 0.1\n'),
    ("flow in one of the paper's forms", WEIGHT,
     PERMEABLE + STEADY + CLOSED + ON_TOP + '[formulation]\nmotion = "proposed"\n'),
    ("rain on a face with a head", WEIGHT, PERMEABLE + STEADY + CLOSED + ON_TOP + "rate = 1e-6\n"),
    ("a level over time in steady flow", WEIGHT,
     PERMEABLE + STEADY + CLOSED + ON_TOP.replace("level = 3", "level_over_time = [[0, 3], [60, 4]]")),
    ("a level and a level over time", WEIGHT,
     PERMEABLE + TRANSIENT + ON_TOP + "level_over_time = [[0, 3], [60, 4]]\n"),
    ("damping of soil that follows a flow", WEIGHT, PERMEABLE + TRANSIENT + ON_TOP + "[loading]\ndamping = 0.1\n"),
    ("inertia from the start in transient flow", WEIGHT, PERMEABLE + TRANSIENT + 'motion = "dynamic"\n' + ON_TOP),
    ("rigid soil that may fail", WEIGHT, PERMEABLE + TRANSIENT + 'motion = "automatic"\nrigid_soil = true\n' + ON_TOP),
    ("how long soil moves that never does", WEIGHT, PERMEABLE + TRANSIENT + "motion_time = 5\n" + ON_TOP),
    ("flow over time that nothing drives", WEIGHT, PERMEABLE + TRANSIENT + CLOSED),
    ("a start of steady flow", WEIGHT, PERMEABLE + STEADY + "start_level = 1\n" + CLOSED + ON_TOP),
    ("more water that stays than there are pores", WEIGHT,
     PERMEABLE + "retention = { residual = 0.5 }\n" + TRANSIENT + ON_TOP),
    ("a table of retention that rises", WEIGHT,
     PERMEABLE + 'retention = { model = "table", saturation = [[0, 1], [1, 0.2], [2, 0.3]], '
     'permeability = [[0, 1], [1, 0.01]] }\n' + TRANSIENT + ON_TOP),
    ("permeability that follows the pores of soil that is rigid to the flow", WEIGHT,
     PERMEABLE + 'permeability_law = "kozeny_carman"\n' + STEADY + CLOSED + ON_TOP),
    ("a law of permeability that is not known", WEIGHT,
     PERMEABLE + 'permeability_law = "kozeny"\n[water]\nmode = "coupled"\nlevel = 3\n'),
    ("a well wider than its particle", WEIGHT,
     PERMEABLE + TRANSIENT + '[[water.drain]]\nname = "well"\nfrom = [2, 1]\nradius = 0.1\n' + ON_TOP),
    ("the radius of a drain along a line", WEIGHT,
     PERMEABLE + TRANSIENT + '[[water.drain]]\nname = "toe"\nfrom = [2, 1]\nto = [3, 1]\nradius = 0.01\n' + ON_TOP),
    ("a well in soil that is more permeable along its layers", WEIGHT,
     PERMEABLE + "permeability_vertical = 1e-6\n" + TRANSIENT +
     '[[water.drain]]\nname = "well"\nfrom = [2, 1]\nradius = 0.01\n' + ON_TOP),
    ("a drain beside the soil", WEIGHT,
     PERMEABLE + TRANSIENT + '[[water.drain]]\nname = "toe"\nfrom = [9, 1]\n' + ON_TOP),
    ("a section where water stands", WEIGHT,
     WEIGHT + '[water]\nlevel = 1\n[[section]]\nname = "A"\nfrom = [1, 0]\nto = [1, 2]\n'),
    ("a body that no head reaches", WEIGHT,
     PERMEABLE + CLAY.replace("4.2", "6").replace(WEIGHT, PERMEABLE) +
     '[[boundary]]\nkind = "fixed"\nfrom = [6, 0]\nto = [9, 0]\n' + STEADY + CLOSED + ON_TOP),
]
OF_THE_GROUND = [
    ("an outline that crosses itself", OUTLINE, "[[0, 0], [4, 2], [4, 0], [0, 2]]"),
    ("soil without area", OUTLINE, "[[0, 0], [4, 0], [8, 0]]"),
    ("a layer thinner than the spacing", OUTLINE, "[[0, 0], [4, 0], [4, 0.3], [0, 0.3]]"),
    ("soils that overlap", "[[boundary]]", CLAY.replace("4.2", "3") + "[[boundary]]"),
    ("a gap between soils", "[[boundary]]", CLAY + "[[boundary]]"),
    ("a slit between soils that touch at a point", "[[boundary]]",
     CLAY.replace("[[4.2, 0], [9, 0], [9, 2], [4.2, 2]]", "[[4, 0], [9, 0], [9, 2], [4.3, 2]]") + "[[boundary]]"),
    ("a body that nothing carries", "[[boundary]]", CLAY.replace("4.2", "6") + "[[boundary]]"),
    ("sides that hold, and no bottom", '"fixed"\nfrom = [0, 0]\nto = [4, 0]', '"roller"\nfrom = [0, 0]\nto = [0, 2]'),
    ("a boundary that touches nothing", "to = [4, 0]", "to = [4, -1]"),
    ("a boundary inside the soil", "from = [0, 0]\nto = [4, 0]", "from = [0, 1]\nto = [4, 1]"),
    ("water that touches no soil", "[time]", "[[water.stretches]]\nx_to = -1\nlevel = 1\n[time]"),
    ("a probe outside", "position = [2, 1]", "position = [2, 3]"),
    ("a wall that ends at a load", "[time]", LOAD.replace("[1, 2]", "[0, 2]") + "[[boundary]]\nkind = \"roller\"\nfrom = [0, 0]\nto = [0, 2]\n[time]"),
    ("a load that touches nothing", "[time]", LOAD.replace(", 2]", ", 3]") + "[time]"),
    ("a load on a wall", "[time]", LOAD.replace(", 2]", ", 0]") + "[time]"),
    ("a load that reaches beyond the soil", "[time]", LOAD.replace("[3, 2]", "[5, 2]") + "[time]"),
    ("a load shorter than the spacing", "[time]", LOAD.replace("[3, 2]", "[1.2, 2]") + "[time]"),
    ("a load between two soils", "[[boundary]]", CLAY.replace("4.2", "4")
     + LOAD.replace("[1, 2]", "[4, 0]").replace("[3, 2]", "[4, 2]") + "[[boundary]]"),
    ("a load of nothing", "[time]", LOAD.replace("pressure = 1e4\n", "") + "[time]"),
    ("a footing that nothing drives", "[time]", FOOTING.replace("force = 1e4\n", "") + "[time]"),
    ("a footing that jumps", "[time]", FOOTING.replace("force = 1e4", "settlement = 0.1") + "[time]"),
    ("a footing on a wall", "[time]", FOOTING.replace(", 2]", ", 0]") + "[time]"),
    ("a footing in the paper's form", "[time]", FOOTING + "[formulation]\nmotion = \"proposed\"\n[time]"),
    ("a sheet on a slant", "[time]", SHEET.replace("[2, 0.5]", "[3, 0.5]") + "[time]"),
    ("a sheet shorter than two spacings", "[time]", SHEET.replace("[2, 0.5]", "[2, 1.5]") + "[time]"),
    ("a sheet in the air", "[time]", SHEET.replace("[2, ", "[7, ") + "[time]"),
    ("a sheet on a wall", "[time]", SHEET.replace("[2, 2]", "[0, 0]").replace("[2, 0.5]", "[4, 0]") + "[time]"),
    ("a sheet in the paper's form", "[time]", SHEET + "[formulation]\nmotion = \"proposed\"\n[time]"),
    ("a sheet in a lattice", "spacing = 0.5", "spacing = 0.5\narrangement = \"lattice\"\n" + SHEET),
    ("two sheets close together", "[time]", SHEET + SHEET.replace("wall", "other").replace("[2, ", "[2.5, ") + "[time]"),
    ("a sheet with the name of a probe", "[time]", SHEET.replace("wall", "A") + "[time]"),
    ("friction of a sheet that is bonded", "[time]", SHEET + "bonded = true\nfriction = 0.3\n[time]"),
    ("a footing that settles on coupled water", "[time]",
     FOOTING.replace("force = 1e4", "settlement = 0.1\nover_time = [[0, 0], [1, 1]]")
     + "[water]\nmode = \"undrained\"\nlevel = 2\n[time]"),
]
SIDE = '[[boundary]]\nkind = "periodic"\nfrom = [{0}, 0]\nto = [{0}, {1}]\n'
SIDES = SIDE.format(0, 2) + SIDE.format(4, 2)
SINE = "[shaking]\namplitude = 1\nfrequency = 2\n"
IN_AN_EARTHQUAKE = [
    ("one periodic side", "[time]", SIDE.format(0, 2) + "[time]"),
    ("a periodic side that is too short", "[time]", SIDE.format(0, 2) + SIDE.format(4, 1) + "[time]"),
    ("periodic sides of unlike height", "[[boundary]]", CLAY.replace("[[4.2, 0], [9, 0], [9, 2], [4.2, 2]]",
                                                                     "[[0, 2], [2, 2], [2, 4], [0, 4]]")
     + SIDE.format(0, 4) + SIDE.format(4, 4) + "[[boundary]]"),
    ("periodic sides in the paper's forms", "[time]", '[formulation]\nmotion = "proposed"\n' + SIDES + "[time]"),
    ("a sine without its frequency", "[time]", "[shaking]\namplitude = 1\n[time]"),
    ("a ramp longer than the sine", "[time]", SINE + "cycles = 3\nramp = 2\n[time]"),
    ("a sine and a course over time", "[time]", SINE + "acceleration_over_time = [[0, 0], [1, 1]]\n[time]"),
    ("shaking of soil that rests all the while", "[time]",
     SINE + '[water]\nmode = "undrained"\nlevel = 3\n[time]'),
    ("Byrne's sand without what compacts it", "[[boundary]]",
     'law = "byrne"\ncohesion = 0\nfriction_angle = 30\n[[boundary]]'),
]
STRENGTH = 'law = "mohr_coulomb"\ncohesion = 1e3\nfriction_angle = 30\n'
PLATE = FOOTING.replace("[1, 2]", "[0, 2]").replace("[3, 2]", "[0.9, 2]")
FILL = CLAY.replace("clay", "fill").replace("[[4.2, 0], [9, 0], [9, 2], [4.2, 2]]", "[[0, 2], [4, 2], [4, 4], [0, 4]]")


def stage(keys, things=FILL + LOAD):
    """Puts a stage that changes `keys` behind the soil, and one that brings the fill behind that."""
    text = '[[stage]]\nname = "next"\nduration = 1\n'
    later = text.replace("next", "later") + 'fill = ["fill"]\nload_off = ["strip"]\n'
    return things + text + keys + "\n" + later + "[[boundary]]"


IN_A_STAGE = [
    ("a stage without its duration", "[[boundary]]", '[[stage]]\nname = "next"\n[[boundary]]'),
    ("two stages of one name", "[[boundary]]",
     '[[stage]]\nname = "next"\nduration = 1\n' * 2 + "[[boundary]]"),
    ("digging in a soil that is not there", "[[boundary]]", stage('excavate = ["sandd"]')),
    ("digging where there is no soil", "[[boundary]]", stage("excavate_within = [[[5, 0], [6, 0], [6, 1]]]")),
    ("an outline to dig within that crosses itself", "[[boundary]]",
     stage("excavate_within = [[[0, 0], [1, 1], [1, 0], [0, 1]]]")),
    ("digging that leaves a sliver", "[[boundary]]",
     stage("excavate_within = [[[0.2, 0], [4, 0], [4, 2], [0.2, 2]]]")),
    ("digging under a load", "[[boundary]]", stage("excavate_within = [[[1, 1], [2, 1], [2, 2], [1, 2]]]")),
    ("digging out all", "[[boundary]]", stage('excavate = ["sand"]')),
    ("filling what is there", "[[boundary]]",
     '[[stage]]\nname = "next"\nduration = 1\nexcavate = ["sand"]\nfill = ["sand", "sand"]\n[[boundary]]'),
    ("a fill on a load", "[[boundary]]", stage("").replace('load_off = ["strip"]', "")),
    ("stress of a fill without one", "[[boundary]]", stage('fill_stress = "k0"')),
    ("a load that is not there", "[[boundary]]", stage('load_off = ["strop"]')),
    ("a load that has gone already", "[[boundary]]", stage('load_off = ["strip", "strip"]')),
    ("a footing that is not there", "[[boundary]]", stage('footing_off = ["plat"]', FILL + LOAD + PLATE)),
    ("a footing that is there already", "[[boundary]]",
     stage('footing_off = ["plate"]\nfooting_on = ["plate", "plate"]', FILL + LOAD + PLATE)),
    ("a fill on a footing", "[[boundary]]",
     stage('footing_on = ["plate"]', FILL + LOAD + PLATE)),
    ("digging under a footing", "[[boundary]]",
     stage('excavate_within = [[[0, 1], [1, 1], [1, 2], [0, 2]]]', FILL + LOAD + PLATE).replace('load_off = ["strip"]', 'load_off = ["strip"]\nfooting_off = ["plate"]')),
    ("a factor of safety of a footing that is pushed", "[[boundary]]", STRENGTH + stage(
        'safety = true', FILL + LOAD + PLATE.replace("force = 1e4", "settlement = 0.1\nover_time = [[0, 0], [1, 1]]"))),
    ("a stage that moves a footing", "[[boundary]]", stage('set = ["footing.plate.from = [0, 2]"]', FILL + LOAD + PLATE)),
    ("a sheet that is not there", "[[boundary]]", stage('sheet_off = ["wal"]', FILL + LOAD + SHEET)),
    ("a sheet that is there already", "[[boundary]]",
     stage('sheet_off = ["wall"]\nsheet_on = ["wall", "wall"]', FILL + LOAD + SHEET)),
    ("a stage that moves a sheet", "[[boundary]]", stage('set = ["sheet.wall.to = [2, 1]"]', FILL + LOAD + SHEET)),
    ("a ramp without a load", "[[boundary]]", stage("ramp = 1")),
    ("a boundary that is not there", "[[boundary]]", stage('support_off = ["left"]')),
    ("a setting of a stage with a typing mistake", "[[boundary]]", stage('set = ["water.levle = 1"]')),
    ("a setting of a stage out of range", "[[boundary]]", stage('set = ["soil.sand.poissons_ratio = 0.5"]')),
    ("a setting that holds throughout", "[[boundary]]", stage('set = ["particles.spacing = 0.1"]')),
    ("a factor of safety of elastic soil", "[[boundary]]", stage("safety = true")),
    ("a bracket of no factor of safety", "[[boundary]]", STRENGTH + stage("safety_bracket = 0.1")),
    ("a setting that moves soil", "[[boundary]]", stage('set = ["soil.sand.polygon = [[0, 0], [1, 0], [1, 1]]"]')),
    ("stages of consolidation", WEIGHT, PERMEABLE + '[water]\nmode = "coupled"\nlevel = 3\n'
     '[[stage]]\nname = "next"\nduration = 1\n'),
]
# What is allowed but can hardly be meant, likewise: warnings, with which the case is computed.
WARNED_OF = [
    ("unit weight in kN/m3", "unit_weight_saturated = 20e3", "unit_weight_saturated = 20"),
    ("density in place of unit weight", "unit_weight_saturated = 20e3", "unit_weight_saturated = 2000"),
    ("Young's modulus in kPa", "youngs_modulus = 1e6", "youngs_modulus = 1e3"),
    ("soil that settles much", "youngs_modulus = 1e6", "youngs_modulus = 0.2e6"),
    ("soil lighter than water", "unit_weight_saturated = 20e3\n",
     "unit_weight_saturated = 9e3\n[water]\nlevel = 1\n"),
    ("a layer of one row", "[[boundary]]", CLAY.replace("[[4.2, 0], [9, 0], [9, 2], [4.2, 2]]",
                                                       "[[0, 2], [4, 2], [4, 2.6], [0, 2.6]]") + "[[boundary]]"),
    ("a lattice that does not fit", "spacing = 0.5", "spacing = 0.7\narrangement = \"lattice\""),
    ("water below all soil", "[time]", "[[water.stretches]]\nx_to = 2\nlevel = -1\n[time]"),
    ("a footing with few neighbours around its edge", 'spacing = 0.5\n[[soil]]\n',
     "spacing = 0.5\nsmoothing_ratio = 1\n" + FOOTING + "[[soil]]\n" + STRENGTH),
    ("a time step that is too large", "end = 0.1", "end = 0.1\ncourant = 1.2"),
]
# What is wrong, the command, and what is put into files beforehand.
ON_THE_COMMAND_LINE = [
    ("no such subcommand", "runn case.toml", {}),
    ("no such option", "run case.toml --thread 2", {}),
    ("no such case", "run cse.toml", {}),
    ("an override of a key that is not there", "run case.toml --set soil.sand.youngs=1", {}),
    ("an override of a soil that is not there", "run case.toml --set soil.clay.youngs_modulus=1e6", {}),
    ("a start from a folder without a state", "run case.toml --out started --set start_from=nothing", {}),
    ("a start from soil with other particles", "run case.toml --out started --set start_from=run --set particles.spacing=0.4",
     {}),
    ("a failure of a case with stages", "safety staged.toml --then-run", {
        "staged.toml": CASE.replace("[[boundary]]", STRENGTH + "[[boundary]]") + '[[stage]]\nname = "next"\nduration = 1\n'}),
    ("limit equilibrium under a footing", "safety footing.toml --method both", {
        "footing.toml": CASE.replace("[[boundary]]", STRENGTH + FOOTING + "[[boundary]]")}),
    ("limit equilibrium beside a sheet", "safety sheet.toml --method both", {
        "sheet.toml": CASE.replace("[[boundary]]", STRENGTH + SHEET + "[[boundary]]")}),
    ("a factor of safety of a footing that is pushed", "safety pushed.toml", {
        "pushed.toml": CASE.replace("[[boundary]]", STRENGTH + FOOTING.replace("force = 1e4", "settlement = 0.1\nover_time = [[0, 0], [1, 1]]") + "[[boundary]]")}),
    ("another case's results in the folder", "run case.toml --out other", {"other/case.toml": CASE.replace("0.1", "0.2"),
                                                                         "other/history.csv": "time\n"}),
    ("finite elements into that folder", "fem case.toml --out other", {}),
    ("finite elements that no memory holds", "fem case.toml --out fine --edge 1e-4", {}),
    ("edges longer than the section", "fem case.toml --out coarse --edge 1e9", {}),
    ("finite elements of soil in motion", "fem moving.toml --out moving", {
        "moving.toml": CASE.replace(WEIGHT, PERMEABLE + '[water]\nmode = "coupled"\nmotion = "dynamic"\nlevel = 3\n')}),
    ("finite elements of seepage over time", "fem seeping.toml --out seeping", {
        "seeping.toml": CASE.replace(WEIGHT, PERMEABLE + TRANSIENT + ON_TOP)}),
    ("finite elements under a footing that is pushed", "fem pushed.toml --out pushed", {}),
    ("a factor of safety without strength", "safety case.toml", {}),
    ("a factor of safety of level ground", "safety level.toml --method limit-equilibrium", {
        "level.toml": CASE.replace("[[boundary]]", 'law = "mohr_coulomb"\ncohesion = 1e3\nfriction_angle = 30\n[[boundary]]')
        + "".join(f'[[boundary]]\nkind = "roller"\nfrom = [{x}, 0]\nto = [{x}, 2]\n' for x in (0, 4))}),
    ("a factor of safety of soil that keeps its water", "safety undrained.toml", {
        "undrained.toml": CASE.replace("[[boundary]]", 'law = "mohr_coulomb"\ncohesion = 1e3\nfriction_angle = 30\n[[boundary]]')
        + '[water]\nlevel = 3\nmode = "undrained"\n'}),
    ("a factor of safety without gravity", "safety case.toml --set loading.gravity_applied=false", {}),
    ("a method that is not there", "safety case.toml --method bishop", {}),
    ("a bracket that is too narrow", "safety case.toml --bracket 0", {}),
    ("a curve over something that is not a number", "safety case.toml --vary soil.sand.poissons_ratio=0.2,much", {}),
    ("a runout of a curve", "safety case.toml --vary soil.sand.poissons_ratio=0.2,0.3 --then-run", {}),
    ("a failure without strength reduction", "safety case.toml --method limit-equilibrium --then-run", {}),
    ("an element test of a soil that is not there", "element case.toml clay", {}),
    ("an element test that there is not", "element case.toml --test triaxial", {}),
    ("an element test to nowhere", "element case.toml --strain 0.1 --strain 0.1", {}),
    ("a stress that a test cannot go to", "element case.toml --stress 2e5", {}),
    ("no such field", "render run --field Stress", {}),
    ("a component is needed", "render run --field EffectiveStress", {}),
    ("logarithmic colours over zero", "render run --field PorePressure --scale logarithmic --range 0,10", {}),
    ("a scale that there is not", "render run --field PorePressure --scale log", {}),
    ("all frames and one more", "render run --field PorePressure --time all --time last", {}),
    ("a drawing whose lines leave a gap", "import gap.wkt", {
        "gap.wkt": "base: LINESTRING (0 0, 8 0, 8 4)\nground: LINESTRING (0 0, 0 4, 7.8 4)\n"}),
    ("a drawing with two names in one region", "import names.csv", {
        "names.csv": 'layer,wkt,text\nline,"LINESTRING (0 0, 8 0, 8 4)",\nline,"LINESTRING (0 0, 0 4, 8 4)",\n'
                     'names,POINT (1 1),clay\nnames,POINT (1 3),sand\n'}),
    ("a drawing with a region that nothing names", "import none.wkt", {
        "none.wkt": "base: LINESTRING (0 0, 8 0, 8 4)\nground: LINESTRING (0 0, 0 4, 8 4)\n"}),
    ("a name where the drawing has no soil", "import none.wkt --name 9,1=sand", {}),
    ("drawn water that falls through the air", "import falls.wkt", {
        "falls.wkt": "sand: POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))\nwater: LINESTRING (0 5, 4 3)\n"}),
    ("drawn water that drives no flow", "import inside.wkt", {
        "inside.wkt": "sand: POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))\nwater: LINESTRING (1 1, 3 1)\n"}),
    ("a section without a line", "section run", {}),
    ("a section beside the soil", "section run --vertical 9", {}),
]
WITH_FILES = [
    ("a file in the place of the folder", "run case.toml --out file", {"file": "mine"}),
    ("a folder that another run is computing into", "run case.toml --out busy", {}),
    ("results of a run are not there", "render nothing --field PorePressure", {}),
    ("a series cut short", "render bad --field PorePressure", {"bad/particles.pvd": "<?xml version=\"1.0\"?>\n<VTKFile"}),
    ("a series of something else", "render bad --field PorePressure", {"bad/particles.pvd": "<VTKFile type=\"ImageData\"/>"}),
    ("a series that leads out of its folder", "render bad --field PorePressure", {
        "bad/particles.pvd": '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="../run/frames/'
                             'particles_000000.vtp"/></Collection></VTKFile>'}),
    ("a frame cut short", "render bad --field PorePressure", {
        "bad/particles.pvd": '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="a.vtp"/></Collection>'
                             '</VTKFile>', "bad/a.vtp": '<VTKFile type="PolyData">'}),
    ("a history with a word in it", "report run2", {"run2/history.csv": "time,A.PorePressure\n0,high\n"}),
    ("a summary cut short", "report run3", {"run3/summary.json": '{"title": "Box", '}),
    ("a damaged checkpoint", "run case.toml --out run4 --resume", {"run4/checkpoint.bin": "rubbish"}),
    ("a history that was changed", "run case.toml --out run5 --resume --set time.end=0.2", {"run5/history.csv": "time,B\n"}),
    ("an end that the run is beyond", "run case.toml --out run2 --resume --set time.end=0.05", {}),
]


def say(place, program, arguments):
    outcome = subprocess.run(f"'{program}' {arguments}", shell=True, cwd=place, capture_output=True, text=True)
    return outcome.returncode, outcome.stderr.strip()


def row(what, how, status, message, expected=(2, 4)):
    if status not in expected or not message:
        sys.exit(f"{what}: exit status {status}, message {message!r}")
    lines = message.replace("|", "\\|").split("\n")
    return f"| {what} | {how} | {status} | {'<br>'.join(f'`{line}`' if '`' not in line else line for line in lines)} |\n"


def table(title, rows):
    return f"\n## {title}\n\n| What is wrong | Example | Exit status | Message |\n|---|---|---|---|\n" + "".join(rows)


def in_a_case(place, program, mistakes, expected=(2, 4)):
    rows = []
    for what, old, new in mistakes:
        if CASE.count(old) != 1:
            sys.exit(f"{what}: {old!r} does not stand once in the case")
        (place / "box.toml").write_text(CASE.replace(old, new))
        how = f"`{old}` becomes `{new}`" if new and "\n" not in old + new and len(old + new) < 50 else ""
        rows.append(row(what, how, *say(place, program, "check box.toml"), expected))
    return rows


def by_command(place, program, mistakes):
    rows = []
    for what, arguments, files in mistakes:
        for name, text in files.items():
            (place / name).parent.mkdir(exist_ok=True)
            (place / name).write_text(text)
        rows.append(row(what, f"`{arguments}`", *say(place, program, arguments)))
    return rows


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    place = pathlib.Path(tempfile.mkdtemp(prefix="porosph_errors_"))
    (place / "case.toml").write_text(CASE)
    for folder in ("run", "run2", "run3", "run4", "run5"):
        subprocess.run([program, "run", "case.toml", "--quiet", "--out", folder], cwd=place, check=True)
    (place / "run4" / "summary.json").unlink()  # as after a kill
    (place / "busy").mkdir()
    busy = os.open(place / "busy", os.O_RDONLY)
    fcntl.flock(busy, fcntl.LOCK_EX)
    page = HEAD + "".join(f"    {line}\n" for line in CASE.splitlines())
    page += table("In the case", in_a_case(place, program, IN_THE_CASE))
    page += table("In the ground", in_a_case(place, program, OF_THE_GROUND))
    page += table("In the flow of water", in_a_case(place, program, IN_THE_FLOW))
    page += table("In an earthquake", in_a_case(place, program, IN_AN_EARTHQUAKE))
    page += table("In a stage", in_a_case(place, program, IN_A_STAGE))
    page += table("Warnings of the case", in_a_case(place, program, WARNED_OF, expected=(0,)))
    page += table("On the command line", by_command(place, program, ON_THE_COMMAND_LINE))
    page += table("With files", by_command(place, program, WITH_FILES))
    shutil.rmtree(place)
    if "--write" in sys.argv:
        DOCUMENT.write_text(page)
    elif DOCUMENT.read_text() != page:
        print(page)
        sys.exit(f"{DOCUMENT} does not say this; update it with --write")


if __name__ == "__main__":
    main()
