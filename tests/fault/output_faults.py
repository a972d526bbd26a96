#!/usr/bin/env python3
"""Takes the disk, the rights or the folder away from a run: exit 4, one message, earlier files whole, and a
resumed run ends as if nothing had been.

Usage: output_faults.py PROGRAM [PART...]     without PART: all of them. Exit status 77 (skipped) where a part
cannot be tried on this machine; the others are tried all the same.
"""
import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import kill_and_resume as runs

SETTINGS = ["time.end=4", "output.interval=0.2"]
FILE_FAILURE = 4
SKIPPED = 77
NOBODY = 65534


class Skipped(Exception):
    """A part that cannot be tried on this machine."""


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def run(program, case, folder, resume=False, **how):
    arguments = runs.command(program, case, folder, SETTINGS, resume)
    return subprocess.run(arguments, capture_output=True, text=True, **how)


def check_failure(outcome, what):
    check(outcome.returncode == FILE_FAILURE, f"{what}: exit {outcome.returncode}, not 4: {outcome.stderr}")
    lines = [line for line in outcome.stderr.splitlines() if not line.startswith("porosph: warning: ")]
    check(len(lines) == 1 and lines[0].startswith("porosph: cannot write"), f"{what}: says {outcome.stderr!r}")


def check_whole_files(folder, what):
    """What is there is complete: all frames of the series, whole rows, no temporaries."""
    if not folder.exists():
        return
    left = [f.name for f in folder.rglob("*.part")]
    check(not left, f"{what}: left {left}")
    if (folder / "particles.pvd").exists():
        text = (folder / "particles.pvd").read_text()
        check(text.endswith("</VTKFile>\n"), f"{what}: the series is cut")
        for name in re.findall(r'file="([^"]+)"', text):
            check((folder / name).read_bytes().endswith(b"</VTKFile>\n"), f"{what}: {name} is cut")
    if (folder / "history.csv").exists():
        rows = (folder / "history.csv").read_text()
        check(rows.endswith("\n") and len({row.count(",") for row in rows.splitlines()}) == 1,
              f"{what}: the history has a torn row")


def check_resumed(program, case, folder, whole, what):
    outcome = run(program, case, folder, resume=True)
    check(outcome.returncode == 0, f"{what}: the resumed run ends with {outcome.returncode}: {outcome.stderr}")
    different = runs.differences(whole, runs.content(folder))
    check(not different, f"{what}: the resumed run differs in {different}")


def limited_file_size(program, case, place, whole):
    largest = max(f.stat().st_size for f in (place / "whole").rglob("*") if f.is_file())
    for size in (0, 500, 3000, 9000, largest - 1):
        folder, what = place / f"limit_{size}", f"no file above {size} bytes"
        outcome = run(program, case, folder,
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
        check_failure(outcome, what)
        check_whole_files(folder, what)
        if (folder / "case.toml").exists():
            check_resumed(program, case, folder, whole, what)


def full_disk(program, case, place, whole):
    """On a small file system, which only this process sees and which is copied out before it goes."""
    disk, copy = place / "disk", place / "disk_copy"
    script = ('mount -t tmpfs -o size=120k none "$1" || exit 99; disk=$1; copy=$2; shift 2; "$@"; status=$?; '
              'cp -r "$disk/run" "$copy"; exit $status')
    for with_root in (["--mount"], ["--mount", "--map-root-user"]):
        disk.mkdir(exist_ok=True)
        arguments = runs.command(program, case, disk / "run", SETTINGS, False)
        outcome = subprocess.run(["unshare", *with_root, "sh", "-c", script, "sh", str(disk), str(copy), *arguments],
                                 capture_output=True, text=True)
        if outcome.returncode in (1, 99):  # not allowed here
            continue
        check_failure(outcome, "full disk")
        check("No space left" in outcome.stderr, f"full disk: {outcome.stderr}")
        check_whole_files(copy, "full disk")
        check((copy / "particles.pvd").exists(), "full disk: not a frame was kept")
        check_resumed(program, case, copy, whole, "full disk")
        return
    raise Skipped("no file system can be mounted here")


def no_permission(program, case, place, whole):
    folder = place / "locked"
    folder.mkdir()
    folder.chmod(0o555)
    place.chmod(0o755)
    as_nobody = {"user": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
    if as_nobody:
        # root's own folders may be closed to others, with the program in them
        program = pathlib.Path(shutil.copy(program, place / "porosph"))
        program.chmod(0o755)
        try:
            subprocess.run([program, "--version"], check=True, capture_output=True, cwd="/", **as_nobody)
        except (OSError, subprocess.CalledProcessError) as error:
            raise Skipped(f"another user cannot start the program: {error}")
    check_failure(run(program, case, folder / "run", **as_nobody), "a folder without permission")
    check(not any(folder.iterdir()), "a folder without permission: something was written")


def names_taken(program, case, place, whole):
    (place / "file").write_text("mine")
    check_failure(run(program, case, place / "file"), "a file in the place of the folder")
    check_failure(run(program, case, place / "file" / "run"), "a file above the folder")
    check((place / "file").read_text() == "mine", "a file in the place of the folder: it was changed")
    (place / "taken").mkdir()
    (place / "taken" / "frames").write_text("mine")
    check_failure(run(program, case, place / "taken"), "a file in the place of the frames")
    check((place / "taken" / "frames").read_text() == "mine", "a file in the place of the frames: it was changed")


def vanished_folder(program, case, place, whole):
    for frames in ([], ["--no-frames"]):
        folder = place / "vanishing"
        arguments = runs.command(program, case, folder, SETTINGS + ["time.end=1e4", "output.interval=1"], False)
        process = subprocess.Popen(arguments + frames, stderr=subprocess.PIPE, text=True)
        while not (folder / "checkpoint.bin").exists():
            check(process.poll() is None, "vanished folder: the run ended too early")
            time.sleep(0.01)
        folder.rename(place / "gone")
        shutil.rmtree(place / "gone")
        _, errors = process.communicate()
        check_failure(subprocess.CompletedProcess(arguments, process.returncode, "", errors), "a vanished folder")
        check(not folder.exists(), "a vanished folder: it was made again")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("part", nargs="*", choices=[[], *PARTS])
    options = parser.parse_args()
    program = pathlib.Path(options.program).resolve()
    place = pathlib.Path(tempfile.mkdtemp(prefix="porosph_output_"))
    case = place / "case.toml"
    case.write_text(runs.CASE)
    outcome = run(program, case, place / "whole")
    check(outcome.returncode == 0, outcome.stderr)
    whole = runs.content(place / "whole")
    skipped = False
    for part in options.part or PARTS:
        try:
            PARTS[part](program, case, place, whole)
        except Skipped as reason:
            print(f"skipped: {part}: {reason}")
            skipped = True
    shutil.rmtree(place)
    return SKIPPED if skipped else 0


PARTS = {f.__name__: f for f in (limited_file_size, full_disk, no_permission, names_taken, vanished_folder)}

if __name__ == "__main__":
    sys.exit(main())
