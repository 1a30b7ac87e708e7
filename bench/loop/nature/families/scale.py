"""Instruments that are out of scale: sensor_offset's other forms, in a kind of their own (--only instrument).

They came after the sets of docs/lab/loop-measured.md were drawn, which therefore hold none.
"""
from ..wheel import ratio_from_slip, slip_from_ratio
from . import Form


class SlipRadius(Form):
    """The slip was told by a rolling radius (1 + a) r."""
    ID, NAME, TYPICAL, LARGEST, SIGNED = "sensor_offset", "slip_radius", 0.03, 0.25, True

    def soil(self, p):
        p.s = slip_from_ratio(ratio_from_slip(p.s) * (1 + self.a))


class _Gain(Form):
    """channel (1 + a)."""
    ID, TYPICAL, LARGEST, SIGNED, CHANNEL = None, 0.08, 0.4, True, None

    def sensor(self, p, out):
        out[self.CHANNEL] = out[self.CHANNEL] * (1 + self.a)


class GainPull(_Gain):
    """Force cell out of scale."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "drawbar_pull_gain", (), "drawbar_pull"


class GainTorque(_Gain):
    """Torque cell out of scale."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "torque_gain", ("torque",), "torque"


class GainSinkage(_Gain):
    """Depth gauge out of scale."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "sinkage_gain", ("sinkage",), "sinkage"


class GainSide(_Gain):
    """Side force cell out of scale."""
    ID, NAME, NEEDS, CHANNEL = "sensor_offset", "lateral_force_gain", ("lateral_force", "yaw"), "lateral_force"
