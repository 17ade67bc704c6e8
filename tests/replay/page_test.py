"""Opens pages of `metamorph replay` in headless Chromium: they load without a request or a fault, play,
seek and change colours, and show what the program computes.

usage: page_test.py METAMORPH SOURCE_TREE [FOLDER_FOR_PICTURES]
Exit code 77 (skipped) where there is no Chromium.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from browser import Browser, program

SKIPPED = 77
SHORT = ["--set", "scenes.*.run_steps=900", "--set", "scenes.*.ramp_steps=100",
         "--set", "scenes.land.settle_quiet_steps=100"]
CUT = 60  # steps of the timeline that a body's appearance takes
COLOURS = ("area", "phase", "period", "speed", "birth", "contact")
# Where nodes are at a frame, cells at a step, as the page reads them; waits for what is being read.
READ = """
const wait = (points) => Promise.all([...points.loading.values()]);
async function nodes(a, motion, frames) {
  const { track } = (await replay.life(a)).motions[motion], places = [];
  for (const frame of frames) {
    let now;
    while (!(now = track.at(frame))) await wait(track.points);
    places.push([...now.x].map((x, i) => [x, now.y[i]]));
  }
  return places;
}
async function cells(a, step) {
  const d = (await replay.life(a)).development;
  let now;
  while (!(now = replay.cellsAt(d, step))) await wait(d.points);
  const { x, y, there } = now;
  return there.map((i) => ({ id: d.id[i], mother: d.mother[i], place: [x[i], y[i]],
    period: replay.signalsAt(d, i, step)[1], phase: replay.signalsAt(d, i, step)[2],
    linked: replay.linksAt(d, step).filter(([k, j]) => k === i || j === i)
      .map(([k, j]) => d.id[k === i ? j : k]).sort((p, q) => p - q) }));
}
"""


def run(*arguments):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    assert result.returncode == 0, f"{arguments}: {result.stderr}"


def show(browser, page, address=""):
    """Opens the page anew and waits until it is drawn."""
    browser.open("about:blank")
    browser.requests.clear()
    browser.open(f"file://{page}{address}")
    browser.until("window.replay && replay.drawn > 0 && replay.whole()")


def seek(browser, address):
    """Another address of the page that is open."""
    browser.value(f"location.hash = {address!r}")
    browser.until(f"replay.state.t === {address.split('t=')[1].split('&')[0]} && replay.whole()")


def now(browser):
    return browser.value("document.getElementById('now').textContent")


def colours(browser):
    """How many pixels of the picture are neither grey nor white, and a digest of all."""
    return browser.value("""(() => {
      const c = document.getElementById('stage');
      const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
      let many = 0, digest = 0;
      for (let i = 0; i < d.length; i += 4) {
        if (Math.max(d[i], d[i + 1], d[i + 2]) - Math.min(d[i], d[i + 1], d[i + 2]) > 20) ++many;
        digest = (digest * 31 + d[i] + 7 * d[i + 1] + 13 * d[i + 2]) % 4294967291;
      }
      return [many, digest];
    })()""")


def check_quiet(browser, page):
    # What else the page asks for would stand here: pictures and texts in it are no requests.
    assert browser.requests == [f"file://{page}"], browser.requests
    assert not browser.faults, browser.faults


def check_loads(browser, page):
    show(browser, page)
    check_quiet(browser, page)
    milliseconds = browser.value("replay.drawn")
    assert milliseconds < 10000, milliseconds  # a second, where nothing else runs
    assert now(browser).startswith("development, step 0 of 1200: 1 cell,"), now(browser)
    print(f"drawn {milliseconds:.0f} ms after it was opened, {page.stat().st_size / 1000:.0f} kB")


def check_one_life(browser, page):
    """From the egg on: cells, a body, its motion, cells, a body, its motion."""
    show(browser, page, "#a=0&t=300")
    assert "step 300 of 1200" in now(browser), now(browser)
    assert "cells" in now(browser)
    larva = 600 + CUT
    adult = larva + 900 + 600 + CUT
    pictures = set()
    for t, words in ((600 + CUT // 2, "its body is cut out"), (larva + 450, "larva in water, step 450"),
                     (larva + 900 + 500, "metamorphosis, step 1100 of 1200"),
                     (adult + 450, "adult on land, step 450 of 900")):
        seek(browser, f"#a=0&t={t}")
        assert words in now(browser), (words, now(browser))
        many, digest = colours(browser)
        assert many > 2000, (t, many)
        pictures.add(digest)
    assert len(pictures) == 4
    check_quiet(browser, page)


def check_colours(browser, page):
    digests = {}
    for colour in COLOURS:
        show(browser, page, f"#a=0&t={600 + CUT + 450}&c={colour}")
        digests[colour] = colours(browser)[1]
        assert browser.value("document.getElementById('legend').textContent"), colour
    assert len(set(digests.values())) == len(COLOURS), digests
    browser.press("c")  # from the last one to the first
    browser.until("replay.whole()")
    assert colours(browser)[1] == digests["area"]
    check_quiet(browser, page)


def check_keys_and_play(browser, page):
    show(browser, page, "#a=0&t=800")
    for key, shift, t in (("ArrowRight", False, 801), ("ArrowRight", True, 811), ("ArrowLeft", False, 810),
                          ("Home", False, 0), ("]", False, 600), ("[", False, 0)):
        browser.press(key, shift)
        assert browser.value("replay.state.t") == t, (key, browser.value("replay.state.t"))
        assert browser.value("location.hash") == f"#a=0&t={t}", browser.value("location.hash")
    browser.press("End")
    browser.until("document.getElementById('now').textContent.includes('step 900 of 900')")
    seek(browser, "#a=0&t=700")
    browser.press(" ")
    browser.until("replay.state.t > 720")
    browser.press("r")
    browser.until("replay.state.t < 715")
    browser.press("r")  # stops
    stopped = browser.value("replay.state.t")
    assert browser.value("replay.state.playing") is False
    browser.until("replay.whole()")
    assert browser.value("replay.state.t") == stopped
    browser.press("End")
    browser.value("document.getElementById('play').click()")  # loops to the egg
    browser.until("replay.state.t < 600")
    browser.press("l")  # no more
    browser.press(" ")
    browser.press("End")
    browser.press(" ")  # from the start again, then to the end and no further
    browser.press("End")
    browser.until("!replay.state.playing")
    check_quiet(browser, page)


def check_touch(browser, page):
    show(browser, page, "#a=0&t=700")
    width = browser.value("document.documentElement.scrollWidth")
    assert width <= 400, f"wider than the phone: {width}"
    browser.touch("touchStart", (100, 300))
    for x in (120, 160, 200):
        browser.touch("touchMove", (x, 300))
    browser.touch("touchEnd")
    browser.until("replay.state.t === 900")  # 100 pixels, two steps each
    browser.touch("touchStart", (100, 300))
    browser.touch("touchEnd")
    browser.until("replay.state.playing && replay.state.t > 900")
    check_quiet(browser, page)


def check_numbers(browser, page, folder, metamorph, genome):
    """Nodes are where `simulate` says, cells are those of `grow`."""
    show(browser, page)
    for number, trial in enumerate(("larva", "adult")):
        table = folder / f"{trial}.csv"
        run(metamorph, "simulate", genome, "--experiment", folder / "life.toml", "--trial", trial,
            "--trajectory", table, "--every", "1", *SHORT)
        frames = {}
        with open(table) as file:
            for row in csv.DictReader(file):
                frames.setdefault(int(row["step"]), []).append((float(row["x"]), float(row["y"])))
        steps = sorted(frames)[::7] + [max(frames)]
        shown = browser.value(f"(async () => {{ {READ} return nodes(0, {number}, {steps}); }})()")
        errors = sorted(math.dist(p, q) for step, places in zip(steps, shown)
                        for p, q in zip(frames[step], places, strict=True))
        most = errors[int(0.999 * len(errors))]
        print(f"{trial}: {len(errors)} nodes in frames, 99.9 % within {most:.4f} d, worst {errors[-1]:.4f} d")
        assert most < 0.0105 and errors[-1] < 0.06, trial
    run(metamorph, "grow", genome, "--experiment", folder / "life.toml", "--at", "30,600,961,1021,1171",
        "--out", folder / "grown", *SHORT)
    compared = 0
    for file in sorted((folder / "grown").glob("*.json")):
        embryo = json.loads(file.read_text())
        if embryo["format"] != "metamorph-embryo/1":
            continue
        compared += 1
        shown = browser.value(f"(async () => {{ {READ} return cells(0, {embryo['step']}); }})()")
        compare_cells(embryo, shown)
    assert compared == 5, compared  # some links end at the last three steps


def compare_cells(embryo, shown):
    cells = embryo["cells"]
    assert [c["id"] for c in cells] == [c["id"] for c in shown]
    linked = [[] for _ in cells]
    for i, j in embryo["links"]:
        linked[i].append(cells[j]["id"])
        linked[j].append(cells[i]["id"])
    for cell, there, neighbours in zip(cells, shown, linked, strict=True):
        assert cell["mother"] == there["mother"]
        assert math.dist((cell["x"], cell["y"]), there["place"]) < 0.003
        assert abs(cell["period"] - there["period"]) <= 0.126
        assert abs(math.remainder(cell["phase"] - there["phase"], 2 * math.pi)) <= math.pi / 256 + 1e-9
        assert sorted(neighbours) == there["linked"]


def check_zoo_and_ghosts(browser, page):
    show(browser, page, "#a=1&t=900&z=1")
    zoo = colours(browser)
    assert zoo[0] > 2000
    browser.press("z")
    browser.until("!replay.state.zoo && replay.whole()")
    alone = colours(browser)[1]
    for switch in ("copies", "reference"):
        assert browser.value(f"document.getElementById('{switch}').hidden") is False
        browser.value(f"document.getElementById('{switch}').click()")
        browser.until("replay.whole()")
        assert colours(browser)[1] != alone, switch
        alone = colours(browser)[1]
    browser.press("ArrowDown")
    browser.until("replay.state.a === 0 && replay.whole()")
    check_quiet(browser, page)


def check_body_on_a_slope(browser, page):
    show(browser, page, "#t=450")
    assert "body on slope, step 450 of 900" in now(browser), now(browser)
    # Uphill goes to the right; at both sides of the picture there is nothing but the ground.
    for key in "t---":  # no trail, from afar
        browser.press(key)
    browser.until("replay.whole()")
    left, right, width = browser.value("""(() => {
      const c = document.getElementById('stage'), w = c.width;
      const d = c.getContext('2d').getImageData(0, 0, w, c.height).data;
      const first = (x) => { for (let y = 0; y < c.height; ++y) if (d[4 * (y * w + x)] < 230) return y; };
      return [first(6), first(w - 6), w - 12];
    })()""")
    slope = math.degrees(math.atan2(left - right, width))
    assert abs(slope - 17) < 0.5, slope
    assert browser.value("document.getElementById('genome').disabled") is True
    check_quiet(browser, page)


def check_stage_without_a_body(browser, page):
    show(browser, page, "#t=25")
    assert now(browser).startswith("larva: no body ("), now(browser)
    seek(browser, f"#t={1200 + 2 * CUT + 450}")
    assert "adult on land, step 450 of 900" in now(browser), now(browser)
    check_quiet(browser, page)


def check_lineage(browser, page):
    show(browser, page, "#a=2")
    rows = "[...document.querySelectorAll('#ancestors li')]"
    assert browser.value(f"{rows}.length") == 3  # generations 2, 1, 0
    assert browser.value(f"{rows}[0].textContent").startswith("generation 2: individual ")
    assert browser.value("document.querySelectorAll('#curve line').length") == 4
    browser.value("document.getElementById('generation').value = 0; "
                  "document.getElementById('generation').dispatchEvent(new Event('input'))")
    browser.until(f"replay.state.a === 0 && {rows}.length === 1 && replay.whole()")
    # The last champion comes of others: what of them is in the page is a button that shows it.
    browser.value("replay.seek(2, 0)")
    browser.until(f"{rows}.length === 3")
    target = browser.value("""(() => {
      const buttons = [...document.querySelectorAll('#ancestors button')];
      buttons.at(-1).click();
      return +/generation (\\d+)/.exec(buttons.at(-1).textContent)[1];
    })()""")
    browser.until(f"replay.state.a === {target} && replay.whole()")
    check_quiet(browser, page)


def check_files(browser, page, genome, folder):
    show(browser, page, "#t=700")
    browser.ask("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
    for button in ("genome", "body", "picture"):
        browser.value(f"document.getElementById('{button}').click()")
        found = lambda: [p for p in folder.iterdir() if p.suffix in (".json", ".png") and p.stat().st_size]
        wanted = {"genome": 1, "body": 2, "picture": 3}[button]
        for _ in range(600):
            if len(found()) >= wanted:
                break
            time.sleep(0.05)
        assert len(found()) == wanted, found()
    saved = {p.suffix + p.stem.split("-")[-1]: p for p in found()}
    # The genome as the program writes it, which need not be how that file was written.
    assert json.loads(saved[".jsongenome"].read_text())["links"] == json.loads(genome.read_text())["links"]
    assert json.loads(saved[".jsonlarva"].read_text())["format"] == "metamorph-body/1"
    assert saved[".png700"].read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def main():
    metamorph, root = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if program() is None:
        print("skipped: there is no Chromium (Debian package chromium)")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        pictures = Path(sys.argv[3]) if len(sys.argv) > 3 else folder
        (folder / "life.toml").write_text(
            'name = "life"\n[[trials]]\nname = "larva"\nstage = 600\nscene = "water"\n'
            '[[trials]]\nname = "adult"\nstage = 1200\nscene = "land"\n')
        genomes = [root / "bench" / "genomes" / f"solid-{k}.json" for k in (1, 4)]
        life, zoo = folder / "life.html", folder / "zoo.html"
        rules = ("--experiment", folder / "life.toml", *SHORT)
        run(metamorph, "replay", genomes[0], "--out", life, *rules)
        run(metamorph, "replay", *genomes, "--out", zoo, "--copies", "2", "--reference", *rules)
        body, early, history = folder / "body.html", folder / "early.html", folder / "history.html"
        run(metamorph, "grow", genomes[0], "--at", "1200", "--out", folder / "adult")
        run(metamorph, "replay", folder / "adult" / "body-1200.json", "--scene", "slope", "--out", body,
            "--set", "trials.adult.scene=slope", *SHORT[:4])
        run(metamorph, "replay", genomes[0], "--out", early, *rules, "--set", "trials.larva.stage=5")
        run(metamorph, "evolve", folder / "life.toml", "--out", folder / "run", "--population", "12",
            "--generations", "3", *SHORT)
        run(metamorph, "replay", folder / "run", "--every-generation", "1", "--out", history)
        with Browser() as browser:
            check_loads(browser, life)
            check_one_life(browser, life)
            check_colours(browser, life)
            check_keys_and_play(browser, life)
            check_numbers(browser, life, folder, metamorph, genomes[0])
            check_body_on_a_slope(browser, body)
            check_stage_without_a_body(browser, early)
            check_lineage(browser, history)
            (folder / "saved").mkdir()
            check_files(browser, life, genomes[0], folder / "saved")
            check_zoo_and_ghosts(browser, zoo)
            browser.picture(pictures / "page-1200.png")
        with Browser(400, 800, touch=True) as browser:
            check_touch(browser, life)
            browser.picture(pictures / "page-400.png")
    print("pages are quiet, play, seek, and show what was computed")


main()
