#!/usr/bin/env python3
"""Reads runs by python/porosph.py, and runs python/example.py: read_run.py PATH_OF_POROSPH. Exit status 77 (skipped) where VTK's
Python modules are missing."""
import os
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "python"))
try:
    import numpy
    import porosph
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(77)


def require(truth, what):
    if not truth:
        raise AssertionError(what)
    print("  " + what)


def check_run(run, summary_tolerance):
    require(len(run) == 3 and run.times[0] == 0 and abs(run.times[-1] - 0.1) < 0.01, "three frames with their times")
    first, last = run.frame(0), run.frame(time=1)
    require(last.time == run.times[-1] and len(first) == len(last) > 100, "the same particles in all frames")
    require(last.fields["EffectiveStress"] == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"], "components by their names")
    require(numpy.all(first["Displacement"] == 0) and numpy.any(last["Displacement", "Y"] < 0), "they have moved downwards")
    moved = first.points + last["Displacement"][:, :2]
    require(numpy.allclose(moved, last.points, atol=summary_tolerance), "points are where the displacements say")
    total, effective, pressure = last["TotalStress", "YY"], last["EffectiveStress", "YY"], last["PorePressure"]
    require(numpy.allclose(total, effective + pressure, rtol=1e-6), "total stress is effective stress and pore pressure")
    principal = last.principal("EffectiveStress")
    require(numpy.allclose(principal.sum(1), last["EffectiveStress"][:, :3].sum(1), rtol=1e-6) and
            numpy.all(principal[:, 0] >= principal[:, 2]), "principal stresses")
    history, probes = run.history, run.summary["probes"]
    require(history["time"][-1] == run.summary["time"], "the history ends with the run")
    for name, probe in probes.items():
        require(numpy.isclose(history[f"{name}.EffectiveStress_YY"][-1], probe["values"]["EffectiveStress_YY"]), f"history of {name}")
    for wrong in ("Stress", ("EffectiveStress", "AB")):
        try:
            last[wrong]
        except KeyError:
            continue
        raise AssertionError(f"{wrong} is not an error")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        case = SOURCE / "cases/foundation.toml"
        settings = ["--set", "particles.spacing=0.5", "--set", "output.interval=0.05", "--set", "time.end=0.1", "--quiet"]
        subprocess.run([program, "run", case, *settings, "--out", "usual"], check=True)
        check_run(porosph.open_run("usual"), 1e-12)
        subprocess.run([program, "run", case, *settings, "--set", "output.format=vtu", "--set", "output.boundary=true", "--out",
                        "grid"], check=True)
        check_run(porosph.open_run("grid/particles.pvd"), 1e-12)
        subprocess.run([program, "grid", "usual", "--spacing", "0.25", "--field", "VonMisesStress"], check=True,
                       stdout=subprocess.DEVNULL)
        grid = porosph.read_grid("usual/grid.vti")
        stress = grid.rows(grid["EffectiveStress", "YY"])
        require(stress.shape == (len(grid.y), len(grid.x)) and grid.x[1] - grid.x[0] == 0.25, "a grid of rows and columns")
        require(numpy.array_equal(numpy.isnan(stress), grid.rows(grid["InSoil"]) == 0), "it has values in the soil")
        row = numpy.nanmean(stress[3])
        last = porosph.open_run("usual").frame(-1)
        nearest = numpy.argmin(numpy.abs(last.points[:, 1] - grid.y[3]))
        require(numpy.ptp(stress[3]) < 1e-3 * abs(row) and abs(row - last["EffectiveStress", "YY"][nearest]) <
                0.1 * abs(row), "rows of one stress, that of the particles beside them")
        require(numpy.nanmin(grid["VonMisesStress"]) >= 0, "a field computed on the grid")
        told = subprocess.run([sys.executable, SOURCE / "python/example.py", "usual"], check=True, text=True,
                              stdout=subprocess.PIPE).stdout
        require("vertical effective stress" in told and "mm" in told, "the example runs")


main()
