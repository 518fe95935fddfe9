"""Recordings as universal files: data sets 58 of functions over time."""

from __future__ import annotations

import re
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.later import later
from cardan.questions.diagnosis.signals.quality import evened
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.texts import _, mark

from .columns import Asked, Column, Raw, content, title_of

pyuff = later("pyuff", mark("universal files need the extra `signals`: pip install 'cardan[signals]'"))

suffix = ".uff"

MAX_BYTES = 400_000_000  # larger files are refused
MOST_LETTERS = 80  # of a line of text in a data set
TIME_RESPONSES = (0, 1)  # types of functions that run over time: general ones and time responses
QUANTITY_OF = {8: "displacement", 11: "velocity", 12: "acceleration"}  # type of the ordinate -> quantity

DIRECTION_OF = {1: "x", 2: "y", 3: "z", 4: "torsion", 5: "torsion", 6: "torsion"}
"""Direction of the response -> direction; negative ones turn the sign."""


def read(path: Path, asked: Asked) -> Raw:
    """Return the channels of a universal file."""
    name = path.name
    marks = len(re.findall(rb"^ *-1 *\r?$", content(path, name, MAX_BYTES), re.MULTILINE))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            file = pyuff().UFF(str(path))
            kinds = [int(one) for one in file.get_set_types()]
            wanted = [k for k, kind in enumerate(kinds) if kind == 58]
            found = file.read_sets(wanted) if wanted else []
        except Exception as error:  # the library names no errors of its own
            raise refuse(name, _("is not a universal file that can be read: {why}").format(why=error)) from None
    sets = found if isinstance(found, list) else [found]
    over_time = [one for one in sets if int(one.get("func_type") or 0) in TIME_RESPONSES and np.size(one["data"])]
    if not over_time:
        if sets:
            raise refuse(name, _("holds no function over time, but spectra or such"), "missing")
        raise refuse(name, _("holds no whole data set 58; it may be cut off"), "empty")
    cautions = [_("{name} is cut off: it holds less than it says.").format(name=name)] if marks % 2 else []
    return Raw(columns=[_column(one, k, cautions) for k, one in enumerate(over_time)], cautions=tuple(cautions))


def _column(one: dict[str, Any], k: int, cautions: list[str]) -> Column:
    """Return the column of a data set."""
    title = str(one.get("id1") or "").strip()
    node, way = int(one.get("rsp_node") or 0), int(one.get("rsp_dir") or 0)
    if title in ("", "NONE"):
        title = _("channel {number}").format(number=node or k + 1)
    values = np.real(np.asarray(one["data"])).astype(float) * (-1.0 if way < 0 else 1.0)
    step = float(one.get("abscissa_inc") or 0.0)
    start = float(one.get("abscissa_min") or 0.0)
    rate, trust = (1.0 / step if step > 0.0 else None), 1.0
    if int(one.get("abscissa_spacing") or 0) == 0 and np.size(one.get("x", ())) == values.size > 1:
        times = np.asarray(one["x"], dtype=float)
        if np.any(np.diff(times) <= 0.0):
            raise refuse(title, _("the times do not rise"), "inconsistent")
        rate, start, rows, told, trust = evened(times, values[None])
        values = rows[0]
        cautions += [f"{title}: {text}" for text in told]
    unit = str(one.get("ordinate_axis_units_lab") or "").strip()
    return Column(
        title=title,
        values=values,
        rate=rate,
        start=start,
        quantity=QUANTITY_OF.get(int(one.get("ordinate_spec_data_type") or 0), ""),
        unit="" if unit == "NONE" else unit,
        direction=DIRECTION_OF.get(abs(way), ""),
        trust=trust,
    )


def content_of(signal: Signal) -> bytes:
    """Return a recording as the bytes of a universal file, a data set 58 for each channel, in SI."""
    titles = [title_of(one.name, one.quantity, one.place, one.direction) for one in signal.channels]
    text = _("is longer than the {most} letters of a line of a universal file")
    check(Problem(one, text.format(most=MOST_LETTERS), "out_of_range") for one in titles if len(one) > MOST_LETTERS)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "recording.uff"
        pyuff().UFF(str(path)).write_sets(
            [
                pyuff().prepare_58(
                    func_type=1,
                    rsp_node=k + 1,
                    rsp_dir=0,
                    ref_node=0,
                    ref_dir=0,
                    x=one.time,
                    data=one.values,
                    id1=title,
                    abscissa_spacing=1,
                    abscissa_min=one.start,
                    abscissa_inc=1.0 / one.rate,
                    abscissa_spec_data_type=17,
                    ordinate_spec_data_type=0,
                    orddenom_spec_data_type=0,
                )
                for k, (one, title) in enumerate(zip(signal.channels, titles, strict=True))
            ],
            mode="overwrite",
        )
        return path.read_bytes()
