"""Effects on the shear law: interface_limit, shear_hump, pressure_dependent_shear_modulus, lug_thrust (two of three)."""
import numpy as np

from . import Form


class InterfaceCoulomb(Form):
    """tau <= (1 - a)^2 c + sigma (1 - a) tan phi: adhesion falls faster than wall friction (Potyondy 1961)."""
    ID, NAME, TYPICAL, LARGEST = "interface_limit", "coulomb", 0.3, 0.8

    def limit(self, p, tau, sigma):
        return np.minimum(tau, (1 - self.a) ** 2 * p.c[:, None] + (1 - self.a) * sigma * p.tan[:, None])


class InterfaceSmooth(Form):
    """tau (1 + (a tau/t)^3)^(-1/3), t = c + sigma tan phi: a wall reached smoothly."""
    ID, NAME, TYPICAL, LARGEST = "interface_limit", "smooth", 0.8, 3.0

    def limit(self, p, tau, sigma):
        top = p.c[:, None] + sigma * p.tan[:, None]
        return tau / np.cbrt(1 + (self.a * tau / np.maximum(top, 1e-9)) ** 3)


class InterfaceConstant(Form):
    """tau -> t_a tanh(tau/t_a), t_a = t0/a: a rubber or wet metal surface of pressure-independent adhesion."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "interface_limit", "constant_adhesion", ("loads",), 0.5, 4.0

    def limit(self, p, tau, sigma):
        x = self.a * tau / (p.scale["pressure"] * p.tan[:, None] + p.c[:, None])
        return np.where(x > 1e-6, tau * np.tanh(x) / np.maximum(x, 1e-6), tau)


class HumpGaussian(Form):
    """part (1 + a exp(-((x - 3)/1.5)^2)), x = j/K: a bump on Janosi's curve."""
    ID, NAME, TYPICAL, LARGEST = "shear_hump", "gaussian_bump", 0.3, 1.5

    def mobilised(self, p, part, x):
        return part * (1 + self.a * np.exp(-((x - 3.0) / 1.5) ** 2))


class HumpLinear(Form):
    """Linear softening from x1 = j/K to a residual 1 - a at x2 (brittle clay)."""
    ID, NAME, TYPICAL, LARGEST = "shear_hump", "linear_softening", 0.3, 0.8

    @classmethod
    def draw(cls, rng, scale):
        start = float(rng.uniform(0.8, 2.5))
        return {"x1": start, "x2": start + float(rng.uniform(1.5, 6.0))}

    def mobilised(self, p, part, x):
        fall = np.clip((x - self.shape["x1"]) / (self.shape["x2"] - self.shape["x1"]), 0.0, 1.0)
        return part * (1 - self.a * fall)


class HumpBekker(Form):
    """(1 - a) Janosi + a Bekker 1956: (e^-x' - e^-k x')/peak, over-damped, falls to nothing; x' = 0.5 x, k = 3."""
    ID, NAME, TYPICAL, LARGEST = "shear_hump", "bekker_two_exponentials", 0.3, 0.9

    def mobilised(self, p, part, x):
        peak = 3 ** -0.5 - 3 ** -1.5
        return (1 - self.a) * part + self.a * (np.exp(-0.5 * x) - np.exp(-1.5 * x)) / peak


class ModulusLinear(Form):
    """K (1 + a sigma/p0): K rises with normal stress (sands; Wong 2008, ch. 2), p0 a typical pressure."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "pressure_dependent_shear_modulus", "linear", ("loads",), 0.5, 8.0

    def modulus(self, p, modulus, sigma):
        return modulus * (1 + self.a * sigma / p.scale["pressure"])


class ModulusPower(Form):
    """K ((sigma + 0.02 p0)/p0)^a."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "pressure_dependent_shear_modulus", "power", ("loads",), 0.4, 1.5

    def modulus(self, p, modulus, sigma):
        return modulus * (np.maximum(sigma, 0.0) / p.scale["pressure"] + 0.02) ** self.a


class ModulusStiffening(Form):
    """K/(1 + a (sigma/p0)^0.5): stress stiffens the soil's shear (G grows as the root of stress), strength the same."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "pressure_dependent_shear_modulus", "stiffening_root", ("loads",), 0.8, 8.0

    def modulus(self, p, modulus, sigma):
        return modulus / (1 + self.a * np.sqrt(np.maximum(sigma, 0.0) / p.scale["pressure"]))


class LugRadius(Form):
    """All shear at r + a h, a <= 1.2: the soil between the lugs turns with the wheel."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "lug_thrust", "effective_radius", ("lugs",), 0.7, 1.2

    def soil(self, p):
        p.rs, p.arm = p.rs + self.a * p.h, p.arm + self.a * p.h


class LugMicklethwait(Form):
    """c (1 + 2 a h/b), tan phi (1 + 0.64 a (h/b) arccot(h/b)): Micklethwait's and Bekker's side shear of the lugs."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "lug_thrust", "side_shear", ("lugs",), 1.0, 3.0

    def soil(self, p):
        if p.h > 0:
            ratio = p.h / p.b
            p.c = p.c * (1 + 2 * self.a * ratio)
            p.tan = p.tan * (1 + 0.64 * self.a * ratio * np.arctan(1 / ratio))
