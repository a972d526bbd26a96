#!/usr/bin/env python3
"""Kills runs at random moments, resumes them, and compares what comes out with a run that was left alone.

Usage: kill_and_resume.py PROGRAM [--kills N] [--seed N]

Every frame, the series, the history and all physical numbers of the summary must agree bit for bit.
"""
import argparse
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CASE = """
title = "Killed and resumed"
[particles]
spacing = 0.25
[[soil]]
name = "sand"
polygon = [[0, 0], [4, 0], [4, 2], [0, 2]]
youngs_modulus = 3e5
poissons_ratio = 0.33
unit_weight_saturated = 20e3
unit_weight_unsaturated = 18e3
[[soil]]
name = "fill"
polygon = [[0, 2], [3, 2], [1.5, 3.5], [0, 3.5]]
youngs_modulus = 2e5
poissons_ratio = 0.25
unit_weight_saturated = 19e3
unit_weight_unsaturated = 17e3
no_tension = true
[water]
level = 2.5
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 4]
[[boundary]]
kind = "roller"
from = [4, 0]
to = [4, 4]
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [4, 0]
[loading]
damping = 0.004
[time]
end = 12
courant = 0.3
[output]
interval = 0.9
[[probe]]
name = "A"
position = [1, 1]
"""

# Soil that fails and comes to rest, on a fixed base; and softening soil and clay that slide on walls with friction.
COLLAPSE = """
title = "Killed while it flows"
[particles]
spacing = 0.005
arrangement = "lattice"
[[soil]]
name = "bars"
polygon = [[0, 0], [0.1, 0], [0.1, 0.06], [0, 0.06]]
youngs_modulus = 0.84e6
poissons_ratio = 0.3
unit_weight_saturated = 20.4e3
law = "drucker_prager"
cohesion = 0
friction_angle = 19.8
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [0.5, 0]
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 0.1]
[time]
end = 0.3
courant = 0.6
[output]
interval = 0.03
fields = ["Velocity", "EffectiveStress", "Density", "PlasticStrain", "Opening", "Yielding"]
"""
SLIDE = """
title = "Killed while it slides"
[particles]
spacing = 0.25
[[soil]]
name = "loam"
polygon = [[0, 0], [6, -2], [6, -0.5], [0, 1.5]]
youngs_modulus = 5e6
poissons_ratio = 0.3
unit_weight_saturated = 19e3
law = "mohr_coulomb"
cohesion = 4e3
friction_angle = 20
tensile_strength = 1e3
softening = "linear"
softening_strain = 0.2
softening_length = 0.5
residual_cohesion = 1e3
[[soil]]
name = "clay"
polygon = [[6, -2], [9, -3], [9, -1.5], [6, -0.5]]
youngs_modulus = 20e6
poissons_ratio = 0.3
unit_weight_saturated = 18e3
law = "modified_cam_clay"
critical_state_ratio = 1
lambda = 0.2
kappa = 0.04
void_ratio = 1
preconsolidation_pressure = 60e3
attraction = 4e3
[[boundary]]
kind = "friction"
coefficient = 0.25
from = [0, 0]
to = [15, -5]
[time]
end = 1
courant = 0.4
[output]
interval = 0.1
fields = ["Velocity", "EffectiveStress", "Density", "PlasticStrain", "VoidRatio", "Preconsolidation"]
"""

# "renewed" has a reference that is renewed many times and ends in equilibrium, "breakdown" ends unstable.
VARIANTS = {
    "consistent": [],
    "proposed": ["formulation.motion=proposed", "time.end=6"],
    "conventional": ["formulation.motion=conventional", "time.end=6", "formulation.artificial_stress=0.3",
                     "stop.on_separation=false"],
    "adaptive": ["loading.damping=adaptive", "time.courant=0.1"],
    "tide": [],
    "disordered": ["particles.arrangement=disordered", "particles.disorder=0.1"],
    "breakdown": ["formulation.motion=conventional", "time.courant=0.015", "loading.damping=0", "output.interval=0.1"],
    "renewed": ["formulation.refresh_strain=0.002", "stop.unbalanced_force_ratio=0.02", "loading.damping=0.02"],
    "collapse": [],
    "slide": [],
}
TEXTS = {"tide": CASE.replace("level = 2.5", "level_over_time = [[0, 2.5], [4, 3.5], [9, 1]]"),
         "collapse": COLLAPSE, "slide": SLIDE}
# Whether a comparison with finite elements is worth its time depends on how long the run took.
TIMES_AND_MEMORY = ("wall_seconds", "stepping_seconds", "particle_steps_per_second", "peak_memory_bytes",
                    "finite_elements")
DONE, UNSTABLE, INTERRUPTED = 0, 3, 130


def command(program, case, folder, settings, resume):
    arguments = [program, "run", case, "--out", folder, "--quiet", "--threads", "1", "--checkpoint-every", "0.02"]
    for setting in settings:
        arguments += ["--set", setting]
    return [str(a) for a in arguments + (["--resume"] if resume else [])]


def end_of(name):
    return UNSTABLE if name == "breakdown" else DONE


def content(folder):
    """What must agree: name -> bytes or numbers."""
    found = {f.name: f.read_bytes() for f in sorted((folder / "frames").iterdir())}
    for name in ("history.csv", "particles.pvd", "case.toml"):
        found[name] = (folder / name).read_bytes()
    summary = json.loads((folder / "summary.json").read_text())
    found["summary.json"] = {k: v for k, v in summary.items() if k not in TIMES_AND_MEMORY}
    return found


def differences(a, b):
    return [name for name in sorted(a.keys() | b.keys()) if a.get(name) != b.get(name)]


def run_and_stop(arguments, delay, how):
    """Starts a run and stops it after `delay` seconds. Returns its exit status."""
    process = subprocess.Popen(arguments, stderr=subprocess.DEVNULL)
    try:
        return process.wait(timeout=delay)
    except subprocess.TimeoutExpired:
        process.send_signal(how)
        return process.wait()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    place = pathlib.Path(tempfile.mkdtemp(prefix="porosph_fault_"))

    def command_of(name, folder, resume):
        return command(options.program, place / f"{name}.toml", folder, VARIANTS[name], resume)

    whole, seconds = {}, {}
    for name in VARIANTS:
        (place / f"{name}.toml").write_text(TEXTS.get(name, CASE))
        start = time.monotonic()
        status = subprocess.run(command_of(name, place / name, False), stderr=subprocess.DEVNULL).returncode
        if status != end_of(name):
            sys.exit(f"{name}: exit status {status}")
        seconds[name] = time.monotonic() - start
        whole[name] = content(place / name)

    kills, from_checkpoint, failures = 0, 0, []
    round_number = 0
    while kills < options.kills:
        round_number += 1
        name = list(VARIANTS)[round_number % len(VARIANTS)]
        folder, resume = place / f"killed_{round_number}", False
        status = None
        while status != end_of(name):
            last = kills >= options.kills or (resume and chance.random() < 0.4)
            how = signal.SIGTERM if chance.random() < 0.2 else signal.SIGKILL
            delay = 600 if last else chance.uniform(0, seconds[name])
            status = run_and_stop(command_of(name, folder, resume), delay, how)
            if status in (-signal.SIGKILL, -signal.SIGTERM, INTERRUPTED):
                kills += 1
                from_checkpoint += (folder / "checkpoint.bin").exists()
            elif status != end_of(name):
                sys.exit(f"round {round_number} ({name}): exit status {status}")
            resume = True
        different = differences(whole[name], content(folder))
        if different:
            failures.append(f"round {round_number} ({name}): differs in {', '.join(different)}")
        elif (folder / "checkpoint.previous.bin").exists():
            failures.append(f"round {round_number} ({name}): the finished run left an old checkpoint")
        if not different:
            shutil.rmtree(folder)

    print(f"{kills} kills in {round_number} runs, {from_checkpoint} with a checkpoint to continue from")
    if from_checkpoint == 0:
        failures.append("no run was killed late enough to have a checkpoint")
    for failure in failures:
        print("FAILED:", failure)
    if failures:
        sys.exit(f"see {place}")
    shutil.rmtree(place)


if __name__ == "__main__":
    main()
