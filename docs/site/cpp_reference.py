"""The C++ reference of the site: the headers that docs/reference/cpp-api.md names, as Markdown.

Of each header its opening comment, then each declaration: its comment as a paragraph and the declaration itself as code,
with the comments of its members, which hold meaning and units. Left out: what is private, bodies of functions, includes.
A header that is not there, and an example that no program of tests/consumer holds, are errors.

    python3 docs/site/cpp_reference.py PROJECT_ROOT     prints it
"""
import re
import sys
from pathlib import Path


def headers_of(page):
    """Paths of the headers that a page names, in its order, each once."""
    return list(dict.fromkeys(re.findall(r"`((?:scenario|bekker_wong|dem|compare)/[\w/]+\.hpp)`", page)))


def check_examples(root, page):
    """Throws ValueError where a C++ example of the page is in no program that the tests build."""
    programs = [path.read_text(encoding="utf-8") for path in sorted((root / "tests/consumer").glob("*.cpp"))]
    for example in re.findall(r"^```cpp\n(.*?)^```", page, flags=re.S | re.M):
        if not any(example in program for program in programs):
            raise ValueError(f"no program of tests/consumer holds this example:\n{example}")


def comment_text(lines, mark):
    """Comment lines as Markdown: paragraphs, and what is indented as code."""
    text, code = [], []

    def end_code():
        if code:
            text.extend(["", "```cpp" if any(";" in line for line in code) else "```text", *dedented(code), "```", ""])
            code.clear()

    for line in lines:
        line = line.strip()[len(mark):]
        if line.startswith("  ") or (code and not line.strip()):
            code.append(line[1:])
            continue
        end_code()
        text.append(escaped(line.strip()))
    end_code()
    return "\n".join(text)


def dedented(lines):
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    indent = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
    return [line[indent:] for line in lines]


def escaped(text):
    """Plain text for Markdown; what stands in backticks stays code."""
    parts = re.split(r"(`[^`]*`)", text)
    parts[::2] = [re.sub(r"([\\*_<>|\[\]$`#])", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def without_bodies(text):
    """Declarations alone: what functions do is left out, and so are the private parts of a class."""
    text = re.sub(r"^ (?:private|protected):\n.*?(?=^(?: public:|};))", "", text, flags=re.S | re.M)
    out, place = "", 0
    # ') {', ') const {', a list of initialisers before it, 'noexcept {'
    head = re.compile(r"\)(?P<after>(?:\s*(?:const|noexcept|override|final)\b)*(?:\s*->\s*[\w:<>&*, ]+?)?)"
                      r"(?:\s*:\s*(?:\w+(?:\([^()]*\)|\{[^{}]*\})(?:,\s*)?)+)?\s*\{")
    while True:
        found = head.search(text, place)
        if not found:
            return re.sub(r"\n\n+};", "\n};", out + text[place:])
        depth, end = 1, found.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        out += text[place:found.start()] + ")" + found["after"] + ";"
        place = end + (text[end:end + 1] == ";")


def declarations(body):
    """Parts of a header's body that blank lines and comments at its margin tell apart: (comment, code)."""
    comment, code = [], []
    for line in body.splitlines() + [""]:
        at_margin = line[:1] not in ("", " ", "}", "#") and not (code and open_in(code))
        if at_margin and line.startswith("//") and code:
            yield comment, code
            comment, code = [], []
        if line.startswith("//"):
            comment.append(line)
        elif line.strip() or open_in(code):
            code.append(line)
        elif code:
            yield comment, code
            comment, code = [], []
        elif comment:  # a comment that stands alone
            comment = []


def open_in(lines):
    text = re.sub(r'//[^\n]*|"(?:\\.|[^"\\])*"', "", "\n".join(lines))
    return text.count("{") > text.count("}") or text.count("(") > text.count(")")


def name_of(code):
    """What a declaration declares, for its heading; none for a function or a constant."""
    found = re.match(r"(?:template <[^\n]*>\n)?(struct|class|enum class|enum)\s+(\w+)", "\n".join(code))
    return f"{found[2]}" if found else None


def header_text(root, name):
    lines = (root / name).read_text(encoding="utf-8").splitlines()
    opening = lines[:next(i for i, line in enumerate(lines) if not line.startswith("//"))]
    body = "\n".join(lines[len(opening):])
    body = re.sub(r"^#(?:pragma|include|define|undef|if|endif)[^\n]*\n", "", body, flags=re.M)
    spaces = re.findall(r"^namespace ([\w:]+) \{$", body, flags=re.M)
    body = re.sub(r"^(?:namespace [\w:]+ \{|\}  // namespace.*)$", "", body, flags=re.M)
    out = [f"## {name}", "", comment_text(opening, "//"), "", f"Namespace `{spaces[0]}`." if spaces else "", ""]
    for comment, code in declarations(without_bodies(body)):
        title = name_of(code)
        if re.fullmatch(r"(struct|class) \w+;", code[0]):  # declared elsewhere
            continue
        out += [f"### {escaped(title)}", ""] if title else []
        out += [comment_text(comment, "///"), "", "```cpp", *code, "```", ""]
    return "\n".join(out)


def reference_text(root, page):
    check_examples(root, page)
    return "\n\n".join(header_text(Path(root), name) for name in headers_of(page))


if __name__ == "__main__":
    project = Path(sys.argv[1])
    print(reference_text(project, (project / "docs/reference/cpp-api.md").read_text(encoding="utf-8")))
