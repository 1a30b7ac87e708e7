"""Effects of the rig and its instruments: bed_tilt, rig_friction, sensor_offset, cross_talk, drift."""
import numpy as np

from ..wheel import ratio_from_slip
from . import Form, positive


def turn(p):
    """Speed of rotation [rad/s] from speed and slip (no rotation at slip -1)."""
    return p.v * np.cos(p.psi) / (p.r0 * np.maximum(ratio_from_slip(p.s), 0.05))


class TiltConstant(Form):
    """F_DP - W sin(a): one tilt a [rad] of the whole bed."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "bed_tilt", "constant", ("loads",), 0.02, 0.12, True

    def report(self, p, out):
        out["drawbar_pull"] = out["drawbar_pull"] - p.W * np.sin(self.a)


class TiltBoth(Form):
    """The bed leans along and across: F_DP - a W, F_y - e a W, e -1 - 1."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "bed_tilt", "along_and_across", ("loads", "lateral_force"), 0.02, 0.1, True

    @classmethod
    def draw(cls, rng, scale):
        return {"e": float(rng.uniform(-1, 1))}

    def report(self, p, out):
        out["drawbar_pull"] = out["drawbar_pull"] - self.a * p.W
        out["lateral_force"] = out["lateral_force"] - self.shape["e"] * self.a * p.W


class TiltSag(Form):
    """F_DP - a W (0.6 + 0.4 x'): tilted, and sagging so that the slope grows along the bin."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "bed_tilt", "tilt_and_sag", ("loads", "position"), 0.02, 0.12, True

    def report(self, p, out):
        x = (p.x - p.scale["position"]) / p.scale["position_half"]
        out["drawbar_pull"] = out["drawbar_pull"] - self.a * p.W * (0.6 + 0.4 * x)


class FrictionCoulomb(Form):
    """M + a M0: bearings of constant friction."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rig_friction", "coulomb", ("torque",), 0.1, 1.0

    def sensor(self, p, out):
        out["torque"] = out["torque"] + self.a * p.scale["torque"] * np.sign(1 + p.s)


class FrictionViscous(Form):
    """M + a M0 w/w0: oil in the gearbox."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rig_friction", "viscous", ("torque", "speed"), 0.1, 1.0

    def sensor(self, p, out):
        out["torque"] = out["torque"] + self.a * p.scale["torque"] * turn(p) / p.scale["turn"]


class FrictionLoad(Form):
    """M + a M0 W/W0: bearing friction by load."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rig_friction", "load_proportional", ("torque", "loads"), 0.1, 1.0

    def sensor(self, p, out):
        out["torque"] = out["torque"] + self.a * p.scale["torque"] * p.W / p.scale["load"]


class FrictionStribeck(Form):
    """M + a M0 (0.5 + exp(-w/w0)): seals that stick when slow."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rig_friction", "stribeck", ("torque", "speed"), 0.1, 1.0

    def sensor(self, p, out):
        out["torque"] = out["torque"] + self.a * p.scale["torque"] * (0.5 + np.exp(-turn(p) / p.scale["turn"]))


class _Offset(Form):
    """channel + a (the channel's spread)."""
    ID, TYPICAL, LARGEST, SIGNED, CHANNEL = None, 0.15, 0.8, True, None

    def sensor(self, p, out):
        out[self.CHANNEL] = out[self.CHANNEL] + self.a * p.scale["spread"][self.CHANNEL]


class OffsetPull(_Offset):
    """F_DP + a spread."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "drawbar_pull", (), "drawbar_pull"


class OffsetTorque(_Offset):
    """M + a spread."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "torque", ("torque",), "torque"


class OffsetSinkage(_Offset):
    """z + a spread: the surface was read high or low."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "sinkage", ("sinkage", "loads"), "sinkage"


class OffsetSide(_Offset):
    """F_y + a spread."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "lateral_force", ("lateral_force",), "lateral_force"


class _Leak(Form):
    """to + a from (spread of to/spread of from)."""
    ID, TYPICAL, LARGEST, SIGNED, FROM, TO, POWER = None, 0.06, 0.4, True, None, None, 1

    def sensor(self, p, out):
        spread = p.scale["spread"]
        x = out[self.FROM] / spread[self.FROM]
        out[self.TO] = out[self.TO] + self.a * spread[self.TO] * x * np.abs(x) ** (self.POWER - 1)


class LeakTorquePull(_Leak):
    """Torque into drawbar pull, linear."""
    ID, NAME, NEEDS, FROM, TO = "cross_talk", "torque_to_pull", ("torque", "loads"), "torque", "drawbar_pull"


class LeakSidePull(_Leak):
    """Side force into drawbar pull, linear."""
    ID, NAME, NEEDS, FROM, TO = "cross_talk", "side_to_pull", ("lateral_force", "yaw"), "lateral_force", "drawbar_pull"


class LeakPullTorque(_Leak):
    """Drawbar pull into torque, slightly more than linear (power 1.3)."""
    ID, NAME, NEEDS, FROM, TO, POWER = "cross_talk", "pull_to_torque", ("torque", "loads"), "drawbar_pull", "torque", 1.3


class LeakPullSide(_Leak):
    """Drawbar pull into side force, linear."""
    ID, NAME, NEEDS, FROM, TO = "cross_talk", "pull_to_side", ("lateral_force",), "drawbar_pull", "lateral_force"


def order(p):
    """(run - first)/(planned runs - 1) [-], 0..1 within the campaign."""
    return (p.run - 1) / max(p.scale["runs"] - 1, 1)


class DriftSoil(Form):
    """k and c by exp(a t): the bed dries or compacts steadily."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "drift", "soil_exponential", ("run",), 0.2, 1.0, True

    def soil(self, p):
        p.gain, p.c = p.gain * np.exp(self.a * order(p)), p.c * np.exp(self.a * order(p))


class DriftSensor(Form):
    """A channel's zero moves as a sqrt(t) spread: warming up."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "drift", "warming_zero", ("run",), 0.2, 1.0, True

    @classmethod
    def draw(cls, rng, scale):
        return {"channel": str(rng.choice(scale["channels"]))}

    def sensor(self, p, out):
        name = self.shape["channel"]
        out[name] = out[name] + self.a * p.scale["spread"][name] * np.sqrt(order(p))


class DriftStep(Form):
    """k by (1 + a) after a run in the middle: the bed was turned over once."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "drift", "soil_step", ("run",), 0.2, 0.8, True

    @classmethod
    def draw(cls, rng, scale):
        return {"t": float(rng.uniform(0.3, 0.7))}

    def soil(self, p):
        p.gain = p.gain * (1 + self.a * (order(p) > self.shape["t"]))


class DriftWalk(Form):
    """tan phi and c by 1 + a w(t), w a smoothed random walk of unit range with a trend."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "drift", "soil_walk", ("run",), 0.1, 0.6, True

    @classmethod
    def draw(cls, rng, scale):
        knots = np.cumsum(rng.normal(0.5, 0.6, 7))
        return {"knots": [float(k) for k in (knots - knots[0]) / (np.ptp(knots) + 1e-9)]}

    def soil(self, p):
        knots = np.array(self.shape["knots"])
        w = np.interp(order(p) * 0.75, np.linspace(0, 1, len(knots)), knots)  # the last quarter is for later runs
        grow = positive(1 + self.a * w)
        p.tan, p.c = p.tan * grow, p.c * grow
