"""Turns the JSON files of the benchmark programs into CSV: every benchmark's time per unit of work,
and every bar with what was measured for it.

    python3 bench/report.py RAW_FOLDER OUT_FOLDER [PAGE]

Writes OUT_FOLDER/<processor>.csv and OUT_FOLDER/<processor>-bars.csv, prints the bars, and renews
the tables of a page (Markdown) between its lines "<!-- bars -->", "<!-- arrangements -->" and the
next "<!-- end -->". Times are the least of all repetitions (the machine may be shared; what disturbs
a run only adds time), with the median beside them.
"""

import csv
import json
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

TO_NS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
# Fields of a repetition that are no counters of ours, and counters that are times in disguise.
NOT_COUNTERS = {
    "name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
    "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit", "label",
    "units", "per_unit", "flop", "flop_per_s", "error_occurred", "error_message",
}


class Benchmark:
    def __init__(self, program, name, runs):
        self.program, self.name, self.runs = program, name, runs
        self.unit = runs[0]["label"]
        self.units = runs[0]["units"]

    def per_unit(self, clock, choose=min):
        """Nanoseconds per unit of work; clock: cpu_time (of all threads) or real_time."""
        return choose(run[clock] * TO_NS[run["time_unit"]] / run["units"] for run in self.runs)

    def counters(self):
        """Least value of every counter of the benchmark's own; rates are left to time and units."""
        names = [k for k in self.runs[0] if k not in NOT_COUNTERS and not k.endswith("_per_s")]
        return {name: min(run[name] for run in self.runs) for name in names}

    def gflop_per_s(self):
        if "flop" not in self.runs[0]:
            return None
        return self.runs[0]["flop"] / (self.units * self.per_unit(self.clock()))

    def clock(self):
        return "real_time" if "threads:" in self.name else "cpu_time"


def read(folder):
    benchmarks, errors = {}, []
    for file in sorted(Path(folder).glob("*.json")):
        runs = {}
        for run in json.loads(file.read_text())["benchmarks"]:
            if run.get("run_type") != "iteration":
                continue
            if run.get("error_occurred"):
                errors.append(f"{file.stem} {run['name']}: {run['error_message']}")
                continue
            name = run["run_name"].replace("/process_time", "").replace("/real_time", "")
            runs.setdefault(name, []).append(run)
        for name, list_of_runs in runs.items():
            benchmarks[file.stem, name] = Benchmark(file.stem, name, list_of_runs)
    return benchmarks, errors


class Bars:
    """Measures every bar: value, and the benchmarks that it came from."""

    def __init__(self, benchmarks):
        self.benchmarks = benchmarks

    def get(self, program, name):
        return self.benchmarks["bench_" + program, name]

    def ns(self, program, name, clock="cpu_time"):
        return self.get(program, name).per_unit(clock)

    def ratio(self, program, above, below, clock="cpu_time"):
        return self.ns(program, above, clock) / self.ns(program, below, clock)

    def spread(self, program, names):
        """Dearest against cheapest, as a share on top."""
        times = [self.ns(program, name) for name in names]
        return max(times) / min(times) - 1

    def sizes(self, prefix):
        names = [n for p, n in self.benchmarks if p == "bench_step" and n.startswith(prefix)]
        return [n for n in names if not prefix.startswith("size") or int(n.split("/")[-1]) >= 32]

    def all(self):
        """(what, comparison, bar, moonshot, unit, command, measure)"""
        step, alternatives = "step", "alternatives"
        yield ("water step, float, everything", "<=", 2.0, 1.3, "ns per spring-step",
               "bench_alternatives: library/float/128",
               lambda: self.ns(alternatives, "library/float/128"))
        yield ("water step against the tidy scalar float loop", ">=", 5, 7, "x",
               "bench_alternatives: scalar-tidy/float/128, library/float/128",
               lambda: self.ratio(alternatives, "scalar-tidy/float/128", "library/float/128"))
        yield ("land step (ground, friction) against water", "<=", 1.3, 1.0, "x",
               "bench_step: scene/land/float, scene/water/float",
               lambda: self.ratio(step, "scene/land/float", "scene/water/float"))
        for scene in ("water", "land"):
            yield (f"self-collision when nothing touches, {scene}", "<=", 0.15, 0.05, "on top",
                   f"bench_step: collision/disc/{scene}/collision, .../no-collision",
                   lambda scene=scene: self.ratio(step, f"collision/disc/{scene}/collision",
                                                  f"collision/disc/{scene}/no-collision") - 1)
        yield ("spread of the cost per spring-step, 32 to 256 cells", "<=", 0.20, 0.10, "on top",
               "bench_step: size/water/float/*",
               lambda: self.spread(step, self.sizes("size/water/float/")))
        yield ("spread of the cost per spring-step, batches of 1 to 10,000", "<=", 0.20, 0.10,
               "on top", "bench_step: batch/water/float/*",
               lambda: self.get(step, "batch/water/float/10000")
               and self.spread(step, self.sizes("batch/water/float/")))
        yield ("renewed triangulation against CGAL's from nothing", ">=", 5, 20, "x",
               "bench_development: triangulate, repair",
               lambda: self.ratio("development", "triangulate", "repair"))
        for opponent, how in (("cgal_moves", "moving the points of a kept one"),
                              ("cgal_insertion", "inserting anew, edges only")):
            yield (f"the same against CGAL {how}", ">=", 5, 20, "x",
                   f"bench_development: {opponent}, repair",
                   lambda opponent=opponent: self.ratio("development", opponent, "repair"))
        yield ("the same with the links chosen and listed", ">=", 5, 20, "x",
               "bench_development: renew_anew, renew",
               lambda: self.ratio("development", "renew_anew", "renew"))
        yield ("network inference, float, about 100 links", "<=", 15, 8, "ns per network-cell",
               "bench_development: infer<float>/256",
               lambda: self.ns("development", "infer<float>/256"))
        yield ("one development, 1200 steps, 256 cells at the end", "<=", 1.5, 0.7, "ms",
               "bench_development: develop/whole",
               lambda: self.ns("development", "develop/whole") / 1e6)
        for way in ("water-to-land", "land-to-water"):
            yield (f"one generation of 300, {way}, two threads", "<=", 1.5, 0.7, "s",
                   f"bench_generation: generation/{way}/threads:2",
                   lambda way=way: self.ns("generation", f"generation/{way}/threads:2",
                                           "real_time") / 1e9)
        for threads, bar, moonshot in ((2, 1.9, 2), (16, 14, 16)):
            for work in ("locomotion", "development"):
                yield (f"{work} on {threads} threads against one", ">=", bar, moonshot, "x",
                       f"bench_scaling: strong/{work}/threads:1, :{threads}",
                       lambda threads=threads, work=work: self.ratio(
                           "scaling", f"strong/{work}/threads:1",
                           f"strong/{work}/threads:{threads}", "real_time"))
        yield ("reproduction of 300 genomes", "<=", 3, 1, "ms", "bench_generation: reproduction",
               lambda: self.ns("generation", "reproduction") / 1e6)
        yield ("memory of a population of 300, largest while evaluating", "<=", 200, 50, "MB",
               "bench_generation: generation/water-to-land/threads:2",
               lambda: self.get("generation", "generation/water-to-land/threads:2")
               .counters()["peak_MB"])


def verdict(value, comparison, bar, moonshot):
    beats = (lambda limit: value <= limit) if comparison == "<=" else (lambda limit: value >= limit)
    return "moonshot" if beats(moonshot) else "met" if beats(bar) else "missed"


def machine_name():
    """The processor's name as part of a file name."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return re.sub(r"[^a-z0-9]+", "-", line.split(":", 1)[1].lower()).strip("-")
    return "processor"


def built_with(raw):
    """Compiler and instruction set of the build that the raw folder lies in."""
    cache = next((folder / "CMakeCache.txt" for folder in raw.resolve().parents
                  if (folder / "CMakeCache.txt").exists()), None)
    entries = dict(re.findall(r"^(\w+):\w+=(.*)$", cache.read_text(), re.M)) if cache else {}
    compiler = entries.get("CMAKE_CXX_COMPILER", "c++")
    version = subprocess.run([compiler, "-dumpfullversion", "-dumpversion"], capture_output=True,
                             text=True, check=False).stdout.strip()
    return f"{Path(compiler).name} {version}, -march={entries.get('METAMORPH_ARCH', 'native')}"


def crowding(benchmarks):
    """Wall time against CPU time of the benchmarks of one thread: 1 on an idle machine."""
    return statistics.median(b.per_unit("real_time") / b.per_unit("cpu_time")
                             for b in benchmarks.values() if b.clock() == "cpu_time")


def bars_table(rows, raw, crowded):
    """The bars as Markdown, with the machine they were measured on."""
    model = machine_name().replace("-", " ").upper()
    yield f"{model}, {os.cpu_count()} cores, {built_with(raw)}."
    if crowded > 1.1:
        yield (f"The machine was busy with other work: on one thread, {crowded:.1f} times more wall "
               "time than CPU time went by. Bars in wall time (generations, threads) say nothing in "
               "such a run, and shared caches and clock rates make the others worse.")
    yield ""
    yield "| what | bar | moonshot | measured | | benchmark |"
    yield "|---|---|---|---|---|---|"
    for what, comparison, bar, moonshot, measured, unit, judged, command in rows:
        sign = comparison.replace("<=", "≤").replace(">=", "≥")
        yield (f"| {what} | {sign} {bar:g} {unit} | {moonshot:g} | {measured or '–'} | {judged} "
               f"| `{command}` |")


ARRANGEMENTS = [
    ("library", "the library: `simulate()`, packing and checks included"),
    ("records", "its step alone: lane = node, 16-byte records, loads and transposition"),
    ("floor", "floor: the same arithmetic, neighbours read from contiguous arrays"),
    ("lane-is-node-hardware-gathers", "lane = node, hardware gathers"),
    ("scalar-tidy", "tidy scalar loop, arrays of structs"),
    ("scalar-plain-arrays", "scalar loop, plain arrays"),
    ("lane-is-animat", "lane = animat, `omp simd`, gathers and scatters"),
    ("reference", "reference simulator (double, clarity first)"),
]


def arrangements_table(benchmarks):
    """Time, cycles and instructions of every arrangement as Markdown."""
    yield "| arrangement | float: ns | cycles | instructions | double: ns | cycles | instructions |"
    yield "|---|---|---|---|---|---|---|"
    for name, label in ARRANGEMENTS:
        cells = []
        for precision in ("float", "double"):
            found = benchmarks.get(("bench_alternatives", f"{name}/{precision}/128"))
            counters = found.counters() if found else {}
            cells += [f"{found.per_unit('cpu_time'):.2f}" if found else "–"]
            cells += [f"{counters[k]:.1f}" if k in counters else "–"
                      for k in ("cycles", "instructions")]
        yield f"| {label} | {' | '.join(cells)} |"


def renew_table(page, marker, lines):
    text = page.read_text()
    table = "\n".join(lines)
    page.write_text(re.sub(rf"(<!-- {marker} -->\n).*?(<!-- end -->)",
                           lambda m: f"{m.group(1)}\n{table}\n\n{m.group(2)}", text, count=1,
                           flags=re.S))


def rounded(value):
    return "" if value is None else f"{value:.4g}"


def main():
    raw, out = Path(sys.argv[1]), Path(sys.argv[2])
    benchmarks, errors = read(raw)
    out.mkdir(parents=True, exist_ok=True)
    name = machine_name()

    with open(out / f"{name}.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["program", "benchmark", "unit", "cpu_ns_min", "cpu_ns_median",
                        "real_ns_min", "real_ns_median", "gflop_per_s", "repetitions", "counters"])
        for benchmark in benchmarks.values():
            table.writerow(
                [benchmark.program, benchmark.name, benchmark.unit]
                + [rounded(benchmark.per_unit(clock, choose))
                   for clock in ("cpu_time", "real_time") for choose in (min, statistics.median)]
                + [rounded(benchmark.gflop_per_s()), len(benchmark.runs),
                   " ".join(f"{k}={v:.6g}" for k, v in benchmark.counters().items())])

    rows = []
    for what, comparison, bar, moonshot, unit, command, measure in Bars(benchmarks).all():
        try:
            value = measure()
        except (KeyError, ValueError):
            measured, judged = "", "not measured"
        else:
            measured, judged = rounded(value), verdict(value, comparison, bar, moonshot)
        rows.append([what, comparison, bar, moonshot, measured, unit, judged, command])
        print(f"{judged:12}  {measured:>8} {unit:20} {comparison} {bar:<5} {what}")
    with open(out / f"{name}-bars.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["bar", "comparison", "limit", "moonshot", "measured", "unit", "verdict",
                        "benchmarks"])
        table.writerows(rows)
    if len(sys.argv) > 3:
        renew_table(Path(sys.argv[3]), "bars", bars_table(rows, raw, crowding(benchmarks)))
        renew_table(Path(sys.argv[3]), "arrangements", arrangements_table(benchmarks))
    for error in errors:
        print("FAILED", error)
    print(f"written: {out / name}.csv, {out / name}-bars.csv")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
