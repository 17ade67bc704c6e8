"""Checks that pages and code speak of what there is: sections that comments cite, files that pages
name, links between pages, pictures that a page shows, one version,
the model's numbers.

usage: pages_test.py SOURCE_TREE
"""

import re
import sys
from pathlib import Path

ROOMS = ("kernels", "core", "evolve", "tests", "bench")
PAGES = {"MODEL": "core/MODEL.md", "NUMERICS": "kernels/NUMERICS.md"}
# What happened is told in the names of its time.
TELLS_OF_THE_PAST = {"CHANGELOG.md"}
CODE = {".h", ".cpp", ".py", ".sh", ".txt", ".cmake", ".toml", ".md"}
PICTURES = {".png", ".svg", ".jpg", ".gif"}
VERSIONS = {"CMakeLists.txt": r"^project\(metamorph VERSION ([\d.]+)",
            "CITATION.cff": r"^version: ([\d.]+)$",
            "CHANGELOG.md": r"^## \[(\d[\d.]*)\]"}
# What the model's page says of a number of the code.
NUMBERS = {
    "core/include/metamorph/scene.h": {
        "damping": "c = {}, c_p", "pressure": "c_p = {},", "amplitude": "A = {} ",
        "min_pressure_area": "S0 < {} d^2", "drag_normal": "d_N = {},",
        "drag_tangential": "d_T = {} ", "gravity": "gravity g = {},",
        "friction": "mu = {} on flat land", "collision_stiffness": "k_s = {},",
        "collision_gap": "min({} d, the gap at rest)", "collision_least_gap": "min({} d, theta/2)",
        "step": "step is {} in water", "run_steps": "{} steps of actuation",
        "ramp_steps": "over the first {} steps", "settle_step": "Symplectic Euler at {},",
        "settle_damping": "c = {} and a drag", "settle_drag": "a drag of {} v",
        "settle_speed": "below a speed of {} for", "settle_quiet_steps": "for {} steps.",
        "settle_max_steps": "After {} steps,"},
    "core/locomotion/scene.cpp": {
        "step": "and {} on land", "friction": "and {} on the slope",
        "settle_range": "has gone {} d along x", "slope_degrees": "{} degrees **[P 4.7]**"},
    "core/include/metamorph/development.h": {
        "max_cells": "At most {} living cells", "renew_interval": "Renewal if {} divides s",
        "update_interval": "update if {} divides s", "drag": "b = {} **[O]**",
        "step": "One symplectic Euler step of {} per paper step", "link_limit": "longer than {} d",
        "division_space": "within {} d of that point", "coordinate_scale": "divided by {} d",
        "period_min": "T_min = {},", "period_max": "T_max = {} time units"},
    "evolve/include/metamorph/neat_settings.h": {
        "population": "**Population**: {},", "hidden_nodes": "{} hidden nodes",
        "initial_weight": "Weights are {} (u - u')", "species_min": "`species_min` = {} species",
        "species_max": "`species_max` = {},", "compatibility_threshold": "which starts at {},",
        "compatibility_step": "falls by {} per generation", "young_bonus": "times {} in species",
        "weight_difference_factor": "plus {} times the mean difference",
        "young_age": "younger than {} generations", "old_age": "older than {},",
        "stagnation": "new best for {} generations", "survival_share": "floor({} n) + 1",
        "crossover": "two parents with probability {} ", "interspecies_crossover": "with {})",
        "mutation_after_crossover": "with {} if two", "mutate_weights": "| weights | {} |", "severe": "`severe` = {} of",
        "species_members": "population / {} **[O]**", "node_weight": "incoming {}, since",
        "multipoint": "(probability {} of this kind", "add_link": "| add link | {} |",
        "add_node": "| add node | {} |", "remove_link": "| remove link | {} |",
        "weight_limit": "within {};", "clone_tries": "bred again, {} times at most"},
    "evolve/search/novelty.h": {
        "neighbours": "k = {} nearest", "archive_threshold": "starts at {} d",
        "archive_floor": "is {} d at least", "archive_many": "more than {} additions",
        "archive_idle": "after {} generations without one"},
    "evolve/include/metamorph/evaluator.h": {
        "created_limit": "More than {} cells ever created", "created_penalty": "fitness times {}.",
        "min_cells": "Fewer than {} nodes", "start_displacement": "`start_displacement` = {} d"},
}
CITATION = re.compile(r"\b(MODEL|NUMERICS) sections? (\d+)(?:, tests? ([\d, ]+\d))?")
HEADING = re.compile(r"^## (\d+)\. ", re.M)
ROW = re.compile(r"^\| *(\d[\d, -]*) *\|", re.M)
NAMED = re.compile(rf"(?<![\w/.-])(?:(?:{'|'.join(ROOMS)})/[\w.*/-]*[\w*/]|metamorph/\w+\.h)")
LINK = re.compile(r"\]\(([^)\s]+)\)")


def files(root, suffixes):
    """Files of the rooms and of the top level."""
    found = [path for path in root.iterdir() if path.is_file()]
    for room in ROOMS:
        found += (root / room).rglob("*")
    return sorted(path for path in found if path.is_file() and path.suffix in suffixes)


def joined(text):
    """The text with comments that were broken into lines in one piece."""
    return re.sub(r"\s*\n\s*(?:///?|#)?\s*", " ", text)


def numbers(row):
    """[10, 11, 12] of "10-12", [22, 23] of "22, 23"."""
    for part in row.split(","):
        ends = [int(end) for end in part.split("-")]
        yield from range(ends[0], ends[-1] + 1)


def sections(page):
    return {int(number) for number in HEADING.findall(page)}


def listed_tests(page, section):
    """Numbers in the first column of a section's tables."""
    part = re.split(r"^## ", page, flags=re.M)
    of_section = next((text for text in part if text.startswith(f"{section}. ")), "")
    return {number for row in ROW.findall(of_section) for number in numbers(row)}


def citation_faults(root):
    pages = {name: (root / path).read_text() for name, path in PAGES.items()}
    for path in files(root, CODE):
        for name, section, tests in CITATION.findall(joined(path.read_text())):
            where = f"{path.relative_to(root)}: cites {name} section {section}"
            if int(section) not in sections(pages[name]):
                yield f"{where}, {PAGES[name]} has none"
                continue
            for test in numbers(tests) if tests else ():
                if test not in listed_tests(pages[name], int(section)):
                    yield f"{where}, test {test}, {PAGES[name]} lists none"


def name_faults(root):
    """Files and folders that pages name and that are not there. NAME stands for any name."""
    for path in files(root, {".md"}):
        if path.name in TELLS_OF_THE_PAST:
            continue
        for name in NAMED.findall(path.read_text()):
            pattern = name.replace("NAME", "*")
            if name.startswith("metamorph/"):
                there = any((root / room / "include" / name).is_file() for room in ROOMS)
            else:
                there = any(root.glob(pattern.rstrip("/"))) or any(root.glob(pattern + ".*"))
            if not there:
                yield f"{path.relative_to(root)}: names {name}, there is none"


def link_faults(root):
    for path in files(root, {".md"}):
        for target in LINK.findall(path.read_text()):
            if re.match(r"\w+:|#", target):
                continue
            if not (path.parent / target.split("#")[0]).exists():
                yield f"{path.relative_to(root)}: links to {target}, there is none"


def picture_faults(root):
    """Pictures in the repository that no page shows."""
    shown = {(path.parent / target).resolve() for path in files(root, {".md"})
             for target in LINK.findall(path.read_text())}
    for path in files(root, PICTURES):
        if path.resolve() not in shown:
            yield f"{path.relative_to(root)}: a picture that no page shows"


def version_faults(root):
    """The build, CITATION.cff and the newest release of CHANGELOG.md have one version."""
    told = {}
    for name, pattern in VERSIONS.items():
        match = re.search(pattern, (root / name).read_text(), re.M)
        told[name] = match.group(1) if match else None
    if len(set(told.values())) != 1 or None in told.values():
        yield "versions differ: " + ", ".join(f"{name} {version}" for name, version in told.items())


def number_faults(root):
    """Numbers of the model's page that are not those of the code."""
    page = " ".join((root / PAGES["MODEL"]).read_text().split())
    for file, numbers_of_file in NUMBERS.items():
        code = (root / file).read_text() if (root / file).is_file() else ""
        for member, phrase in numbers_of_file.items():
            match = re.search(rf"\b{member} = ([\d.e-]+);", code)
            value = f"{float(match.group(1)):g}" if match else "?"
            if phrase.format(value) not in page:
                yield (f"{file}: {member} = {value}, but {PAGES['MODEL']} does not say "
                       f'"{phrase.format(value)}"')


def self_test():
    """The scan must see a fault, or its silence means nothing."""
    import tempfile

    def write(root, name, text):
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        write(root, "core/MODEL.md", "## 1. Units\n## 4. Locomotion\n[n](../kernels/NUMERICS.md)")
        write(root, "kernels/NUMERICS.md", "## 8. Tests\n| # | a |\n| 2 | b |\n| 10-12 | c |\n")
        write(root, "core/include/metamorph/body.h", "/// (MODEL section\n/// 4), MODEL section 1")
        write(root, "tests/a.cpp", "// NUMERICS section 8, tests 2,\n// 11 (NUMERICS section 8).")
        write(root, "README.md", "`core/MODEL.md`, `metamorph/body.h`, tests/NAME.cpp `build/core/x`")
        assert [*citation_faults(root), *name_faults(root), *link_faults(root)] == []
        write(root, "tests/b.cpp", "// MODEL section\n  // 5; NUMERICS section 8, test 2, 3\n")
        write(root, "README.md", "`core/model.md` `metamorph/no.h` ![p](a.png) [q](http://a.b)")
        assert len(list(citation_faults(root))) == 2
        assert len(list(name_faults(root))) == 2
        assert len(list(link_faults(root))) == 1
        write(root, "core/a.png", "")
        write(root, "a.png", "")
        assert len(list(picture_faults(root))) == 1
        write(root, "CMakeLists.txt", "project(metamorph VERSION 1.2.0 LANGUAGES CXX)")
        write(root, "CITATION.cff", "cff-version: 1.2.0\nversion: 1.2.0\n")
        write(root, "CHANGELOG.md", "## [Unreleased]\n\n## [1.2.0] - 2026-01-01\n## [1.1.0]\n")
        assert [*version_faults(root)] == []
        for file, members in NUMBERS.items():
            write(root, file, "".join(f"double {member} = 0.5;\n" for member in members))
        write(root, "core/MODEL.md", "\n".join(phrase.format("0.5") for members in
                                               NUMBERS.values() for phrase in members.values()))
        assert [*number_faults(root)] == []
        write(root, "evolve/search/novelty.h", "int neighbours = 14;")
        assert len(list(number_faults(root))) == len(NUMBERS["evolve/search/novelty.h"])
        write(root, "CITATION.cff", "version: 1.1.0\n")
        assert len(list(version_faults(root))) == 1


def main():
    root = Path(sys.argv[1])
    self_test()
    faults = [*citation_faults(root), *name_faults(root), *link_faults(root),
              *picture_faults(root), *version_faults(root),
              *number_faults(root)]
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()
