"""Runs the commands that a document shows, and compares what they print with what it says they print.

    run_readme.py PROJECT_ROOT SOILBIN DOCUMENT

A ```console block holds lines '$ command' (going on over lines that end in a backslash), each followed by the output it
prints, or by none where the document shows none. '...' stands for anything within a line, a line '...' for any lines.
A comment before the block changes that:

    <!-- exit 2 -->            the last command of the block ends with this status, not with 0
    <!-- not run: why -->      the block is left alone

Commands run in order in a fresh folder that holds cases/, the tutorial's data (docs/guide/first-campaign) and, as
build/release/soilbin and in the PATH, the command.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

TIME_LIMIT = 120  # [s] of one command


@dataclass
class Command:
    line: int
    text: str
    status: int = 0
    output: list[str] = field(default_factory=list)


def commands_of(document):
    """The commands of a document's console blocks, in order."""
    found, block, status, skip = [], None, 0, False
    for number, line in enumerate(document.splitlines(), 1):
        if block is None:
            if line.strip() == "```console":
                block = []
            elif line.strip():
                exit_mark = re.fullmatch(r"<!-- exit (\d+) -->", line.strip())
                status = int(exit_mark[1]) if exit_mark else 0
                skip = line.startswith("<!-- not run: ")
        elif line.strip() == "```":
            if block:
                block[-1].status = status
            found += [] if skip else block
            block, status, skip = None, 0, False
        elif line.startswith("$ "):
            block.append(Command(number, line[2:]))
        elif block and not block[-1].output and block[-1].text.endswith("\\"):
            block[-1].text += "\n" + line
        elif block:
            block[-1].output.append(line)
        else:
            raise ValueError(f"line {number}: a console block begins with '$ command'")
    if block is not None:
        raise ValueError("a console block doesn't end")
    return found


def pattern_of(lines):
    """What output must match to be these lines."""
    pieces = []
    for line in lines:
        pieces.append(r"(?:.*\n)*?" if line.strip() == "..." else ".*".join(map(re.escape, line.rstrip().split("..."))) + r" *\n")
    return re.compile("".join(pieces))


def fault_of(command, folder, environment):
    """Runs a command; what is wrong with it, or nothing."""
    try:
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", command.text], cwd=folder, env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return f"took longer than {TIME_LIMIT} s"
    if done.returncode != command.status:
        return f"ended with {done.returncode}, not {command.status}, and printed\n{done.stdout}"
    while command.output and not command.output[-1].strip():
        command.output.pop()
    printed = done.stdout.rstrip("\n") + "\n"
    if command.output and not pattern_of(command.output).fullmatch(printed):
        return f"printed\n{printed}"
    return ""


def run(root, soilbin, document):
    """Number of commands that ran, and the faults found."""
    commands = commands_of(document.read_text(encoding="utf-8"))
    faults = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for needed in ("cases", "docs/guide/first-campaign"):
            shutil.copytree(root / needed, folder / needed)
        (folder / "build/release").mkdir(parents=True)
        (folder / "build/release/soilbin").symlink_to(soilbin)
        environment = {"PATH": f"{folder / 'build/release'}:/usr/bin:/bin", "LC_ALL": "C.UTF-8"}
        for command in commands:
            if fault := fault_of(command, folder, environment):
                faults.append(f"{document}:{command.line}: $ {command.text}\n{fault}")
    return len(commands), faults


def main():
    root, soilbin, document = (Path(os.path.abspath(argument)) for argument in sys.argv[1:4])
    count, faults = run(root, soilbin, document)
    for fault in faults:
        print(fault)
    print(f"{document.name}: {count - len(faults)} of {count} commands do as the document says")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
