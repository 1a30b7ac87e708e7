"""Added forces: bulldozing, sidewall_bulldozing, lug_thrust's passive wedge."""
import numpy as np

from . import Form


def flow(p):
    """Rankine's passive coefficient N_phi = tan^2(45 deg + phi/2) [-]."""
    return np.tan(np.pi / 4 + 0.5 * np.arctan(p.tan)) ** 2


class LugWedge(Form):
    """Lugs in contact, each a passive blade b (rho g h^2/2 N + q h N + 2 c h sqrt N), mobilised by 1 - exp(-s l/K), at r + h/2."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "lug_thrust", "passive_wedge", ("lugs",), 0.3, 1.5

    def added(self, p, z, th1):
        if not p.h:
            return {}
        n, weight = flow(p), p.rho * 9.81
        blade = p.b * p.h * (0.5 * weight * p.h * n + 0.5 * weight * z * n + 2 * p.c * np.sqrt(n))
        met = p.lugs * th1 / (2 * np.pi)
        push = self.a * met * blade * np.sign(p.s) * -np.expm1(-np.abs(p.s) * p.r * th1 / p.K)
        return {"Fx": push, "M": push * (p.r0 + 0.5 * p.h)}


class BowRankine(Form):
    """R = a b (rho g z^2/2 N + 2 c z sqrt N): Rankine's passive wall of the height of the sinkage."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "bulldozing", "rankine_wall", ("loads",), 0.3, 3.0

    def added(self, p, z, th1):
        n = flow(p)
        return {"Fx": -self.a * p.b * (0.5 * p.rho * 9.81 * z ** 2 * n + 2 * p.c * z * np.sqrt(n))}


class BowCoulomb(Form):
    """R = a b rho g z^2/2 K_p, K_p by Coulomb with a wall friction of phi/2 and a surcharge of a heap 0.5 z high."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "bulldozing", "coulomb_heap", ("loads",), 0.5, 8.0

    def added(self, p, z, th1):
        phi = np.arctan(p.tan)
        delta = 0.5 * phi
        kp = np.cos(phi) ** 2 / (np.cos(delta) * (1 - np.sqrt(np.sin(phi + delta) * np.sin(phi) / np.cos(delta))) ** 2)
        return {"Fx": -self.a * p.b * 0.5 * p.rho * 9.81 * (z ** 2 + z * z) * kp}


class BowPower(Form):
    """R = a W0 (z/z0)^e, e 1.2 - 2.5: a power of the sinkage."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "bulldozing", "power", ("loads",), 0.03, 0.4

    @classmethod
    def draw(cls, rng, scale):
        return {"e": float(rng.uniform(1.2, 2.5))}

    def added(self, p, z, th1):
        return {"Fx": -self.a * p.scale["load"] * (z / p.scale["sinkage"]) ** self.shape["e"]}


def aside(p):
    """Which way and how much the wheel moves sideways [-]: sin(yaw) plus half of the cross slope's sine."""
    return np.sin(p.psi) + 0.5 * np.sin(p.be)


class SideRankine(Form):
    """F_y by a passive wall over the sunken chord r sin theta_1, mean depth 2z/3, mobilised by tanh(|aside|/0.1)."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "sidewall_bulldozing", "passive_chord", ("yaw", "lateral_force"), 0.3, 3.0

    def added(self, p, z, th1):
        n, d = flow(p), 2 * z / 3
        wall = p.r * np.sin(th1) * (0.5 * p.rho * 9.81 * d ** 2 * n + 2 * p.c * d * np.sqrt(n))
        return {"Fy": self.a * wall * np.tanh(aside(p) / 0.1)}


class SidePower(Form):
    """F_y = a W (z/z0)^1.5 sin(yaw): no threshold, no cohesion."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "sidewall_bulldozing", "power", ("yaw", "lateral_force"), 0.1, 1.5

    def added(self, p, z, th1):
        return {"Fy": self.a * p.scale["load"] * (z / p.scale["sinkage"]) ** 1.5 * aside(p)}


class SideDrag(Form):
    """The side wedge also drags: F_y = a A (p0/4) aside/0.2, F_x = -0.4 |F_y|, A the sunken segment's area."""
    ID, NAME, NEEDS, TYPICAL, LARGEST = "sidewall_bulldozing", "segment_with_drag", ("yaw", "lateral_force"), 0.5, 8.0

    def added(self, p, z, th1):
        area = p.r ** 2 * (th1 - np.sin(th1) * np.cos(th1))
        side = self.a * area * 0.25 * p.scale["pressure"] * np.tanh(aside(p) / 0.2)
        return {"Fy": side, "Fx": -0.4 * np.abs(side)}
