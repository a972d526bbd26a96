#!/usr/bin/env python3
"""Gives `porosph check` cases with random mistakes: each is computed or refused, at once and with a message.

Usage: mutated_cases.py PROGRAM CASE... [--count N] [--seed N]

Every verdict must be exit 0, or exit 2 with a message that names the file or says what cannot be; within
--seconds of its process (a slower one is tried again alone, so that a busy machine decides nothing).
"""
import argparse
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

NUMBERS = ["0", "-1", "1e-9", "1e9", "1e300", "-1e300", "nan", "inf", "0.5", "3", "true", '"text"', "[]", "[1, 2]",
           "9223372036854775807", "1e-300", "[[0, 0], [1, 0], [1, 1]]", "{}", "1979-05-27"]
PIECES = ["[", "]", "{", "}", '"', "=", ",", "\n", "#", ".", "-", "e", "0", "\0", "\udcff", "[[soil]]\n", "[time]\n",
          "holes = [[[1, 1], [2, 1], [2, 2]]]\n", "\u221e", "'''"]
REPORTS = ("ERROR: AddressSanitizer", "runtime error:", "terminate called")


def mutate(text, chance):
    """One to three mistakes, most of which still look like a case."""
    for _ in range(chance.choice([1, 1, 2, 3])):
        kind = chance.randrange(8)
        lines = text.split("\n")
        line = chance.randrange(len(lines))
        numbers = list(re.finditer(r"-?\d+\.?\d*(e-?\d+)?", text))
        if kind == 0 and numbers:  # another number, or none
            at = chance.choice(numbers)
            text = text[:at.start()] + chance.choice(NUMBERS) + text[at.end():]
        elif kind == 1 and numbers:  # the same number, scaled
            at = chance.choice(numbers)
            scaled = float(at.group()) * 10 ** chance.uniform(-3, 3) * chance.choice([1, 1, -1])
            text = text[:at.start()] + repr(scaled) + text[at.end():]
        elif kind == 2:  # a line lost
            text = "\n".join(lines[:line] + lines[line + 1:])
        elif kind == 3:  # a line twice, or in another place
            other = chance.randrange(len(lines))
            text = "\n".join(lines[:other] + [lines[line]] + lines[other:])
        elif kind == 4:  # a slip of the finger
            at = chance.randrange(len(text))
            text = text[:at] + chance.choice(PIECES) + text[at + chance.randrange(3):]
        elif kind == 5:  # letters exchanged
            at = chance.randrange(len(text) - 1)
            text = text[:at] + text[at + 1] + text[at] + text[at + 2:]
        elif kind == 6:  # cut short
            if chance.random() < 0.2:
                text = text[:chance.randrange(len(text))]
        else:  # two blocks exchanged
            blocks = text.split("\n\n")
            a, b = chance.randrange(len(blocks)), chance.randrange(len(blocks))
            blocks[a], blocks[b] = blocks[b], blocks[a]
            text = "\n\n".join(blocks)
        if not text.strip():
            text = "\n"
    return text


def seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def verdict(program, file, limit):
    """Exit status, fault (empty if none)."""
    before = seconds_of_children()
    try:
        outcome = subprocess.run([program, "check", str(file)], capture_output=True, timeout=60 * limit)
    except subprocess.TimeoutExpired:
        return None, "no verdict at all"
    seconds = seconds_of_children() - before
    errors = outcome.stderr.decode(errors="replace")
    fault = ""
    if outcome.returncode not in (0, 2):
        fault = f"exit status {outcome.returncode}"
    elif any(report in errors for report in REPORTS):
        fault = "a sanitizer's report"
    elif outcome.returncode == 2 and not (errors.startswith(str(file)) or errors.startswith("porosph: ")):
        fault = "no message"
    elif seconds > limit:
        fault = f"{seconds:.1f} s of computing"
    return outcome.returncode, fault and f"{fault}: {errors[:2000]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("cases", nargs="+", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=2, help="of computing that a verdict may take")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    texts = [case.read_text() for case in options.cases]
    place = pathlib.Path(tempfile.mkdtemp(prefix="porosph_mutated_"))
    valid, refused, faults = 0, 0, []
    for number in range(options.count):
        file = place / f"case_{number}.toml"
        file.write_bytes(mutate(texts[number % len(texts)], chance).encode(errors="surrogateescape"))
        status, fault = verdict(options.program, file, options.seconds)
        if fault and "of computing" in fault:
            status, fault = verdict(options.program, file, options.seconds)
        if fault:
            faults.append(f"{file}: {fault}")
            continue
        valid, refused = valid + (status == 0), refused + (status == 2)
        file.unlink()
    print(f"{options.count} mutated cases: {valid} valid, {refused} refused, {len(faults)} faults")
    for fault in faults:
        print("FAILED:", fault)
    if faults:
        sys.exit(1)
    shutil.rmtree(place)


if __name__ == "__main__":
    main()
