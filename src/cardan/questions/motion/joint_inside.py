"""What else moves inside a joint while it turns at a bend: wobble, orbits, strokes, play, planes that are missed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Quantity
from cardan.drive.joints import (
    DoubleCardan,
    ElasticHalfCardan,
    HalfCardan,
    Joint,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.drive.joints.laws import (
    dividing_lever,
    double_cardan,
    half_cardan,
    offset_cross,
    offset_grooves,
    pin_coupling,
    tilted_plane,
    tracta,
    tripod,
)
from cardan.texts import _
from cardan.units import deg

TURN = np.arange(360) * deg


@dataclass(frozen=True, kw_only=True)
class Inside:
    """One measure of what moves inside a joint.

    Attributes
    ----------
    key : str
        Short name, without unit.
    meaning : str
        One sentence.
    value : float
        In SI.
    dimension : str or None
        A key of `cardan.units.DIMENSIONS`; None for a pure number, or 1/m.
    """

    key: str
    meaning: str
    value: float
    dimension: str | None = "angle"

    def quantity(self, digits: int = 4) -> Quantity:
        """Return it with its dimension and with so many digits."""
        return Quantity(self.value, self.dimension or "", digits)


def joint_inside(joint: Joint, bend: float) -> tuple[Inside, ...]:
    """Return what else moves inside a joint at a bend, as far as its sizes are given.

    Parameters
    ----------
    joint : Joint
        A joint of any kind.
    bend : float [rad]
        α in [0, π/2).

    Returns
    -------
    tuple of Inside
        Empty where nothing else moves, or where no size says how much.

    Examples
    --------
    >>> from cardan.drive.joints import Tripod
    >>> (orbit,) = joint_inside(Tripod(track_radius=0.02), 20 * deg)
    >>> print(f"{orbit.meaning}: {1e3 * orbit.value:.4f} mm")
    radius of the circle that the spider runs round three times a turn: 0.6418 mm
    """
    return tuple(_inside(joint, bend))


def _inside(joint: Joint, bend: float) -> Iterator[Inside]:
    if isinstance(joint, OffsetCross):
        text = _("half angle of the cone on which the driven shaft wobbles, twice a turn")
        yield Inside(key="wobble", meaning=text, value=float(offset_cross.wobble(bend, joint.offset, joint.reach)))
    elif isinstance(joint, DoubleCardan) and joint.centring_ratio is not None:
        yield from _double(joint.centring_ratio, joint.ball_on == "driving", bend)
    elif isinstance(joint, Tripod) and joint.track_radius is not None:
        text = _("radius of the circle that the spider runs round three times a turn")
        value = float(tripod.orbit_radius(bend, joint.track_radius))
        yield Inside(key="orbit", meaning=text, value=value, dimension="length")
    elif isinstance(joint, HalfCardan):
        text = _("play that its pairs of faces need to turn at this bend")
        yield Inside(key="play", meaning=text, value=float(half_cardan.play(bend, joint.pairs)))
    elif isinstance(joint, ElasticHalfCardan) and joint.pairs is not None:
        text = _("angle by which its links are strained against each other")
        yield Inside(key="strain", meaning=text, value=float(half_cardan.play(bend, joint.pairs)))
    elif isinstance(joint, PinCoupling):
        yield from _pins(joint, bend)
    elif isinstance(joint, Tracta) and joint.driving_distance is not None and joint.driven_distance is not None:
        yield _missed(float(tracta.tilt(bend, joint.driving_distance, joint.driven_distance)))
    elif isinstance(joint, Rzeppa | Weiss):
        yield from _balls(joint, bend)


def _missed(tilt: float) -> Inside:
    return Inside(key="plane_tilt", meaning=_("angle by which the plane of contact misses the middle"), value=tilt)


def _double(ratio: float, driving: bool, bend: float) -> Iterator[Inside]:
    bends = double_cardan.split(bend, ratio)
    first, second = bends if driving else bends[::-1]
    yield Inside(key="driving_bend", meaning=_("bend of the joint on the driving side"), value=float(first))
    yield Inside(key="driven_bend", meaning=_("bend of the joint on the driven side"), value=float(second))
    text = _("way of the ball along the other shaft, over the distance of both joint centres")
    way = float(double_cardan.slide(bend, ratio) - double_cardan.slide(0.0, ratio))
    yield Inside(key="ball_way", meaning=text, value=way, dimension=None)


def _pins(joint: PinCoupling, bend: float) -> Iterator[Inside]:
    one, other = joint.driving_slant, joint.driving_slant if joint.driven_slant is None else joint.driven_slant
    low, high = (float(end) for end in pin_coupling.slant_range(bend))
    text = _("slant above which pins turn all the way round at this bend")
    yield Inside(key="least_slant", meaning=text, value=low)
    yield Inside(key="most_slant", meaning=_("slant below which they do"), value=high)
    if joint.driving_distance is None or joint.driven_distance is None:
        return
    found = pin_coupling.pin_contact(TURN, bend, joint.driving_distance, joint.driven_distance, one, other)
    text = _("way of the contact along the driving pin")
    yield Inside(key="stroke", meaning=text, value=float(np.ptp(found.first)), dimension="length")
    text = _("largest contact force, without friction, for each N·m of torque, in N")
    yield Inside(key="force_N_per_Nm", meaning=text, value=float(np.max(found.force)), dimension=None)


def _balls(joint: Rzeppa | Weiss, bend: float) -> Iterator[Inside]:
    places = TURN[:, None] + np.arange(joint.balls) * (2.0 * np.pi / joint.balls)
    if isinstance(joint, Rzeppa) and joint.lever_b is not None and joint.lever_c is not None:
        tilt = float(dividing_lever.plane_error(bend, joint.lever_b, joint.lever_c))
        leads = tilted_plane.deviation(places, bend, tilt)
    elif joint.groove_radius is not None and joint.driving_offset is not None and joint.driven_offset is not None:
        offsets = joint.driving_offset, joint.driven_offset
        tilt = float(offset_grooves.plane_tilt(bend, *offsets))
        leads = offset_grooves.deviation(places, bend, *offsets, joint.groove_radius)
    else:
        return
    yield _missed(tilt)
    text = _("play that its balls need, or strain between them")
    yield Inside(key="ball_spread", meaning=text, value=float(np.max(np.ptp(leads, axis=-1))))
