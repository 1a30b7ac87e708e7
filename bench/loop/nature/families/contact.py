"""Effects on the contact's geometry and its pressure: exit_angle, slip_sinkage, tire_flexibility, hard_layer."""
import numpy as np

from . import Form


class ExitProportional(Form):
    """theta_2 = -a theta_1 (1 - 0.5 max(s, 0)): exit a part of the entry angle, less as slip grows (Wong 2008, ch. 2)."""
    ID, NAME, TYPICAL, LARGEST = "exit_angle", "proportional_to_entry", 0.3, 0.75

    def exit(self, p, th1, th2):
        return -self.a * th1 * (1 - 0.5 * np.maximum(p.s, 0.0))


class ExitConstant(Form):
    """theta_2 = -a [rad], held to 0.8 theta_1: a fixed tail of contact (as fitted to stress-cell wheels)."""
    ID, NAME, TYPICAL, LARGEST = "exit_angle", "constant", 0.08, 0.3

    def exit(self, p, th1, th2):
        return -0.8 * th1 * np.tanh(self.a / (0.8 * th1))


class ExitRebound(Form):
    """Elastic rebound: cos theta_2 = 1 - z_e/r, z_e = min(a sqrt(W/W0) z0, 0.9 z): unloading stiffer than loading."""
    ID, NAME, TYPICAL, LARGEST = "exit_angle", "elastic_rebound", 0.1, 0.8

    def exit(self, p, th1, th2):
        z = 2 * p.r * np.sin(th1 / 2) ** 2
        back = np.minimum(self.a * np.sqrt(p.W / p.scale["load"]) * p.scale["sinkage"], 0.9 * z)
        return -np.arccos(1 - back / p.r)


class ExitEarly(Form):
    """theta_2 = +a theta_m, a < 0.85: the rut's floor leaves the wheel before the axle (plastic soil, no rebound)."""
    ID, NAME, TYPICAL, LARGEST = "exit_angle", "early", 0.3, 0.85

    def exit(self, p, th1, th2):
        return self.a * np.minimum(p.c1 + p.c2 * np.abs(p.s), 0.98) * th1


class SlipReece(Form):
    """Extra depth a z0 s/(1 - s), s held to 0.85 (Reece 1965: the height of soil a grouser removes per slip)."""
    ID, NAME, TYPICAL, LARGEST = "slip_sinkage", "reece", 0.2, 1.5

    def sunk(self, p, z):
        s = np.clip(p.s, 0.0, 0.85)
        return self.a * p.scale["sinkage"] * s / (1 - s)


class SlipSaturating(Form):
    """Extra depth a r (1 - exp(-s/s0)): digging that ends (cf. Lyasko 2010's bounded K_ss), s0 0.15 - 0.4."""
    ID, NAME, TYPICAL, LARGEST = "slip_sinkage", "saturating", 0.02, 0.3

    @classmethod
    def draw(cls, rng, scale):
        return {"s0": float(rng.uniform(0.15, 0.4))}

    def sunk(self, p, z):
        return self.a * p.r * -np.expm1(-np.maximum(p.s, 0.0) / self.shape["s0"])


class SlipExponent(Form):
    """n -> n + a s^2 for s > 0, depth in reference z0 so that k keeps its unit (after Ding 2010, n linear in s there)."""
    ID, NAME, TYPICAL, LARGEST = "slip_sinkage", "quadratic_exponent", 0.3, 2.0

    def soil(self, p):
        p.n = p.n + self.a * np.maximum(p.s, 0.0) ** 2


class SlipModulus(Form):
    """k -> k/(1 + a s^1.5) for s > 0: the sheared layer bears less."""
    ID, NAME, TYPICAL, LARGEST = "slip_sinkage", "softening_modulus", 0.5, 8.0

    def soil(self, p):
        p.gain = p.gain / (1 + self.a * np.maximum(p.s, 0.0) ** 1.5)


class TireCircle(Form):
    """Substitute circle r* = r (1 + a (W/(b r p_i))^0.8), torque's arm still r (cf. Schmid 1995)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "tire_flexibility", "substitute_circle", ("inflation", "loads"), 0.3, 3.0

    def soil(self, p):
        if p.inflation:
            grow = 1 + self.a * (p.W / (p.b * p.r0 * p.inflation)) ** 0.8
            p.r, p.rs = p.r * grow, p.rs * grow


class TirePressure(Form):
    """sigma -> sigma/(1 + (a sigma/p_i)^3)^(1/3): the carcass carries no more than about p_i/a (cf. Wong 2008, ch. 2)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "tire_flexibility", "pressure_ceiling", ("inflation",), 0.8, 3.0

    def pressure(self, p, sigma, depth, theta):
        return sigma / np.cbrt(1 + (self.a * sigma / p.inflation) ** 3) if p.inflation else sigma


class TireParabola(Form):
    """The tread gives way by f (d/z)^2, f = a W/(p_i b) * 0.1 held to 0.7 z: a parabolic flattening; z less by f."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "tire_flexibility", "parabolic_flattening", ("inflation", "loads"), 0.3, 4.0

    def _flat(self, p, z):
        return 0.7 * z * np.tanh(0.1 * self.a * p.W / (p.inflation * p.b) / (0.7 * z)) if p.inflation else 0.0 * z

    def outline(self, p, depth, th1):
        z = np.maximum(2 * p.r * np.sin(th1 / 2) ** 2, 1e-12)
        return depth - self._flat(p, z)[:, None] * (depth / z[:, None]) ** 2

    def report(self, p, out):
        out["sinkage"] = out["sinkage"] - self._flat(p, out["sinkage"])


class LayerHyperbolic(Form):
    """sigma (1 + a d/(H - d)), d < 0.97 H: a floor at H [m] (the bin's depth, or a firm layer)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "hard_layer", "hyperbolic", ("layer", "loads"), 0.5, 6.0

    def pressure(self, p, sigma, depth, theta):
        d = np.minimum(depth, 0.97 * p.scale["layer"])
        return sigma * (1 + self.a * d / (p.scale["layer"] - d))


class LayerCubic(Form):
    """sigma (1 + a (d/H)^3): stiffening that sets in late."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "hard_layer", "cubic", ("layer", "loads"), 2.0, 60.0

    def pressure(self, p, sigma, depth, theta):
        return sigma * (1 + self.a * (depth / p.scale["layer"]) ** 3)


class LayerBilinear(Form):
    """sigma + a k z0^(n-1) <d - d_h>: a second, linear stiffness below d_h (a plough pan under loose soil)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "hard_layer", "two_layers", ("layer", "loads"), 1.0, 30.0

    @classmethod
    def draw(cls, rng, scale):
        return {"top": float(rng.uniform(0.5, 0.9) * scale["sinkage"])}

    def pressure(self, p, sigma, depth, theta):
        k = (p.kc / p.b + p.kphi) * p.scale["sinkage"] ** (p.n - 1)
        return sigma + self.a * k[:, None] * np.maximum(depth - self.shape["top"], 0.0)
