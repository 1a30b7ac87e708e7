"""Draws the figures of docs/theory/grains.md from its equations alone: /usr/bin/python3 docs/theory/grains/figures.py"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
BLUE, ORANGE, GREEN, GREY = "#1f6fb4", "#d9631e", "#2c8a57", "#666666"
plt.rcParams.update({"svg.hashsalt": "soilbin", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
                     "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False})
R, E, NU, RHO = 0.02, 31.75e6, 0.18, 2463.5  # the paper's sand: two grains of 20 mm
M = 4 / 3 * np.pi * R**3 * RHO / 2           # m*
RS, ES, GS = R / 2, E / (2 * (1 - NU**2)), E / (4 * (2 - NU) * (1 + NU))
MU = 0.5


def save(figure, name):
    figure.savefig(HERE / f"{name}.svg", metadata={"Date": None, "Creator": "docs/theory/grains/figures.py"},
                   bbox_inches="tight", facecolor="white")
    plt.close(figure)


def contact():
    figure, ax = plt.subplots(figsize=(6, 2.7))
    for x, label in ((-0.92, "i"), (0.92, "j")):
        ax.add_patch(plt.Circle((x, 0), 1, facecolor="#e9dcc6", edgecolor="#8a6d3b", alpha=0.75))
        ax.plot(x, 0, "o", color="k", ms=3)
        ax.text(x, 0.12, label)
    ax.annotate("", (-0.08, -1.12), (0.08, -1.12), arrowprops={"arrowstyle": "<->", "color": GREY, "shrinkA": 0, "shrinkB": 0})
    ax.text(0.16, -1.2, r"overlap $\delta$")
    for start, end, colour, label, at in (((0, 0), (-0.55, 0), BLUE, r"$F_n$", (-0.55, 0.08)),
                                          ((0, 0), (0, 0.55), ORANGE, r"$F_t$", (0.06, 0.5))):
        ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.8})
        ax.text(*at, label, color=colour)
    turn = np.linspace(200, 330, 30) * np.pi / 180
    ax.plot(-0.92 + 0.5 * np.cos(turn), 0.5 * np.sin(turn), color=GREEN)
    ax.annotate("", (-0.92 + 0.5 * np.cos(turn[-1]), 0.5 * np.sin(turn[-1])),
                (-0.92 + 0.5 * np.cos(turn[-3]), 0.5 * np.sin(turn[-3])), arrowprops={"arrowstyle": "->", "color": GREEN})
    ax.text(-1.6, -0.62, "M", color=GREEN)
    ax.set(aspect="equal", xlim=(-2.1, 2.1), ylim=(-1.35, 1.1))
    ax.axis("off")
    save(figure, "contact")


def impact(restitution, speed=1.0):
    """Overlap and normal force of a head-on impact of two grains."""
    log = np.log(restitution) if restitution < 1 else 0.0
    beta = -log / np.hypot(log, np.pi)
    overlap, rate, dt, path = 0.0, speed, 2e-7, []
    while overlap >= 0:
        a = np.sqrt(RS * overlap)
        force = 4 / 3 * ES * a * overlap + 2 * np.sqrt(5 / 6) * beta * np.sqrt(2 * ES * a * M) * rate
        path.append((overlap, force))
        rate -= dt * force / M
        overlap += dt * rate
    return np.array(path), -rate / speed


def normal_force():
    figure, ax = plt.subplots(figsize=(6.2, 3.2))
    for restitution, colour in ((1.0, GREY), (0.7, BLUE), (0.4, ORANGE)):
        path, rebound = impact(restitution)
        assert abs(rebound - restitution) < 2e-3, (rebound, restitution)  # the closed relation of beta to e
        ax.plot(path[:, 0] * 1e3, path[:, 1], color=colour, label=f"e = {restitution:g}")
    ax.axhline(0, color="k", lw=0.8)
    ax.set(xlabel=r"overlap $\delta$ [mm]", ylabel="normal force [N]")
    ax.legend(frameon=False, loc="upper left")
    save(figure, "normal-force")


def friction():
    """Tangential force of a contact of constant overlap that is sheared to and fro, by the return map."""
    figure, ax = plt.subplots(figsize=(6.2, 3.2))
    normal = 20.0
    overlap = (normal / (4 / 3 * ES * np.sqrt(RS))) ** (2 / 3)
    k = 8 * GS * np.sqrt(RS * overlap)
    way = np.concatenate([np.linspace(0, 1, 200), np.linspace(1, -1, 400), np.linspace(-1, 1, 400)]) * 3 * MU * normal / k
    spring, force = 0.0, []
    for step in np.diff(way, prepend=0.0):
        spring = np.clip(spring + step, -MU * normal / k, MU * normal / k)
        force.append(k * spring / normal)
    ax.plot(way * 1e6, force, color=BLUE)
    for limit in (MU, -MU):
        ax.axhline(limit, color=GREY, lw=0.8, ls="--")
    ax.text(way.min() * 1e6, MU + 0.03, r"$\mu F_N$ : the contact slides", color=GREY)
    ax.set(xlabel="tangential displacement [µm]", ylabel="tangential over normal force", ylim=(-0.65, 0.68))
    save(figure, "friction")


if __name__ == "__main__":
    for draw in (contact, normal_force, friction):
        draw()
