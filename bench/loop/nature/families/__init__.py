"""The effects: a form is a class with an id of the catalogue, a name, a scale parameter `a` and its joints.

`a` = 0 is no effect. TYPICAL is a first guess of a's size, LARGEST its physical bound; SIGNED says that either sign is
physical. NEEDS names what a campaign must vary or have for the effect to leave a trace: speed, pass, position, moisture,
longitudinal, transverse, yaw, run, lugs, inflation, loads, brake, and the channels. `shape` draws the form's other
constants (JSON values); `p` is wheel.state, whose p.scale holds the campaign's typical values (design.scales).
"""

FORM_NEEDS_CHANNELS = ("drawbar_pull", "torque", "sinkage", "lateral_force")


class Form:
    """Joints of a form that does nothing; arrays over runs, stress arrays (runs, nodes), SI."""
    ID, NAME, NEEDS, TYPICAL, LARGEST, SIGNED = None, None, (), 0.1, 1.0, False

    def __init__(self, a, shape):
        self.a, self.shape = float(a), dict(shape)

    @classmethod
    def draw(cls, rng, scale):
        """The form's other constants, JSON values."""
        return {}

    def soil(self, p):
        """Change the state before the balance (in place)."""

    def exit(self, p, th1, th2):
        """Exit angle [rad], negative behind the axle."""
        return th2

    def outline(self, p, depth, th1):
        """Depth [m] of each point of the outline under the undisturbed surface."""
        return depth

    def pressure(self, p, sigma, depth, theta):
        """Normal stress [Pa]."""
        return sigma

    def modulus(self, p, modulus, sigma):
        """Shear modulus K [m]."""
        return modulus

    def mobilised(self, p, part, x):
        """Mobilised part of the shear strength [-] at x = |j|/K."""
        return part

    def limit(self, p, tau, sigma):
        """Shear stress [Pa]."""
        return tau

    def added(self, p, z, th1):
        """Added forces {V, Fx, Fy: N, M: N m} in the wheel's plane."""
        return {}

    def sunk(self, p, z):
        """Extra depth [m] at the same load."""
        return 0.0

    def report(self, p, out):
        """Change the channels in the frame of travel (in place)."""

    def sensor(self, p, out):
        """Change the channels as measured (in place)."""


def positive(value, least=0.05):
    """A multiplier kept physical: not below `least` [-]."""
    import numpy as np
    return np.maximum(value, least)


def forms_of(*modules):
    """Form classes that these modules hold, in their order; a class without a name is a base of others."""
    items = [item for module in modules for item in vars(module).values()]
    return [item for item in items if isinstance(item, type) and issubclass(item, Form) and item.NAME]


def catalogue():
    """{id: [form classes]} for the ids of the catalogue."""
    from . import contact, shear, added, strength, rig
    found = {}
    for form in forms_of(contact, shear, added, strength, rig):
        found.setdefault(form.ID, []).append(form)
    return found


def instruments():
    """Form classes of instruments that are out of scale, which the sets of a whole catalogue leave out."""
    from . import scale
    return forms_of(scale)


def unknown():
    """Form classes of effects that the catalogue does not hold."""
    from . import outside
    return forms_of(outside)


def build(record):
    """A form from its record {id, form, a, shape} as sidecars keep it."""
    classes = unknown() if record["id"] is None else catalogue()[record["id"]] + instruments()
    return next(c for c in classes if c.NAME == record["form"])(record["a"], record["shape"])
