#!/usr/bin/env python3
"""Opens a report in a headless browser, on wide and narrow windows, with and without script: every picture loads, nothing
overflows, panels stand alone on narrow windows, the player plays and the slider cuts.

Usage: report_page.py PATH_OF_POROSPH. Exit status 77 (skipped) where chromium is not installed."""
import html
import json
import pathlib
import re
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
const problems = [], pause = t => new Promise(done => setTimeout(done, t)), shown = e => e.getClientRects().length > 0;
function expect(what, right) { if (!right) problems.push(what); }
function move(range, value) { range.value = value; range.dispatchEvent(new Event('input')); }

async function check_pictures() {
  for (const i of document.images) i.loading = 'eager';
  await pause(1000);
  for (const i of document.images) {
    expect('picture ' + i.getAttribute('src').slice(0, 40) + ' does not load', i.complete && i.naturalWidth > 0);
    const link = i.closest('a');
    expect('no link to ' + i.getAttribute('src').slice(0, 40),
           link && (SINGLE || link.getAttribute('href') === i.getAttribute('src')));
  }
}
function check_overflow() {
  const wide = document.documentElement.clientWidth;
  for (const e of document.querySelectorAll('body *'))
    if (e.getBoundingClientRect().right > wide + 1 && !e.parentElement.closest('.scroll, pre, .strip'))  // these scroll
      problems.push(e.tagName + ' overflows: ' + e.textContent.slice(0, 40));
  expect('the page is wider than the window', document.documentElement.scrollWidth <= wide);
}
function check_panels() {
  const narrow = Array.from(document.querySelectorAll('.narrow img')), wide = document.querySelectorAll('.wide img');
  expect('no picture of several panels', narrow.length > 1 && wide.length > 0);
  expect('panels are shown in a wide window', innerWidth <= 700 || !narrow.some(shown));
  expect('one picture of all panels is shown in a narrow window', innerWidth > 700 || !Array.from(wide).some(shown));
  expect('a panel is not shown in a narrow window', innerWidth > 700 || narrow.every(shown));
}
async function check_player() {
  const player = document.querySelector('.player'), frames = Array.from(player.querySelectorAll('li'));
  expect('fewer than 5 frames', frames.length > 4);
  if (!SCRIPTED) return expect('the strip is not shown whole', frames.every(shown));
  const range = player.querySelector('input'), button = player.querySelector('button');
  const current = () => frames.filter(shown).map(f => frames.indexOf(f)).join();
  expect('the player does not begin with the last frame', current() === String(frames.length - 1));
  move(range, 1);
  expect('the range does not choose a frame', current() === '1');
  button.click();
  await pause(500);
  expect('it does not play', current() !== '1' && button.textContent === 'Pause');
  button.click();
  const stopped = current();
  await pause(500);
  expect('it does not pause', current() === stopped && button.textContent === 'Play');
}
function check_slider() {
  const figures = Array.from(document.querySelectorAll('.slider figure')), boxes = figures.map(f => f.getBoundingClientRect());
  expect('a picture of the slider is not shown', figures.length === 2 && figures.every(shown));
  if (!SCRIPTED) return expect('the two pictures are not apart', boxes[1].top >= boxes[0].bottom - 1);
  expect('the two pictures do not lie on each other', Math.abs(boxes[1].top - boxes[0].top) < 1);
  move(document.querySelector('.slider input'), 30);
  const upper = figures[1].querySelector('a');
  expect('the slider does not cut', getComputedStyle(upper).clipPath.endsWith('30%)'));
}
function check_full_size() {
  document.querySelector('figure a:not([href]) img').click();
  expect('a picture does not open', document.querySelector('dialog[open] img') !== null);
}
addEventListener('load', async () => {
  try {
    await check_pictures();
    check_overflow();
    check_panels();
    await check_player();
    check_slider();
    if (SINGLE) check_full_size();
  } catch (error) { problems.push(String(error)); }
  const found = JSON.stringify({pictures: document.images.length, problems: problems});
  document.body.textContent = 'CHECKED' + found + 'END';
});
</script>"""


def look_at(page, width, scripted=True):
    """What the browser finds on the page in a window of this width [pixels], with or without the page's script."""
    checked = page.with_name("checked.html")
    text = page.read_text()
    if not scripted:
        text = re.sub("<script>.*?</script>", "", text, flags=re.S)
    single = "true" if page.parent.name == "single" else "false"
    constants = f"<script>const SCRIPTED = {'true' if scripted else 'false'}, SINGLE = {single};</script>"
    checked.write_text(text + constants + CHECK)
    arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
                 "--disable-background-networking", f"--user-data-dir={page.parent / 'profile'}",
                 f"--window-size={width},900", "--virtual-time-budget=20000", "--dump-dom", checked.as_uri()]
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
        for run, settings in (("run", []), ("soft", ["--set", "soil.0.youngs_modulus=10 MPa"])):
            subprocess.run([porosph, "run", "case.toml", "--out", run, "--quiet", *settings], cwd=folder, check=True)
        report = [porosph, "report", "run", "soft", "--field", "EffectiveStress:YY", "--field", "StressRatio",
                  "--range", "-40,0", "--range", "0,2"]
        for out, more in (("report", []), ("single", ["--single-file"])):
            subprocess.run([*report, "--out", out, *more], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        problems = []
        for out, width, scripted in (("report", 1400, True), ("report", 700, True), ("report", 400, True),
                                     ("report", 1400, False), ("report", 400, False), ("single", 400, True)):
            found = look_at(folder / out / "index.html", width, scripted)
            where = f"{out}, {width} pixels wide{'' if scripted else ', without script'}"
            problems += [f"{where}: {problem}" for problem in found["problems"]]
        if found["pictures"] < 20:
            problems.append(f"only {found['pictures']} pictures on the page")
        if list((folder / "single").glob("*.png")):
            problems.append("pictures lie beside the page that holds them")
    print("\n".join(problems) if problems else f"{found['pictures']} pictures load, nothing overflows")
    return 1 if problems else 0


sys.exit(main())
