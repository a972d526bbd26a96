#!/usr/bin/env python3
"""Opens a report in a headless browser: every picture loads and nothing overflows, on wide and narrow windows.

Usage: report_page.py PATH_OF_POROSPH. Exit status 77 (skipped) where chromium's driver is not installed."""
import json
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request

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

IMAGES = "return Array.from(document.images, i => [i.getAttribute('src'), i.complete && i.naturalWidth > 0])"
OVERFLOW = """
const wide = document.documentElement.clientWidth;
return Array.from(document.querySelectorAll('body *'))
  .filter(e => e.getBoundingClientRect().right > wide + 1 && getComputedStyle(e.parentElement).overflowX === 'visible')
  .map(e => e.tagName + ' ' + e.textContent.slice(0, 40)).concat(
  document.documentElement.scrollWidth > wide ? ['the page is wider than the window'] : []);
"""


class Browser:
    """The few calls of the WebDriver protocol that this needs."""

    def __init__(self):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            self.port = s.getsockname()[1]
        self.driver = subprocess.Popen(["chromedriver", f"--port={self.port}"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
                     "--disable-background-networking"]
        for attempt in range(50):
            try:
                wish = {"capabilities": {"alwaysMatch": {"goog:chromeOptions": {"args": arguments}}}}
                self.session = "/session/" + self.call("POST", "/session", wish)["sessionId"]
                return
            except OSError:
                time.sleep(0.2)
        raise RuntimeError("chromedriver does not answer")

    def call(self, method, path, body=None):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", method=method,
                                         data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def open(self, url):
        self.call("POST", self.session + "/url", {"url": url})

    def resize(self, width):
        self.call("POST", self.session + "/window/rect", {"width": width, "height": 900})

    def ask(self, script):
        return self.call("POST", self.session + "/execute/sync", {"script": script, "args": []})

    def close(self):
        self.call("DELETE", self.session)  # ends the browser
        self.driver.terminate()
        self.driver.wait()


def main():
    if not shutil.which("chromedriver"):
        print("chromedriver is not installed: skipped")
        return 77
    porosph = pathlib.Path(sys.argv[1]).resolve()
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "case.toml").write_text(CASE)
        subprocess.run([porosph, "run", "case.toml", "--out", "run", "--quiet"], cwd=folder, check=True)
        subprocess.run([porosph, "report", "run", "--out", "report"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        browser = Browser()
        try:
            browser.open((folder / "report" / "index.html").as_uri())
            images = browser.ask(IMAGES)
            if len(images) < 4:
                problems.append(f"only {len(images)} pictures on the page")
            problems += [f"picture {name} does not load" for name, loaded in images if not loaded]
            for width in (1280, 700):
                browser.resize(width)
                problems += [f"{width} pixels wide: {what} overflows" for what in browser.ask(OVERFLOW)]
        finally:
            browser.close()
    print("\n".join(problems) if problems else f"{len(images)} pictures load, nothing overflows")
    return 1 if problems else 0


sys.exit(main())
