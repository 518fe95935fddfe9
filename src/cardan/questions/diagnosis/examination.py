"""Everything a recording tells of a drive at once: causes, speed, orders, and the way of a shaft's centre."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from cardan.answers.quantity import Text
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.texts import _

from .expected import FAULTS, Expected, expected_orders
from .features import features
from .findings import Finding, weighed
from .signals.orbit import Orbit, orbit
from .signals.orders import OrderMap, OrderSpectrum, TrackedOrders, order_map, order_spectrum, tracked_orders
from .signals.signal import Channel, Progress, Signal, Watch
from .signals.spectra import integrate
from .signals.torsional import KEPT, LEAST_TEETH, TorsionalVibration, torsional_vibration

SHAKING = ("acceleration", "velocity", "displacement")  # quantities whose orders are shown, the best first
FOLLOWED = (1.0, 2.0, 3.0)  # orders followed over the speed
SLOWEST = 0.4  # share of the least speed of the shaft below which integrated channels are cut off

JUDGED, LOOKED_AT, MAPPED = 0.6, 0.8, 0.9
"""Shares of the work, about: causes, spectra, the map; orders followed are the rest."""

ALONG = ("axial", "torsion")  # directions in which no sensor looks across a shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class Examination:
    """What a recording tells.

    Attributes
    ----------
    signal : Signal
        The recording.
    drive : Drive
        The drive in order.
    findings : tuple of Finding
        Causes, the likeliest first.
    rotation : Rotation
        How the shaft turned.
    critical : float [rad/s]
        Lowest bending critical speed as computed; nan where not known.
    channel : Channel
        The one whose orders are shown: that with the highest line, or the one asked for.
    spectra : tuple of OrderSpectrum
        Of every channel that shakes.
    spectrum : OrderSpectrum
        Of that channel.
    map : OrderMap
        Of that channel.
    tracks : TrackedOrders
        Of that channel.
    orbit : Orbit or None
        Where two sensors look across the shaft at one place.
    swing : TorsionalVibration or None
        Where the tacho has teeth enough.
    expected : Expected or None
        What the likeliest cause should show; None where no model makes it.
    """

    signal: Signal
    drive: Drive
    findings: tuple[Finding, ...]
    rotation: Rotation
    critical: float
    channel: Channel
    spectra: tuple[OrderSpectrum, ...]
    spectrum: OrderSpectrum
    map: OrderMap
    tracks: TrackedOrders
    orbit: Orbit | None = None
    swing: TorsionalVibration | None = None
    expected: Expected | None = None

    @property
    def confidence(self) -> float:
        """From 0 to 1: how far the recording can be relied on."""
        return self.findings[0].confidence

    @property
    def cautions(self) -> tuple[Text, ...]:
        """What was doubtful."""
        return self.findings[0].cautions


def examine(
    signal: Signal,
    drive: Drive,
    *,
    channel: str | None = None,
    speed_range: tuple[float, float] | None = None,
    known: Catalogue | None = None,
    progress: Progress | None = None,
) -> Examination:
    """Return what a recording tells of a drive: `diagnose`, and the orders that it looks at.

    Parameters
    ----------
    signal : Signal
        The recording.
    drive : Drive
        The drive in order.
    channel : str, optional
        Name of the channel whose orders are shown; the one with the highest line when not given.
    speed_range : (float, float) [rad/s], optional
        Between which the shaft turned, for a recording without a tacho.
    known : Catalogue, optional
        With the table of faults; the shipped one when not given.
    progress : function, optional
        Told the share done; when it answers "stop" channels not yet looked at are left out, which a caution says, and
        the pictures end where the channels were read to.

    Returns
    -------
    Examination

    Raises
    ------
    InputError
        No such channel, a recording without vibration, or one without turns.

    See Also
    --------
    diagnose, order_spectrum

    Examples
    --------
    >>> from cardan import example
    >>> from cardan.recordings import examine, simulate_fault
    >>> drive = example("truck-supports")
    >>> found = examine(simulate_fault(drive, "worn_spline", seed=5), drive)
    >>> found.findings[0].cause, found.channel.name, round(found.spectrum.peaks()[0][0], 2)
    ('F21', 'centre radial', 2.0)
    """
    watch = Watch(progress, 1)
    asked = None if channel is None else signal.channel(channel)
    seen = features(signal, drive, speed_range=speed_range, progress=_part(watch, 0.0, JUDGED))
    findings = weighed(seen, known=known)
    shaft = seen.rotation
    spectra = tuple(_spectra(signal, shaft, watch))
    shown = asked or _loudest(signal, spectra)
    own = next((one for one in spectra if one.name == shown.name), None)
    found = Examination(
        signal=signal,
        drive=drive,
        findings=findings,
        rotation=shaft,
        critical=seen.critical,
        channel=shown,
        spectra=spectra,
        spectrum=own if own is not None else order_spectrum(shown, shaft),
        map=order_map(shown, shaft, progress=_part(watch, LOOKED_AT, MAPPED)),
        tracks=tracked_orders(shown, shaft, FOLLOWED, progress=_part(watch, MAPPED, 1.0)),
        orbit=_orbit(signal, shaft),
        swing=_swing(signal),
        expected=_expected(drive, findings[0].cause),
    )
    watch(1.0)
    return found


def _part(watch: Watch, begin: float, end: float) -> Progress:
    """Return who is told of a part of the work as the share of that part."""
    return lambda share: watch(begin + (end - begin) * share)


def _spectra(signal: Signal, shaft: Rotation, watch: Watch) -> Iterator[OrderSpectrum]:
    """Yield the order spectra of all channels that shake and cover turns enough."""
    shaking = [one for one in signal.measured if one.quantity in SHAKING]
    marks = [JUDGED + (LOOKED_AT - JUDGED) * k / max(len(shaking), 1) for k in range(len(shaking) + 1)]
    for k, one in enumerate(shaking):
        try:
            yield order_spectrum(one, shaft, progress=_part(watch, marks[k], marks[k + 1]))
        except InputError:
            continue


def _loudest(signal: Signal, spectra: tuple[OrderSpectrum, ...]) -> Channel:
    """Return the channel with the highest line, of the quantity that shows orders best."""
    for quantity in SHAKING:
        of_it = [one for one in spectra if one.quantity == quantity]
        if of_it:
            highest = max(of_it, key=lambda one: max((size for _order, size in one.peaks()), default=0.0))
            return signal.channel(highest.name)
    raise refuse("signal", _("the recording has no channel of vibration"), "missing")


def _orbit(signal: Signal, shaft: Rotation) -> Orbit | None:
    """Return the orbit of two sensors that look across the shaft at one place; None where there are no two."""
    for quantity in reversed(SHAKING):
        likely = [one for one in signal.measured if one.quantity == quantity and one.direction not in ALONG]
        for x, y in combinations(likely, 2):
            if x.place != y.place or (x.direction == y.direction and x.direction):
                continue
            if quantity != "displacement" and not {x.direction, y.direction} <= {"y", "z"}:
                continue  # nothing says that both look across the shaft
            try:
                return orbit(_way(x, shaft), _way(y, shaft), shaft)
            except InputError:
                continue
    return None


def _way(channel: Channel, shaft: Rotation) -> Channel:
    """Return a channel as displacement."""
    low = SLOWEST * shaft.speeds[0] / (2.0 * math.pi)
    times = {"displacement": 0, "velocity": 1, "acceleration": 2}[channel.quantity]
    for _time in range(times):
        channel = integrate(channel, low=low)
    return channel


def _swing(signal: Signal) -> TorsionalVibration | None:
    """Return the torsional vibration that a tooth wheel shows; None where the tacho has few pulses a turn."""
    teeth = signal.pulses_per_turn
    if signal.tacho is None or teeth < LEAST_TEETH or teeth % 1.0:
        return None
    wheel = signal.channels[signal.tacho]
    if wheel.quantity != "pulses":
        return None
    try:
        return torsional_vibration(wheel, int(teeth), kept=min(KEPT, int(teeth) // 2))
    except InputError:
        return None


def _expected(drive: Drive, cause: str) -> Expected | None:
    """Return what a cause should show; None where nothing models it, or the drive cannot have it."""
    wanted = "" if cause == "healthy" else cause
    fault = next((name for name, row in FAULTS.items() if row == wanted), None)
    if fault is None:
        return None
    try:
        return expected_orders(drive, fault)
    except InputError:
        return None
