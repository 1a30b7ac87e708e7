"""The base model as one would write it with SciPy: quad over each side of theta_m, brentq for the balance.

What operating_point.cpp is measured against. Written from docs/reference/conventions.md, in plain floats (faster here than NumPy
scalars). quad to a relative 1e-8, brentq to a relative 1e-10.
"""

import csv
import time
from math import acos, cos, exp, hypot, radians, sin, tan

from scipy.integrate import quad
from scipy.optimize import brentq


class Wheel:
    def __init__(self, row):
        number = {key: float(value) for key, value in row.items() if key != "kind"}
        self.kind = row["kind"]
        self.r, self.b, self.n = number["radius"], number["width"], number["n"]
        self.k = number["k_c"] / self.b + number["k_phi"]
        self.c, self.tan_phi = number["cohesion"], tan(radians(number["friction_angle_deg"]))
        self.K, self.load = number["shear_modulus"], number["load"]
        slip, self.yaw = number["slip"], radians(number["yaw_deg"])
        self.rate = 1 - slip if slip >= 0 else 1 / (1 + slip)
        self.side_rate = self.rate * tan(self.yaw)
        self.share = min(number["c1"] + number["c2"] * abs(slip), 0.98)

    def stress(self, theta, theta_1):
        """sigma, tau_x, tau_y [Pa]"""
        theta_m = self.share * theta_1
        seen = theta if theta > theta_m else theta_1 - theta / theta_m * (theta_1 - theta_m)
        sigma = self.k * (self.r * max(cos(seen) - cos(theta_1), 0.0)) ** self.n
        j_x = self.r * (theta_1 - theta - self.rate * (sin(theta_1) - sin(theta)))
        j_y = self.r * self.side_rate * (theta_1 - theta)
        j = hypot(j_x, j_y)
        if j == 0.0:
            return sigma, 0.0, 0.0
        tau = (self.c + sigma * self.tan_phi) * (1 - exp(-j / self.K))
        return sigma, tau * j_x / j, tau * j_y / j

    def integral(self, term, theta_1):
        theta_m = self.share * theta_1

        def density(theta):
            return term(theta, *self.stress(theta, theta_1))

        parts = (quad(density, low, high, epsabs=0, epsrel=1e-8, limit=200)[0]
                 for low, high in ((0, theta_m), (theta_m, theta_1)))
        return self.r * self.b * sum(parts)

    def roll(self):
        """sinkage [m], drawbar pull [N], torque [N m], lateral force [N]"""
        def excess(theta_1):
            return self.integral(lambda t, s, x, y: s * cos(t) + x * sin(t), theta_1) - self.load

        theta_1 = brentq(excess, 1e-3, acos(0.1), rtol=1e-10)
        forward = self.integral(lambda t, s, x, y: x * cos(t) - s * sin(t), theta_1)
        torque = self.r * self.integral(lambda t, s, x, y: x, theta_1)
        side = self.integral(lambda t, s, x, y: y, theta_1) if self.yaw else 0.0
        return (self.r * (1 - cos(theta_1)), forward * cos(self.yaw) - side * sin(self.yaw), torque,
                forward * sin(self.yaw) + side * cos(self.yaw))


def measure(points_file):
    """Results of every point, and the mean time of a point [s] by kind."""
    with open(points_file, newline="") as file:
        wheels = [Wheel(row) for row in csv.DictReader(file)]
    results, spent, count = [], {}, {}
    for wheel in wheels:
        start = time.perf_counter()
        results.append((wheel.kind, *wheel.roll()))
        spent[wheel.kind] = spent.get(wheel.kind, 0.0) + time.perf_counter() - start
        count[wheel.kind] = count.get(wheel.kind, 0) + 1
    return results, {kind: spent[kind] / count[kind] for kind in spent}
