"""Compiles each source file of the floors by itself, without writing an object: a missing #include of the project's or a
warning is an error. The other builds join files, and so would not see what a file borrows from its neighbour.

The libraries' headers are precompiled once for the files of each target, so what is missed is a library's header that a
file forgets: the joined build has it from elsewhere.

Usage: each_file.py BUILD_FOLDER       of the configured preset 'strict'; exit status 1 where a file fails
"""
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FLOORS = {"scenario", "bekker_wong", "dem", "compare", "cli", "notebooks"}


def checks(build):
    """Each source file once: its path below the project, the folder to compile in, and the command."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    root = build.parent.parent
    found = {}
    for entry in entries:
        file = Path(entry["file"])
        if not file.is_relative_to(root) or file.relative_to(root).parts[0] not in FLOORS:
            continue  # tests, and what the build itself writes
        words = shlex.split(entry["command"])
        at, source = words.index("-o"), words.index("-c")
        found.setdefault(file.relative_to(root), (entry["directory"], words[:at] + words[at + 2:source]))
    return [(name, folder, command) for name, (folder, command) in sorted(found.items())]


def library_headers(root, files):
    """The libraries' headers that these files include before anything that could change what they mean."""
    found = set()
    for file in files:
        for line in (root / file).read_text(encoding="utf-8").splitlines():
            if re.match(r"#\s*(define|if)", line):
                break
            if include := re.match(r"#include (<[^>]+>)", line):
                found.add(include[1])
    return sorted(found, key=lambda header: ("." in header or "/" in header, header))  # the standard ones first


def precompiled(root, build, todo):
    """For each command what to put behind it so that it takes the precompiled header of its target."""
    targets = {}
    for name, folder, command in todo:
        targets.setdefault((folder, tuple(command)), []).append(name)
    into = build / "precompiled"
    into.mkdir(exist_ok=True)

    def make(number, folder, command, files):
        beside = {hpp.relative_to(root) for parent in {f.parent for f in files} for hpp in (root / parent).glob("*.hpp")}
        header = into / f"{number}.hpp"
        header.write_text("".join(f"#include {h}\n" for h in library_headers(root, [*files, *beside])), encoding="utf-8")
        words = [*command, "-w", "-x", "c++-header", "-c", str(header), "-o", f"{header}.gch"]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"the libraries' headers of {files[0].parent} do not compile together:\n{done.stderr}")
        return ["-include", str(header), "-Winvalid-pch"]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        made = pool.map(lambda n, item: make(n, *item[0], item[1]), range(len(targets)), targets.items())
        return dict(zip(targets, made))


def main(build):
    root = build.parent.parent
    todo = checks(build)
    if not todo:
        sys.exit(f"{build}: no source files")
    headers = precompiled(root, build, todo)

    def compiles(check):
        name, folder, command = check
        words = [*command, *headers[(folder, tuple(command))], "-fsyntax-only", str(root / name)]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        return name, done.returncode, done.stderr

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
