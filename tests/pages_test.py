"""Checks that pages and code speak of what there is: sections that comments cite, files that pages
name, links between pages, pictures that a page shows, one version.

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
        write(root, "CITATION.cff", "version: 1.1.0\n")
        assert len(list(version_faults(root))) == 1


def main():
    root = Path(sys.argv[1])
    self_test()
    faults = [*citation_faults(root), *name_faults(root), *link_faults(root),
              *picture_faults(root), *version_faults(root)]
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()
