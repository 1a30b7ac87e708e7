"""Two figures of an answer beside nature's truth: how far off the soil is, and at which runs the model is said to fail.

Used by measure.py and lisdd.py; both need the hidden .nature/ beside the campaigns, and the Python package for the second.
"""
import numpy as np

from nature import campaign, noise
from nature import wheel as base
from nature.families import build

LARGE = 2.0  # change of a channel by what the model lacks that counts as a failure [sd of its noise]


def fails_at(record):
    """Runs at which what nature hides changes a measured channel by more than LARGE sd of its noise, as booleans."""
    world = campaign.restore(record)
    plain, truth = world.truth(), world.truth([build(e) for e in record["effects"]])
    sd = np.sqrt(np.einsum("rii->ri", noise.covariance(record["noise"], truth)))
    change = np.stack([truth[c] - plain[c] for c in base.CHANNELS], axis=1)
    unread = [None] * len(sd)
    seen = np.array([[v is not None for v in record["read"].get(c, unread)] for c in base.CHANNELS]).T
    return ((np.abs(change) > LARGE * sd) & seen).any(axis=1)


def rows_of(indices, count):
    """These rows of `count`, as booleans."""
    return np.isin(np.arange(count), indices)


def soil_error(record, soil):
    """Error of each soil value {key: value}, in order of base.SOIL_KEYS: in its declared sd, and as a share of the true one."""
    wrong = np.array([soil[k] - record["soil"][k] for k in base.SOIL_KEYS])
    return wrong / [record["sd"][k] for k in base.SOIL_KEYS], wrong / [record["soil"][k] for k in base.SOIL_KEYS]


class Places:
    """Runs said to fail beside those that do, counted over campaigns."""

    def __init__(self):
        self.hits = self.false = self.missed = self.runs = 0

    def add(self, said, true):
        self.hits += int(np.sum(said & true))
        self.false += int(np.sum(said & ~true))
        self.missed += int(np.sum(~said & true))
        self.runs += len(true)

    def words(self):
        """F1, precision, recall and the share of runs judged right; F1 of saying that every run fails."""
        said, true = self.hits + self.false, self.hits + self.missed
        if not true:
            return f"{100 * self.false / max(1, self.runs):.1f} % of {self.runs} runs, none of which fails"
        right = 100 * (self.runs - self.false - self.missed) / self.runs
        return (f"F1 {2 * self.hits / (said + true):.2f} (precision {self.hits / max(1, said):.2f}, "
                f"recall {self.hits / true:.2f}), {right:.0f} % of {self.runs} runs judged right; {true} fail; "
                f"were every run said to fail: F1 {2 * true / (self.runs + true):.2f}, {100 * true / self.runs:.0f} %")


class SoilErrors:
    """Errors of fitted soils over campaigns."""

    def __init__(self):
        self.in_sd, self.relative = [], []

    def add(self, record, soil):
        in_sd, relative = soil_error(record, soil)
        self.in_sd.append(in_sd)
        self.relative.append(relative)

    def words(self):
        """Root mean square over values and campaigns [declared sd], with a median, and medians of n, k_phi, c, phi and K [%]."""
        if not self.in_sd:
            return "none"
        each = np.sqrt(np.mean(np.square(self.in_sd), axis=1))
        share = 100 * np.median(np.abs(self.relative), axis=0)
        names = ("n", "", "k_phi", "c", "phi", "K")
        return (f"rms {np.sqrt(np.mean(np.square(self.in_sd))):.2f} sd, median {np.median(each):.2f} sd; medians "
                + ", ".join(f"{n} {v:.1f} %" for n, v in zip(names, share) if n) + f" ({len(each)} campaigns)")
