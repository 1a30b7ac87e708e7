"""Compiles each source file of the floors by itself, without writing an object: a missing #include or a warning is an
error. The other builds join files, and so would not see what a file borrows from its neighbour. Headers that a floor
precompiles (CMakeLists.txt of compare and cli) are there in every build, so a file that leaves one of them out passes.
The bindings of the notebooks are left out: they are a fifth of the time, and what is missing there harms nobody else.

Usage: each_file.py BUILD_FOLDER       of the configured preset 'strict'; exit status 1 where a file fails
"""
import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FLOORS = {"scenario", "bekker_wong", "resistive_force", "cone_index", "dem", "compare", "cli"}


def checks(build):
    """Each source file once: its path below the project, the folder to compile in, and the command."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    root = build.parent.parent
    found = {}
    for entry in entries:
        file = Path(entry["file"])
        if not file.is_relative_to(root) or file.relative_to(root).parts[0] not in FLOORS:
            continue  # tests, bindings, and what the build itself writes
        words = shlex.split(entry["command"])
        at = words.index("-o")
        found.setdefault(file.relative_to(root), (entry["directory"], words[:at] + words[at + 2:] + ["-fsyntax-only"]))
    return [(name, *rest) for name, rest in sorted(found.items())]


def precompile(build):
    """The headers that a floor precompiles, and the one that the build writes."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    for entry in entries:
        file = Path(entry["file"])
        if file.name == "cmake_pch.hxx.cxx" and file.relative_to(build).parts[0] in FLOORS:
            subprocess.run(shlex.split(entry["command"]), cwd=entry["directory"], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "soilbin_source_state"], check=True)


def main(build):
    def compiles(check):
        name, folder, command = check
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        return name, done.returncode, done.stderr

    todo = checks(build)
    if not todo:
        sys.exit(f"{build}: no source files")
    precompile(build)
    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, status, errors in pool.map(compiles, todo):
            if status != 0:
                failed += 1
                print(f"{name} does not compile by itself:\n{errors}")
    print(f"{len(todo)} files, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve()))
