"""Results as CSV: one row for each position or time, one column for each quantity, named with its unit."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from cardan.errors import refuse
from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.motion import Motion
from cardan.texts import _

suffix = ".csv"


def content(result: Any) -> bytes:
    """Return a result as the bytes of a CSV file."""
    return table(columns_of(result)).encode()


def columns_of(result: Any) -> Mapping[str, Sequence[Any]]:
    """Return a result as columns, each named with its unit."""
    for kind, columns in COLUMNS.items():
        if isinstance(result, kind):
            return columns(result)
    if isinstance(result, Mapping):
        return result
    raise refuse("result", _("{kind} is not a table; save it as .json").format(kind=type(result).__name__))


def table(columns: Mapping[str, Sequence[Any]]) -> str:
    """Return columns as CSV text, numbers in full precision.

    >>> print(table({"angle_deg": [0.0, 90.0], "ratio": [1.25, 0.8]}))
    angle_deg,ratio
    0.0,1.25
    90.0,0.8
    <BLANKLINE>
    """
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        writer.writerow([_cell(value) for value in row])
    return stream.getvalue()


def _cell(value: Any) -> Any:
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or (isinstance(value, float) and value != value):
        return ""
    return repr(value) if isinstance(value, float) else value


def motion_columns(motion: Motion) -> dict[str, Any]:
    """Return the motion of a single drive as columns over the input angle."""
    deg = 180.0 / np.pi
    columns: dict[str, Any] = {"angle_deg": motion.angle * deg}
    for k in range(1, motion.shaft_angle.shape[-2]):
        columns[f"shaft_{k + 1}_angle_deg"] = motion.shaft_angle[k] * deg
        columns[f"shaft_{k + 1}_angle_error_deg"] = motion.angle_error[k] * deg
        columns[f"shaft_{k + 1}_ratio"] = motion.shaft_ratio[k]
        columns[f"shaft_{k + 1}_ratio_slope_per_rad"] = motion.shaft_slope[k]
        if motion.speed is not None:
            columns[f"shaft_{k + 1}_speed_rpm"] = motion.shaft_speed[k] * 30.0 / np.pi
            columns[f"shaft_{k + 1}_acceleration_rad_s2"] = motion.shaft_acceleration[k]
    for i in range(motion.yoke_rotation.shape[-2]):
        columns[f"joint_{i + 1}_yoke_rotation_deg"] = motion.yoke_rotation[i] * deg
        if not motion.crossed or motion.crossed[i]:
            columns[f"joint_{i + 1}_cross_driving_deg"] = motion.cross_driving[i] * deg
            columns[f"joint_{i + 1}_cross_driven_deg"] = motion.cross_driven[i] * deg
    return columns


def articulation_columns(result: Articulation) -> dict[str, Any]:
    """Return an articulation as columns over time."""
    deg = 180.0 / np.pi
    columns: dict[str, Any] = {"time_s": result.times}
    for i in range(result.joint_angle.shape[-1]):
        columns[f"joint_{i + 1}_joint_angle_deg"] = result.joint_angle[:, i] * deg
    for i in range(result.plane_twist.shape[-1]):
        columns[f"joint_{i + 2}_plane_twist_deg"] = result.plane_twist[:, i] * deg
    for k in range(result.length.shape[-1]):
        columns[f"shaft_{k + 1}_length_mm"] = result.length[:, k] * 1e3
    columns["speed_fluctuation"] = result.speed_fluctuation
    if result.shaft_speed is not None and result.shaft_acceleration is not None:
        for k in range(result.shaft_speed.shape[-1]):
            columns[f"shaft_{k + 1}_speed_rad_s"] = result.shaft_speed[:, k]
            columns[f"shaft_{k + 1}_acceleration_rad_s2"] = result.shaft_acceleration[:, k]
    return columns


COLUMNS: dict[type, Callable[[Any], dict[str, Any]]] = {Motion: motion_columns, Articulation: articulation_columns}
"""Result -> its columns."""
