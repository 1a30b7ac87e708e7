"""The noise of the channels: sd^2 = a^2 + b^2 f^2 a channel, correlated between drawbar pull and torque, and a part that a
whole run shares (a common multiplier of the forces, since each run has its own bed)."""
import numpy as np

from .wheel import CHANNELS

RUN_SHARE = (1.0, 1.0, -0.5, 1.0)  # of the run's common part g, by channel: a stronger bed pulls more and sinks less


def draw(rng, truth, plan):
    """Noise constants: a [channel's unit], b [-] a channel, rho [-], run-level sd g [-]."""
    quality = float(np.exp(rng.uniform(np.log(0.5), np.log(1.6))))
    a = {c: quality * float(rng.uniform(0.006, 0.02)) * (float(np.ptp(truth[c])) + 0.1 * float(np.max(np.abs(truth[c]))))
         for c in CHANNELS}
    a["lateral_force"] = max(a["lateral_force"], 0.5 * a["drawbar_pull"])  # an idle channel still has its cell's noise
    b = {c: quality * float(rng.choice([0.0, 0.006, 0.012, 0.02])) for c in CHANNELS}
    return {"a": a, "b": b, "rho": float(rng.choice([0.0, 0.3, 0.6])), "run": quality * float(rng.choice([0.0, 0.0, 0.007, 0.015]))}


def covariance(noise, truth):
    """Covariance of the four channels for each run, (runs, 4, 4), at the channels' true values."""
    f = np.stack([truth[c] for c in CHANNELS], axis=1)
    a = np.array([noise["a"][c] for c in CHANNELS])
    b = np.array([noise["b"][c] for c in CHANNELS])
    sd = np.sqrt(a ** 2 + (b * f) ** 2)
    relation = np.eye(4)
    relation[0, 1] = relation[1, 0] = noise["rho"]
    share = noise["run"] * f * np.array(RUN_SHARE)
    return sd[:, :, None] * relation * sd[:, None, :] + share[:, :, None] * share[:, None, :]


def sample(rng, noise, truth):
    """One noisy reading of every channel and run, {channel: array}."""
    factor = np.linalg.cholesky(covariance(noise, truth))
    e = np.einsum("rij,rj->ri", factor, rng.normal(size=factor.shape[:2]))
    return {c: truth[c] + e[:, i] for i, c in enumerate(CHANNELS)}


def whitener(noise, truth, present):
    """(runs, 4, 4) matrices that whiten a run's present channels and put zero for the absent; `present` (runs, 4) bool."""
    out = np.zeros((len(present), 4, 4))
    for i, (cov, mask) in enumerate(zip(covariance(noise, truth), present)):
        if mask.any():
            out[i][np.ix_(mask, mask)] = np.linalg.inv(np.linalg.cholesky(cov[np.ix_(mask, mask)]))
    return out


def outliers(rng, noise, truth, read, channels):
    """Spoil 2 - 6 % of the runs (at least one) by 6 - 15 sd in one channel or all; returns (runs, channels) spoilt."""
    sd = np.sqrt(np.einsum("rii->ri", covariance(noise, truth)))
    count = len(sd)
    spoilt = np.sort(rng.choice(count, max(1, int(round(count * rng.uniform(0.02, 0.06)))), replace=False))
    for run in spoilt:
        chosen = list(channels) if rng.random() < 0.3 else [channels[int(rng.integers(len(channels)))]]
        for name in chosen:
            size = float(rng.uniform(6, 15)) * (1 if rng.random() < 0.5 else -1)
            read[name][run] += size * sd[run, CHANNELS.index(name)]
    return [int(run) for run in spoilt]
