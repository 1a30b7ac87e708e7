"""A campaign's wheel model fitted in Python: soilbin's own equations by its package, plain least squares on top.

Nothing of the loop is in here: a baseline that stands beside it (lisdd.py) must share the equations and nothing else.
"""
from dataclasses import dataclass
from typing import Optional

import numpy as np

from soilbin import _soilbin

CHANNELS = tuple(_soilbin.channels())
SOIL_KEYS = ("exponent", "k_c", "k_phi", "cohesion", "friction_angle", "shear_modulus", "stress_angle_c1", "stress_angle_c2")
MODEL = _soilbin.BekkerWong(errors=False, patch=False)
FEW_RERUNS = 6  # degrees of freedom of the re-runs below which they do not set a channel's noise
LEAST = 0.05  # share of its declared value that a soil value keeps


class Campaign:
    """The readings [SI], which runs share a setpoint, the declared soil, and the model's answers."""

    def __init__(self, folder):
        told = _soilbin.find_campaign(str(folder))
        self.scenario = told.scenario()
        self.soil = self.scenario.soil.semi_empirical
        self.at = [run.at for run in told.runs]
        self.read = np.array([[np.nan if (v := getattr(run, c)) is None else v for c in CHANNELS] for run in told.runs])
        labels = {}
        self.setpoint = np.array([labels.setdefault(run.setpoint or f"run {i}", len(labels)) for i, run in enumerate(told.runs)])
        self.declared = np.array([getattr(told.soil, key).value for key in SOIL_KEYS])
        self.sd = np.array([getattr(told.soil, key).std_error for key in SOIL_KEYS])
        # away from values that no soil has; the stress angle's constants may be of either sign
        self.least = np.array([-np.inf if key.startswith("stress") else LEAST for key in SOIL_KEYS]) * np.abs(self.declared)
        self.most = np.where(np.array(SOIL_KEYS) == "friction_angle", 1.2, np.inf)

    def predict(self, soil, effects=(), rows=None):
        """Channels (runs, 4) [SI] of a soil (SOIL_KEYS, SI) with effects (EffectChoice); nan where a run has no balance."""
        for key, value in zip(SOIL_KEYS, soil):
            setattr(self.soil, key, float(value))
        self.scenario.soil.semi_empirical = self.soil
        self.scenario.effects = list(effects)
        answers = _soilbin.answers(MODEL, self.scenario, self.at if rows is None else [self.at[i] for i in rows])
        nothing = [np.nan] * len(CHANNELS)
        return np.array([[r.drawbar_pull.value, r.torque.value, r.sinkage.value, r.lateral_force.value]
                         if (r := a.result) else nothing for a in answers])

    def conditions(self):
        """What was set at each run (runs, conditions), centred, in sd; the order of the runs is none of them."""
        names = ("load", "slip", "speed", "longitudinal_incline", "transverse_incline", "yaw", "pass", "moisture", "position")
        values = np.array([[getattr(at, n) or 0.0 for n in names] for at in self.at], float)
        values = values[:, np.ptp(values, axis=0) > 0]
        return (values - values.mean(axis=0)) / values.std(axis=0)

    def noise(self, predicted):
        """Standard deviation of each channel [SI] and the degrees of freedom behind all of them.

        Of re-runs about their setpoint's mean; where there are few, of all residuals by their median.
        """
        residual = self.read - predicted
        out, behind = np.full(4, np.nan), 0.0
        for c in range(4):
            seen = np.isfinite(residual[:, c])
            squares, freedom = 0.0, 0
            for s in np.unique(self.setpoint[seen]):
                same = residual[seen & (self.setpoint == s), c]
                squares, freedom = squares + np.sum((same - same.mean()) ** 2), freedom + len(same) - 1
            if freedom >= FEW_RERUNS and squares > 0:
                out[c], behind = np.sqrt(squares / freedom), behind + freedom
            elif seen.sum() > 2:
                middle = np.median(residual[seen, c])
                out[c] = max(1.4826 * np.median(np.abs(residual[seen, c] - middle)), 1e-9 * np.ptp(self.read[seen, c]) + 1e-12)
                behind += 0.37 * seen.sum()  # efficiency of the median absolute deviation
        return out, behind


class Term:
    """A form of the catalogue, with the bounds of its parameters and where a fit of it starts."""

    def __init__(self, form):
        self.id, self.form = form.id, form.form
        self.names = [p.name for p in form.parameters]
        self.lower = np.array([p.lower for p in form.parameters])
        self.upper = np.array([p.upper for p in form.parameters])
        self.usual = np.clip([p.default for p in form.parameters], self.lower, self.upper)
        wide = np.where(np.isfinite(self.upper - self.lower), self.upper - self.lower, np.abs(self.usual) + 1)
        self.scale = np.where(self.usual != 0, np.abs(self.usual), 0.1 * wide)

    def choice(self, values):
        """The effect with these parameters."""
        return _soilbin.EffectChoice(self.id, self.form, **{n: float(v) for n, v in zip(self.names, values)})

    def starts(self):
        """The form near the base model, either way where its amplitude may be negative."""
        for share in (0.2, -0.2) if self.lower[0] < 0 else (0.2,):
            start = self.usual.copy()
            start[0] = np.clip(share * self.scale[0], self.lower[0], self.upper[0])
            yield start


def parameters(terms, x):
    """Each term's part of a fit's values, which follow the soil's eight."""
    return np.split(x[8:], np.cumsum([len(t.names) for t in terms])[:-1]) if terms else []


def changed(campaign, soil, effects, noise, sizes):
    """Runs at which effects (id, form, {parameter: value}) change a measured channel by more than `sizes` sd of its noise."""
    chosen = [_soilbin.EffectChoice(name, form, **values) for name, form, values in effects]
    change = np.abs(campaign.predict(soil, chosen) - campaign.predict(soil)) > sizes * np.asarray(noise)
    return (change & np.isfinite(campaign.read)).any(axis=1)


CATALOGUE = [Term(form) for form in _soilbin.effect_catalogue()]


@dataclass
class Fit:
    """Soil in declared sd from the declared one, then the terms' parameters; what is left, whitened, and its slopes."""
    terms: tuple
    x: np.ndarray
    residual: Optional[np.ndarray] = None  # (cells,) [sd]
    slopes: Optional[np.ndarray] = None    # (cells, parameters) of the prediction
    free: Optional[np.ndarray] = None      # parameters that no bound holds
    squares: float = np.inf                # of residual and of the soil's distance from the declared one

    def effects(self):
        """(id, form, {parameter: value}) of each term."""
        return [(t.id, t.form, dict(zip(t.names, map(float, v)))) for t, v in zip(self.terms, parameters(self.terms, self.x))]


class Fitter:
    """Least squares on some of a campaign's rows, the declared soil counted as eight more readings."""

    def __init__(self, campaign, noise, rows):
        self.campaign, self.noise, self.rows = campaign, noise, np.asarray(rows)
        self.seen = np.isfinite(campaign.read[self.rows]) & np.isfinite(noise)
        self.cell_rows = np.repeat(self.rows, 4).reshape(-1, 4)[self.seen]
        self.cell_channels = np.broadcast_to(np.arange(4), self.seen.shape)[self.seen]
        self.target = (campaign.read[self.rows] / noise)[self.seen]  # readings [sd]

    def soil(self, x):
        """Soil values [SI] of a fit's first eight."""
        c = self.campaign
        return np.clip(c.declared + c.sd * x[:8], c.least, c.most)

    def whitened(self, terms, x):
        """Predictions of the cells [sd]; None where a run has no balance or the model refuses the effect."""
        chosen = [t.choice(v) for t, v in zip(terms, parameters(terms, x))]
        try:
            f = self.campaign.predict(self.soil(x), chosen, self.rows)
        except _soilbin.InputError:
            return None
        f = (f / self.noise)[self.seen]
        return f if np.isfinite(f).all() else None

    def fit(self, terms=(), start=None, near=None, held=None, steps=10):
        """The best fit from a start (Levenberg and Marquardt, bounds by projection), or None where there is no balance.

        near: a fit of the same rows whose slopes by the soil will do until a step with them fails. held: soil kept at [sd].
        """
        target = self.target
        lower = np.concatenate([np.full(8, -15.0)] + [t.lower for t in terms])
        upper = np.concatenate([np.full(8, 15.0)] + [t.upper for t in terms])
        x = np.clip(np.zeros(8) if start is None else start, lower, upper)
        if held is not None:
            x[:8] = lower[:8] = upper[:8] = held
        f = self.whitened(terms, x)
        if f is None:
            return None
        is_soil = np.arange(len(x)) < 8
        squares, damping, slopes = np.sum((target - f) ** 2) + np.sum(x[:8] ** 2), 1e-2, None
        for _ in range(steps):
            if slopes is None:
                slopes = self.slopes(terms, x, f, lower, upper, near)
            if slopes is None:
                return None
            down = slopes.T @ (target - f)  # where the fit wants to go
            down[:8] -= x[:8]
            free = ~((x <= lower) & (down <= 0) | (x >= upper) & (down >= 0)) & (is_soil | (np.abs(slopes).max(axis=0) > 1e-9))
            if not free.any():
                break
            curvature = slopes[:, free].T @ slopes[:, free] + np.diag(is_soil[free].astype(float))
            move = np.zeros(len(x))
            move[free] = np.linalg.solve(curvature + damping * np.diag(np.diag(curvature)), down[free])
            new = np.clip(x + move, lower, upper)
            g = self.whitened(terms, new)
            after = np.inf if g is None else np.sum((target - g) ** 2) + np.sum(new[:8] ** 2)
            if after < squares:
                gain = squares - after
                x, f, squares, damping, slopes = new, g, after, damping / 8, None
                if gain < 0.01:
                    break
            elif near is not None and damping > 0.1:
                near, slopes, damping = None, None, 1e-2
            elif damping > 1e4:
                break
            else:
                damping *= 10
        slopes = self.slopes(terms, x, f, lower, upper, near) if slopes is None else slopes
        if slopes is None:
            return None
        free = (lower < x) & (x < upper) & (is_soil | (np.abs(slopes).max(axis=0) > 1e-9))
        return Fit(tuple(terms), x, target - f, slopes, free, float(squares))

    def slopes(self, terms, x, f, lower, upper, near=None):
        """Derivatives of the whitened predictions by forward differences, inwards at a bound; of the soil as at `near`."""
        steps = 0.01 * np.concatenate([np.ones(8)] + [t.scale for t in terms])
        out = np.zeros((len(f), len(x)))
        if near is not None:
            out[:, :8] = near.slopes[:, :8]
        for i in range(8 if near is not None else 0, len(x)):
            if lower[i] == upper[i]:
                continue
            for step in (steps[i], -steps[i]):
                ahead = x.copy()
                ahead[i] += step
                if lower[i] <= ahead[i] <= upper[i] and (g := self.whitened(terms, ahead)) is not None:
                    out[:, i] = (g - f) / step
                    break
            else:
                return None
        return out
