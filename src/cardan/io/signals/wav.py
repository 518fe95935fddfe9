"""Recordings as WAV: numbers without units; what they stand for is to be told."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
import scipy

from cardan.errors import check, refuse
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.texts import _

from .columns import Asked, Column, Raw, content
from .csv import unlike

suffix = ".wav"

MAX_BYTES = 400_000_000  # larger files are refused; no more of them is read


def read(path: Path, asked: Asked) -> Raw:
    """Return the channels of a WAV file, ``left`` and ``right`` where there are two."""
    name = path.name
    found = content(path, name, MAX_BYTES)
    cautions = []
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            whole_rate, values = scipy.io.wavfile.read(io.BytesIO(found))
        except Exception as error:  # a header of nonsense makes all sorts
            raise refuse(name, _("is not a WAV file that can be read: {why}").format(why=error)) from None
    if any("premature" in str(one.message) for one in told):
        cautions.append(_("{name} is cut off: it holds less than it says.").format(name=name))
    rate = float(whole_rate)
    if values.size == 0 or rate <= 0.0:
        raise refuse(name, _("holds no values"), "empty")
    if asked.rate is not None and abs(asked.rate / rate - 1.0) > 0.01:
        text = _("{name}: says {found:.6g} values a second; it was read with the {given:.6g} given.")
        cautions.append(text.format(name=name, found=rate, given=asked.rate))
        rate = asked.rate
    rows = np.atleast_2d(values.T).astype(float)
    whole = np.issubdtype(values.dtype, np.integer)
    if values.dtype == np.uint8:
        rows = (rows - 128.0) / 128.0
    elif whole:
        rows /= -float(np.iinfo(values.dtype).min)
    scale = list(asked.full_scale) or [1.0]
    if len(scale) not in (1, len(rows)):
        text = _("{given} numbers given for {count} channels")
        raise refuse("full_scale", text.format(given=len(scale), count=len(rows)), "inconsistent")
    if whole and not asked.full_scale and asked.titles:
        text = _("{name}: nothing says what its greatest number stands for (full_scale); it counts as 1 of its unit.")
        cautions.append(text.format(name=name))
    if not asked.titles:
        text = _("{name}: a WAV file does not say what its channels measure; name it by their titles.")
        cautions.append(text.format(name=name))
    names = ("left", "right") if len(rows) == 2 else tuple(f"channel {k + 1}" for k in range(len(rows)))
    return Raw(
        columns=[
            Column(title=one, values=row * scale[k % len(scale)], rate=rate, scaled=bool(asked.full_scale) or not whole)
            for k, (one, row) in enumerate(zip(names, rows, strict=True))
        ],
        cautions=tuple(cautions),
    )


def content_of(signal: Signal) -> bytes:
    """Return a recording as the bytes of a WAV file of 32-bit floating numbers in SI."""
    check(unlike(signal))
    rate = signal.channels[0].rate
    if abs(rate - round(rate)) > 1e-6 * rate:
        text = _("{value:.6g} values a second; a WAV file holds whole numbers only")
        raise refuse("channels[0].rate", text.format(value=rate), "out_of_range")
    stream = io.BytesIO()
    scipy.io.wavfile.write(
        stream, round(rate), np.stack([one.values for one in signal.channels], axis=1).astype(np.float32)
    )
    return stream.getvalue()
