"""Has a compiler look at every source file of a configured build, and writes nothing.

usage: syntax_check.py BUILD_FOLDER [JOBS]

BUILD_FOLDER has a compile_commands.json. Prints what the compiler says; exits with 1 if it refuses
a file. Sources that the build makes itself are left out.
"""

import json
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def look_at(entry):
    """Whether a file is taken."""
    command = shlex.split(entry["command"])
    at = command.index("-o")
    del command[at:at + 2]
    done = subprocess.run([*command, "-fsyntax-only"], cwd=entry["directory"], check=False,
                          capture_output=True, text=True)
    if done.stderr:
        print(done.stderr, flush=True)
    return done.returncode == 0


def main():
    folder = Path(sys.argv[1])
    entries = json.loads((folder / "compile_commands.json").read_text())
    entries = [entry for entry in entries if Path(entry["file"]).exists()]
    with ThreadPoolExecutor(int(sys.argv[2]) if len(sys.argv) > 2 else 1) as pool:
        taken = list(pool.map(look_at, entries))
    print(f"{sum(taken)} of {len(taken)} files")
    return 0 if taken and all(taken) else 1


if __name__ == "__main__":
    sys.exit(main())
