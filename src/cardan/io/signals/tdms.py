"""Recordings as TDMS: groups of channels with their units and steps of time as properties."""

from __future__ import annotations

import io
import logging
from pathlib import Path

import numpy as np

from cardan.errors import InputError, refuse
from cardan.later import later
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.texts import _, mark

from .columns import Asked, Column, Raw, content, title_of

nptdms = later("nptdms", mark("TDMS files need the extra `signals`: pip install 'cardan[signals]'"))
log = later("nptdms.log")

suffix = ".tdms"

MAX_BYTES = 400_000_000  # larger files are refused


def read(path: Path, asked: Asked) -> Raw:
    """Return the channels of a TDMS file, of all its groups."""
    name = path.name
    log().log_manager.set_level(logging.ERROR)  # what it warns of is asked for below
    try:
        file = nptdms().TdmsFile.read(io.BytesIO(content(path, name, MAX_BYTES)))
        cut = bool(file.file_status.incomplete_final_segment)
        groups = file.groups()
        rows = [(group, channel, channel[:]) for group in groups for channel in group.channels()]
    except InputError:
        raise
    except Exception as error:  # a header of nonsense makes all sorts
        raise refuse(name, _("is not a TDMS file that can be read: {why}").format(why=error)) from None
    cautions = [_("{name} is cut off: it holds less than it says.").format(name=name)] if cut else []
    columns = []
    for group, channel, values in rows:
        numbers = np.asarray(values)
        title = str(channel.name).strip()
        if numbers.size == 0 or not np.issubdtype(numbers.dtype, np.number):
            text = _("{channel} of {name} holds no numbers; it was left out.")
            cautions.append(text.format(channel=title, name=name))
            continue
        known = {str(key).lower(): value for key, value in channel.properties.items()}
        step = float(known.get("wf_increment") or 0.0)
        columns.append(
            Column(
                title=title if len(groups) == 1 else f"{group.name}_{title}",
                values=numbers.astype(float),
                rate=1.0 / step if step > 0.0 else None,
                start=float(known.get("wf_start_offset") or 0.0),
                unit=str(known.get("unit_string") or known.get("unit") or "").strip(),
            )
        )
    if not columns:
        raise refuse(name, _("is cut off before its numbers") if cut else _("holds no channel of numbers"), "empty")
    return Raw(columns=columns, cautions=tuple(cautions))


def content_of(signal: Signal) -> bytes:
    """Return a recording as the bytes of a TDMS file, in SI, each channel with its own rate."""
    stream = io.BytesIO()
    with nptdms().TdmsWriter(stream) as writer:
        writer.write_segment(
            [
                nptdms().ChannelObject(
                    "recording",
                    title_of(one.name, one.quantity, one.place, one.direction),
                    one.values,
                    properties={"wf_increment": 1.0 / one.rate, "wf_start_offset": one.start},
                )
                for one in signal.channels
            ]
        )
    return stream.getvalue()
