"""The documents as a site: docs/site/make, output in build/docs. Sphinx, MyST (Markdown) and Furo, all of Debian 12.

The pages are the Markdown files as they lie in the project; nothing is written a second time. Added here: the table of
contents, from the folders; formulas as MathML, which browsers draw without a script or a network; the Python
reference, from the docstrings, where the package is built; the C++ reference, from the headers (cpp_reference.py); the
list of commands, which the command writes, where it is built; links to notebooks, which become links to their exported pages; and links to files that are no pages, which become
their names.
"""
import importlib.util
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
project, author, language = "soilbin", "the soilbin authors", "en"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
sys.path[:0] = [str(ROOT / "build/release/python"), str(ROOT / "docs/site")]
mathml = importlib.import_module("formula").mathml
COMMANDS = ROOT / "build/release/share/commands.md"  # written by the build
MODULES = ("soilbin", "soilbin.bekker_wong", "soilbin.dem", "soilbin.compare")
# a build of the command alone leaves an empty folder soilbin, which Python takes for a package without a file
HAS_PACKAGE = all(getattr(importlib.util.find_spec(name), "origin", None) for name in ("soilbin", "pandas"))
nitpick_ignore_regex = [("py:.*", ".*")]  # signatures name types that are not documented by themselves
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4  # links to headings, by the names that GitHub gives them
suppress_warnings = ["myst.header"]
root_doc = "README"
include_patterns = ["*.md", "docs/**.md"]
exclude_patterns = ["build/**", "**/NOTICE.md"]
html_theme = "furo"
html_title = "soilbin"
html_copy_source = html_show_sourcelink = False
html_math_renderer = "mathml"
html_theme_options = {"sidebar_hide_name": False}
highlight_language = "text"

SHELVES = (("Guide", "docs/guide"), ("Theory", "docs/theory"), ("Reference", "docs/reference"), ("Lab book", "docs/lab"),
           ("More", "docs"), ("The project", "."))


def contents():
    """Hidden tables of contents, a shelf each, for the sidebar: first the pages that docs/index.md names, in its order."""
    index = (ROOT / "docs/index.md").read_text(encoding="utf-8")
    named = [link.split("#")[0] for link in re.findall(r"\]\(([^)]+\.md[^)]*)\)", index)]
    order = {(ROOT / "docs" / link).resolve(): place for place, link in reversed(list(enumerate(named)))}
    for title, folder in SHELVES:
        pages = sorted((ROOT / folder).glob("*.md"), key=lambda page: (order.get(page, len(order)), page.name))
        names = [page.relative_to(ROOT).with_suffix("").as_posix() for page in pages if page != ROOT / "README.md"]
        if names:
            yield "\n".join(["```{toctree}", ":hidden:", f":caption: {title}", "", *("/" + name for name in names), "```"])


def prepare(app, name, source):
    """Links to what is no page become its name; the front page gets the table of contents."""
    page = ROOT / f"{name}.md"

    def link(match):
        target = (page.parent / match[2].split("#")[0]).resolve()
        if target.suffix == ".ipynb" and target.exists():  # its page, where docs/site/make has exported it
            lesson = Path(app.outdir) / "notebooks" / f"{target.stem}.html"
            up = "../" * len(page.relative_to(ROOT).parent.parts)
            return f'<a href="{up}notebooks/{lesson.name}">{match[1]}</a>' if lesson.is_file() else match[1]
        is_page = target.suffix == ".md" and target.name != "NOTICE.md" and (target.parent == ROOT or ROOT / "docs" in target.parents)
        return match[1] if target.exists() and not is_page and not match[2].startswith("#") else match[0]

    # code in blocks stays as it is
    parts = re.split(r"(^```.*?^```[^\n]*$)", source[0], flags=re.S | re.M)
    parts[::2] = [re.sub(r"(?<!!)\[([^\]]+)\]\(((?!https?:)[^)\s]+)\)", link, part) for part in parts[::2]]
    source[0] = "".join(parts)
    if name.endswith("python-api") and HAS_PACKAGE:
        seen = set()
        for module in MODULES:
            of = importlib.import_module(module)
            public = {member: getattr(of, member) for member in of.__all__ if not member.startswith("_")}
            ours = {member: (getattr(value, "__module__", ""), getattr(value, "__qualname__", member)) for member, value in public.items()}
            public = [member for member in public if ours[member] not in seen]
            seen.update(ours.values())
            source[0] += f"\n\n## {module}\n\n```{{eval-rst}}\n.. automodule:: {module}\n   :members: {', '.join(public)}\n```\n"
    if name.endswith("commands") and COMMANDS.is_file():
        source[0] = COMMANDS.read_text(encoding="utf-8")
    if name.endswith("cpp-api"):
        source[0] += "\n\n" + importlib.import_module("cpp_reference").reference_text(ROOT, page.read_text(encoding="utf-8"))
    if name == root_doc:
        source[0] += "\n\n" + "\n\n".join(contents()) + "\n"


def inline_formula(writer, node):
    write_formula(writer, node, False)


def displayed_formula(writer, node):
    write_formula(writer, node, True)


def write_formula(writer, node, display):
    from docutils.nodes import SkipNode
    from sphinx.util import logging
    try:
        writer.body.append(mathml(node.astext(), display))
    except (SyntaxError, LookupError, AttributeError) as error:
        logging.getLogger(__name__).warning("no MathML of %r: %s", node.astext(), error, location=node)
    raise SkipNode


def as_it_stands(app, what, name, obj, options, lines):
    """Docstrings are plain text, not reStructuredText: they keep their lines."""
    lines[:] = ["| " + re.sub(r"([*`_|\\])", r"\\\1", line.strip()) if line.strip() else "" for line in lines] + [""]


def shorter(app, what, name, obj, options, signature, answer):
    """Signatures name soilbin.Tire, not the extension that it lies in."""
    return tuple(text and text.replace("soilbin._soilbin.", "") for text in (signature, answer))


def mend_theme(app, error):
    if error is None:
        importlib.import_module("furo_repaired").repair(Path(app.outdir) / "_static")


def setup(app):
    app.connect("build-finished", mend_theme)
    app.connect("autodoc-process-docstring", as_it_stands)
    app.connect("autodoc-process-signature", shorter)
    app.connect("source-read", prepare)
    app.add_html_math_renderer("mathml", (inline_formula, None), (displayed_formula, None))
    return {"parallel_read_safe": True}
