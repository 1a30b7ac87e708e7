"""Draws the sketches of docs/theory/effects.md, one for each effect that a picture explains better than a sentence.

    /usr/bin/python3 docs/theory/effects/sketches.py

Ground is brown, the wheel black, what the effect adds orange. Nothing is to scale.
"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
SOIL, EDGE, ADDED, BLUE, GREY = "#e9dcc6", "#8a6d3b", "#d9631e", "#1f6fb4", "#777777"
plt.rcParams.update({"svg.hashsalt": "soilbin", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10})
deg = np.pi / 180


def canvas(low=-0.7, high=2.15, left=-1.9, right=1.9):
    figure, ax = plt.subplots(figsize=(3.6, 2.7))
    ax.set(aspect="equal", xlim=(left, right), ylim=(low, high))
    ax.axis("off")
    return figure, ax


def save(figure, name):
    figure.savefig(HERE / f"{name}.svg", metadata={"Date": None, "Creator": "docs/theory/effects/sketches.py"},
                   bbox_inches="tight", facecolor="white")
    plt.close(figure)


def arrow(ax, start, end, colour="k", width=1.5):
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": width})


def ground(ax, entry=50, exit_=0, behind=None, left=-1.9, right=1.9, low=-0.7):
    """Soil with the rut of a wheel of radius 1 that touches the point (0, 0); `behind`: height of the rut's floor."""
    rim = np.linspace(entry, exit_, 60) * deg
    x = np.concatenate([[right], np.sin(rim), [left]])
    floor = 1 - np.cos(exit_ * deg) if behind is None else behind
    y = np.concatenate([[1 - np.cos(entry * deg)], 1 - np.cos(rim), [floor]])
    ax.fill_between(x[::-1], y[::-1], low, color=SOIL, lw=0)
    ax.plot(x, y, color=EDGE, lw=1.2)


def wheel(ax, drop=0.0, colour="k", style="-", radius=1.0, lift=0.0):
    around = np.linspace(0, 2 * np.pi, 200)
    ax.plot(radius * np.sin(around), 1 - radius * np.cos(around) - drop + lift, color=colour, ls=style, lw=1.5)
    ax.plot(0, 1 - drop + lift, ".", color=colour, ms=4)


def exit_angle():
    figure, ax = canvas()
    ground(ax, exit_=-28)
    wheel(ax)
    for angle, label, colour in ((50, r"$\theta_1$", GREY), (-28, r"$\theta_2$", ADDED)):
        ax.plot([0, np.sin(angle * deg)], [1, 1 - np.cos(angle * deg)], color=colour, ls="--", lw=1)
        ax.text(1.12 * np.sin(angle * deg) - 0.06, 1 - 1.2 * np.cos(angle * deg), label, color=colour)
    under = np.linspace(0, -28, 20) * deg
    ax.plot(np.sin(under), 1 - np.cos(under), color=ADDED, lw=3)
    ax.text(-1.85, -0.55, "the soil follows the rim behind the axle", fontsize=9)
    save(figure, "exit_angle")


def slip_sinkage():
    figure, ax = canvas(low=-0.8, high=2.4)
    ground(ax, entry=58, behind=0.0, low=-0.8)
    wheel(ax)
    wheel(ax, colour=GREY, style=":", lift=0.28)
    arrow(ax, (1.35, 0.75), (1.35, 0.47), ADDED)
    for place in (-0.35, -0.75, -1.15):
        arrow(ax, (place + 0.35, 0.08 + 0.04 * abs(place)), (place, 0.2 + 0.12 * abs(place)), ADDED)
    ax.text(-1.85, -0.65, "the rim carries soil out of the rut", fontsize=9)
    save(figure, "slip_sinkage")


def lug_thrust():
    figure, ax = canvas()
    ground(ax)
    wheel(ax)
    for angle in np.arange(0, 360, 20) * deg:
        x, y = np.sin(angle), 1 - np.cos(angle)
        ax.plot([x, 1.13 * x], [y, 1 - 1.13 * np.cos(angle)], color="k", lw=3)
    shear = np.linspace(-4, 52, 40) * deg
    ax.plot(1.13 * np.sin(shear), 1 - 1.13 * np.cos(shear), color=ADDED, lw=1.5, ls="--")
    ax.fill([0.0, -0.05, -0.5, -0.05], [-0.0, -0.13, -0.02, 0.0], color=ADDED, alpha=0.5, lw=0)
    arrow(ax, (-0.05, -0.08), (-0.55, -0.2), ADDED)
    ax.text(-1.85, -0.6, "it shears at the tips; a lug pushes a wedge", fontsize=8.5)
    save(figure, "lug_thrust")


def bulldozing():
    figure, ax = canvas()
    ground(ax, entry=46)
    wheel(ax)
    height = 1 - np.cos(46 * deg)
    ax.fill([np.sin(46 * deg), np.sin(62 * deg), 1.15, 1.75], [height, 1 - np.cos(62 * deg), height + 0.24, height], color=ADDED, alpha=0.6, lw=0)
    arrow(ax, (1.15, height + 0.12), (0.72, height + 0.12), ADDED)
    ax.text(-1.85, -0.6, "a bow wave ahead pushes back", fontsize=9)
    save(figure, "bulldozing")


def multipass():
    figure, ax = canvas()
    ground(ax, entry=26, right=1.9)
    ax.plot([1.15, 1.9], [0.5, 0.5], color=GREY, ls=":", lw=1)
    ax.fill_between([-1.9, 0, 1.9], [0, 0, 0.1], -0.28, color=EDGE, alpha=0.4, lw=0)
    wheel(ax)
    ax.text(1.05, 0.58, "fresh ground", color=GREY, fontsize=9)
    ax.text(-1.85, -0.6, "the floor of the rut is compacted: firmer", fontsize=9)
    save(figure, "multipass")


def tire_flexibility():
    figure, ax = canvas()
    half, depth = 0.55, 0.165
    under = np.linspace(50, 33.4, 20) * deg
    x = np.concatenate([[1.9], np.sin(under), [half, -half, -1.9]])
    y = np.concatenate([[1 - np.cos(50 * deg)], 1 - np.cos(under), [depth, depth, depth]])
    ax.fill_between(x[::-1], y[::-1], -0.7, color=SOIL, lw=0)
    ax.plot(x, y, color=EDGE, lw=1.2)
    around = np.linspace(0, 2 * np.pi, 400)
    ax.plot(np.sin(around), np.maximum(1 - np.cos(around), depth), color="k", lw=1.5)
    ax.plot([-half, half], [depth, depth], color=ADDED, lw=3)
    lower = np.linspace(-33, 33, 40) * deg
    ax.plot(np.sin(lower), 1 - np.cos(lower), color=GREY, ls=":", lw=1)
    ax.text(-1.85, -0.55, "it flattens: longer, shallower contact", fontsize=9)
    save(figure, "tire_flexibility")


def hard_layer():
    figure, ax = canvas()
    ground(ax)
    wheel(ax)
    ax.fill_between([-1.9, 1.9], -0.38, -0.7, color=EDGE, alpha=0.7, lw=0, hatch="///", edgecolor="white")
    ax.annotate("", (0.0, 0.0), (0.0, -0.38), arrowprops={"arrowstyle": "<->", "color": ADDED})
    ax.text(0.1, -0.25, "near: it feels stiff", color=ADDED, fontsize=9)
    save(figure, "hard_layer")


def sidewall_bulldozing():
    figure, ax = canvas(low=-0.9, high=1.6)
    ax.fill_between([-1.9, 1.9], 0.0, -0.9, color=SOIL, lw=0)
    ax.fill_between([-0.45, 0.45], 0.02, -0.5, color="white", lw=0)
    ax.plot([-1.9, -0.45, -0.45, 0.45, 0.45, 1.9], [0, 0, -0.5, -0.5, 0, 0], color=EDGE, lw=1.2)
    ax.plot([-0.45, -0.45, 0.45, 0.45, -0.45], [1.3, -0.5, -0.5, 1.3, 1.3], color="k", lw=1.5)
    ax.fill([0.45, 0.45, 1.35], [0.0, -0.5, 0.0], color=ADDED, alpha=0.5, lw=0)
    ax.fill([0.45, 0.7, 1.1], [0.0, 0.22, 0.0], color=ADDED, alpha=0.35, lw=0)
    arrow(ax, (0.95, -0.17), (0.48, -0.17), ADDED)
    arrow(ax, (0.0, 0.75), (0.4, 0.75), BLUE)
    ax.text(-1.85, -0.8, "from behind: its wall pushes soil aside", fontsize=9)
    save(figure, "sidewall_bulldozing")


def interface_limit():
    figure, ax = plt.subplots(figsize=(3.6, 2.5))
    sigma = np.linspace(0, 1, 20)
    ax.plot(sigma, 0.12 + 0.6 * sigma, color=EDGE, label="soil: c + σ tan φ")
    ax.plot(sigma, 0.42 * sigma, color=ADDED, label="wheel on soil")
    ax.set(xlabel="normal stress σ", ylabel="largest shear stress", xticks=[], yticks=[])
    ax.legend(frameon=False, fontsize=8), ax.spines[["top", "right"]].set_visible(False)
    save(figure, "interface_limit")


def shear_hump():
    figure, ax = plt.subplots(figsize=(3.6, 2.5))
    j = np.linspace(0, 6, 200)
    ax.plot(j, 1 - np.exp(-j), color=GREY, label="base model")
    ax.plot(j, (1 - np.exp(-1.6 * j)) * (0.75 + 0.62 * np.exp(-0.55 * j)), color=ADDED, label="dense or cemented soil")
    ax.set(xlabel="shear displacement j/K", ylabel="shear stress", xticks=[], yticks=[], ylim=(0, 1.25))
    ax.legend(frameon=False, fontsize=8, loc="lower right"), ax.spines[["top", "right"]].set_visible(False)
    save(figure, "shear_hump")


def bed_tilt():
    figure, ax = canvas(low=-0.7, high=2.2)
    x = np.array([-1.9, 1.9])
    ax.fill_between(x, 0.12 * x, -0.7, color=SOIL, lw=0)
    ax.plot(x, 0.12 * x, color=EDGE, lw=1.2)
    ax.plot(x, 0 * x, color=GREY, ls=":", lw=1)
    wheel(ax)
    arrow(ax, (0, 1), (0, 0.35))
    arrow(ax, (0, 1), (-0.45, 0.95), ADDED)
    ax.text(-1.85, -0.6, "a share of the load looks like pull", fontsize=9)
    save(figure, "bed_tilt")


DRAWN = (exit_angle, slip_sinkage, lug_thrust, bulldozing, multipass, tire_flexibility, hard_layer, sidewall_bulldozing,
         interface_limit, shear_hump, bed_tilt)

if __name__ == "__main__":
    for draw in DRAWN:
        draw()
