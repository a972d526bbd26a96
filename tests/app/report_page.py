#!/usr/bin/env python3
"""Opens a report in a headless browser: every picture loads and nothing overflows, on wide and narrow windows.

Usage: report_page.py PATH_OF_POROSPH. Exit status 77 (skipped) where chromium is not installed."""
import html
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

CASE = """
title = "Small <submerged> column & more"
reference = "column"
[particles]
spacing = 0.25
[[soil]]
name = "soil"
polygon = [[0, 0], [2, 0], [2, 3], [0, 3]]
youngs_modulus = 15e6
poissons_ratio = 0.33
unit_weight_saturated = 20e3
[water]
level = 4
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 3]
[[boundary]]
kind = "roller"
from = [2, 0]
to = [2, 3]
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [2, 0]
[loading]
damping = 0.02
[time]
end = 0.3
[output]
interval = 0.05
[[probe]]
name = "A"
position = [1, 1.5]
"""

# Added to a copy of the page: what is wrong, as JSON, becomes the page's text.
CHECK = """<script>
addEventListener('load', () => {
  const wide = document.documentElement.clientWidth;
  const problems = Array.from(document.images).filter(i => !(i.complete && i.naturalWidth > 0))
    .map(i => 'picture ' + i.getAttribute('src') + ' does not load');
  for (const e of document.querySelectorAll('body *'))
    if (e.getBoundingClientRect().right > wide + 1 && !e.parentElement.closest('.scroll, pre'))  // these scroll
      problems.push(e.tagName + ' overflows: ' + e.textContent.slice(0, 40));
  if (document.documentElement.scrollWidth > wide) problems.push('the page is wider than the window');
  const found = JSON.stringify({pictures: document.images.length, problems: problems});
  document.body.textContent = 'CHECKED' + found + 'END';
});
</script>"""


def look_at(page, width):
    """What the browser finds on the page in a window of this width [pixels]."""
    checked = page.with_name("checked.html")
    checked.write_text(page.read_text() + CHECK)
    arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
                 "--disable-background-networking", f"--user-data-dir={page.parent / 'profile'}",
                 f"--window-size={width},900", "--virtual-time-budget=10000", "--dump-dom", checked.as_uri()]
    shown = subprocess.run(["chromium", *arguments], check=True, text=True, stdout=subprocess.PIPE,
                           stderr=subprocess.DEVNULL, timeout=100).stdout
    return json.loads(html.unescape(shown[shown.index("CHECKED") + len("CHECKED"):shown.index("END")]))


def main():
    if not shutil.which("chromium"):
        print("chromium is not installed: skipped")
        return 77
    porosph = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "case.toml").write_text(CASE)
        subprocess.run([porosph, "run", "case.toml", "--out", "run", "--quiet"], cwd=folder, check=True)
        subprocess.run([porosph, "report", "run", "--out", "report"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        problems = []
        for width in (1400, 700, 400):
            found = look_at(folder / "report" / "index.html", width)
            problems += [f"{width} pixels wide: {problem}" for problem in found["problems"]]
        if found["pictures"] < 4:
            problems.append(f"only {found['pictures']} pictures on the page")
    print("\n".join(problems) if problems else f"{found['pictures']} pictures load, nothing overflows")
    return 1 if problems else 0


sys.exit(main())
