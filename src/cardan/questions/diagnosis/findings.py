"""From a recording of a drive to what is wrong with it: causes by likelihood, what speaks for and against each."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field, replace
from functools import lru_cache
from importlib import resources

import numpy as np
import scipy

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.catalogue import Catalogue, catalogue
from cardan.catalogue.rows import Fault
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .features import Features, features
from .match import Signs, likely_causes
from .signals.orders import OrderSpectrum
from .signals.signal import Progress, Signal

TELLING = 0.3  # what a feature has to add for or against a cause to be told [nat]
MOST = 4  # most reasons told for or against
BY_SIGNS = 0.3  # confidence in causes that are ranked by signs alone

UNLIKE, MOST_UNLIKE = 0.4, 3
"""What a feature beyond all of the calibration leaves of the confidence, and how many of them count."""

BETTER = ("order_2_unloaded", "at_centre", "axial_share", "uneven")  # features that may be as small as they like
SURE = 0.98  # largest confidence: the calibration is of simulated recordings


@dataclass(frozen=True, kw_only=True)
class Finding:
    """A cause and how likely it is.

    Attributes
    ----------
    cause : str
        Id of its row in the catalogue of faults, or ``healthy``.
    fault : str
        What is wrong, in words.
    score : float
        From 0 to 1: probability, calibrated on simulated recordings; the less the recording can be trusted, the
        nearer to the same for all causes. All scores add up to 1.
    evidence, against : tuple of Text
        What speaks for it and against it, the strongest first.
    check : str
        What to look at to make sure.
    repair : str
        What to do.
    confidence : float
        From 0 to 1: how far the recording can be relied on.
    cautions : tuple of Text
        What was doubtful in it.
    """

    cause: str
    fault: str
    score: float
    evidence: tuple[Text, ...] = ()
    against: tuple[Text, ...] = ()
    check: str = ""
    repair: str = ""
    confidence: float = 1.0
    cautions: tuple[Text, ...] = field(default=())


def diagnose(
    shown: Signal | OrderSpectrum | Signs,
    drive: Drive | None = None,
    *,
    speed_range: tuple[float, float] | None = None,
    known: Catalogue | None = None,
    progress: Progress | None = None,
) -> tuple[Finding, ...]:
    """Return what may be wrong with a drive, the likeliest first.

    Parameters
    ----------
    shown : Signal, OrderSpectrum or Signs
        A recording; or only the orders in it, or what was noticed.
    drive : Drive, optional
        The drive as it should be; a recording needs it.
    speed_range : (float, float) [rad/s], optional
        Between which the shaft turned, for a recording without a tacho.
    known : Catalogue, optional
        With the table of faults; the shipped one when not given.
    progress : function, optional
        Told the share done; when it answers "stop" channels not yet looked at are left out, and a caution says so.

    Returns
    -------
    tuple of Finding
        By falling score. ``healthy`` is one of the answers to a recording.

    Raises
    ------
    InputError
        A recording without vibration or without turns.

    See Also
    --------
    examine, expected_orders

    Notes
    -----
    A recording: p = softmax(W φ), φ = (1, z, z² − 1) of the features of `cardan.questions.diagnosis.features`, W of the
    calibration; score = c p + (1 − c)/K for K causes and the confidence c. Orders or signs alone: softmax of the points
    of `likely_causes`, with a confidence of 0.3.

    Examples
    --------
    >>> from cardan import example
    >>> from cardan.answers.quantity import told
    >>> from cardan.answers.reader import USUAL
    >>> from cardan.recordings import diagnose, simulate_fault
    >>> drive = example("truck-supports")
    >>> first = diagnose(simulate_fault(drive, "worn_spline", seed=5), drive)[0]
    >>> first.cause, told(first.evidence[0], USUAL)
    ('F21', 'Order 1 turns its phase or changes its size by 63 % with the torque.')
    """
    if isinstance(shown, OrderSpectrum):
        return _by_signs(Signs(orders=tuple(order for order, _size in shown.peaks())), shown.confidence, known)
    if isinstance(shown, Signs):
        return _by_signs(shown, 1.0, known)
    if drive is None:
        raise refuse("drive", _("a recording can only be judged beside the drive that it is of"), "missing")
    return weighed(features(shown, drive, speed_range=speed_range, progress=progress), known=known)


def weighed(seen: Features, *, known: Catalogue | None = None) -> tuple[Finding, ...]:
    """Return the causes of what a recording shows, the likeliest first; see `diagnose`."""
    rows = (known or catalogue()).rows(Fault)
    model = shipped()
    sentences = [_sentence(name, value, seen) for name, value in zip(model.features, seen.value, strict=True)]
    beyond = _beyond(seen)
    confidence = relied_on(seen)
    score = confidence * model.probability(seen.value) + (1.0 - confidence) / len(model.causes)
    speaks = model.speaks(seen.value)
    text = _(
        "This is beyond all that the diagnosis has learnt of: {said} A unit, a scale or the drive file may be wrong."
    )
    strange = (say(text, said=Joined([sentences[k] for k in beyond[:MOST_UNLIKE]], between=" ")),) if beyond else ()
    found = []
    for k in sorted(range(len(model.causes)), key=lambda k: -score[k]):
        order = np.argsort(-np.abs(speaks[k]))
        told = [(speaks[k, f], sentences[f]) for f in order if abs(speaks[k, f]) > TELLING and sentences[f]]
        found.append(
            _finding(
                model.causes[k],
                rows.get(model.causes[k]),
                score=float(score[k]),
                evidence=tuple(text for size, text in told if size > 0.0)[:MOST],
                against=tuple(text for size, text in told if size < 0.0)[:MOST],
                confidence=confidence,
                cautions=(*seen.cautions, *strange),
            )
        )
    return tuple(found)


def relied_on(seen: Features) -> float:
    """Return how far a recording can be relied on, from 0 to 1: less where it shows what nobody has learnt of."""
    return float(min(SURE, seen.confidence) * UNLIKE ** min(len(_beyond(seen)), MOST_UNLIKE))


def _beyond(seen: Features) -> tuple[int, ...]:
    """Return the features that lie beyond all of the calibration, but those of which less is only better."""
    model = shipped()
    found = model.beyond(seen.value)
    return tuple(k for k in found if model.features[k] not in BETTER or seen.value[k] > model.mean[k])


def _finding(cause: str, row: Fault | None, **more: object) -> Finding:
    if row is None:
        return Finding(
            cause=cause,
            fault=_("no fault shows"),
            check=_("record again at two torques and up to the top speed if the complaint stays"),
            repair=_("nothing"),
            **more,  # type: ignore[arg-type]
        )
    return Finding(
        cause=cause,
        fault=_(row.fault),
        check=_(row.inspection),
        repair=_(row.repair),
        **more,  # type: ignore[arg-type]
    )


def _by_signs(signs: Signs, trust: float, known: Catalogue | None) -> tuple[Finding, ...]:
    causes = likely_causes(signs, known=known)
    grown = np.exp(np.asarray([one.score for one in causes]) - causes[0].score)
    confidence = BY_SIGNS * trust
    score = confidence * grown / np.sum(grown) + (1.0 - confidence) / len(causes)
    caution = _("Orders and signs alone rank causes; only a recording with speed and torque tells how likely they are.")
    return tuple(
        _finding(
            one.fault.id,
            one.fault,
            score=float(size),
            evidence=tuple(_("Order {order:.3g} is one of its orders.").format(order=order) for order in one.orders),
            confidence=confidence,
            cautions=(caution,),
        )
        for one, size in zip(causes, score, strict=True)
    )


def _sentence(name: str, value: float, seen: Features) -> Text:
    """Return what a feature says in words; empty where it says nothing."""
    if not math.isfinite(value):
        return ""
    times = _short(10.0**value)
    if name in ("peak_of_2", "peak_of_3", "at_third"):
        return _peak(name, times, seen)
    texts = {
        "order_1": _("Order 1 is {times} times as large as in the drive in order."),
        "order_2": _("Under load order 2 is {times} times as large as in the drive in order."),
        "order_2_unloaded": _("At the smaller torque order 2 is {times} times what the full torque should make."),
        "order_3": _("Order 3 is {times} times the order 1 of the drive in order."),
        "order_4": _("Order 4 is {times} times the order 2 of the drive in order."),
        "half_orders": _("Orders 0.5 and 1.5 are {times} times the order 1 of the drive in order."),
        "at_centre": _("Order 3 loads the centre bearing {times} times as much as the ends."),
        "torque_on_1": _("Order 1 under load is {times} times that at the smaller torque."),
        "turned_by_torque": _("Order 1 turns its phase or changes its size by {share} with the torque."),
        "torque_on_2": _("Order 2 under load is {times} times that at the smaller torque."),
        "power_of_1": _("Order 1 grows with the power {value} of the speed."),
        "steep_at_top": _("Near the top speed order 1 grows with the power {value} of the speed."),
        "power_of_2": _("Order 2 grows with the power {value} of the speed."),
        "axial_share": _("Along the shaft order 1 is {times} times that across it."),
        "knocks_1": _("The noise swells once a turn, by {share} of its mean."),
        "knocks_2": _("The noise swells twice a turn, by {share} of its mean."),
        "uneven": _("Order 2 of the output speed is {times} times what the joints make."),
    }
    share = Quantity(value, "share", decimals=0)
    return say(texts[name], times=times, share=share, value=Quantity(value, decimals=1))


def _short(value: float) -> Quantity | str:
    """Return a number with two significant digits; what is next to nothing says no more."""
    return Quantity(value, digits=2) if value >= 1e-3 else "<0.001"


def _peak(name: str, times: Quantity | str, seen: Features) -> Text:
    if name == "at_third":
        text = _("At a third of the critical speed, {speed}, order 3 is {times} times that elsewhere.")
        return say(text, speed=Quantity(seen.critical / 3.0, "angular_speed"), times=times)
    order, speed = (2, seen.peak_2) if name == "peak_of_2" else (3, seen.peak_3)
    said = say(
        _("Order {order} is largest at {speed}, {times} times its median."),
        order=order,
        speed=Quantity(speed, "angular_speed"),
        times=times,
    )
    if not math.isfinite(seen.critical):
        return said
    more = say(_("That is {share} of the critical speed."), share=Quantity(speed / seen.critical, decimals=2))
    return Joined([said, more], between=" ")


# How likely each cause is by what a recording shows: a multinomial logistic model with its numbers in a data file.

BEYOND = 1.0
"""Standard deviations beyond all of the calibration from which on a feature is like nothing that was learnt."""

FAR = 3.0  # standard deviations beyond which a feature counts no more


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
