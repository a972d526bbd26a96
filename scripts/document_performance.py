#!/usr/bin/env python3
"""Measures speed and puts what was measured into docs/performance.md and docs/images.

Usage: document_performance.py PATH_OF_POROSPH [OPTIONS of porosph bench]"""
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "performance.md"
BEGIN, END = "<!-- measured -->\n", "<!-- end of measured -->\n"


def table(rows):
    """Rows as Markdown, the first as heads."""
    lines = ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0])] + lines[1:]) + "\n"


def section(study_folder, part):
    """A section of the study; its pictures are copied beside the other pictures of the documents."""
    text = f"### {part['heading']}\n\n"
    for t in part["tables"]:
        text += (f"{t['caption']}\n\n" if t["caption"] else "") + table(t["rows"]) + "\n"
    for picture in part["pictures"]:
        name = f"bench_{picture['file']}"
        shutil.copy(study_folder / picture["file"], ROOT / "docs" / "images" / name)
        text += f"![{picture['description']}](images/{name})\n\n"
    return text


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = ROOT / "results" / "bench"
    subprocess.run([sys.argv[1], "bench", "--cases", ROOT / "cases", "--out", folder, *sys.argv[2:]], check=True)
    study = json.loads((folder / "study.json").read_text())
    measured = study["lead"] + "\n\n" + "".join(section(folder, part) for part in study["sections"])
    before, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(before + BEGIN + measured + END + rest.split(END)[1])


main()
