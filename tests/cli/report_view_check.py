#!/usr/bin/env python3
"""Opens the report of the shipped example in headless Chromium and does what a reader does.

Usage: report_view_check.py TCM_ICP_EXECUTABLE TOWN_FOLDER
Exit code 77, with the reason, where Chromium or python3-websocket is missing: the test counts as skipped."""
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

SKIPPED = 77


class Browser:
    """A page in headless Chromium, over its debugging port; software rendering, so that WebGL is there everywhere."""

    def __init__(self, program, folder, websocket, webgl=True):
        graphics = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] if webgl else \
            ["--disable-gpu", "--disable-3d-apis"]
        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
             "--remote-debugging-port=0", "--remote-allow-origins=*", "--user-data-dir=" + folder, *graphics, "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file = os.path.join(folder, "DevToolsActivePort")
        wait_for("Chromium's debugging port", lambda: os.path.exists(port_file) and open(port_file).read().count("\n") > 0)
        pages = json.load(urllib.request.urlopen("http://127.0.0.1:%s/json" % open(port_file).read().split()[0]))
        address = next(p for p in pages if p["type"] == "page")["webSocketDebuggerUrl"]
        self.socket = websocket.create_connection(address, timeout=60)
        self.number = 0
        self.complaints = []
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError("%s: %s" % (method, message["error"]))
                return message["result"]
            self.note(message)

    def note(self, message):
        if message.get("method") == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(message["params"]["exceptionDetails"])[:500])
        if message.get("method") == "Runtime.consoleAPICalled" and message["params"]["type"] in ("error", "assert"):
            self.complaints.append(json.dumps(message["params"]["args"])[:500])
        if message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
            self.complaints.append(message["params"]["entry"]["text"])

    def run(self, script):
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(script + ": " + json.dumps(result["exceptionDetails"])[:500])
        return result["result"].get("value")

    def open(self, path, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                  mobile=width < 500)
        self.call("Page.navigate", url="file://" + path)
        wait_for("the page", lambda: self.run("document.readyState") == "complete")

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait()


def wait_for(what, happened, seconds=40):
    end = time.monotonic() + seconds
    while not happened():
        if time.monotonic() > end:
            raise RuntimeError("waited %d s for %s" % (seconds, what))
        time.sleep(0.1)


# Pixels of the canvas that are not its background, and a sum that changes with the picture.
PIXELS = """(() => {
  const view = window.tcmIcpView, canvas = view.canvas, copy = document.createElement('canvas');
  copy.width = canvas.width; copy.height = canvas.height;
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data;
  let drawn = 0, sum = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i] !== 0xf4 || data[i + 1] !== 0xf6 || data[i + 2] !== 0xf8) ++drawn;
    sum = (sum * 31 + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) % 1000000007;
  }
  return {drawn, sum, all: data.length / 4};
})()"""

CLICK_ON_LINK = """(() => {
  const view = window.tcmIcpView;
  for (const line of view.lines.children) {
    const [a, b] = line.userData.ends.map(end => view.onScreen(end));
    if (!line.visible || !a || !b) continue;
    const box = view.canvas.getBoundingClientRect();
    const at = {clientX: box.left + 0.4 * a[0] + 0.6 * b[0], clientY: box.top + 0.4 * a[1] + 0.6 * b[1], bubbles: true};
    for (const type of ['pointerdown', 'pointerup']) view.canvas.dispatchEvent(new PointerEvent(type, at));
    return view.selected;
  }
  return null;
})()"""


class Checks:
    def __init__(self):
        self.failed = 0

    def that(self, holds, what):
        if not holds:
            self.failed += 1
        print(("ok      " if holds else "FAILED  ") + what, flush=True)


def check_controls(page, checks):
    def changes(what, script):
        before = page.run(PIXELS)
        page.run(script)
        after = page.run(PIXELS)
        checks.that(before["sum"] != after["sum"], what + " changes the picture")
        return before, after

    first = page.run(PIXELS)
    checks.that(first["drawn"] > 0.05 * first["all"], "the view is not blank: %(drawn)d of %(all)d pixels" % first)
    for mode in ("height", "distance", "scan"):
        changes("colour by " + mode, "document.querySelector('[name=view-colour][value=%s]').click()" % mode)
    before, after = changes("hiding a scan", "document.querySelectorAll('.view-scans input')[1].click()")
    checks.that(after["drawn"] < before["drawn"], "a hidden scan's points are gone")
    page.run("document.querySelectorAll('.view-scans input')[1].click()")
    for name in ("links", "setups"):
        changes("switching off " + name, "document.querySelector('[name=view-%s]').click()" % name)
        page.run("document.querySelector('[name=view-%s]').click()" % name)
    for look in ("top", "side", "oblique"):
        changes("the view from " + look, "document.querySelector('[data-look=%s]').click()" % look)
    changes("what the files have", "document.querySelector('[name=view-state][value=input]').click()")
    page.run("document.querySelector('[name=view-state][value=registered]').click()")
    checks.that(page.run(PIXELS)["sum"] == first["sum"], "and back gives the first picture again")

    link = page.run(CLICK_ON_LINK)
    checks.that(link is not None, "a click on a link's line chooses it")
    told = page.run("document.querySelector('.view-link').hidden ? '' : document.querySelector('.view-link').textContent")
    checks.that("RMS" in told and "unnoticed" in told, "the panel tells of it: " + told[:120])
    checks.that(page.run("document.querySelectorAll('.view-link .histogram rect').length > 10"), "with its histogram")
    checks.that(page.run("tcmIcpView.clouds.filter(c => c.visible).length") == 2, "two scans are shown")
    checks.that(page.run("tcmIcpView.marks.children.length") == 2, "arrows show where it can move")
    page.run("document.querySelector('.view-link button').click()")
    checks.that(page.run("tcmIcpView.clouds.filter(c => c.visible).length") > 2, "all scans are shown again")
    page.run("document.querySelector('tr[data-link]').click()")
    checks.that(page.run("tcmIcpView.selected === Number(document.querySelector('tr[data-link]').dataset.link)"),
                "a click on a row of the table chooses its link")


def check_groups(page, checks):
    chosen = "document.querySelector('[name=view-group][value=\"%d\"]').click()"
    listed = "[...document.querySelectorAll('.view-scans label')].filter(e => !e.hidden).length"
    first = page.run(PIXELS)
    checks.that(page.run("tcmIcpView.clouds.filter(c => c.visible).length") == 2, "the registered scans are shown alone")
    page.run(chosen % 1)
    other = page.run(PIXELS)
    checks.that(other["drawn"] > 0.02 * other["all"] and other["sum"] != first["sum"],
                "the group is shown: %(drawn)d of %(all)d pixels" % other)
    checks.that(page.run("tcmIcpView.clouds.map(c => c.visible)") == [False, False, True, True], "its scans, and no other")
    told = page.run("document.querySelector('.view-own').hidden ? '' : document.querySelector('.view-own').textContent")
    checks.that("not registered" in told, "and marked: " + told)
    checks.that(page.run(listed) == 3, "the list has its scans")
    page.run("document.querySelectorAll('.view-scans input')[3].click()")
    checks.that(page.run("tcmIcpView.clouds.map(c => c.visible)") == [False, False, False, True], "its scans go off")
    checks.that(page.run(PIXELS)["drawn"] < other["drawn"], "with their points")
    page.run("document.querySelectorAll('.view-scans input')[3].click()")
    page.run("document.querySelector('[name=view-state][value=input]').click()")
    checks.that(page.run(PIXELS)["drawn"] > 0.02 * other["all"], "as the files have them, too")
    page.run("document.querySelector('[name=view-state][value=registered]').click()")
    page.run(chosen % 0)
    checks.that(page.run(PIXELS)["sum"] == first["sum"], "and back gives the first picture again")
    checks.that(page.run("document.querySelector('.view-own').hidden"), "without the mark")
    page.run("choose = n => [...document.querySelectorAll('tr[data-link]')].find(row => tcmIcpView.data.scans["
             "tcmIcpView.data.links[Number(row.dataset.link)].a].group === n).click()")
    page.run("choose(1)")
    checks.that(page.run("tcmIcpView.group") == 1, "a click on a link of the group shows it")


def check_report_of_groups(chromium, websocket, report, folder):
    checks = Checks()
    page = Browser(chromium, os.path.join(folder, "profile3"), websocket)
    try:
        page.open(report, 1400, 1000)
        if page.run("!!document.getElementById('view-data')"):
            wait_for("the view", lambda: page.run("!!window.tcmIcpView"))
            check_groups(page, checks)
        checks.that(not page.complaints, "no error on the console" + "".join("\n        " + c for c in page.complaints))
    finally:
        page.close()
    return checks.failed


# Two scans of the town and two of a street: what holds together, but not with the reference.
def register_two_places(program, town, folder):
    street = os.path.join(folder, "street")
    subprocess.run([program, "simulate", "--scene", "street", "--scans", "2", "--sensor", "terrestrial", "--max-range",
                    "40", "--seed", "5", "--out", street, "--quiet"], check=True)
    scans = [os.path.join(town, "002.ply"), os.path.join(town, "003.ply")]
    for number in range(2):
        scans.append(os.path.join(folder, "street_%d.ply" % number))
        os.rename(os.path.join(street, "00%d.ply" % number), scans[-1])
    result = os.path.join(folder, "groups")
    ended = subprocess.run([program, "register", *scans, "--reference", "002.ply", "--sampling.working-points", "20000",
                            "--sampling.coarse-voxels", "4000", "--sampling.fine-voxels", "10000", "--out", result, "--quiet"])
    if ended.returncode != 3:
        raise RuntimeError("two places are not one: exit code %d" % ended.returncode)
    return os.path.join(result, "report.html")


def check_report(chromium, websocket, report, folder):
    checks = Checks()
    checks.that(os.path.getsize(report) < 10e6, "%.1f MB are below 10" % (os.path.getsize(report) / 1e6))
    page = Browser(chromium, os.path.join(folder, "profile"), websocket)
    try:
        page.open(report, 1400, 1000)
        has_view = page.run("!!document.getElementById('view-data')")
        if has_view:
            wait_for("the view", lambda: page.run("!!window.tcmIcpView"))
            check_controls(page, checks)
        else:
            print("        built without three.js: no view to look at", flush=True)
        pdf = base64.b64decode(page.call("Page.printToPDF", preferCSSPageSize=True)["data"])
        checks.that(pdf[:5] == b"%PDF-" and pdf.count(b"/Type /Page") > 1 or len(pdf) > 50000, "prints to PDF")
        page.open(report, 390, 844)
        checks.that(page.run("document.documentElement.scrollWidth") <= 390, "390 pixels are wide enough")
        checks.that(not page.complaints, "no error on the console" + "".join("\n        " + c for c in page.complaints))
    finally:
        page.close()
    page = Browser(chromium, os.path.join(folder, "profile2"), websocket, webgl=False)
    try:
        page.open(report, 1400, 1000)
        shown = page.run("(() => { const i = document.querySelector('.view-stage img'); return i.complete && "
                         "i.naturalWidth > 500 && getComputedStyle(i).display !== 'none'; })()")
        checks.that(shown, "without WebGL there is a picture")
    finally:
        page.close()
    return checks.failed


def main():
    program, town = sys.argv[1:3]
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    try:
        import websocket
    except ImportError:
        websocket = None
    if chromium is None or websocket is None:
        print("SKIPPED: no Chromium or no python3-websocket: nobody looked at the report")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        result = os.path.join(folder, "town")
        scans = sorted(os.path.join(town, name) for name in os.listdir(town) if name.endswith(".ply"))
        subprocess.run([program, "register", *scans, "--out", result, "--quiet", "--accept-residual", "20mm", "--project",
                        "Town <1> & \"2\""], check=True)
        failed = check_report(chromium, websocket, os.path.join(result, "report.html"), folder)
        failed += check_report_of_groups(chromium, websocket, register_two_places(program, town, folder), folder)
    print("%d checks failed" % failed)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
