#!/usr/bin/env python3
"""Checks that no file includes what lies above it in the order of docs/architecture.md.

The order is the block of that page that begins with ```order: one layer per line, the lowest last, each a list of folders or
of files without their ending, up to two spaces. The longest name that matches a file is its place; a layer's members may
include themselves and what lies below. Usage: include_order.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

SOURCES = ("app", "render", "vtk_io", "solver")


def read_order(page):
    """Unit -> (layer, name); layer 0 is the lowest."""
    block = re.search(r"^```order\n(.*?)^```", page.read_text(), re.S | re.M)
    if block is None:
        sys.exit(f"{page}: has no block ```order")
    layers = [line.split("  ")[0].split() for line in block.group(1).splitlines() if line.strip()]
    return {name: number for number, layer in enumerate(reversed(layers)) for name in layer}


def unit_of(path, order):
    stem = re.sub(r"\.[ch]pp$", "", path)
    while stem and stem not in order:
        stem = stem.rpartition("/")[0]
    return stem


def main(root):
    order = read_order(root / "docs" / "architecture.md")
    faults, files = [], 0
    for top in SOURCES:
        for file in sorted((root / top).rglob("*.?pp")):
            files += 1
            path = file.relative_to(root).as_posix()
            unit = unit_of(path, order)
            if not unit:
                faults.append(f"{path}: is not in the order of docs/architecture.md")
                continue
            for line, text in enumerate(file.read_text().splitlines(), 1):
                include = re.match(r'#include "((?:%s)/[^"]+)"' % "|".join(SOURCES), text)
                used = include and unit_of(include.group(1), order)
                if used and used != unit and order[used] >= order[unit]:
                    faults.append(f"{path}:{line}: {unit} includes {include.group(1)}, which is not below it")
    for name in order:
        if not (root / name).is_dir() and not list((root / name).parent.glob((root / name).name + ".?pp")):
            faults.append(f"docs/architecture.md: there is no {name}")
    print("\n".join(faults) or f"{files} files include only what is below them")
    return 1 if faults or files == 0 else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
