"""Recordings: one module for each kind of file, with ``suffix`` and ``read``, and its name in `SIGNAL_FORMATS`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from cardan.errors import InputError, Problem, check, refuse
from cardan.files import write_bytes
from cardan.questions.diagnosis.signals.quality import sound
from cardan.questions.diagnosis.signals.signal import TURNING, Channel, Signal
from cardan.texts import _
from cardan.units import nearest

from . import csv, tdms, uff, wav
from .columns import MOST_VALUES, UNITS, Asked, Column, Meaning, Raw, meaning, suffix_of

SIGNAL_FORMATS = {csv.suffix: csv, ".txt": csv, wav.suffix: wav, uff.suffix: uff, ".unv": uff, tdms.suffix: tdms}
"""Suffix -> module that reads such files."""

WRITERS = {csv.suffix: csv, wav.suffix: wav, uff.suffix: uff, ".unv": uff, tdms.suffix: tdms}
"""Suffix -> module that writes such files."""

MARKS = ((b"RIFF", ".wav"), (b"TDSm", ".tdms"), (b"    -1", ".uff"))  # how files begin -> suffix
UNSCALED = 0.3  # trust in a channel whose numbers are of an unknown size: its orders are right, its levels are not
LEAST_VALUES = 16  # a channel with fewer is no recording

__all__ = ["SIGNAL_FORMATS", "WRITERS", "signal", "write"]


def load_recording(
    path: str | Path,
    *,
    tacho: str | None = None,
    pulses_per_turn: float = 1.0,
    titles: dict[str, str] | Sequence[str] = (),
    rate: float | None = None,
    full_scale: float | Sequence[float] = (),
    progress: Callable[[float], object] | None = None,
) -> Signal:
    """Return the recording in a file: CSV, WAV, universal file (data set 58) or TDMS.

    Parameters
    ----------
    path : str or Path
        Its suffix says how to read it: .csv, .txt, .wav, .uff, .unv or .tdms.
    tacho : str, optional
        Name of the channel that tells how the shaft turns: pulses, a speed or an angle. Without it the first channel of
        pulses counts, else the first of a speed, else the first of an angle.
    pulses_per_turn : float
        Pulses of the tacho in a turn of the shaft.
    titles : dict of str to str, or sequence of str
        What the channels measure, as the title of a CSV column says it (``acceleration_front_z_m_s2``, ``tacho``): by
        the name that the file has for them, or all of them in order.
    rate : float [Hz], optional
        Values a second, for files that do not say it.
    full_scale : float or sequence of float
        What the greatest number of a WAV file stands for, in the unit of the title: one for all channels or one each.
    progress : function, optional
        Told the share done; if it answers "stop", the part read so far is the recording.

    Returns
    -------
    Signal
        In SI, with even steps, all values finite; what was doubtful is among its cautions and lowers the trust of the
        channel.

    Raises
    ------
    InputError
        The file cannot be read, is none of these, too large or cut off beyond use; a title lacks a unit; no channel
        holds anything; there is no such tacho.
    MissingExtraError
        What reads universal files or TDMS is not installed.

    See Also
    --------
    examine, estimate_rotation

    Examples
    --------
    >>> import numpy as np
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from cardan.recordings import load_recording
    >>> rows = ["time_s,tacho,acceleration_front_z_m_s2"]
    >>> rows += [f"{k / 1000},{int(k % 50 < 10)},{np.sin(k / 8):.4f}" for k in range(500)]
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.csv"
    ...     _ = file.write_text("\\n".join(rows))
    ...     found = load_recording(file)
    >>> front = found.measured[0]
    >>> front.name, front.quantity, front.direction, round(front.rate), found.channels[found.tacho].name
    ('front', 'acceleration', 'z', 1000, 'tacho')
    """
    where = Path(path)
    scales = (float(full_scale),) if isinstance(full_scale, int | float) else tuple(full_scale)
    check(_bad_options(pulses_per_turn, rate, scales))
    asked = Asked(
        titles=titles if isinstance(titles, dict) else tuple(titles), rate=rate, full_scale=scales, progress=progress
    )
    module = _module(where)
    raw: Raw = module.read(where, asked)
    if sum(one.values.size for one in raw.columns) > MOST_VALUES:
        text = _("holds more than {limit} million values; cut the recording")
        raise refuse(where.name, text.format(limit=MOST_VALUES // 10**6), "out_of_range")
    told = _titled(raw.columns, asked.titles, where.name)
    return _made(where.name, raw, told, asked, tacho, pulses_per_turn)


def _bad_options(pulses_per_turn: float, rate: float | None, scales: Sequence[float]) -> list[Problem]:
    found = []
    text = _("{value:.6g} given; a finite number above 0 is needed")
    for name, value in (("pulses_per_turn", pulses_per_turn), ("rate", rate), *(("full_scale", one) for one in scales)):
        if value is not None and not 0.0 < value < float("inf"):
            found.append(Problem(name, text.format(value=value), "not_positive"))
    return found


def _module(where: Path) -> Any:
    """Return the module that reads a file; told by its suffix, checked by how it begins."""
    suffix = where.suffix.lower()
    if suffix not in SIGNAL_FORMATS:
        text = _("{suffix} is not a format of recordings; known are {known}")
        raise refuse(where.name, text.format(suffix=suffix or "–", known=", ".join(SIGNAL_FORMATS)), "unknown_kind")
    try:
        with where.open("rb") as stream:
            head = stream.read(8)
    except OSError:
        return SIGNAL_FORMATS[suffix]  # which says why it cannot be read
    by_content = next((own for mark, own in MARKS if head.startswith(mark)), None)
    if by_content is not None and SIGNAL_FORMATS[suffix] is not SIGNAL_FORMATS[by_content]:
        text = _("is a {found} file by its content; rename it or choose the right one")
        raise refuse(where.name, text.format(found=by_content), "inconsistent")
    return SIGNAL_FORMATS[suffix]


def _titled(columns: Sequence[Column], titles: dict[str, str] | Sequence[str], name: str) -> list[Meaning]:
    """Return what every column measures; all that is wrong with the titles at once."""
    problems: list[Problem] = []
    own = [one.title for one in columns]
    if isinstance(titles, dict):
        for key in titles:
            if key not in own:
                near = nearest(key, own)
                text = _("there is no channel {name}; there are {names}").format(name=repr(key), names=", ".join(own))
                if near is not None:
                    text = _("there is no channel {name}; did you mean {near}?").format(name=repr(key), near=near)
                problems.append(Problem("titles", text, "unknown_key"))
        given = [titles.get(one, "") for one in own]
    else:
        given = [*titles, *[""] * len(columns)][: len(columns)]
        if titles and len(titles) != len(columns):
            text = _("{given} titles given; {name} has {count} channels: {names}")
            text = text.format(given=len(titles), name=name, count=len(columns), names=", ".join(own))
            problems.append(Problem("titles", text, "inconsistent"))
    found = []
    for one, title in zip(columns, given, strict=True):
        try:
            found.append(meaning(title) if title else _own_meaning(one))
        except InputError as error:
            problems += error.problems
    check(problems)
    return found


def _own_meaning(one: Column) -> Meaning:
    """Return what a column measures by what its file says of it."""
    suffix = suffix_of(one.unit)
    if one.unit and not suffix:
        if not one.quantity:
            return Meaning(name=one.title, quantity="other", factor=1.0, unit=one.unit, direction=one.direction)
        text = _("{unit} is not a unit of {quantity}; known are {known}")
        known = ", ".join(UNITS[one.quantity])
        raise refuse(one.title, text.format(unit=repr(one.unit), quantity=one.quantity, known=known), "inconsistent")
    if not one.quantity:
        return meaning(f"{one.title.replace(' ', '_')}_{suffix}") if suffix else meaning(one.title)
    if suffix and suffix not in UNITS[one.quantity]:
        text = _("{unit} is not a unit of {quantity}; known are {known}")
        known = ", ".join(UNITS[one.quantity])
        raise refuse(one.title, text.format(unit=repr(one.unit), quantity=one.quantity, known=known), "inconsistent")
    factor = UNITS[one.quantity].get(suffix, 1.0)
    return Meaning(name=one.title, quantity=one.quantity, factor=factor, unit=suffix, direction=one.direction)


def _made(
    name: str, raw: Raw, told: Sequence[Meaning], asked: Asked, tacho: str | None, pulses_per_turn: float
) -> Signal:
    """Return the recording, its channels judged and its tacho chosen."""
    names = _unlike([one.name for one in told])
    problems: list[Problem] = []
    cautions = list(raw.cautions)
    channels: list[Channel] = []
    wanted = _wanted(tacho, names, raw.columns)
    for one, means, own in zip(raw.columns, told, names, strict=True):
        if means.quantity == "time":
            continue
        rate = one.rate if one.rate is not None else asked.rate
        if rate is None:
            problems.append(Problem(own, _("the file does not say its rate: give the rate of its values"), "missing"))
            continue
        quantity = "pulses" if own == wanted and means.quantity == "other" else means.quantity
        swings = quantity not in (*TURNING, "other")
        judged = sound(own, one.values, swings=swings, steady=quantity == "angular_speed")
        if judged is None or judged.values.size < LEAST_VALUES:
            text = _("{channel}: holds no more than {count} numbers; it was left out.")
            count = int(np.sum(np.isfinite(one.values)))
            if own == wanted:
                problems.append(Problem(own, _("the tacho holds no more than {count} numbers").format(count=count)))
            cautions.append(text.format(channel=own, count=count))
            continue
        cautions += judged.cautions
        channels.append(
            Channel(
                name=own,
                quantity=quantity,
                values=judged.values * means.factor,
                rate=rate,
                start=one.start,
                place=means.place or one.place,
                direction=means.direction or one.direction,
                unit=means.unit,
                trust=judged.trust * one.trust * (1.0 if one.scaled or quantity in ("pulses", "other") else UNSCALED),
            )
        )
    check(problems)
    if not channels:
        raise refuse(name, _("no channel holds anything: {why}").format(why=" ".join(cautions)), "empty")
    place = _chosen(channels, wanted, cautions)
    return Signal(
        name=name, channels=tuple(channels), tacho=place, pulses_per_turn=pulses_per_turn, cautions=tuple(cautions)
    )


def _unlike(names: Sequence[str]) -> list[str]:
    """Return names of which none is there twice."""
    found: list[str] = []
    for one in names:
        count, own = 2, one
        while own in found:
            own, count = f"{one}_{count}", count + 1
        found.append(own)
    return found


def _wanted(tacho: str | None, names: Sequence[str], columns: Sequence[Column]) -> str | None:
    """Return the name of the channel asked for as tacho, by its name or by its title."""
    if tacho is None:
        return None
    for own, column in zip(names, columns, strict=True):
        if tacho in (own, column.title):
            return own
    near = nearest(tacho, names)
    text = _("there is no channel {name}; there are {names}").format(name=repr(tacho), names=", ".join(names))
    if near is not None:
        text = _("there is no channel {name}; did you mean {near}?").format(name=repr(tacho), near=near)
    raise refuse("tacho", text, "unknown_key")


def _chosen(channels: Sequence[Channel], wanted: str | None, cautions: list[str]) -> int | None:
    """Return the place of the tacho: the one asked for, else the likeliest; None where it is dead."""
    if wanted is not None:
        place = next(k for k, one in enumerate(channels) if one.name == wanted)
        if channels[place].quantity not in TURNING:
            text = _("channel {name} measures {quantity}; one of {choices} is needed")
            text = text.format(name=wanted, quantity=channels[place].quantity, choices=", ".join(TURNING))
            raise refuse("tacho", text, "inconsistent")
        likely = [place]
    else:
        order = {quantity: rank for rank, quantity in enumerate(TURNING)}
        likely = [k for k, one in enumerate(channels) if one.quantity in order]
        likely.sort(key=lambda k: order[channels[k].quantity])
    alive = [k for k in likely if channels[k].trust > 0.0]
    if not likely:
        cautions.append(_("There is no tacho: the speed has to be found in what shakes."))
    elif not alive:
        text = _("{name}: the tacho is dead: the speed has to be found in what shakes.")
        cautions.append(text.format(name=channels[likely[0]].name))
    elif len(alive) > 1 and channels[alive[0]].quantity == channels[alive[1]].quantity:
        text = _("{name} was taken as the tacho; {others} could be as well.")
        others = ", ".join(channels[k].name for k in alive[1:] if channels[k].quantity == channels[alive[0]].quantity)
        cautions.append(text.format(name=channels[alive[0]].name, others=others))
    return alive[0] if alive else None


def write(recording: Signal, path: Path) -> None:
    """Write a recording in SI: as CSV with a column of times, WAV of 32-bit floating numbers, universal file or TDMS.

    Raises
    ------
    InputError
        The suffix is none of these, the channels of a CSV or WAV have different times, or the file cannot be written.
    MissingExtraError
        What writes universal files or TDMS is not installed.
    """
    module = WRITERS.get(path.suffix.lower())
    if module is None:
        text = _("a recording is saved as {known}")
        raise refuse(str(path), text.format(known=_(" or ").join(WRITERS)), "unknown_kind")
    write_bytes(path, module.content_of(recording))
