"""Draws the sketches of docs/theory/effects.md, one for each effect.

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


def axes(x, y, **more):
    """A plot of one quantity against another, without numbers."""
    figure, ax = plt.subplots(figsize=(3.6, 2.5))
    ax.set(xlabel=x, ylabel=y, xticks=[], yticks=[], **more)
    ax.spines[["top", "right"]].set_visible(False)
    return figure, ax


def turning(ax, radius, start, end, colour, centre=(0, 1)):
    """An arrow round a centre, clockwise from one angle to another [deg from the downward vertical]."""
    angles = np.linspace(start, end, 40) * deg
    x, y = centre[0] + radius * np.sin(angles), centre[1] - radius * np.cos(angles)
    ax.plot(x, y, color=colour, lw=1.5)
    arrow(ax, (x[-2], y[-2]), (x[-1], y[-1]), colour)


def rate_dependence():
    figure, ax = axes("sinkage z", "pressure σ", ylim=(0, 1.3))
    z = np.linspace(0, 1, 60)
    ax.plot(z, 0.75 * z**0.8, color=GREY, label="slow, as the plate test")
    ax.plot(z, 1.1 * z**0.8, color=ADDED, label="fast: the soil resists more")
    arrow(ax, (0.7, 0.75 * 0.7**0.8), (0.7, 1.08 * 0.7**0.8), ADDED)
    ax.legend(frameon=False, fontsize=8, loc="upper left")
    save(figure, "rate_dependence")


def pressure_dependent_shear_modulus():
    figure, ax = axes("shear displacement j", "share of the strength", ylim=(0, 1.1))
    j = np.linspace(0, 5, 200)
    for k, colour, style, label in ((0.5, ADDED, "--", "light wheel: small K"), (1, GREY, "-", "base model: one K"),
                                    (2, ADDED, "-", "heavy wheel: large K")):
        ax.plot(j, 1 - np.exp(-j / k), color=colour, ls=style, label=label)
    ax.legend(frameon=False, fontsize=8, loc="lower right")
    save(figure, "pressure_dependent_shear_modulus")


def moisture():
    figure, ax = axes("water content w", "cohesion, stiffness", xlim=(0, 1), ylim=(0, 1.3))
    w = np.linspace(0.02, 0.98, 100)
    ax.axhline(0.8, color=GREY, label="base model: one value")
    ax.plot(w, np.exp(-8 * (w - 0.45)**2), color=ADDED, label="an optimum, then too wet")
    place = 0.45 + np.sqrt(-np.log(0.8) / 8)
    ax.plot(place, 0.8, "o", color=ADDED, ms=4)
    ax.vlines(place, 0, 0.8, color=GREY, ls=":", lw=1)
    ax.text(place + 0.02, 0.05, r"$w_{ref}$", color=GREY, fontsize=8)
    ax.legend(frameon=False, fontsize=8, loc="upper left")
    save(figure, "moisture")


def slope_weakening():
    figure, ax = canvas(low=-1.7, high=2.2)
    rise, x = np.tan(18 * deg), np.array([-1.9, 1.9])
    ax.fill_between(x, rise * x, -0.95, color=SOIL, lw=0)
    ax.plot(x, rise * x, color=EDGE, lw=1.2)
    ax.plot(x, 0 * x + rise * -1.9, color=GREY, ls=":", lw=1)
    ax.text(-1.4, rise * -1.9 + 0.03, "i", color=GREY, fontsize=9)
    lift = 1 / np.cos(18 * deg) - 1.05
    wheel(ax, lift=lift)
    for place in (-0.75, 0.35, 1.35):
        arrow(ax, (place + 0.25, rise * (place + 0.25) - 0.22), (place - 0.15, rise * (place - 0.15) - 0.22), ADDED)
    ax.barh(-1.3, 1.6, 0.16, left=-1.9, color=ADDED)
    ax.barh(-1.3, 2.2, 0.16, left=-0.3, color=EDGE, alpha=0.6)
    ax.text(-1.85, -1.17, "the soil's strength, tan φ:", fontsize=8)
    ax.text(-1.85, -1.62, "holds the slope", color=ADDED, fontsize=8)
    ax.text(0.15, -1.62, "left for the wheel", fontsize=8)
    save(figure, "slope_weakening")


def rig_friction():
    figure, ax = canvas()
    ground(ax)
    wheel(ax)
    around = np.linspace(0, 2 * np.pi, 60)
    ax.fill(0.2 * np.sin(around), 1 - 0.2 * np.cos(around), color=ADDED, alpha=0.35, lw=0)
    ax.plot(0.2 * np.sin(around), 1 - 0.2 * np.cos(around), color=ADDED, lw=1)
    turning(ax, 0.34, 300, 130, ADDED)
    turning(ax, 0.72, 300, 130, "k")
    ax.text(-1.85, 2.0, "soil's torque M", fontsize=9)
    ax.text(1.05, 2.0, "bearing", color=ADDED, fontsize=9)
    ax.plot([1.03, 0.22], [1.98, 1.13], color=ADDED, lw=0.8)
    ax.text(-1.85, -0.6, "the sensor reads both together", fontsize=9)
    save(figure, "rig_friction")


def sensor_offset():
    figure, ax = axes("slip", "drawbar pull", ylim=(-0.35, 1.35))
    s = np.linspace(0, 1, 60)
    pull = 1.1 * (1 - np.exp(-5 * s)) - 0.2
    ax.axhline(0, color=GREY, lw=0.6)
    ax.plot(s, pull, color=GREY, label="base model")
    ax.plot(s, pull + 0.28, color=ADDED, label="as read: the zero is off by a")
    ax.annotate("", (0.75, pull[45]), (0.75, pull[45] + 0.28), arrowprops={"arrowstyle": "<->", "color": ADDED})
    ax.text(0.77, pull[45] + 0.09, "a", color=ADDED)
    ax.legend(frameon=False, fontsize=8, loc="lower right")
    save(figure, "sensor_offset")


def cross_talk():
    figure, ax = canvas(low=-0.75, high=1.75, left=-1.9, right=1.9)
    turn = 20 * deg
    for angle, colour, style in ((0, GREY, ":"), (-turn, ADDED, "-")):
        along, across = np.array([-np.sin(angle), np.cos(angle)]), np.array([-np.cos(angle), -np.sin(angle)])
        for axis in (along, across):
            ax.plot([0, 1.5 * axis[0]], [0, 1.5 * axis[1]], color=colour, ls=style, lw=1.2)
        ax.fill(*np.array([0.22 * (p * along + q * across) for p, q in ((1, 1), (1, -1), (-1, -1), (-1, 1))]).T,
                color=colour, alpha=0.35, lw=0)
    arrow(ax, (0, 0), (0, 1.15))
    along = np.array([np.sin(turn), np.cos(turn)])
    across = np.array([-np.cos(turn), np.sin(turn)])
    for axis in (along, across):
        foot = 1.15 * axis[1] * axis
        ax.plot([0, foot[0]], [1.15, foot[1]], color=ADDED, ls="--", lw=0.8)
        ax.plot([0, foot[0]], [0, foot[1]], color=ADDED, lw=3)
    ax.text(-0.98, 1.22, "true pull", fontsize=9)
    ax.text(0.6, 1.35, "pull as read", color=ADDED, fontsize=9)
    ax.text(-1.9, 0.62, "lateral force\nas read", color=ADDED, fontsize=9)
    ax.text(-1.85, -0.65, "from above: a cell that is turned", fontsize=9)
    save(figure, "cross_talk")


def soil_gradient():
    figure, ax = canvas(low=-0.95, high=1.6, left=-2.0, right=2.0)
    count = 40
    for k, left in enumerate(np.linspace(-2, 2, count, endpoint=False)):
        ax.fill_between([left, left + 4 / count], 0, -0.65, color=ADDED, alpha=0.12 + 0.6 * k / count, lw=0)
    ax.plot([-2, 2], [0, 0], color=EDGE, lw=1.2)
    around = np.linspace(0, 2 * np.pi, 100)
    for place, sunk in ((-1.15, 0.3), (1.15, 0.08)):
        ax.fill(place + 0.62 * np.sin(around), 0.62 - sunk - 0.62 * np.cos(around), fc="white", ec="k", lw=1.5, zorder=3)
    ax.text(-1.95, -0.58, "soft", fontsize=9)
    ax.text(1.5, -0.58, "firm", fontsize=9)
    arrow(ax, (-0.4, 1.2), (0.4, 1.2))
    ax.text(0, 1.32, "along the bin", fontsize=8, ha="center")
    ax.text(-1.95, -0.88, "where a run is made changes its sinkage", fontsize=9)
    save(figure, "soil_gradient")


def drift():
    figure, ax = axes("order of the runs", "reading of the same run", ylim=(0, 1.4))
    runs = np.arange(1, 13)
    noise = np.array([0.02, -0.05, 0.04, 0.01, -0.03, 0.05, -0.04, 0.02, -0.01, 0.03, -0.05, 0.02])
    ax.axhline(0.4, color=GREY, label="base model: the order does not matter")
    ax.plot(runs, 0.4 + 0.045 * (runs - 1) + noise, "o", color=ADDED, ms=4, label="soil or sensor drifts")
    ax.plot(runs, 0.4 + 0.045 * (runs - 1), color=ADDED, lw=1)
    ax.legend(frameon=False, fontsize=8, loc="upper left")
    save(figure, "drift")


DRAWN = (exit_angle, slip_sinkage, lug_thrust, bulldozing, multipass, tire_flexibility, rate_dependence, interface_limit,
         shear_hump, pressure_dependent_shear_modulus, hard_layer, moisture, slope_weakening, sidewall_bulldozing, bed_tilt,
         rig_friction, sensor_offset, cross_talk, soil_gradient, drift)

if __name__ == "__main__":
    for draw in DRAWN:
        draw()
