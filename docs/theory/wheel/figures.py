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


def arrow(ax, start, end, colour="k", width=1.6):
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0})


def arc(ax, radius, first, last, colour, width=1.2):
    """An arc about the axle, angles from the lowest point, with its head at `last`."""
    along = np.linspace(first, last, 60)
    x, z = radius * np.sin(along), 1 - radius * np.cos(along)
    ax.plot(x[:-1], z[:-1], color=colour, lw=width)
    arrow(ax, (x[-3], z[-3]), (x[-1], z[-1]), colour, width)


def contact_geometry():
    """The wheel rolls to the right. Stresses, pull and torque as they act on the wheel."""
    figure, ax = plt.subplots(figsize=(7.4, 5.2))
    entry, most, at = 50 * deg, 19 * deg, 31 * deg  # `at`: where the two stresses are drawn
    around = np.linspace(0, 2 * np.pi, 300)
    surface = 1 - np.cos(entry)
    under = np.linspace(0, entry, 60)
    x = np.concatenate([[-1.5], np.sin(under), [1.9]])
    z = np.concatenate([[0], 1 - np.cos(under), [surface]])
    ax.fill_between(x, z, -0.5, color="#e9dcc6", lw=0)
    ax.plot(x, z, color="#8a6d3b", lw=1.2)
    ax.plot(np.sin(around), 1 - np.cos(around), color="k", lw=1.4)

    for angle in (0, most, entry):
        ax.plot([0, np.sin(angle)], [1, 1 - np.cos(angle)], color=GREY, lw=0.8, ls="--")
        ax.plot(np.sin(angle), 1 - np.cos(angle), "o", color="k", ms=4)
    arc(ax, 0.50, 0, entry, GREY)
    ax.text(0.36, 0.45, r"$\theta_1$", color=GREY)
    arc(ax, 0.78, 0, most, GREY)
    ax.text(0.10, 0.10, r"$\theta_m$", color=GREY)
    ax.text(np.sin(entry) + 0.16, surface + 0.07, r"entry, $\theta_1$")
    ax.annotate(r"largest normal stress, $\theta_m$", (np.sin(most), 1 - np.cos(most)), (-0.75, -0.4),
                arrowprops={"arrowstyle": "-", "color": GREY, "lw": 0.8})
    ax.text(-0.75, -0.17, r"exit, $\theta_2 = 0$")

    rim = np.array([np.sin(at), 1 - np.cos(at)])
    inward, forward = np.array([-np.sin(at), np.cos(at)]), np.array([np.cos(at), np.sin(at)])
    arrow(ax, rim - 0.42 * inward, rim, BLUE)
    ax.text(*(rim - 0.42 * inward + [0.05, -0.02]), r"$\sigma$", color=BLUE)
    arrow(ax, rim, rim + 0.36 * forward, ORANGE)
    ax.text(*(rim + 0.33 * forward + [0.04, -0.08]), r"$\tau$", color=ORANGE)

    ax.plot([0, np.sin(275 * deg)], [1, 1 - np.cos(275 * deg)], color=GREY, lw=0.8)
    ax.text(-0.58, 0.96, "r", color=GREY)
    arrow(ax, (1.55, surface), (1.55, 0), GREY, 1), arrow(ax, (1.55, 0), (1.55, surface), GREY, 1)
    ax.plot([np.sin(most), 1.6], [0, 0], color=GREY, lw=0.6, ls=":")
    ax.text(1.59, surface / 2 - 0.03, "z", color=GREY)

    ax.plot(0, 1, "o", color="k", ms=4)
    arrow(ax, (0, 1), (0, 0.62))
    ax.text(-0.11, 0.72, "W")
    arrow(ax, (0, 1), (0.62, 1), BLUE)
    ax.text(0.40, 1.05, r"$F_{DP}$", color=BLUE)
    arc(ax, 0.26, 290 * deg, 130 * deg, "k", 1.4)
    ax.text(-0.02, 1.32, "M")
    arc(ax, 1.10, 215 * deg, 165 * deg, ORANGE, 1.4)
    ax.text(-0.03, 2.15, r"$\omega$", color=ORANGE)
    arrow(ax, (1.12, 1.7), (1.72, 1.7), ORANGE)
    ax.text(1.38, 1.76, "v", color=ORANGE)
    ax.set(aspect="equal", xlim=(-1.5, 1.9), ylim=(-0.5, 2.3))
    ax.axis("off")
    save(figure, "geometry")


def stresses():
    """The wheel rolls to the right, so the entry is at the right."""
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.2), sharex=True)
    for slip, colour in ((0.05, GREY), (0.2, BLUE), (0.6, ORANGE)):
        contact, nodes = rolled(slip)
        largest = {step.name: step.value for step in bw.explain(scenario(), AT.replace(slip=slip)).steps}  # kPa, at theta_m
        place = np.searchsorted(nodes["theta"], contact.max_stress_angle)  # no node lies there
        theta = np.insert(nodes["theta"], place, contact.max_stress_angle) / deg
        for ax, stress, name in ((axes[0], "sigma", "normal stress there"), (axes[1], "tau_x", "shear stress there")):
            ax.plot(theta, np.insert(nodes[stress] / kPa, place, largest[name]), color=colour, label=f"slip {100 * slip:.0f} %")
        axes[0].plot(theta[place], largest["normal stress there"], "o", color=colour, ms=4)
    axes[0].set(title=r"normal stress $\sigma$ [kPa]"), axes[1].set(title=r"shear stress $\tau$ [kPa]")
    for ax in axes:
        ax.set(xlabel=r"exit   $\leftarrow$   angle $\theta$ [deg]   $\rightarrow$   entry")
    axes[0].legend(frameon=False)
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
    """For notebook 1: two round plates, their curves, and the line that gives k_c and k_phi. With k_c > 0 the small plate
    is stiffer. The depths on the left are those of the curves at 70 kPa."""
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 2.9))
    ground = axes[0]
    ground.fill_between([-2.6, 2.6], 0, -1.5, color="#e9dcc6", lw=0)
    for middle, half, depth, colour in ((-1.3, 0.35, 0.47, ORANGE), (1.1, 0.8, 0.68, BLUE)):
        ground.fill_between([middle - half, middle + half], 0, -depth, color="white", lw=0)
        ground.fill_between([middle - half, middle + half], -depth, -depth + 0.12, color=colour, lw=0)
        ground.annotate("", (middle, -depth + 0.14), (middle, 0.75), arrowprops={"arrowstyle": "->", "lw": 1.6})
        ground.annotate("", (middle + half, -depth - 0.16), (middle, -depth - 0.16), arrowprops={"arrowstyle": "<->", "color": GREY})
        ground.text(middle + half / 2 - 0.08, -depth - 0.42, "b")
        ground.text(middle + 0.08, 0.5, "p")
    ground.annotate("", (-2.0, -0.47), (-2.0, 0), arrowprops={"arrowstyle": "<->", "color": GREY})
    ground.text(-2.3, -0.3, "z")
    ground.set(xlim=(-2.6, 2.6), ylim=(-1.5, 1.0), title="two round plates, the same pressure")
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
