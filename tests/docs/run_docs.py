#!/usr/bin/env python3
"""Runs the shell lines of README.md and docs/*.md as a reader would.

Usage: run_docs.py SOURCE_DIR BUILD_DIR            the blocks marked ```sh, with the program of BUILD_DIR
       run_docs.py SOURCE_DIR BUILD_DIR display    as well those that open windows (see tests/paraview)
       run_docs.py SOURCE_DIR --long [DOCUMENT...] all blocks but those, in a fresh clone that builds its own

What stands behind sh says what a block needs:
    ```sh            runs in a few seconds
    ```sh long       builds, or computes for minutes
    ```sh display    opens a window: started on a virtual screen by ./test.sh --paraview
    ```sh machine    starts tests, or computes for the better part of an hour
Each document is one shell: what a block sets, later ones find. At the end the lines that were not run are listed.
Links between the documents are followed as well."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

NOT_RUN = {"display": "./test.sh --paraview runs them", "machine": "./test.sh and ./test.sh --nightly, or by hand"}
KNOWN = {"", "long", *NOT_RUN}
BLOCK = re.compile(r"^```sh *([a-z]*)\n(.*?)^```$", re.M | re.S)
COMMAND_OUTSIDE = re.compile(r"^(?: {4}|\t)(?:\$ |\./|porosph |build/|scripts/|tests/|cmake |pvpython |paraview )", re.M)
LINK = re.compile(r"\]\(([^)#\s]*)#?([^)\s]*)\)")


def documents(source):
    return [source / "README.md"] + sorted((source / "docs").glob("*.md"))


def check(document):
    """Complaints about how shell lines are written down."""
    text = document.read_text()
    problems = [f"unknown mark '{mark}'" for mark, _ in BLOCK.findall(text) if mark not in KNOWN]
    outside = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    problems += [f"a command outside of a ```sh block: {m.group().strip()}"
                 for m in COMMAND_OUTSIDE.finditer(outside)]
    return problems + broken_links(document, outside)


def broken_links(document, text):
    """Files and headings of this project that are linked to and are not there."""
    problems = []
    for path, heading in LINK.findall(text):
        if path.startswith("http"):
            continue
        target = document.parent / path if path else document
        if not target.exists():
            problems.append(f"a link to {path}, which is not there")
        elif heading and heading not in headings(target):
            problems.append(f"a link to the heading #{heading}, which {target.name} does not have")
    return problems


def headings(document):
    """As they are named in links."""
    titles = re.findall(r"^#+ (.*)$", document.read_text(), re.M)
    return [re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles]


def not_run(source):
    """The lines that this script leaves to others, for a reader of its output."""
    lines = []
    for document in documents(source):
        for mark, body in BLOCK.findall(document.read_text()):
            if mark in NOT_RUN:
                lines += [f"  {document.name}, {mark}: {line}" for line in body.strip().splitlines()]
    ways = "; ".join(f"{mark}: {who}" for mark, who in NOT_RUN.items())
    return "\n".join([f"Not run here ({ways}):", *lines])


def ci_lines(source):
    """The shell lines of the workflow for GitLab; GitHub's must have the same."""
    script = (source / "docs/ci/gitlab.yml").read_text().split("  script:\n")[1].split("  artifacts:")[0]
    return re.findall(r"^    - (.*)$", script, re.M)


def check_ci(source):
    github = (source / "docs/ci/github.yml").read_text()
    return [f"github.yml lacks: {line}" for line in ci_lines(source) if line not in github]


def script(document, marks):
    blocks = [body for mark, body in BLOCK.findall(document.read_text()) if mark in marks]
    return "set -eu -o pipefail\n" + "".join(f"set -x\n{body}\n{{ set +x; }} 2> /dev/null\n" for body in blocks), len(blocks)


def run(document, marks, folder, path):
    text, blocks = script(document, marks)
    return blocks == 0 or shell(f"{document.name}: {blocks} blocks", text, folder, path)


def shell(title, text, folder, path):
    """Whether bash ran the text without a failure; prints what it said if not."""
    screen = {name: os.environ[name] for name in ("DISPLAY", "LD_LIBRARY_PATH") if name in os.environ}
    environment = {"PATH": path, "HOME": str(folder), "LANG": "C.UTF-8", **screen}
    done = subprocess.run(["bash", "-c", text], cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(f"{title}, {'passed' if done.returncode == 0 else 'FAILED'}", flush=True)
    if done.returncode != 0:
        print(done.stdout[-6000:])
    return done.returncode == 0


def scratch(source, build, folder):
    """The working tree without its build and results: as after building the preset `release`."""
    for entry in source.iterdir():
        if entry.name not in ("build", "results", "report", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(build)


def main(source, arguments):
    problems = [f"{d.name}: {p}" for d in documents(source) for p in check(d)] + check_ci(source)
    print("\n".join(problems), end="\n" if problems else "")
    passed = not problems
    if arguments[0] == "--long":
        wanted = set(arguments[1:])
        with tempfile.TemporaryDirectory() as name:
            clone = pathlib.Path(name) / "porosph"
            subprocess.run(["git", "clone", "--quiet", str(source), str(clone)], check=True)
            path = f"{clone}/build/release/bin:{os.environ['PATH']}"
            for document in documents(clone):
                if not wanted or document.name in wanted or document.name == "README.md":
                    passed = run(document, {"", "long"}, clone, path) and passed
                    subprocess.run(["git", "clean", "-fdxq", "-e", "build"], cwd=clone, check=True)
            if not wanted:
                lines = "set -eux -o pipefail\n" + "\n".join(ci_lines(clone))
                passed = shell("ci/gitlab.yml", lines, clone, path) and passed
        print(not_run(source))
    else:
        marks = {""} | set(arguments[1:])
        for document in documents(source):
            if len(marks) > 1 and script(document, marks - {""})[1] == 0:
                continue
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                scratch(source, pathlib.Path(arguments[0]).resolve(), folder)
                path = f"{folder}/build/release/bin:{os.environ['PATH']}"
                passed = run(document, marks, folder, path) and passed
    return 0 if passed else 1


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
