"""What the shafts of a drive are made of, stretch by stretch, and how their own weight bends them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from cardan.drive.body import body_length, body_material, inner_diameter
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.material import Material
from cardan.texts import _


class Stretch(NamedTuple):
    """A stretch of a shaft."""

    path: str
    outer: float
    """[m]"""
    inner: float
    """[m]"""
    length: float | None
    """[m]"""
    material: Material

    @property
    def words(self) -> str:
        """What to add to the name of its shaft; nothing where the shaft is one stretch."""
        if "segments" not in self.path:
            return ""
        return _(", stretch {number}").format(number=int(self.path.rpartition("[")[2].rstrip("]")) + 1)


def stretches(drive: Drive, k: int) -> tuple[Stretch, ...]:
    """Return the stretches of a shaft, counted from 0; none where the drive does not say its body."""
    shaft, path = drive.shafts[k], f"shafts[{k}]"
    if shaft.outer is not None:
        length = body_length(shaft, known_lengths(drive).get(shaft.number))
        made = body_material(shaft) if shaft.layup is not None else shaft.material or Material()
        return (Stretch(path, shaft.outer, inner_diameter(shaft), length, made),)
    return tuple(
        Stretch(f"{path}.segments[{s}]", one.outer, one.inner, one.length, one.material or Material())
        for s, one in enumerate(shaft.segments)
    )


def weight_bending(drive: Drive, k: int) -> float:
    """Return the largest bending moment of a shaft's weight between its joints, counted from 0 [N·m].

    Parameters
    ----------
    drive : Drive
    k : int
        Shaft, counted from 0.

    Notes
    -----
    A beam on two hinges, g across its full length: weights of its stretches and of the parts it carries; nan for the
    end shafts, and where body or length is not given.
    """
    found, length = stretches(drive, k), known_lengths(drive).get(k + 1)
    if not 0 < k < len(drive.joints) or not found or length is None:
        return math.nan
    whole = sum(one.length or 0.0 for one in found) or length
    fit, gravity = length / whole, math.hypot(*drive.settings.gravity)
    edge, rows = 0.0, []
    for one in found:
        reach = fit * (one.length or 0.0)
        load = gravity * one.material.density * 0.25 * math.pi * (one.outer**2 - one.inner**2)
        rows.append((edge, edge + reach, load))
        edge += reach
    at = np.linspace(0.0, length, 401)
    moment = np.zeros(at.size)
    for start, end, load in rows:
        force, middle = load * (end - start), 0.5 * (start + end)
        beside = np.clip(at - start, 0.0, end - start)
        moment += force * (1.0 - middle / length) * at - load * beside * (at - start - 0.5 * beside)
    for lump in drive.shafts[k].masses:
        force = gravity * lump.mass
        moment += force * (1.0 - lump.position / length) * at - force * np.clip(at - lump.position, 0.0, None)
    return float(np.max(np.abs(moment)))
