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
# Folders of core, and which others each may include. A public header stands with the folder whose
# files implement it.
CORE_MAY_INCLUDE = {
    "body": set(),
    "development": {"body"},
    "locomotion": {"body"},
    "reference": {"body", "locomotion"},
    "example": {"body", "development", "locomotion", "reference"},
}
PUBLIC_OF_CORE = {
    "body": ("body", "named", "shape", "status", "threads"),
    "development": ("development", "extraction", "network", "signals"),
    "locomotion": ("automatic_step", "locomotion", "motion", "outcome", "outcome_fields",
                   "scene", "scene_fields", "stability", "step_refusal"),
    "reference": ("reference",),
}
# Folders of evolve that are to know no more of it than this, whoever includes them.
EVOLVE_MAY_INCLUDE = {
    "files": {"files"},
    "view": {"view", "files"},
    "study": {"study", "run", "experiment", "files", "view"},
}
# And folders of evolve that only these may include.
EVOLVE_INCLUDED_BY = {"study": {"study", "app"}}
TOP_LEVEL_FOLDERS = set(ROOMS)
TOP_LEVEL_FILES = {"CMakeLists.txt", "CMakePresets.json", "CMakeUserPresets.json", "README.md",
                   "LICENSE", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "Doxyfile",
                   "pyproject.toml"}
BUILT = {"build", "runs", "compile_commands.json"}  # made locally, ignored by git
LONG_FILE = 450  # lines
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def sources(room):
    return sorted(p for p in room.rglob("*") if p.suffix in (".h", ".cpp"))


def public_headers(root):
    """Of each public header, as it is included: the room that has it."""
    return {f"metamorph/{path.name}": name for name in ROOMS
            for path in (root / name / "include" / "metamorph").glob("*.h")}


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, *match.groups()


def include_faults(name, room, public):
    """Lines of one include against the arrows or not written as "room/folder/file.h"."""
    for path in sources(room):
        relative = f"{name}/{path.relative_to(room)}"
        is_public = path.parent == room / "include" / "metamorph"
        is_example = path.parent == room / "example"
        for number, quote, target in includes(path):
            first = public.get(target, target.split("/")[0])
            where = f"{relative}:{number}: "
            if quote == '"' and first not in ROOMS:
                yield where + f'"{target}" is not written as "room/folder/file.h"'
            if first in ROOMS and first not in MAY_INCLUDE[name]:
                yield where + f"{name}/ may not include {target}"
            if is_public and first in ROOMS and target not in public:
                yield where + f"a public header may include public ones only, not {target}"
            if is_example and first in ROOMS and target not in public:
                yield where + f"an example may include public headers only, not {target}"


def folder_of(target):
    """The folder of core that an include or a file of it belongs to; None if it is none of core."""
    parts = target.split("/")
    if parts[0] == "metamorph":
        stem = Path(parts[1]).stem
        return next((f for f, names in PUBLIC_OF_CORE.items() if stem in names), None)
    return parts[1] if parts[0] == "core" and len(parts) > 2 else None


def core_faults(core):
    """Includes between the folders of core against the arrows, and cycles of headers."""
    graph = {}
    for path in sources(core):
        relative = path.relative_to(core)
        public = relative.parts[0] == "include"
        file = f"metamorph/{path.name}" if public else f"core/{relative}"
        own = folder_of(file)
        if own not in CORE_MAY_INCLUDE:
            yield f"core/{relative}: lies in none of {', '.join(CORE_MAY_INCLUDE)}"
            continue
        for number, _, target in includes(path):
            other = folder_of(target)
            if other is None:
                continue
            graph.setdefault(file, []).append(target)
            if other != own and other not in CORE_MAY_INCLUDE[own]:
                yield f"core/{relative}:{number}: {own}/ may not include {target} of {other}/"
    yield from cycles(graph)


def evolve_faults(evolve):
    """Includes between the folders of evolve against the arrows."""
    for path in sources(evolve):
        relative = path.relative_to(evolve)
        own = relative.parts[0]
        for number, _, target in includes(path):
            parts = target.split("/")
            if parts[0] != "evolve" or len(parts) < 3:
                continue
            if (parts[1] not in EVOLVE_MAY_INCLUDE.get(own, {parts[1]})
                    or own not in EVOLVE_INCLUDED_BY.get(parts[1], {own})):
                yield f"evolve/{relative}:{number}: {own}/ may not include {target}"


def cycles(graph):
    done = set()

    def visit(file, path):
        if file in path:
            yield "includes go in a circle: " + " -> ".join(path[path.index(file):] + [file])
        elif file not in done:
            for target in graph.get(file, ()):
                yield from visit(target, path + [file])
            done.add(file)

    for file in graph:
        yield from visit(file, [])


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

    def write(root, name, *lines):
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("".join(f'#include "{line}"\n' for line in lines))

    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        write(root, "kernels/a.h", "core/body/edge_uses.h", "b.h")
        write(root, "core/include/metamorph/body.h", "core/body/parts.h")
        write(root, "core/body/parts.h", "metamorph/body.h", "core/locomotion/runner.h")
        write(root, "core/locomotion/runner.h", "core/development/links.h", "kernels/a.h")
        write(root, "core/stray.h", "metamorph/body.h")
        write(root, "evolve/view/chart.h", "evolve/run/run_reader.h", "evolve/files/output_file.h")
        write(root, "evolve/run/run.cpp", "evolve/study/curves.h", "evolve/run/run.h")
        write(root, "core/example/bodies.cpp", "metamorph/body.h", "core/body/parts.h")
        public = public_headers(root)
        assert len(list(include_faults("kernels", root / "kernels", public))) == 2
        assert len(list(include_faults("core", root / "core", public))) == 2
        # parts to runner, runner to links, stray; body and parts include each other.
        assert len(list(core_faults(root / "core"))) == 4
        assert len(list(evolve_faults(root / "evolve"))) == 2
        (root / "stray.txt").write_text("")
        assert len(list(top_level_faults(root))) == 3


def main():
    root = Path(sys.argv[1])
    self_test()
    public = public_headers(root)
    faults = [fault for name in ROOMS for fault in include_faults(name, root / name, public)]
    faults += core_faults(root / "core")
    faults += evolve_faults(root / "evolve")
    faults += top_level_faults(root)
    for line in long_files(root):
        print("long file, worth a look:", line)
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()
