"""Effects that the catalogue does not hold (ID None): the right answer is `unknown_effect`."""
import numpy as np

from ..wheel import ratio_from_slip, sinkage, slip_from_ratio
from . import Form


class Resonance(Form):
    """F_DP and M (1 + a/(1 + ((s - s0)/w)^2)): the drive train rings near one slip."""
    NAME, TYPICAL, LARGEST, SIGNED = "slip_resonance", 0.15, 0.8, True

    @classmethod
    def draw(cls, rng, scale):
        return {"s0": float(rng.uniform(0.15, 0.5)), "w": float(rng.uniform(0.04, 0.1))}

    def sensor(self, p, out):
        bump = self.a / (1 + ((p.s - self.shape["s0"]) / self.shape["w"]) ** 2)
        for name in ("drawbar_pull", "torque"):
            out[name] = out[name] + bump * p.scale["spread"][name]


class LugRipple(Form):
    """F_DP + a spread sin(N theta_1 + f), N 30 - 90: a mean taken over a broken number of lug passages."""
    NAME, NEEDS, TYPICAL, LARGEST = "lug_ripple", ("loads",), 0.2, 0.8

    @classmethod
    def draw(cls, rng, scale):
        return {"n": float(rng.uniform(30, 90)), "f": float(rng.uniform(0, 6.28))}

    def sensor(self, p, out):
        wave = np.sin(self.shape["n"] * p.th1 + self.shape["f"])
        out["drawbar_pull"] = out["drawbar_pull"] + self.a * p.scale["spread"]["drawbar_pull"] * wave


class CellCubic(Form):
    """F_DP - a spread P3(F/(2 spread)), P3 Legendre's cubic: a load cell beyond its linear range."""
    NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "cell_nonlinearity", ("loads",), 0.2, 0.6, True

    def sensor(self, p, out):
        spread = p.scale["spread"]["drawbar_pull"]
        x = np.clip((out["drawbar_pull"] - p.scale["middle"]["drawbar_pull"]) / (2 * spread), -1.3, 1.3)
        out["drawbar_pull"] = out["drawbar_pull"] - self.a * spread * 0.5 * (5 * x ** 3 - 3 * x)


class ExitSuction(Form):
    """F_DP - a W0 sqrt(z/z0) v/(v + v0) (1 - s): soil sucked up behind a moving wheel."""
    NAME, NEEDS, TYPICAL, LARGEST = "exit_suction", ("speed",), 0.05, 0.4

    def report(self, p, out):
        pull = np.sqrt(sinkage(p, p.th1) / p.scale["sinkage"]) * p.v / (p.v + p.scale["speed"]) * ratio_from_slip(p.s) ** 2
        out["drawbar_pull"] = out["drawbar_pull"] - self.a * p.scale["load"] * pull


class SlipReading(Form):
    """The true slip is the one written less a (v/v0 - 1): an encoder that loses pulses at speed."""
    NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "slip_misread", ("speed",), 0.02, 0.12, True

    def soil(self, p):
        ratio = ratio_from_slip(p.s) * (1 + self.a * (p.v / p.scale["speed"] - 1))
        p.s = np.clip(slip_from_ratio(np.maximum(ratio, 0.02)), -0.98, 0.98)


class DayBlocks(Form):
    """Force channels (1 + a T), T alternating between 4 - 7 blocks of runs: warm and cold days."""
    NAME, NEEDS, TYPICAL, LARGEST = "temperature_blocks", ("run",), 0.06, 0.3

    @classmethod
    def draw(cls, rng, scale):
        count = int(rng.integers(4, 8))
        sign = np.where(np.arange(count) % 2, 1.0, -1.0)
        return {"t": [float(v) for v in sign * rng.uniform(0.6, 1.4, count)]}

    def sensor(self, p, out):
        days = np.array(self.shape["t"])
        block = (p.run - 1) * len(days) // max(p.scale["runs"], 1)
        for name in ("drawbar_pull", "torque", "lateral_force"):
            out[name] = out[name] * (1 + self.a * days[block.astype(int) % len(days)])


class Hysteresis(Form):
    """channel + a (the run before - this one): a cell that creeps with its history."""
    NAME, NEEDS, TYPICAL, LARGEST = "sensor_hysteresis", ("run",), 0.1, 0.5

    @classmethod
    def draw(cls, rng, scale):
        return {"channel": str(rng.choice(scale["channels"]))}

    def sensor(self, p, out):
        name = self.shape["channel"]
        turn = np.argsort(p.run, kind="stable")
        before = np.empty(p.count)
        before[turn] = np.concatenate([out[name][turn[:1]], out[name][turn[:-1]]])
        out[name] = out[name] + self.a * (before - out[name])


class SlipChatter(Form):
    """M + a spread cos(2 pi s/w), w 0.18 - 0.3: stick-slip locked to slip."""
    NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "slip_chatter", ("torque",), 0.15, 0.6, True

    @classmethod
    def draw(cls, rng, scale):
        return {"w": float(rng.uniform(0.18, 0.3)), "f": float(rng.uniform(0, 6.28))}

    def sensor(self, p, out):
        wave = np.cos(2 * np.pi * p.s / self.shape["w"] + self.shape["f"])
        out["torque"] = out["torque"] + self.a * p.scale["spread"]["torque"] * wave


class LoadWindow(Form):
    """z (1 + a sin(6 ln(W/W0) + f)): the carriage's frame bends at some loads and fools the sinkage reading."""
    NAME, NEEDS, TYPICAL, LARGEST = "frame_bending", ("loads", "sinkage"), 0.1, 0.4

    @classmethod
    def draw(cls, rng, scale):
        return {"f": float(rng.uniform(0, 6.28))}

    def sensor(self, p, out):
        out["sinkage"] = out["sinkage"] * (1 + self.a * np.sin(6 * np.log(p.W / p.scale["load"]) + self.shape["f"]))
