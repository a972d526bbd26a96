#!/usr/bin/env python3
"""Reads a run of cases/foundation.toml with porosph.py: example.py RUN

Compares the vertical effective stress at the end with the submerged weight above, and writes the settlement of the highest
probe as a table. As a notebook would, cell by cell."""
import sys

import numpy

import porosph

# %% The run
run = porosph.open_run(sys.argv[1])
case = run.case
print(f"{case['title']}: {len(run)} frames to {run.times[-1]:g} s, {run.summary['status']}")

# %% Effective stress against depth
last = run.frame(-1)
x, y = last.points.T
stress = last["EffectiveStress", "YY"] / 1e3  # kPa
soil = case["soil"][0]
surface = max(corner[1] for corner in soil["polygon"])
submerged = (soil["unit_weight_saturated"] - case["water"]["unit_weight"]) / 1e3  # kN/m3
theory = submerged * (y - surface)
inside = y < surface - 4 * case["particles"]["spacing"]
off = numpy.linalg.norm((stress - theory)[inside]) / numpy.linalg.norm(theory[inside])
print(f"vertical effective stress: {100 * off:.2g} % from the submerged weight above")

# %% Invariants
principal = last.principal("EffectiveStress") / 1e3
print(f"largest shear stress: {numpy.max(principal[:, 0] - principal[:, 2]) / 2:.1f} kPa")

# %% What a probe recorded
name = max(case["probe"], key=lambda probe: probe["position"][1])["name"]
time, settlement = run.history["time"], -1e3 * run.history[name + ".Displacement_Y"]
for t in numpy.linspace(0, time[-1], 5):
    print(f"{name} at {t:.2f} s: {numpy.interp(t, time, settlement):.2f} mm")
