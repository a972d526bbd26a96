#!/usr/bin/env python3
"""Runs the examples of every command's --help, with coarser copies of the cases: help_examples.py PATH_OF_POROSPH SOURCE_DIR

The program is copied into a folder with cases of its own, in which `foundation` has a hundred particles."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# What an example takes for granted.
FOUNDATION = ["porosph run foundation --quiet"]
PREPARED = {
    "render": FOUNDATION, "section": FOUNDATION, "history": FOUNDATION, "grid": FOUNDATION,
    "profile": ["porosph run collapse/square --quiet --set time.end=0.05 --out results/column_collapse",
                "cp -r results/column_collapse results/coarse; cp -r results/column_collapse results/fine"],
    "compare": [f"porosph run foundation --quiet --set formulation.motion={form} --out results/{form}"
                for form in ("conventional", "proposed")] +
               ["porosph run embankment --quiet --out results/a", "porosph fem embankment --out results/embankment_fem",
                "porosph run embankment --quiet --set formulation.motion=proposed --out results/b"],
    "report": FOUNDATION + ["cp -r results/foundation results/a; cp -r results/foundation results/b",
                            "porosph import cases/drawings/levee.dxf --skip frame --spacing 2 --out levee.toml",
                            "porosph run levee.toml --quiet --set time.end=0.1",
                            "porosph safety levee.toml --quiet --bracket 1"],
}
# Measurements that take minutes are made with a few particles.
SHORTER = {"bench": "--quick --particles 200"}
# The other status that an example may end with: its threshold is for the case as it is shipped.
STATUS = {"report": 1}


def coarser(text):
    """The case with a spacing two and a half times as large, and a fifth of the time."""
    text = re.sub(r"^spacing = ([0-9.]+)", lambda m: f"spacing = {2.5 * float(m[1]):g}", text, flags=re.M)
    return re.sub(r"^end = ([0-9.]+)", lambda m: f"end = {0.2 * float(m[1]):g}", text, flags=re.M)


def install(program, source, folder):
    """bin, libexec and share as they are installed."""
    (folder / "bin").mkdir()
    shutil.copy(program, folder / "bin/porosph")
    reader = program.parent.parent / "libexec"
    if reader.exists():
        shutil.copytree(reader, folder / "libexec")
    cases = folder / "share/porosph/cases"
    shutil.copytree(source / "cases", cases)
    for name in ("foundation.toml", "embankment.toml", "safety/griffiths_lane_1.toml"):
        (cases / name).write_text(coarser((cases / name).read_text()))


def shell(line, folder, home):
    environment = {**os.environ, "PATH": f"{home / 'bin'}:{os.environ['PATH']}", "HOME": str(folder), "LANG": "C.UTF-8"}
    return subprocess.run(["bash", "-c", line], cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def examples_of(command, home):
    text = shell(f"porosph {command} --help", home, home).stdout
    lines = text.split("Examples:\n")[1].replace("\\\n", " ") if "Examples:\n" in text else ""
    return [line.strip() for line in lines.splitlines() if line.strip()]


def check(command, home):
    """What is wrong with the examples of a command."""
    examples = examples_of(command, home)
    if not examples:
        return [f"{command}: --help shows no example"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "cases").symlink_to(home / "share/porosph/cases")
        for line in PREPARED.get(command, []):
            done = shell(line, folder, home)
            if done.returncode != 0:
                return [f"{command}: {line}: {done.stdout[-1500:]}"]
        problems = []
        for line in examples:
            if not shutil.which("man"):
                line = line.replace("man -l -", "cat")
            more = [o for o in re.split(" (?=--)", SHORTER.get(command, "")) if o not in line]
            done = shell(" ".join([line, *more]), folder, home)
            if done.returncode not in (0, STATUS.get(command, 0)):
                problems.append(f"{line}: status {done.returncode}: {done.stdout[-1500:]}")
        print(f"{command}: {len(examples)} examples", flush=True)
        return problems


def main():
    program, source = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as name:
        home = pathlib.Path(name)
        install(program, source, home)
        overview = shell("porosph --help", home, home).stdout
        commands = re.findall(r"^  ([a-z]+) +\S", overview.split("SUBCOMMAND ...")[1].split("porosph SUBCOMMAND --help")[0], re.M)
        wanted = sys.argv[3:] or commands
        problems = [problem for command in wanted for problem in check(command, home)]
    print("\n".join(problems))
    return 1 if problems or len(commands) < 14 else 0


sys.exit(main())
