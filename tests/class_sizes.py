#!/usr/bin/env python3
"""Finds classes of solver/ with more than 12 data members, and fails where one is not a record that is allowed more.

Usage: class_sizes.py SOURCE_DIR
"""

import pathlib
import re
import sys

MOST = 12

# Records hold what a table of a case file, summary.json or the fields of the particles hold.
RECORDS = {"Case", "SoilCase", "StrengthCase", "StageCase", "Summary", "Particles"}


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def bodies(text):
    """Yields the name of each class and the text between its braces."""
    for match in re.finditer(r"\b(?:class|struct)\s+(\w+)[^;{()]*\{", text):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += (text[end] == "{") - (text[end] == "}")
            end += 1
        yield match.group(1), text[match.end() : end - 1]


def outermost(body):
    """The body without what stands in braces of its own."""
    kept, depth = [], 0
    for character in body:
        depth -= character == "}"
        kept.append(" " if depth or character in "{}" else character)
        depth += character == "{"
    return "".join(kept)


def members(body):
    """How many data members a class has: names that its declarations end with."""
    count = 0
    for statement in outermost(body).split(";"):
        statement = re.sub(r"\b(public|private|protected)\s*:", "", statement).strip()
        while (shorter := re.sub(r"<[^<>]*>", "", statement)) != statement:
            statement = shorter
        first = statement.split(" ", 1)[0]
        if not statement or "(" in statement or first in {"using", "friend", "static", "template", "enum", "class", "struct"}:
            continue
        count += 1 + statement.count(",")
    return count


def main():
    source = pathlib.Path(sys.argv[1])
    files = sorted((source / "solver").rglob("*.hpp")) + sorted((source / "solver").rglob("*.cpp"))
    classes, faults = 0, []
    for path in files:
        for name, body in bodies(without_comments(path.read_text())):
            classes += 1
            if (count := members(body)) > MOST and name not in RECORDS:
                faults.append(f"{path.relative_to(source)}: {name} has {count} data members, more than {MOST}")
    print("\n".join(faults) or f"{classes} classes have at most {MOST} data members")
    return 1 if faults or classes == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
