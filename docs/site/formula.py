"""Formulas as MathML, which a browser draws without a script and without a network; for the site and the notebooks."""
from xml.dom import minidom

from docutils.utils.math import latex2mathml


def mathml(code, display):
    """A formula of LaTeX, in the line or displayed."""
    tree = latex2mathml.math(**({"display": "block"} if display else {}))
    latex2mathml.parse_latex_math(tree, code.strip())
    document = minidom.parseString(tree.toprettyxml().replace("&ApplyFunction;", "\u2061"))
    without_blanks(document.documentElement)
    for sub in list(document.getElementsByTagName("msub")):
        lower(document, sub)
    for sign in list(document.getElementsByTagName("mo")):
        if sign.firstChild and sign.firstChild.data == "\u2061":
            part_from_neighbours(document, sign)
    if display:
        document.documentElement.setAttribute("style", "margin: .6em 0")
    return document.documentElement.toxml()


def without_blanks(element):
    for child in list(element.childNodes):
        if child.nodeType == child.TEXT_NODE and not child.data.strip():
            element.removeChild(child)
        else:
            without_blanks(child)


def part_from_neighbours(document, sign):
    """A thin space on both sides of a function such as tan: c + sigma tan phi. `sign` stands behind its name."""
    def thin():
        space = document.createElement("mspace")
        space.setAttribute("width", "0.17em")
        return space
    name, of = sign.previousSibling, sign.nextSibling
    if name is not None and name.previousSibling is not None and name.previousSibling.tagName != "mo":
        sign.parentNode.insertBefore(thin(), name)
    bracket = of is not None and of.tagName == "mo"
    sign.parentNode.removeChild(sign) if bracket else sign.parentNode.replaceChild(thin(), sign)


def lower(document, sub):
    """A subscript that stands low by itself: where no font for mathematics is installed Chromium leaves it on the line."""
    script = sub.childNodes[1]
    small = document.createElement("mstyle")
    small.setAttribute("scriptlevel", "+1")
    padded = document.createElement("mpadded")
    padded.setAttribute("voffset", "-0.3em")
    sub.removeChild(script)
    small.appendChild(script)
    padded.appendChild(small)
    sub.appendChild(padded)
    sub.tagName = sub.nodeName = "mrow"
