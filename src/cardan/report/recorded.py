"""A recording in a file, read and judged beside a drive: its page, and the channels about which more can be said."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeAlias

from cardan.answers.reader import reader
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.io.signals import SIGNAL_FORMATS, load_recording
from cardan.questions.diagnosis.answer import answer
from cardan.questions.diagnosis.examination import examine
from cardan.questions.diagnosis.signals.signal import DIRECTIONS, TURNING, Channel, Signal
from cardan.texts import _

from .block import Page, Points, Words
from .block import page as page_of

Progress: TypeAlias = Callable[[float], object]  # told the share done; may answer "stop"
READING = 0.4  # share of the work that reading a file is, about
SUFFIXES = tuple(SIGNAL_FORMATS)  # what recordings are called at their end
WAYS = tuple(one for one in DIRECTIONS if one)  # directions in which a sensor can look


@dataclass(frozen=True, kw_only=True)
class Said:
    """What is said of a recording that its file does not tell."""

    tacho: str | None = None  # channel that tells how the shaft turns; the likeliest when not given
    pulses_per_turn: float = 1.0  # pulses of the tacho in a turn
    titles: tuple[str, ...] = ()  # what the channels measure, all in order, as ``acceleration_front_z_m_s2``
    rate: float | None = None  # values a second [Hz]
    full_scale: float | None = None  # what the greatest number of a WAV file stands for
    # channel, key path of the part that it sits on, direction in which it looks; empty where nothing is said
    places: tuple[tuple[str, str, str], ...] = ()
    channel: str | None = None  # channel whose orders are shown; the loudest when not given


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """A channel of a recording, as it was taken."""

    name: str
    place: str = ""  # place, direction: where it sits and looks; empty where not known
    direction: str = ""
    turns: bool = False  # whether it can tell how the shaft turns
    shakes: bool = False  # whether it measures vibration


@dataclass(frozen=True, eq=False, kw_only=True)
class Recorded:
    """What a recording tells."""

    page: Page  # its diagnosis, or why there is none
    sensors: tuple[Sensor, ...]  # its channels
    tacho: str  # name of the channel taken as tacho; empty where there is none


def recorded(
    path: Path, drive: Drive, said: Said, *, known: Catalogue | None = None, progress: Progress | None = None
) -> Recorded:
    """Return what a recording in a file tells of a drive.

    path: the file; it is read as data.
    drive: the drive in order; said: what the file does not tell.
    """
    told = progress or (lambda _share: None)
    found = _placed(
        load_recording(
            path,
            tacho=said.tacho,
            pulses_per_turn=said.pulses_per_turn,
            titles=said.titles,
            rate=said.rate,
            full_scale=said.full_scale or (),
            progress=lambda share: told(READING * share),
        ),
        said,
    )
    names = [one.name for one in found.channels]
    try:
        channel = said.channel if said.channel in names else None
        examined = examine(
            found, drive, channel=channel, known=known, progress=lambda share: told(READING + (1.0 - READING) * share)
        )
        page = page_of(answer(examined), reader())
    except InputError as error:
        page = _unjudged(found, error)
    tacho = "" if found.tacho is None else names[found.tacho]
    return Recorded(page=page, sensors=tuple(_sensor(one) for one in found.channels), tacho=tacho)


def _placed(found: Signal, said: Said) -> Signal:
    """Return a recording with its sensors where they are said to be."""
    places = {name: (place, way) for name, place, way in said.places}

    def moved(one: Channel) -> Channel:
        place, way = places.get(one.name, ("", ""))
        return replace(one, place=place or one.place, direction=way or one.direction)

    return replace(found, channels=tuple(moved(one) for one in found.channels))


def _sensor(one: Channel) -> Sensor:
    turns = one.quantity in TURNING
    shakes = one.quantity in ("acceleration", "velocity", "displacement")
    return Sensor(
        name=one.name, place=one.place, direction=one.direction, turns=turns or one.quantity == "other", shakes=shakes
    )


def _unjudged(found: Signal, error: InputError) -> Page:
    """Return the page of a recording that tells nothing, with the reasons."""
    alarms = [Words(text=str(one), tone="warning") for one in error.problems]
    more = [Points(title=_("To mind"), items=found.cautions)] if found.cautions else []
    title = _("Diagnosis of {name}").format(name=found.name)
    text = _("This recording cannot be judged.")
    return Page(name="diagnosis", title=title, answer=text, blocks=[*alarms, *more], alarms=alarms)
