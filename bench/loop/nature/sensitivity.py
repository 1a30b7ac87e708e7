"""What refitting the soil's eight values absorbs, and how large an effect is beyond that.

The base model is linearised at the true soil: J (whitened channels by soil values), with the priors as eight more rows.
With d the whitened change that an effect makes, P the projector off the columns of J, the noncentrality is
lambda = |P d|^2. One degree of freedom tested among about 50 forms at a family-wise 5 % (two-sided 0.001: z 3.3) and a power
of 80 % (z 0.84) needs lambda = (3.3 + 0.84)^2 = 17; the ratio to the detectable size is sqrt(lambda/17).
"""
import numpy as np
from scipy.optimize import least_squares

from . import design, noise
from . import wheel as base
from .families import catalogue

DETECTABLE = 17.0


class World:
    """A campaign's truth: wheel, soil, prior sds, rows, frames, scales, noise, which cells are present."""

    def __init__(self, **parts):
        self.__dict__.update(parts)
        self.guess = None

    def truth(self, fx=(), soil=None):
        """True channels with the forms fx (and another soil, if given)."""
        p = base.state(self.wheel, soil or self.soil, design.radians(self.rows), self.plan["slip_by"], self.scale)
        return base.evaluate(p, fx, self.plan["force_frame"], self.guess)


def prepare(world, truth):
    """Jacobian's orthonormal basis and the whitener, at `truth` (base channels), kept on the world."""
    world.guess = truth["entry"]
    world.white = noise.whitener(world.noise, truth, world.present)
    world.base = truth
    world.basis = np.linalg.qr(jacobian(world, world.soil))[0]
    return world


def jacobian(world, soil):
    """Whitened channels, then the eight prior rows, by the soil's values in units of their prior sd."""
    columns = []
    for i, key in enumerate(base.SOIL_KEYS):
        step = 0.05 * world.sd[key]
        up, down = dict(soil), dict(soil)
        up[key], down[key] = up[key] + step, down[key] - step
        slope = (whiten(world, world.truth((), up)) - whiten(world, world.truth((), down))) / 0.1
        columns.append(np.concatenate([slope, np.eye(8)[i]]))
    return np.stack(columns, axis=1)


def refit(world, fx, free=None):
    """chi^2 left when the base model's soil is refitted, in full non-linearity, to noise-free runs with the effects fx.

    With `free`, that form's scale parameter is fitted too (what a fitter reaches who knows of this effect alone). The
    prior is centred on the truth; the soil's values are held above a twentieth of the truth (c1, c2: 15 sd). The
    linearised answer is |change|^2; the two part where the effect moves the soil's values by several prior sds.
    """
    want = whiten(world, world.truth(fx))

    def model(u):
        soil = {**world.soil, **{k: world.soil[k] + u[i] * world.sd[k] for i, k in enumerate(base.SOIL_KEYS)}}
        forms = [type(free)(free.a * u[8], free.shape)] if free else ()
        return np.concatenate([whiten(world, world.truth(forms, soil)) - want, u[:8]])

    low = [-0.95 * world.soil[k] / world.sd[k] if not k.startswith("stress") else -15.0 for k in base.SOIL_KEYS]
    low, high = np.array(low), 15.0 + np.abs(low)
    start = np.zeros(8)
    if free:
        top = type(free).LARGEST / abs(free.a)
        low, high, start = np.append(low, -top if free.SIGNED else 0.0), np.append(high, top * 1.01), np.append(start, 1.0)
    found = least_squares(model, start, lambda u: slopes(model, u, low, high), bounds=(low, high), method="trf", ftol=1e-4,
                          xtol=1e-6, max_nfev=40)
    return float(2 * found.cost)


def slopes(model, u, low, high, step=0.02):
    """Derivatives of model (a vector) at u, by columns: central differences, their ends held within the bounds.

    A scale of an effect that physics keeps above 0 is 0 where the fit does without it: a step beyond has no balance.
    """
    ends = [(np.minimum(u + step * e, high), np.maximum(u - step * e, low)) for e in np.eye(len(u))]
    return np.stack([(model(up) - model(down)) / (up - down).sum() for up, down in ends], axis=1)


def whiten(world, channels):
    """Whitened vector (4 runs) of channels in their units."""
    f = np.stack([channels[c] for c in base.CHANNELS], axis=1)
    return np.einsum("rij,rj->ri", world.white, f).ravel()


def change(world, fx):
    """Part of the effects' whitened change that the soil's values can't absorb; None where a run has no balance."""
    truth = world.truth(fx)
    if not truth["ok"].all():
        return None
    d = np.concatenate([whiten(world, truth) - whiten(world, world.base), np.zeros(8)])
    return d - world.basis @ (world.basis.T @ d)


def ratio(d):
    """Size against the minimal detectable one [-]."""
    return 0.0 if d is None else float(np.sqrt(d @ d / DETECTABLE))


def size(world, kind, shape, sign, wanted, measure=ratio):
    """Scale parameter a whose ratio is about `wanted` (at most 7 % off), or the largest physical one; form and its change."""
    a = 0.5 * kind.TYPICAL
    best = None
    for _ in range(8):
        form = kind(sign * a, shape)
        d = change(world, [form])
        if d is None:
            a *= 0.5
            continue
        best, got = (form, d), measure(d)
        if got <= 1e-9 or abs(got / wanted - 1) < 0.07 or (a >= kind.LARGEST and got < wanted):
            break
        a = min(a * float(np.clip(wanted / got, 0.1, 6.0)), kind.LARGEST)
    return best if best else (None, None)


def leftover(d, span):
    """Norm^2 of d beyond the span of the columns."""
    if not len(span):
        return float(d @ d)
    u, s, _ = np.linalg.svd(np.stack(span, axis=1), full_matrices=False)
    u = u[:, s > 1e-9 * max(s[0], 1e-300)] if s[0] > 0 else u[:, :0]
    rest = d - u @ (u.T @ d)
    return float(rest @ rest)


def families(world, rng, usable):
    """{id: [changes]} of every form of the catalogue at half its typical size, for forms the campaign can show."""
    found = {}
    for name, forms in catalogue().items():
        found[name] = []
        for kind in forms:
            shape = kind.draw(rng, world.scale)
            if usable(kind):
                d = change(world, [kind(0.5 * kind.TYPICAL, shape)])
                if d is not None:
                    found[name].append(d)
    return found


def beyond_pairs(d, found):
    """Smallest norm^2 of d beyond any two single forms of different ids: small where two effects of the catalogue mimic it."""
    columns = [(name, v / np.linalg.norm(v)) for name, span in found.items() for v in span if np.linalg.norm(v) > 1e-9]
    best = float(d @ d)
    forms = np.stack([v for _, v in columns], axis=1)
    names = np.array([name for name, _ in columns])
    for i, (name, v) in enumerate(columns):
        rest = d - v * (v @ d)
        others = forms[:, names != name]
        others = others - np.outer(v, v @ others)
        norm = np.sqrt((others ** 2).sum(axis=0))
        gain = np.where(norm > 1e-3, (rest @ others) / np.maximum(norm, 1e-3), 0.0)
        best = min(best, float(rest @ rest - np.max(gain ** 2, initial=0.0)))
    return best
