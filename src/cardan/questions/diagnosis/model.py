"""How likely each cause is by what a recording shows: a multinomial logistic model with its numbers in a data file."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib import resources

import numpy as np
import scipy

from cardan.maths.arrays import Array

BEYOND = 1.0
"""Standard deviations beyond all of the calibration from which on a feature is like nothing that was learnt."""

FAR = 3.0
"""Standard deviations beyond which a feature counts no more."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """Weights of a multinomial logistic model."""

    # features, causes: what it weighs, and what it tells apart; ``healthy`` or an id of the catalogue of faults
    features: tuple[str, ...]
    causes: tuple[str, ...]
    mean: Array  # mean, spread (f,): of the features in the calibration
    spread: Array  # (f,)
    weight: Array  # (c, 1 + 2f): of 1, z, and z² − 1 of every feature, z its distance from the mean over the spread
    least: Array  # least, most (f,): of the features in the calibration
    most: Array  # (f,)

    def beyond(self, value: Array) -> tuple[int, ...]:
        """Return the features (f,) that lie a spread or more beyond all of the calibration, the farthest first."""
        below, above = self.least - np.asarray(value, dtype=float), np.asarray(value, dtype=float) - self.most
        off = np.nan_to_num(np.maximum(below, above) / self.spread, nan=0.0)
        return tuple(int(k) for k in np.argsort(-off, kind="stable") if off[k] >= BEYOND)

    def terms(self, value: Array) -> Array:
        """Return 1, z and z² − 1 of features, array (..., f) to array (..., 1 + 2f); what is not known adds nothing."""
        z = np.clip((np.asarray(value, dtype=float) - self.mean) / self.spread, -FAR, FAR)
        known = np.isfinite(z)
        first, second = np.where(known, z, 0.0), np.where(known, z**2 - 1.0, 0.0)
        return np.concatenate([np.ones((*z.shape[:-1], 1)), first, second], axis=-1)

    def probability(self, value: Array) -> Array:
        """Return the probability of each cause, array (..., f) to array (..., c)."""
        level = self.terms(value) @ self.weight.T
        grown = np.exp(level - np.max(level, axis=-1, keepdims=True))
        return np.asarray(grown / np.sum(grown, axis=-1, keepdims=True))

    def speaks(self, value: Array) -> Array:
        """Return what each feature adds for each cause, beside the mean over the causes, array (c, f) [nat]."""
        count = len(self.features)
        each = self.weight[:, 1:] * self.terms(value)[1:]
        each = each[:, :count] + each[:, count:]
        return np.asarray(each - np.mean(each, axis=0))


@lru_cache(maxsize=1)
def shipped() -> Model:
    """Return the model calibrated on simulated recordings, ``catalogue/calibration.json``."""
    text = (resources.files("cardan") / "catalogue" / "calibration.json").read_text(encoding="utf-8")
    return model_of(json.loads(text))


def model_of(tree: dict[str, object]) -> Model:
    """Return a model from the tables of its file."""
    return Model(
        features=tuple(tree["features"]),  # type: ignore[arg-type]
        causes=tuple(tree["causes"]),  # type: ignore[arg-type]
        mean=np.asarray(tree["mean"], dtype=float),
        spread=np.asarray(tree["spread"], dtype=float),
        weight=np.asarray(tree["weight"], dtype=float),
        least=np.asarray(tree["least"], dtype=float),
        most=np.asarray(tree["most"], dtype=float),
    )


def fitted(value: Array, cause: list[str], features: tuple[str, ...], *, pull: float = 1.0) -> Model:
    """Return the model that fits recordings of known causes best.

    value (r, f): features; nan where not known.
    features: names of the features.
    pull: pull of the weights to 0: half of it times the sum of their squares goes on top of the surprise.
    Least of −Σ log p + ½ pull Σ w² over the weights w but those of 1 (maximum a posteriori), by L-BFGS; convex, so that
    the answer does not depend on a start.
    """
    names = tuple(sorted(set(cause), key=lambda one: (one != "healthy", one)))
    spread = np.nanstd(value, axis=0)
    bare = Model(
        features=features,
        causes=names,
        mean=np.nanmean(value, axis=0),
        spread=np.where(spread > 0.0, spread, 1.0),
        weight=np.zeros((len(names), 1 + 2 * len(features))),
        least=np.nanmin(value, axis=0),
        most=np.nanmax(value, axis=0),
    )
    terms = bare.terms(value)
    truth = np.eye(len(names))[[names.index(one) for one in cause]]

    def surprise(flat: Array) -> tuple[float, Array]:
        weight = flat.reshape(bare.weight.shape)
        level = terms @ weight.T
        level = level - np.max(level, axis=1, keepdims=True)
        total = np.log(np.sum(np.exp(level), axis=1))
        pulled = weight.copy()
        pulled[:, 0] = 0.0
        cost = float(np.sum(total - np.sum(truth * level, axis=1)) + 0.5 * pull * np.sum(pulled**2))
        slope = (np.exp(level - total[:, None]) - truth).T @ terms + pull * pulled
        return cost, slope.ravel()

    best = scipy.optimize.minimize(
        surprise, bare.weight.ravel(), jac=True, method="L-BFGS-B", options={"maxiter": 2000}
    )
    return replace(bare, weight=np.asarray(best.x).reshape(bare.weight.shape))
