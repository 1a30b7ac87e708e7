"""Effects on the soil's strength: multipass, rate_dependence, moisture, slope_weakening, soil_gradient."""
import numpy as np

from . import Form, positive


class PassExponential(Form):
    """k (1 + a (1 - exp(-(p - 1)/p0))): hardening that saturates with passes, p0 0.8 - 2."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "multipass", "exponential_hardening", ("pass",), 0.4, 8.0

    @classmethod
    def draw(cls, rng, scale):
        return {"p0": float(rng.uniform(0.8, 2.0))}

    def soil(self, p):
        p.gain = p.gain * (1 + self.a * -np.expm1(-(p.npass - 1) / self.shape["p0"]))


class PassPower(Form):
    """k p^a, c p^(a/2), K p^(-a/2): the rut is denser (after Holm 1969: strength as a power of the pass)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "multipass", "power_densification", ("pass",), 0.3, 2.0

    def soil(self, p):
        p.gain = p.gain * p.npass ** self.a
        p.c, p.K = p.c * p.npass ** (0.5 * self.a), p.K * p.npass ** (-0.5 * self.a)


class PassRut(Form):
    """The rut's depth adds: sinkage (1 + a ln p) under the undisturbed surface, k p^(2a) for what the wheel meets."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "multipass", "rut_depth", ("pass", "sinkage"), 0.2, 1.0

    def soil(self, p):
        p.gain = p.gain * p.npass ** (2 * self.a)

    def report(self, p, out):
        out["sinkage"] = out["sinkage"] * p.npass ** (2 * self.a / (p.n + 0.5)) * (1 + self.a * np.log(p.npass))


class RateLog(Form):
    """k, c (1 + a ln(v/v0)): a decade of speed adds 2.3 a (penetration tests in clay)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rate_dependence", "logarithmic", ("speed",), 0.1, 0.6

    def soil(self, p):
        grow = positive(1 + self.a * np.log(p.v / p.scale["speed"]), 0.2)
        p.gain, p.c = p.gain * grow, p.c * grow


class RateShear(Form):
    """c, tan phi (v/v0)^a: shear strength alone, a power law."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rate_dependence", "shear_power", ("speed",), 0.05, 0.3

    def soil(self, p):
        grow = (p.v / p.scale["speed"]) ** self.a
        p.c, p.tan = p.c * grow, p.tan * grow


class RateViscous(Form):
    """sigma (1 + a sqrt(v_z/v0)), v_z = v sin theta at the front: a damper in parallel with Bekker's spring."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rate_dependence", "local_damper", ("speed",), 0.3, 6.0

    def pressure(self, p, sigma, depth, theta):
        down = p.v[:, None] * np.maximum(np.sin(theta), 0.0) / p.scale["speed"]
        return sigma * (1 + self.a * np.sqrt(down))


class RateShearLinear(Form):
    """c + a p0 v/v0/10: a Bingham soil's plastic viscosity adds to the cohesion."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "rate_dependence", "bingham_cohesion", ("speed",), 0.3, 6.0

    def soil(self, p):
        p.c = p.c + 0.1 * self.a * p.scale["pressure"] * p.v / p.scale["speed"]


def wetness(p):
    """(m - m0)/half range [-], about -1..1 within the campaign."""
    return (p.m - p.scale["moisture"]) / p.scale["moisture_half"]


class MoistQuadratic(Form):
    """c, k (1 + a (0.5 - (w - w_m)^2)): strongest at an optimum (Proctor-like), w_m -0.6 - 0.6."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "moisture", "optimum", ("moisture",), 0.3, 0.8

    @classmethod
    def draw(cls, rng, scale):
        return {"w": float(rng.uniform(-0.6, 0.6))}

    def soil(self, p):
        grow = positive(1 + self.a * (0.5 - (wetness(p) - self.shape["w"]) ** 2))
        p.c, p.gain = p.c * grow, p.gain * grow


class MoistExponential(Form):
    """k exp(-a w), c exp(-1.5 a w): softening as the soil wets (cone index against water content)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "moisture", "exponential_softening", ("moisture",), 0.2, 1.5

    def soil(self, p):
        p.gain, p.c = p.gain * np.exp(-self.a * wetness(p)), p.c * np.exp(-1.5 * self.a * wetness(p))


class MoistFriction(Form):
    """tan phi (1 - a w), K (1 + a w): wet soil slips more easily and later; bearing the same."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "moisture", "friction", ("moisture",), 0.1, 0.5

    def soil(self, p):
        p.tan, p.K = p.tan * positive(1 - self.a * wetness(p)), p.K * positive(1 + self.a * wetness(p))


class MoistSuction(Form):
    """c + a p0 exp(-((w + 0.3)/0.6)^2)/5: capillary cohesion of damp sand, none when dry or flooded."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "moisture", "capillary_cohesion", ("moisture",), 0.3, 3.0

    def soil(self, p):
        p.c = p.c + 0.2 * self.a * p.scale["pressure"] * np.exp(-((wetness(p) + 0.3) / 0.6) ** 2)


def slope(p):
    """Steepest slope of the bed [rad] from both inclines."""
    return np.arccos(np.clip(np.cos(p.al) * np.cos(p.be), -1, 1))


class SlopeMobilised(Form):
    """tan phi - a tan(slope): the part of the friction that already holds the bed."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "slope_weakening", "mobilised_friction", ("longitudinal",), 0.5, 1.5

    def soil(self, p):
        p.tan = np.maximum(p.tan - self.a * np.tan(slope(p)), 0.1 * p.tan)


class SlopeRoot(Form):
    """k, c, tan phi by sqrt(1 - a (tan slope/tan phi)^2), held to 0.1: an infinite slope's reserve, quadrature sum."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "slope_weakening", "quadrature_reserve", ("longitudinal",), 0.7, 2.5

    def soil(self, p):
        left = np.sqrt(positive(1 - self.a * (np.tan(slope(p)) / p.tan) ** 2, 0.01))
        p.gain, p.c, p.tan = p.gain * left, p.c * left, p.tan * left


class SlopeBearing(Form):
    """k (1 - a slope/30 deg): Meyerhof's loss of bearing near a slope, linear; shear the same."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "slope_weakening", "bearing_linear", ("longitudinal",), 0.5, 1.8

    def soil(self, p):
        p.gain = p.gain * positive(1 - self.a * slope(p) / np.radians(30.0))


def along(p):
    """(x - x0)/half length [-], about -1..1 along the runs' part of the bin."""
    return (p.x - p.scale["position"]) / p.scale["position_half"]


class GradientLinear(Form):
    """k and c (1 + a x')."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "soil_gradient", "linear", ("position",), 0.15, 0.8, True

    def soil(self, p):
        grow = positive(1 + self.a * along(p))
        p.gain, p.c = p.gain * grow, p.c * grow


class GradientWave(Form):
    """k exp(a sin(pi x'/w + f)): compaction in bays, w 0.6 - 1.5."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "soil_gradient", "wave", ("position",), 0.15, 1.0

    @classmethod
    def draw(cls, rng, scale):
        return {"w": float(rng.uniform(0.6, 1.5)), "f": float(rng.uniform(0, 6.28))}

    def soil(self, p):
        p.gain = p.gain * np.exp(self.a * np.sin(np.pi * along(p) / self.shape["w"] + self.shape["f"]))


class GradientStep(Form):
    """c and tan phi by (1 + a) beyond x'': the bin was filled from two batches."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "soil_gradient", "two_batches", ("position",), 0.08, 0.5, True

    @classmethod
    def draw(cls, rng, scale):
        return {"x": float(rng.uniform(-0.4, 0.4))}

    def soil(self, p):
        grow = 1 + self.a * (along(p) > self.shape["x"])
        p.c, p.tan = p.c * grow, p.tan * grow


class GradientFriction(Form):
    """tan phi exp(a x'/2), k exp(a x'): a density that rises along the bin acts on both."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = "soil_gradient", "density", ("position",), 0.1, 0.8, True

    def soil(self, p):
        p.gain, p.tan = p.gain * np.exp(self.a * along(p)), p.tan * np.exp(0.5 * self.a * along(p))
