"""Checks what the compiler cannot: which room includes which, and what lies at the top level.

usage: layout_test.py SOURCE_TREE
"""

import re
import sys
from pathlib import Path

ROOMS = ("kernels", "core", "evolve", "tests", "bench")
MAY_INCLUDE = {
    "kernels": {"kernels"},
    "core": {"core", "kernels"},
    "evolve": {"evolve", "core"},
    "tests": {"tests", "bench", "evolve", "core", "kernels"},
    "bench": {"bench", "evolve", "core", "kernels"},
}
TOP_LEVEL_FOLDERS = set(ROOMS)
TOP_LEVEL_FILES = {"CMakeLists.txt", "CMakePresets.json", "CMakeUserPresets.json", "README.md",
                   "LICENSE", "CHANGELOG.md"}
BUILT = {"build", "runs", "compile_commands.json"}  # made locally, ignored by git
LONG_FILE = 450  # lines
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def sources(room):
    return sorted(p for p in room.rglob("*") if p.suffix in (".h", ".cpp"))


def include_faults(name, room):
    """Lines of one include against the arrows or not written as "room/file.h"."""
    public_core = name == "core"
    for path in sources(room):
        relative = f"{name}/{path.relative_to(room)}"
        detail = path.suffix == ".cpp" or path.name.endswith("_detail.h")
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            quote, target = match.groups()
            first = target.split("/")[0]
            where = f"{relative}:{number}: "
            if quote == '"' and first not in ROOMS:
                yield where + f'"{target}" is not written as "room/file.h"'
            if first in ROOMS and first not in MAY_INCLUDE[name]:
                yield where + f"{name}/ may not include {target}"
            if public_core and first == "kernels" and not detail:
                yield where + f"a public header of core/ may not include {target}"


def top_level_faults(root):
    for path in sorted(root.iterdir()):
        name = path.name
        if name.startswith(".") or name in BUILT:
            continue
        allowed = TOP_LEVEL_FOLDERS if path.is_dir() else TOP_LEVEL_FILES
        if name not in allowed:
            yield f"{name}: not a name of the top level"
    for name in sorted(TOP_LEVEL_FOLDERS):
        if not (root / name).is_dir():
            yield f"{name}/: missing"


def long_files(root):
    for name in ROOMS:
        for path in sources(root / name):
            count = len(path.read_text().splitlines())
            if count > LONG_FILE:
                yield f"{path.relative_to(root)}: {count} lines"


def self_test():
    """The scan must see a fault, or its silence means nothing."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        room = Path(folder) / "kernels"
        room.mkdir()
        (room / "a.h").write_text('#include <cmath>\n#include "core/body.h"\n  # include "b.h"\n')
        assert len(list(include_faults("kernels", room))) == 2
        core = Path(folder) / "core"
        core.mkdir()
        for name in ("a.h", "a_detail.h", "a.cpp"):
            (core / name).write_text('#include "kernels/a.h"\n')
        assert len(list(include_faults("core", core))) == 1
        (Path(folder) / "stray.txt").write_text("")
        assert len(list(top_level_faults(Path(folder)))) == 4


def main():
    root = Path(sys.argv[1])
    self_test()
    faults = [fault for name in ROOMS for fault in include_faults(name, root / name)]
    faults += top_level_faults(root)
    for line in long_files(root):
        print("long file, worth a look:", line)
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()
