"""Makes measurements.csv, the spreadsheet of the tutorial "Your first campaign". It is made, not measured.

    python3 docs/guide/first-campaign/make_measurements.py

Nature is the independent wheel of bench/loop/nature, not soilbin: a rigid wheel that digs itself in as slip grows. The
tutorial's model does not know that. The seed below makes the file the same on every run.
"""
import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "bench/loop"))
from nature import wheel as nature  # noqa: E402
from nature.families.contact import SlipModulus  # noqa: E402

SEED = 28
WHEEL = {"radius": 0.125, "width": 0.100, "lug_height": 0.0, "lug_count": 0, "inflation": 0.0}
SOIL = {"exponent": 1.06, "k_c": 1.6e3, "k_phi": 1.70e6, "cohesion": 0.7e3, "friction_angle": np.radians(31.0),
        "shear_modulus": 0.013, "stress_angle_c1": 0.33, "stress_angle_c2": 0.14, "density": 1550.0}
DIGGING = SlipModulus(0.9, {})  # the soil's stiffness is divided by 1 + 0.9 s^1.5
LOADS = (60.0, 100.0, 140.0)  # [N]
SLIPS = (0.05, 0.10, 0.20, 0.30, 0.45, 0.60)
REPEATED = ((60.0, 0.10), (100.0, 0.30), (140.0, 0.45))  # two further runs each: they show the noise of the rig
NOISE = {"drawbar_pull": 1.2, "torque": 0.12, "sinkage": 0.0006}  # standard deviation of one run [N, N m, m]


def main():
    rng = np.random.default_rng(SEED)
    points = [(load, slip) for load in LOADS for slip in SLIPS] + [point for point in REPEATED for _ in range(2)]
    points = [points[i] for i in rng.permutation(len(points))]  # a laboratory draws the order, too
    load, slip = (np.array(values) for values in zip(*points))
    still = np.zeros(len(points))
    rows = {"load": load * (1 + 0.004 * rng.normal(size=len(load))), "slip": slip + 0.003 * rng.normal(size=len(slip)),
            "speed": still + 0.05, "pass": still + 1, "position": still, "moisture": still, "run": 1 + np.arange(len(load)),
            "longitudinal": still, "transverse": still, "yaw": still}
    truth = nature.evaluate(nature.state(WHEEL, SOIL, rows), [DIGGING])
    read = {channel: truth[channel] + sd * rng.normal(size=len(load)) for channel, sd in NOISE.items()}
    with open(HERE / "measurements.csv", "w", newline="", encoding="utf-8") as file:
        sheet = csv.writer(file, lineterminator="\n")
        sheet.writerow(["Test no.", "Test point", "Weight N", "Slip %", "Pull N", "Torque Nm", "Depth mm"])
        for i, (at_load, at_slip) in enumerate(points):
            sheet.writerow([i + 1, f"{at_load:.0f} N at {at_slip * 100:.0f} %", f"{rows['load'][i]:.1f}",
                            f"{rows['slip'][i] * 100:.1f}", f"{read['drawbar_pull'][i]:.1f}", f"{read['torque'][i]:.2f}",
                            f"{read['sinkage'][i] * 1e3:.1f}"])


if __name__ == "__main__":
    main()
