"""Draws the figures of docs/theory/wheel.md, from the answers of soilbin itself, and two sketches for the notebooks.

    PYTHONPATH=build/release/python /usr/bin/python3 docs/theory/wheel/figures.py
"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

import soilbin
from soilbin import bekker_wong as bw

HERE = Path(__file__).resolve().parent
deg, mm, kPa = np.pi / 180, 1e-3, 1e3
TIRE = soilbin.Tire(name="wheel", radius=0.3, width=0.2)
SOIL = soilbin.find_soil("upland-sandy-loam")
AT = soilbin.OperatingCondition(load=800.0, slip=0.2)
BLUE, ORANGE, GREY = "#1f6fb4", "#d9631e", "#666666"
plt.rcParams.update({"svg.hashsalt": "soilbin", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
                     "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False})


def scenario(*effects):
    return soilbin.Scenario(TIRE, SOIL, effects=list(effects))


def save(figure, name):
    figure.savefig(HERE / f"{name}.svg", metadata={"Date": None, "Creator": "docs/theory/wheel/figures.py"},
                   bbox_inches="tight", facecolor="white")
    plt.close(figure)


def rolled(slip=0.2, **at):
    """The contact at a slip, its nodes sorted by angle."""
    contact = bw.RollingWheel(scenario()).roll(AT.replace(slip=slip, **at))
    order = np.argsort(contact.nodes["theta"])
    return contact, {name: values[order] for name, values in contact.nodes.items()}


def contact_geometry():
    figure, ax = plt.subplots(figsize=(6.4, 4.2))
    entry, exit_, most, r = 48 * deg, -10 * deg, 17 * deg, 1.0
    around = np.linspace(0, 2 * np.pi, 300)
    surface = 1 - np.cos(entry)
    ax.fill_between([np.sin(entry), 1.7], surface, -0.45, color="#e9dcc6", lw=0)
    under = np.linspace(entry, exit_, 60)
    ax.fill_between(r * np.sin(under), 1 - np.cos(under), -0.45, color="#e9dcc6", lw=0)
    ax.fill_between([-1.5, np.sin(exit_)], 1 - np.cos(exit_), -0.45, color="#e9dcc6", lw=0)
    ax.plot(np.sin(around), 1 - np.cos(around), color="k", lw=1.4)
    ax.plot([np.sin(entry), 1.7], [surface] * 2, color="#8a6d3b")
    ax.plot([-1.5, np.sin(exit_)], [1 - np.cos(exit_)] * 2, color="#8a6d3b")
    for angle, label, shift in ((entry, r"$\theta_1$: entry", (0.12, 0.06)), (most, r"$\theta_m$: largest stress", (0.03, -0.16)),
                                (exit_, r"$\theta_2$: exit", (-0.52, -0.12))):
        x, z = np.sin(angle), 1 - np.cos(angle)
        ax.plot([0, x], [1, z], color=GREY, lw=0.8, ls="--")
        ax.plot(x, z, "o", color="k", ms=4)
        ax.annotate(label, (x, z), (x + shift[0], z + shift[1]))
    ax.annotate("", (1.25, 0), (1.25, surface), arrowprops={"arrowstyle": "<->", "color": GREY})
    ax.plot([0, 1.3], [0, 0], color=GREY, lw=0.6, ls=":")
    ax.text(1.28, surface / 2 - 0.03, "z")
    ax.annotate("", (0.75, 1), (0, 1), arrowprops={"arrowstyle": "->", "color": BLUE, "lw": 1.6})
    ax.text(0.78, 0.98, "v", color=BLUE)
    ax.annotate("", (0, 0.6), (0, 1), arrowprops={"arrowstyle": "->", "color": "k", "lw": 1.6})
    ax.text(-0.04, 1.06, "W")
    ax.text(-0.36, 1.12, r"$\omega$", color=ORANGE)
    turn = np.linspace(200, 320, 40) * deg
    ax.plot(0.42 * np.sin(turn), 1 - 0.42 * np.cos(turn) * 1.0, color=ORANGE, lw=1.2)
    ax.annotate("", (0.42 * np.sin(turn[0]), 1 - 0.42 * np.cos(turn[0])),
                (0.42 * np.sin(turn[2]), 1 - 0.42 * np.cos(turn[2])), arrowprops={"arrowstyle": "->", "color": ORANGE})
    ax.set(aspect="equal", xlim=(-1.5, 1.7), ylim=(-0.45, 1.75))
    ax.axis("off")
    save(figure, "geometry")


def stresses():
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.2), sharex=True)
    for slip, colour in ((0.05, GREY), (0.2, BLUE), (0.6, ORANGE)):
        contact, nodes = rolled(slip)
        axes[0].plot(nodes["theta"] / deg, nodes["sigma"] / kPa, color=colour, label=f"slip {100 * slip:.0f} %")
        axes[1].plot(nodes["theta"] / deg, nodes["tau_x"] / kPa, color=colour)
        axes[0].plot(contact.max_stress_angle / deg, nodes["sigma"].max() / kPa, "o", color=colour, ms=4)
    axes[0].set(title=r"normal stress $\sigma$ [kPa]", xlabel=r"angle $\theta$ before the lowest point [deg]")
    axes[1].set(title=r"shear stress $\tau$ [kPa]", xlabel=r"angle $\theta$ before the lowest point [deg]")
    axes[0].legend(frameon=False)
    axes[0].invert_xaxis()
    save(figure, "stresses")


def balance():
    figure, ax = plt.subplots(figsize=(6.4, 3.4))
    wheel = bw.RollingWheel(scenario())
    angles = np.linspace(2, 36, 80) * deg
    for slip, colour, label in ((0.6, ORANGE, "driven, 60 % slip"), (0.2, BLUE, "driven, 20 % slip"), (-0.6, GREY, "braked, slip -60 %")):
        at = AT.replace(slip=slip)
        carried = np.array([wheel.at_entry_angle(at, angle).vertical for angle in angles])
        ax.plot(TIRE.radius * (1 - np.cos(angles)) / mm, carried, color=colour, label=label)
        ax.plot(wheel.roll(at).sinkage / mm, AT.load, "o", color=colour, ms=6)
    ax.axhline(AT.load, color="k", lw=0.8)
    ax.text(52, AT.load + 40, "load W")
    ax.set(xlabel="sinkage z [mm]", ylabel="load that the contact carries [N]")
    ax.legend(frameon=False)
    save(figure, "balance")


def against_slip():
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.0))
    slips = np.linspace(0, 0.8, 41)
    for effects, colour, label in (((), BLUE, "without"), (("slip_sinkage:lyasko",), ORANGE, "with slip sinkage")):
        frame = soilbin.sweep(scenario(*effects), soilbin.conditions(load=[AT.load], slip=slips))
        for ax, column, scale in zip(axes, ("drawbar_pull", "torque", "sinkage"), (1, 1, 1 / mm)):
            ax.plot(100 * frame.slip, frame[column] * scale, color=colour, label=label)
    for ax, title in zip(axes, ("drawbar pull [N]", "torque [N m]", "sinkage [mm]")):
        ax.set(title=title, xlabel="slip [%]")
    axes[0].legend(frameon=False)
    figure.tight_layout()
    save(figure, "slip-sinkage")


def slopes_and_yaw():
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.2))
    slopes = np.linspace(0, 25, 26)
    frame = soilbin.sweep(scenario(), soilbin.conditions(load=[AT.load], slip=[AT.slip], longitudinal_incline=slopes * deg))
    axes[0].plot(slopes, frame.drawbar_pull, color=BLUE)
    axes[0].axhline(0, color="k", lw=0.8)
    axes[0].set(title="pull uphill, 20 % slip [N]", xlabel="slope [deg]")
    yaws = np.linspace(0, 45, 46)
    frame = soilbin.sweep(scenario(), soilbin.conditions(load=[AT.load], slip=[AT.slip], yaw=yaws * deg))
    axes[1].plot(yaws, frame.drawbar_pull, color=BLUE, label="drawbar pull, along travel")
    axes[1].plot(yaws, frame.lateral_force, color=ORANGE, label="lateral force, to the left")
    axes[1].axhline(0, color="k", lw=0.8)
    axes[1].set(title="forces at yaw, 20 % slip [N]", xlabel="yaw [deg]")
    axes[1].legend(frameon=False)
    figure.tight_layout()
    save(figure, "slope-and-yaw")


def plates():
    """For notebook 1: two plates, their curves, and the line that gives k_c and k_phi."""
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 2.9))
    ground = axes[0]
    ground.fill_between([-2.6, 2.6], 0, -1.5, color="#e9dcc6", lw=0)
    for middle, half, depth, colour in ((-1.3, 0.35, 0.75, ORANGE), (1.1, 0.8, 0.5, BLUE)):
        ground.fill_between([middle - half, middle + half], 0, -depth, color="white", lw=0)
        ground.fill_between([middle - half, middle + half], -depth, -depth + 0.12, color=colour, lw=0)
        ground.annotate("", (middle, -depth + 0.14), (middle, 0.75), arrowprops={"arrowstyle": "->", "lw": 1.6})
        ground.annotate("", (middle + half, -depth - 0.16), (middle, -depth - 0.16), arrowprops={"arrowstyle": "<->", "color": GREY})
        ground.text(middle + half / 2 - 0.08, -depth - 0.42, "b")
        ground.text(middle + 0.08, 0.5, "p")
    ground.annotate("", (-2.0, -0.75), (-2.0, 0), arrowprops={"arrowstyle": "<->", "color": GREY})
    ground.text(-2.3, -0.45, "z")
    ground.set(xlim=(-2.6, 2.6), ylim=(-1.5, 1.0), title="the same pressure, two plates")
    ground.axis("off")
    depth = np.linspace(0, 0.04, 60)
    n, k_c, k_phi = 0.8, 30.0, 1200.0
    for radius, colour in ((0.03, ORANGE), (0.07, BLUE)):
        axes[1].plot(depth / mm, (k_c / radius + k_phi) * depth**n, color=colour, label=f"b = {radius / mm:.0f} mm")
        axes[2].plot(1 / radius, k_c / radius + k_phi, "o", color=colour)
    axes[1].set(title="$p = k\\,z^n$ [kPa]", xlabel="depth z [mm]")
    axes[1].legend(frameon=False)
    inverse = np.array([0, 40])
    axes[2].plot(inverse, k_c * inverse + k_phi, color=GREY, lw=1)
    axes[2].annotate("slope $k_c$", (22, k_c * 22 + k_phi), (4, k_c * 36 + k_phi))
    axes[2].annotate("height $k_\\phi$", (0, k_phi), (8, k_phi - 90), arrowprops={"arrowstyle": "->", "color": GREY})
    axes[2].set(title="$k = k_c/b + k_\\phi$", xlabel="1/b [1/m]", xlim=(0, 40), ylim=(k_phi - 250, None))
    figure.tight_layout()
    save(figure, "plates")


def loop():
    """For notebook 5: what a residual is taken apart into, drawn with two made shapes over slip."""
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 2.9), sharey=True)
    slip = np.linspace(0, 0.6, 13)
    noise = 0.12 * np.sin(37 * np.arange(13) ** 1.5)
    soil, effect = 1.2 - 0.6 * slip, 4.2 * slip**2
    axes[0].plot(100 * slip, soil + effect + noise, "o", color="k", ms=4)
    axes[0].set(title="1. the residual")
    axes[1].plot(100 * slip, soil + effect + noise, "o", color="#bbbbbb", ms=4)
    axes[1].plot(100 * slip, np.polyval(np.polyfit(slip, soil + effect, 1), slip), color=BLUE, label="another soil value")
    axes[1].set(title="2. what the soil can take over")
    rest = effect - np.polyval(np.polyfit(slip, effect, 1), slip)
    axes[2].plot(100 * slip, rest + noise, "o", color="k", ms=4, label="left over")
    axes[2].plot(100 * slip, rest, color=ORANGE, label="signature of an effect")
    axes[2].set(title="3. what is left, and a signature")
    for ax in axes:
        ax.axhline(0, color=GREY, lw=0.8)
        ax.set(xlabel="slip [%]")
    axes[0].set(ylabel="measured - model")
    axes[1].legend(frameon=False), axes[2].legend(frameon=False, loc="upper center")
    figure.tight_layout()
    save(figure, "loop")


if __name__ == "__main__":
    for draw in (contact_geometry, stresses, balance, against_slip, slopes_and_yaw, plates, loop):
        draw()
