"""Draws the figure of docs/theory/uncertainty.md, from the answers of soilbin itself.

    PYTHONPATH=build/release/python /usr/bin/python3 docs/theory/uncertainty/figures.py
"""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

import soilbin

HERE = Path(__file__).resolve().parent
NAMES = {"exponent": "$n$", "k_c": "$k_c$", "k_phi": r"$k_\phi$", "cohesion": "$c$", "friction_angle": r"$\varphi$",
         "shear_modulus": "$K$", "stress_angle_c1": "$c_1$", "stress_angle_c2": "$c_2$"}
plt.rcParams.update({"svg.hashsalt": "soilbin", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
                     "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False})


def main():
    tire, soil = soilbin.find_tire("paper-lugged"), soilbin.find_soil("paper-sand")
    at = soilbin.OperatingCondition(load=4000.0, slip=0.2)
    whole = soilbin.estimate(soilbin.Scenario(tire, soil), at)
    parts = {}
    for name, symbol in NAMES.items():
        kept = soil.semi_empirical
        for other in NAMES:
            if other != name:
                kept = kept.replace(**{other: soilbin.Estimate(getattr(kept, other).value, 0.0)})
        alone = soilbin.estimate(soilbin.Scenario(tire, soilbin.Soil(name=name, semi_empirical=kept)), at)
        parts[symbol] = (alone.drawbar_pull.std_error, alone.sinkage.std_error * 1e3)
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.2), sharey=True)
    for ax, column, title, error in ((axes[0], 0, "drawbar pull [N]", whole.drawbar_pull.std_error),
                                     (axes[1], 1, "sinkage [mm]", whole.sinkage.std_error * 1e3)):
        values = [part[column] for part in parts.values()]
        ax.barh(list(parts), values, color="#1f6fb4")
        ax.axvline(error, color="#d9631e")
        ax.text(0.98 * error, 7.1, "together", color="#d9631e", ha="right")
        ax.set(title=f"standard error of the {title}")
        print(title, f"together {error:.3g}, root of the sum of squares {np.sqrt(np.sum(np.square(values))):.3g}",
              {k: f"{v[column]:.2g}" for k, v in parts.items()})
    axes[0].invert_yaxis()
    figure.tight_layout()
    figure.savefig(HERE / "parts.svg", metadata={"Date": None, "Creator": "docs/theory/uncertainty/figures.py"},
                   bbox_inches="tight", facecolor="white")


if __name__ == "__main__":
    main()
