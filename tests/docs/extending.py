#!/usr/bin/env python3
"""Applies the changes that docs/extending.md shows, all to one copy of the sources, and checks that what they touch compiles.

Usage: extending.py SOURCE_DIR BUILD_DIR, whose compile_commands.json says how files are compiled.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

FOLDERS = ("app", "render", "vtk_io", "solver")
LOOPS = "solver/sph/kernels/consistent_kernels.cpp"  # every law is compiled into them


def command_for(path, commands):
    """How the file is compiled, or for a new one its neighbour."""
    if path in commands:
        return commands[path]
    folder = path.rpartition("/")[0]
    return next(c for other, c in commands.items() if other.rpartition("/")[0] == folder)


def user_of(header, copy):
    """A source file that includes the header."""
    line = f'#include "{header}"'
    return next((s.relative_to(copy).as_posix() for folder in FOLDERS for s in sorted((copy / folder).rglob("*.cpp"))
                 if line in s.read_text()), None)


def main(source, build):
    changes = re.findall(r"^```diff\n(.*?)^```$", (source / "docs" / "extending.md").read_text(), re.S | re.M)
    if len(changes) < 4:
        return f"docs/extending.md shows {len(changes)} changes"
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        if file.is_relative_to(source):
            commands.setdefault(file.relative_to(source).as_posix(), (entry["command"], entry["directory"]))
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        for name in FOLDERS:
            shutil.copytree(source / name, copy / name)
        touched = {LOOPS}
        for change in changes:
            subprocess.run(["git", "apply", "-"], input=change.encode(), cwd=copy, check=True)
            for path in re.findall(r"^\+\+\+ b/(\S+)", change, re.M):
                touched.add(path if path.endswith(".cpp") else user_of(path, copy))
        for path in sorted(touched - {None}):
            command, directory = command_for(path, commands)
            words, kept = iter(shlex.split(command)), []
            for word in words:
                if word in ("-o", "-c", "-MF", "-MT"):
                    next(words)
                elif word not in ("-MD", "-Winvalid-pch") and not word.endswith("ccache"):
                    kept.append(word.replace(f"-I{source}", f"-I{copy}") if word == f"-I{source}" else word)
            done = subprocess.run(kept + ["-fsyntax-only", str(copy / path)], cwd=directory)
            print(path, "compiles" if done.returncode == 0 else "does not compile", flush=True)
            if done.returncode != 0:
                return f"{path} does not compile with the changes of docs/extending.md"
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
