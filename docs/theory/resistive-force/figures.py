"""Draws the sketch of docs/theory/resistive-force.md, which notebook 9 shows too.

    /usr/bin/python3 docs/theory/resistive-force/figures.py; notebooks/export --attach
"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
deg = np.pi / 180
BLUE, ORANGE, GREY, SAND = "#1f6fb4", "#d9631e", "#666666", "#f3e7cf"
plt.rcParams.update({"svg.hashsalt": "soilbin", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10})


def arrow(ax, start, end, colour, text, at=(4, 4)):
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.8, "shrinkA": 0, "shrinkB": 0})
    ax.annotate(text, end, at, textcoords="offset points", color=colour)


def ground(ax, width, deep):
    ax.fill_between([-width, width], 0, -deep, color=SAND, zorder=0)
    ax.axhline(0, color=GREY, lw=1, zorder=1)
    ax.set(xlim=(-width, width), aspect="equal")
    ax.axis("off")


def element(ax):
    """A plate in sand: its normal, its velocity, its depth, and what the sand does to it."""
    ground(ax, 1.3, 1.55)
    middle, tilt = np.array([0.0, -0.8]), 25 * deg
    along, n = np.array([np.cos(tilt), np.sin(tilt)]), np.array([np.sin(tilt), -np.cos(tilt)])
    ax.plot(*zip(middle - 0.5 * along, middle + 0.5 * along), color="k", lw=4, solid_capstyle="butt")
    arrow(ax, middle, middle + 0.55 * n, GREY, "n", (-12, -2))
    v = np.array([np.cos(50 * deg), -np.sin(50 * deg)])
    arrow(ax, middle, middle + 0.6 * v, ORANGE, "v")
    arrow(ax, middle, middle - 0.75 * n, BLUE, "normal part", (6, -2))
    arrow(ax, middle, middle - 0.38 * along, BLUE, "tangential part", (-62, -16))
    ax.annotate("", (-1.05, 0), (-1.05, middle[1]), arrowprops={"arrowstyle": "<->", "color": GREY, "lw": 1})
    ax.text(-1.0, middle[1] / 2, "d", color=GREY)
    ax.plot([-1.1, middle[0]], [middle[1]] * 2, color=GREY, lw=0.8, ls=":")
    ax.set(ylim=(-1.55, 0.5), title="one element")


def wheel(ax):
    """A wheel cut into elements: those that push into the sand, and those that leave it."""
    ground(ax, 1.5, 0.55)
    axle, slip = np.array([0.0, 0.72]), 0.2
    for theta in np.arange(-180, 180, 12) * deg:
        n = np.array([np.sin(theta), -np.cos(theta)])
        middle, along = axle + n, np.array([np.cos(theta), np.sin(theta)])
        velocity = np.array([1 - slip, 0]) - along  # the lowest point moves backward at slip
        pushed = middle[1] < 0 and n @ velocity > 0
        ax.plot(*zip(middle - 0.09 * along, middle + 0.09 * along), color=BLUE if pushed else "k", lw=4, solid_capstyle="butt")
        if middle[1] < 0:
            arrow(ax, middle, middle + 0.8 * velocity, ORANGE, "")
    arrow(ax, axle, axle + [0.8, 0], ORANGE, "of the axle", (-62, 6))
    ax.plot(*axle, "ko", ms=4)
    ax.set(ylim=(-0.75, 1.85), title="a wheel: only blue elements push into the sand")


def main():
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.9))
    element(axes[0])
    wheel(axes[1])
    figure.savefig(HERE / "plate-to-wheel.svg", metadata={"Date": None, "Creator": "docs/theory/resistive-force/figures.py"},
                   bbox_inches="tight", facecolor="white")


if __name__ == "__main__":
    main()
