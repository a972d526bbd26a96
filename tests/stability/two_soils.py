#!/usr/bin/env python3
"""Random scenes of two elastic soils, each held against finite elements: a map of where the answer is right.

Usage: two_soils.py PROGRAM [--count N] [--seed S] [--only INDEX] [--out FOLDER] [--most-off N]

Shape, stiffness contrast (1 to 10^4), walls, holes, spacing, arrangement and water are drawn from the seed, scene by
scene: scene 7 of seed 1 is the same in every set. Writes map.csv and summary.txt into FOLDER, and keeps the cases there.

Ends with status 1 if a run that says "equilibrium" is off finite elements without a warning that names soil, place and
cause: by what the run says itself, or by `porosph fem` on a finer mesh at probes that the run knows nothing of. Also if
more than --most-off runs are off at all.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

TOLERABLE = 0.05  # of relative difference, besides the strain
AT_PROBES = 0.10  # of the largest value in the soil: single places carry more error than the norm over all


def inside(polygon, x, y):
    odd = False
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            odd = not odd
    return odd


def distance(polygon, x, y):
    least = math.inf
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        dx, dy = x1 - x0, y1 - y0
        s = max(0, min(1, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy)))
        least = min(least, math.hypot(x - x0 - s * dx, y - y0 - s * dy))
    return least


def area(polygon):
    return abs(sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]))) / 2


class Scene:
    """One case, drawn from its number."""

    def __init__(self, seed, index):
        r = self.random = random.Random(seed * 1000003 + index)
        self.shape = r.choice(["layers", "inclined", "embankment", "inclusion", "beside", "step", "thin"])
        length, height = round(r.uniform(6, 16), 1), round(r.uniform(4, 8), 1)
        self.polygons, self.top = getattr(self, self.shape)(length, height)
        self.holes = [[], []]
        self.contrast = 10 ** r.uniform(0, 4)
        self.arrangement = r.choice(["lattice", "fitted", "surface", "disordered"])
        self.spacing = math.sqrt(sum(map(area, self.polygons)) / r.uniform(500, 2000))
        if self.arrangement in ("lattice", "surface") and r.random() < 0.5:  # often the spacing fits the height
            self.spacing = self.top / round(self.top / self.spacing)
        self.spacing = float(f"{self.spacing:.6g}")
        self.hole_kind = "none"
        if self.shape in ("layers", "step") and r.random() < 0.4:
            self.add_hole(length)
        self.sides = r.choice(["roller", "roller", "fixed", "free"])
        self.base = "fixed" if self.sides == "free" else r.choice(["fixed", "roller"])
        self.water = r.choice(["none", "inside", "above"])
        self.length = length
        self.soils = self.materials()
        self.probes = [p for p in (self.place(k) for k in (0, 1, 0, 1)) if p]

    # Outlines of the lower and the upper soil, and the free surface's highest y.
    def layers(self, a, h):
        y = round(h * self.random.uniform(0.25, 0.75), 2)
        return [[(0, 0), (a, 0), (a, y), (0, y)], [(0, y), (a, y), (a, h), (0, h)]], h

    def thin(self, a, h):
        y = round(h * self.random.uniform(0.3, 0.6), 2)
        t = round(h * self.random.uniform(0.06, 0.2), 2)
        return [[(0, y), (a, y), (a, round(y + t, 2)), (0, round(y + t, 2))],
                [(0, 0), (a, 0), (a, y), (0, y)]], round(y + t, 2)

    def inclined(self, a, h):
        y = h * self.random.uniform(0.35, 0.6)
        d = h * self.random.uniform(0.05, 0.25) * self.random.choice([-1, 1])
        left, right = round(y - d, 2), round(y + d, 2)
        return [[(0, 0), (a, 0), (a, right), (0, left)], [(0, left), (a, right), (a, h), (0, h)]], h

    def embankment(self, a, h):
        y = round(h * self.random.uniform(0.35, 0.6), 2)
        slope = self.random.uniform(1, 2.5)
        foot = round(a * self.random.uniform(0.1, 0.2), 2)
        run = round(min(slope * (h - y), 0.3 * a), 2)
        return [[(0, 0), (a, 0), (a, y), (0, y)],
                [(foot, y), (a - foot, y), (a - foot - run, h), (foot + run, h)]], h

    def inclusion(self, a, h):
        x, y = a * self.random.uniform(0.25, 0.45), h * self.random.uniform(0.25, 0.4)
        w, t = a * self.random.uniform(0.15, 0.3), h * self.random.uniform(0.2, 0.35)
        block = [(round(x, 2), round(y, 2)), (round(x + w, 2), round(y, 2)),
                 (round(x + w, 2), round(y + t, 2)), (round(x, 2), round(y + t, 2))]
        self.block = block
        return [[(0, 0), (a, 0), (a, h), (0, h)], block], h

    def beside(self, a, h):
        x = round(a * self.random.uniform(0.3, 0.7), 2)
        return [[(0, 0), (x, 0), (x, h), (0, h)], [(x, 0), (a, 0), (a, h), (x, h)]], h

    def step(self, a, h):
        x, y = round(a * self.random.uniform(0.35, 0.65), 2), round(h * self.random.uniform(0.3, 0.6), 2)
        return [[(0, 0), (a, 0), (a, y), (0, y)], [(x, y), (a, y), (a, h), (x, h)]], h

    def add_hole(self, length):
        (x0, y0), (x1, _), (_, y1), _ = self.polygons[1]
        size = 0.35 * min(x1 - x0, y1 - y0)
        if size < 3 * self.spacing:
            return
        x = x0 + (x1 - x0) * self.random.uniform(0.35, 0.65)
        y = (y0 + y1) / 2
        half = size / 2
        corners = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
        self.holes[1] = [[(round(u, 2), round(v, 2)) for u, v in corners]]
        self.hole_kind = self.random.choice(["free", "fixed"])

    def materials(self):
        r = self.random
        soft = 20e3 * self.top / 10 ** r.uniform(-3.3, -2)  # strains under the weight above: 0.05 to 1 %
        moduli = [soft, soft * self.contrast]
        if r.random() < 0.5:
            moduli.reverse()
        weights = [round(r.uniform(18e3, 22e3)) for _ in moduli]
        return [dict(E=e, nu=round(r.uniform(0.1, 0.4), 3), saturated=w, unsaturated=w - round(r.uniform(0, 2e3)))
                for e, w in zip(moduli, weights)]

    def place(self, k):
        """A point well inside soil k, or None."""
        outlines = [self.polygons[k]] + self.holes[k] + ([self.block] if self.shape == "inclusion" and k == 0 else [])
        xs, ys = zip(*outlines[0])
        for _ in range(200):
            x, y = self.random.uniform(min(xs), max(xs)), self.random.uniform(min(ys), max(ys))
            if (inside(outlines[0], x, y) and not any(inside(o, x, y) for o in outlines[1:])
                    and all(distance(o, x, y) > 3 * self.spacing for o in outlines)):
                return (k, round(x, 3), round(y, 3))
        return None

    def boundaries(self):
        a, h = self.length, self.top
        lines = [(self.base, (0, 0), (a, 0))]
        if self.sides != "free":
            lines += [(self.sides, (0, 0), (0, h)), (self.sides, (a, 0), (a, h))]
            if self.shape == "step":
                lines[1] = (self.sides, (0, 0), (0, self.polygons[0][3][1]))
            if self.shape == "embankment":
                y = self.polygons[0][3][1]
                lines[1:] = [(self.sides, (0, 0), (0, y)), (self.sides, (a, 0), (a, y))]
        if self.hole_kind == "fixed":
            hole = self.holes[1][0]
            lines += [("fixed", p, q) for p, q in zip(hole, hole[1:] + hole[:1])]
        return lines

    def text(self):
        def points(outline):
            return "[" + ", ".join(f"[{x!r}, {y!r}]" for x, y in outline) + "]"
        wave = min(math.sqrt(s["E"] / (s["saturated"] / 9.81)) for s in self.soils)
        t = [f'title = "{self.shape}"', "[particles]", f"spacing = {self.spacing}", f'arrangement = "{self.arrangement}"']
        if self.arrangement == "disordered":
            t += ["disorder = 0.1"]
        if self.arrangement == "surface":
            t += ["smoothing_ratio = 1.0"]
        for k, s in enumerate(self.soils):
            t += ["[[soil]]", f'name = "{"AB"[k]}"', f"polygon = {points(self.polygons[k])}"]
            holes = self.holes[k] + ([self.block] if self.shape == "inclusion" and k == 0 else [])
            if holes:
                t += [f"holes = [{', '.join(map(points, holes))}]"]
            t += [f"youngs_modulus = {s['E']:.6g}", f"poissons_ratio = {s['nu']}",
                  f"unit_weight_saturated = {s['saturated']}", f"unit_weight_unsaturated = {s['unsaturated']}"]
        if self.water != "none":
            level = self.top * (0.6 if self.water == "inside" else 1.3)
            t += ["[water]", f"level = {level:.4g}"]
        for kind, p, q in self.boundaries():
            t += ["[[boundary]]", f'kind = "{kind}"', f"from = [{p[0]!r}, {p[1]!r}]", f"to = [{q[0]!r}, {q[1]!r}]"]
        t += ["[loading]", 'damping = "adaptive"', "[time]", f"end = {60 * max(self.length, self.top) / wave:.4g}",
              "courant = 0.7", "[stop]", "unbalanced_force_ratio = 1e-5", "[check]", "finite_elements = true"]
        for i, (k, x, y) in enumerate(self.probes):
            t += ["[[probe]]", f'name = "p{i}{"AB"[k]}"', f"position = [{x}, {y}]"]
        return "\n".join(t) + "\n"


def run(program, *arguments, seconds=300):
    try:
        return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None


def at_probes(program, case, folder, summary):
    """Largest difference from finer finite elements at the probes, over the largest value of its soil's probes."""
    done = run(program, "fem", case, "--out", folder / "fem", "--force")
    if done is None or done.returncode != 0:
        return math.nan, ""
    rows = {row["probe"]: row for row in csv.DictReader((folder / "fem" / "probes.csv").open())}
    worst, which = 0.0, ""
    for kind in ("EffectiveStress", "Displacement"):
        for soil in "AB":
            names = [n for n in rows if n.endswith(soil)]
            keys = [q for q in next(iter(rows.values())) if q.startswith(kind)] if rows else []
            scale = max((abs(float(rows[n][q])) for n in names for q in keys), default=0)
            for n in names:
                for q in keys:
                    value = summary["probes"][n]["values"][q]
                    off = abs(value - float(rows[n][q])) / scale if value is not None and scale > 0 else math.inf
                    if off > worst:
                        worst, which = off, f"{n}.{q}"
    return worst, which


def worst_field(check):
    found = (0.0, "")
    for soil, entry in check.get("soils", {}).items():
        for field, d in entry["fields"].items():
            value = math.inf if d["relative"] is None else d["relative"]
            found = max(found, (value, f"{soil}.{field}"))
    return found


def names_a_cause(warnings):
    return any("of soil '" in w and "most at (" in w and "cause is not known" not in w for w in warnings)


def compute(program, scene, folder):
    case = folder / "case.toml"
    case.write_text(scene.text())
    row = dict(shape=scene.shape, arrangement=scene.arrangement, spacing=scene.spacing, contrast=f"{scene.contrast:.3g}",
               base=scene.base, sides=scene.sides, hole=scene.hole_kind, water=scene.water)
    done = run(program, "run", case, "--out", folder / "run", "--force", "--no-frames", "--quiet", "--threads", 1)
    if done is None:
        return row | dict(outcome="timeout")
    said = [line for line in done.stderr.splitlines() if line.strip()]
    row["said"] = " | ".join(said)
    if done.returncode == 2:
        return row | dict(outcome="refused")
    summary = json.loads((folder / "run" / "summary.json").read_text())
    check = summary["finite_elements"]
    value, which = worst_field(check)
    probe, where = at_probes(program, case, folder, summary)
    row |= dict(outcome=summary["status"], particles=summary["particles"], steps=summary["steps"],
                seconds=f"{summary['wall_seconds']:.2f}", worst=f"{value:.4f}", field=which,
                limit=f"{check.get('limit', math.nan):.4f}", probe=f"{probe:.4f}", probe_field=where,
                skipped=check.get("skipped", ""), warnings=len(check["warnings"]))
    off = value > check.get("limit", TOLERABLE)
    row["off"] = int(off)
    if summary["status"] == "equilibrium":
        warned = names_a_cause(check["warnings"])
        row["silent"] = int((off and not warned) or bool(check.get("skipped"))
                            or (not off and not warned and probe > AT_PROBES + check.get("limit", 0) - TOLERABLE))
    return row


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--count", type=int, default=200)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", type=int)
    options.add_argument("--out", type=pathlib.Path)
    options.add_argument("--most-off", type=int)
    given = options.parse_args()
    out = given.out or pathlib.Path(tempfile.mkdtemp(prefix="two_soils_"))
    rows = []
    for index in range(given.count) if given.only is None else [given.only]:
        folder = out / f"{index:03d}"
        folder.mkdir(parents=True, exist_ok=True)
        rows.append(dict(scene=index) | compute(given.program, Scene(given.seed, index), folder))
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with (out / "map.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
    outcomes = {}
    for row in rows:
        outcomes[row["outcome"]] = outcomes.get(row["outcome"], 0) + 1
    compared = [row for row in rows if row.get("worst") and not row["skipped"]]
    off = [row for row in compared if row["off"]]
    silent = [row for row in rows if row.get("silent")]
    values = sorted(float(row["worst"]) for row in compared)
    lines = [f"{len(rows)} scenes of seed {given.seed}: " + ", ".join(f"{n} {k}" for k, n in sorted(outcomes.items())),
             f"compared with finite elements: {len(compared)}, off by more than 5 % and the strain: {len(off)}"]
    if values:
        lines.append(f"worst field of a scene: median {100 * values[len(values) // 2]:.2f} %, nine of ten within "
                     f"{100 * values[int(0.9 * (len(values) - 1))]:.2f} %")
    for row in off:
        lines.append(f"  scene {row['scene']} ({row['shape']}, {row['arrangement']}, contrast {row['contrast']}): "
                     f"{row['field']} {100 * float(row['worst']):.1f} % off; {row['said']}")
    lines.append(f"off without a warning: {len(silent)}")
    lines += [f"  scene {row['scene']}: {row['field']} {row['worst']}, probes {row['probe']} ({row['probe_field']}) "
              f"{row['skipped']}" for row in silent]
    text = "\n".join(lines) + "\n"
    (out / "summary.txt").write_text(text)
    print(text, end="")
    if given.out is None:
        shutil.rmtree(out)
    return 1 if silent or (given.most_off is not None and len(off) > given.most_off) else 0


if __name__ == "__main__":
    sys.exit(main())
