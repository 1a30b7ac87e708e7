"""Furo as Debian 12 packs it, made to run in a browser.

Debian leaves out Furo's own build step. Its script is a module with an import that pages load as a plain script, its
style asks a web server for normalize.css, and the style's rule for readers who prefer dark pages is lost. Each is mended
in the site's own copies, where it is found; another Furo is left as it is.
"""
import re
from pathlib import Path

NORMALIZE = Path("/usr/share/javascript/normalize.css/normalize.css")  # of node-normalize.css, which furo depends on


def repair(static):
    """Mends the theme's files below a site's folder _static."""
    script, style = Path(static, "scripts/furo.js"), Path(static, "styles/furo.css")
    text = script.read_text(encoding="utf-8")
    if re.search("^import ", text, flags=re.M):
        imported = script.with_name("gumshoe-patched.js")
        text = imported.read_text(encoding="utf-8") + "\n" + re.sub("^import .*\n", "", text, flags=re.M)
        script.write_text(text, encoding="utf-8")
        imported.unlink()
    text = style.read_text(encoding="utf-8")
    asked = "@import url(/javascript/normalize.css/normalize.css);"
    if asked in text:
        text = text.replace(asked, NORMALIZE.read_text(encoding="utf-8"))
    if "prefers-color-scheme" not in text:
        text += for_dark_readers(text)
    style.write_text(text, encoding="utf-8")


def for_dark_readers(style):
    """The rules of the dark theme once more, for readers who prefer dark and have not chosen light by the button."""
    dark = re.search(r'^@media not print \{\n( *body\[data-theme="dark"\].*?)\}\n\n', style, flags=re.S | re.M)[1]
    dark = dark.replace('body[data-theme="dark"]', 'body:not([data-theme="light"])')
    return f"\n@media not print {{\n@media (prefers-color-scheme: dark) {{\n{dark}\n}}\n}}\n"
