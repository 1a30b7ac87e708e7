"""The rules of the house as functions over a folder of files; each returns its breaches as lines of text."""
import re
import subprocess
from pathlib import Path

# Which floors a floor may include. Nothing runs back up; bekker_wong and dem never meet.
FLOORS = {
    "scenario": {"scenario"},
    "bekker_wong": {"scenario", "bekker_wong"},
    "dem": {"scenario", "dem"},
    "resistive_force": {"scenario", "dem", "resistive_force"},
    "cone_index": {"scenario", "cone_index"},
    "compare": {"scenario", "bekker_wong", "dem", "resistive_force", "cone_index", "compare"},
    "cli": {"scenario", "bekker_wong", "dem", "resistive_force", "cone_index", "compare", "cli"},
    "notebooks": {"scenario", "bekker_wong", "dem", "resistive_force", "cone_index", "compare", "notebooks"},
    "tests": {"scenario", "bekker_wong", "dem", "resistive_force", "cone_index", "compare", "cli", "tests"},
    "bench": {"scenario", "bekker_wong", "dem", "resistive_force", "cone_index", "compare", "bench"},
}

# Where a library's headers may be included: folders (ending in '/') and single files. A single file beside a folder's
# rule carries its reason.
LIBRARIES = {
    "gsl/": ["bekker_wong/gsl.cpp"],  # the wrapper: quadrature, roots, minima, distributions
    "yaml-cpp/": ["scenario/"],
    "Eigen/": ["scenario/", "bekker_wong/", "dem/surface/mass_properties.cpp", "compare/", "tests/", "bench/"],
    "nlohmann/": ["scenario/", "compare/", "cli/", "tests/", "bench/"],
    "fmt/": ["scenario/", "bekker_wong/", "dem/", "resistive_force/", "cone_index/", "compare/", "cli/", "notebooks/", "tests/", "bench/"],
    # mass properties: Gauss's rule; resistive force: a root in a bracket; the server: Beast and Asio
    "boost/": ["dem/surface/mass_properties.cpp", "resistive_force/wheel.cpp", "compare/", "cli/serve/server.cpp", "tests/"],
    "CLI/": ["cli/"],
    "librsvg/": ["cli/picture.cpp"],  # the wrapper: drawings as PNG and PDF
    "cairo": ["cli/picture.cpp"],
    "gtest/": ["tests/"],
    "gmock/": ["tests/"],
    "rapidcheck": ["tests/"],
    "benchmark/": ["bench/"],
    "sundials/": ["bekker_wong/transient/cvodes.cpp"],  # the wrapper
    "cvode": ["bekker_wong/transient/cvodes.cpp"],
    "nvector/": ["bekker_wong/transient/cvodes.cpp"],
    "sunmatrix/": ["bekker_wong/transient/cvodes.cpp"],
    "sunlinsol/": ["bekker_wong/transient/cvodes.cpp"],
    "hdf5": ["dem/", "tests/dem/hostile_archive_test.cpp"],  # the test: files made to do harm
    "H5": ["dem/"],
    "hwy/": ["dem/"],
    "assimp/": ["dem/"],
    "omp.h": ["dem/", "compare/"],
    "mpi.h": ["dem/worker_lammps/", "tests/dem/lammps/"],
    "lammps/": ["dem/worker_lammps/lammps.cpp"],  # the wrapper
    "zlib": ["compare/replay/", "compare/export/packed_files.cpp", "tests/"],
    "pybind11/": ["notebooks/"],
}

VAGUE_FOLDERS = {"utils", "util", "common", "core", "misc", "helpers", "helper"}
FEWEST_WORDS = 6  # of the comment that a header opens with
# Names the headers that C++ users include, in its table 'What to include': their opening comments show how they are
# called.
INTERFACES_PAGE = "docs/reference/cpp-api.md"
CPP = {".cpp", ".hpp", ".h", ".cc", ".ipp", ".cxx", ".hh", ".hxx", ".inl", ".inc", ".tpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
# Folders of one machine, or beside the checkout. Spelt in pieces, or this file would breach its own rule.
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:" + "|".join(("tmp", "work", "root", "farm", "home")) + r")/|\.\./" + "shared")


def project_files(root):
    """Files of the project, relative to its root: those that git tracks or would track, else all but build folders."""
    listed = subprocess.run(["git", "-c", f"safe.directory={root}", "-C", str(root), "ls-files", "-z", "--cached",
                             "--others", "--exclude-standard"], capture_output=True, check=False)
    if listed.returncode == 0:
        names = [Path(name) for name in listed.stdout.decode().split("\0") if name]
    else:
        names = [path.relative_to(root) for path in root.rglob("*")]
        names = [name for name in names if name.parts[0] not in ("build", ".git", ".ccache", "report")]
    return sorted(name for name in names if (root / name).is_file())


def includes(root, files):
    """(file, line number, quoted path or '', bracketed path or '') of each #include."""
    for name in files:
        if name.suffix in CPP:
            for number, line in enumerate((root / name).read_text(encoding="utf-8").splitlines(), 1):
                if found := INCLUDE.match(line):
                    yield name, number, found[1] or "", found[2] or ""


def floor_breaches(root, files):
    for name, number, quoted, bracketed in includes(root, files):
        floor = name.parts[0]
        if "consumer" in name.parts:  # a project of its own
            continue
        if "/" in bracketed and bracketed.split("/")[0] in FLOORS:  # not <compare>; the other rules look at what is quoted
            yield f"{name}:{number}: <{bracketed}> is the project's own: in quotes"
        if not quoted:
            continue
        target = quoted.split("/")[0]
        if floor not in FLOORS:
            yield f"{name}:{number}: C++ outside the floors {', '.join(FLOORS)}"
        elif "/" not in quoted or ".." in quoted:
            yield f'{name}:{number}: "{quoted}" is not written from the root of the project'
        elif target not in FLOORS[floor]:
            yield f'{name}:{number}: {floor} may not include "{quoted}"'


def library_breaches(root, files):
    for name, number, quoted, bracketed in includes(root, files):
        header = bracketed or quoted
        for library, places in LIBRARIES.items():
            if not quoted and header.startswith(library):
                if not any(str(name).startswith(place) if place.endswith("/") else str(name) == place for place in places):
                    yield f"{name}:{number}: <{header}> belongs to {', '.join(places)}"


def folder_breaches(_, files):
    folders = {parent for name in files for parent in name.parents}
    for folder in sorted(folders):
        if folder.name.lower() in VAGUE_FOLDERS:
            yield f"{folder}/: a folder's name says what is in it"


def folder_graph(root, files):
    """{folder: {folder it includes: "file -> header" that says so}}, of the floors' own folders."""
    graph = {}
    for name, _, quoted, _ in includes(root, files):
        if name.parts[0] in ("tests", "bench") or not quoted:
            continue
        folder, target = name.parent.as_posix(), Path(quoted).parent.as_posix()
        if folder != target and target.split("/")[0] in FLOORS:
            graph.setdefault(folder, {}).setdefault(target, f"{name} -> {quoted}")
    return graph


def circles(graph):
    """Each circle of folders once, shortest first to close: [a, b, ..., a]."""
    found, seen = [], set()
    for start in sorted(graph):
        if start in seen:
            continue
        ways, at = [[start]], {start}  # breadth first: the shortest way back to the start
        while ways:
            way = ways.pop(0)
            for target in sorted(graph.get(way[-1], {})):
                if target == start:
                    found.append(way + [start])
                    seen.update(way)
                    ways = []
                    break
                if target not in at:
                    at.add(target)
                    ways.append(way + [target])
    return found


def circle_breaches(root, files):
    graph = folder_graph(root, files)
    for circle in circles(graph):
        steps = ", ".join(graph[a][b] for a, b in zip(circle, circle[1:]))
        yield f"{' -> '.join(circle)}: a circle of folders ({steps})"


def order_breaches(root, files):
    """The table of folders below compare/ in design.md names each, and each includes those above it alone."""
    page = root / "design.md"
    if not page.is_file():
        return
    rows = re.search(r"^Below `?compare/.*?\n\n(\|.*?)\n\n", page.read_text(encoding="utf-8"), re.M | re.S)
    order = re.findall(r"^\| ([a-z_]+)/ \|", rows[1], re.M) if rows else []
    places = {f"compare/{folder}": place for place, folder in enumerate(order)}
    graph = {folder: targets for folder, targets in folder_graph(root, files).items() if folder.startswith("compare/")}
    there = {"/".join(name.parts[:2]) for name in files if name.parts[0] == "compare" and len(name.parts) > 2}
    for folder in sorted(there ^ set(places)):
        yield f"design.md: the table of folders below compare/ and the tree differ in {folder}/"
    for folder, targets in sorted(graph.items()):
        for target, step in sorted(targets.items()):
            if places.get(target, -1) > places.get(folder, len(places)):
                yield f"design.md: {target}/ stands below {folder}/, which includes it ({step})"


def opening_comment(text):
    lines = []
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        lines.append(line[2:])
    return lines


def interfaces(root):
    """Headers that the table 'What to include' names, in its order; none where there is no such page."""
    page = root / INTERFACES_PAGE
    if not page.is_file():
        return []
    section = re.search(r"^## What to include$(.*?)(?=^## |\Z)", page.read_text(encoding="utf-8"), re.M | re.S)
    rows = re.findall(r"^\|.*", section[1], re.M) if section else []
    return re.findall(r"`([\w/]+\.hpp)`", "\n".join(rows))


def shows_a_call(comment):
    """Whether indented lines hold code: a table or a drawing alone, which has no brackets, is no example."""
    return any(line.startswith("   ") and re.search(r"\w[({]|;", line) for line in comment)


def opening_breaches(root, files):
    called = interfaces(root)
    for name in sorted(set(called) - {str(name) for name in files}):
        yield f"{INTERFACES_PAGE}: names {name}, which is not there"
    for name in files:
        if name.suffix != ".hpp" or "consumer" in name.parts:
            continue
        comment = opening_comment((root / name).read_text(encoding="utf-8"))
        if sum(len(line.split()) for line in comment) < FEWEST_WORDS:
            yield f"{name}: opens without a comment that says what it holds, and why"
        if str(name) in called and not shows_a_call(comment):
            yield f"{name}: {INTERFACES_PAGE} names it: its opening comment shows an example of a call"


def machine_path_breaches(root, files):
    for name in files:
        try:
            text = (root / name).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            if found := MACHINE_PATH.search(line):
                yield f"{name}:{number}: '{found[0]}' is a path of one machine"


def effect_breaches(root, files):
    """An effect never names another: neither its forms nor, as a whole literal, its id."""
    effects = [name for name in files if name.parts[:2] == ("bekker_wong", "effects") and name.suffix == ".cpp"]
    texts = {name.stem: (name, (root / name).read_text(encoding="utf-8")) for name in effects}
    ids = {stem for stem, (_, text) in texts.items() if f"{stem}_forms()" in text}
    for stem in sorted(ids):
        name, text = texts[stem]
        for number, line in enumerate(text.splitlines(), 1):
            code = line.split("//")[0]
            for other in sorted(ids - {stem}):
                if re.search(rf'\b{other}_forms\b|"{other}"', code):
                    yield f"{name}:{number}: effect {stem} names effect {other}"


LOCALE = re.compile(r"\b(?:sto[df]|stold|strto[df]|strtold|atof)\s*\(")


def locale_breaches(root, files):
    """Numbers are read by read_number: in a Python with a locale of decimal commas the C library reads 18.4 as 18."""
    for name in files:
        if name.suffix not in CPP or name.parts[0] in ("tests", "bench"):
            continue
        for number, line in enumerate((root / name).read_text(encoding="utf-8").splitlines(), 1):
            if found := LOCALE.search(line.split("//")[0]):
                yield f"{name}:{number}: {found[0]}...) reads by the locale: read_number of scenario/quantity.hpp"


STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
SENTENCE_WORDS = 5
# Where sentences may be formatted beside telling/.
TOLD_ELSEWHERE = {
    "compare/report/",  # a page says that a replay can't be shown
    "compare/measured/time_log.cpp",  # to be told: which columns and rows it left aside
}


def statements(text):
    """The statements of C++ text, comments left out; braces and semicolons in strings part nothing."""
    code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith(("//", "#")))
    place = 0
    for found in re.finditer(r'"(?:[^"\\\n]|\\.)*"|[;{}]', code):
        if found[0] in ";{}":
            yield code[place:found.start()]
            place = found.end()


def sentence_breaches(root, files):
    """What is computed is a value: a sentence is formatted in telling/ alone, errors excepted."""
    for name in files:
        if name.parts[0] != "compare" or name.suffix != ".cpp" or "telling" in name.parts:
            continue
        if any(str(name).startswith(place) if place.endswith("/") else str(name) == place for place in TOLD_ELSEWHERE):
            continue
        for statement in statements((root / name).read_text(encoding="utf-8")):
            if "fmt::format" not in statement or re.search(r"\bthrow\b|Error\(|NoSolution\(", statement):
                continue
            text = "".join(STRING.findall(statement))
            words = re.findall(r"[A-Za-z]{2,}", re.sub(r"\{[^}]*\}", " ", text))
            if len(words) >= SENTENCE_WORDS and text.rstrip().endswith("."):
                yield f"{name}: formats the sentence '{text[:60]}': sentences are made in compare/telling/"


RULES = {
    "floors": floor_breaches,
    "libraries": library_breaches,
    "folder names": folder_breaches,
    "circles": circle_breaches,
    "order of compare": order_breaches,
    "opening comments": opening_breaches,
    "machine paths": machine_path_breaches,
    "effects": effect_breaches,
    "sentences": sentence_breaches,
    "locale": locale_breaches,
}
