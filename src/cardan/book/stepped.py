"""Critical speeds of a single stepped shaft, section by section, with whatever stands at its nodes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.linear.rotor_beams import Line, Section, line, rigid_motions
from cardan.maths.linear.transfer import speeds
from cardan.texts import _

SAME = 1e-9
"""Places nearer than this share of the shaft are one node."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Node:
    """What stands at a node of a stepped shaft.

    Attributes
    ----------
    held : bool
        Whether it cannot move sideways: a pinned or fixed end, a rigid bearing.
    clamped : bool
        Whether it cannot tilt either: a fixed end.
    hinge : bool
        Whether a joint passes no moment there, so that the slope jumps.
    stiffness : float [N/m]
        Of a support.
    tilt_stiffness : float [N·m/rad]
        Of a support.
    mass : float [kg]
    diametral_inertia, polar_inertia : float [kg·m²]
        Across and about the shaft; at a hinge they go with the part before it.
    """

    held: bool = False
    clamped: bool = False
    hinge: bool = False
    stiffness: float = 0.0
    tilt_stiffness: float = 0.0
    mass: float = 0.0
    diametral_inertia: float = 0.0
    polar_inertia: float = 0.0


@dataclass(frozen=True, eq=False, kw_only=True)
class SteppedSpeeds:
    """Natural speeds of a stepped shaft in forward whirl."""

    speed: Array  # (m,) [rad/s]: lowest first; zero for each motion without bending
    rigid: int  # motions without bending
    # modes without a critical speed: parts with more inertia about the shaft than across it stiffen it faster than
    # inertia loads it, and each takes one mode away
    lost: int


def stepped_line(length: ArrayLike, section: Section, nodes: Sequence[Node]) -> Line:
    """Return a stepped shaft as a line of beams.

    length (e,) [m]: of each section; section: stiffness and inertia of each section, arrays (e,); nodes: e+1 of them.

    >>> from cardan.maths.linear.rotor_beams import round_section
    >>> tube = round_section([0.06, 0.06], 0.056, 2.1e11, 7850.0)
    >>> stepped_line([0.5, 0.7], tube, [Node(held=True), Node(hinge=True), Node()]).hinged
    (1,)
    """
    hinged = tuple(k for k, node in enumerate(nodes) if node.hinge)
    before = [k + sum(hinge < k for hinge in hinged) for k in range(len(nodes))]
    slopes = np.zeros((3, len(nodes) + len(hinged)))
    slopes[:, before] = np.asarray([(one.tilt_stiffness, one.diametral_inertia, one.polar_inertia) for one in nodes]).T
    return line(
        length,
        section.bending,
        section.mass,
        shear=section.shear,
        rotary=section.rotary,
        spring=[one.stiffness for one in nodes],
        lump=[one.mass for one in nodes],
        tilt_spring=slopes[0],
        diametral=slopes[1],
        polar=slopes[2],
        hinged=hinged,
        held=tuple(k for k, one in enumerate(nodes) if one.held),
        clamped=tuple(at for at, one in zip(before, nodes, strict=True) if one.clamped),
    )


def stepped_speeds(
    length: ArrayLike, section: Section, nodes: Sequence[Node], *, modes: int = 3, spin: float | None = None
) -> SteppedSpeeds:
    """Return the lowest natural speeds of a stepped shaft in forward whirl, exactly.

    Parameters
    ----------
    length : array (e,) [m]
        Of each section.
    section : Section
        Stiffness and inertia of each section, arrays (e,); with or without shear and rotary inertia.
    nodes : sequence of Node
        e+1 of them.
    modes : int
        How many, motions without bending among them.
    spin : float [rad/s], optional
        Ω, as fast as it whirls when not given: these are critical speeds. 0 is at rest.

    Returns
    -------
    SteppedSpeeds

    Notes
    -----
    Transfer matrices, see `cardan.maths.linear.transfer.speeds`.

    Examples
    --------
    A cantilever without shear and rotary inertia, λ = 1.8751:

    >>> from cardan.maths.linear.rotor_beams import round_section
    >>> bar = round_section(0.05, 0.0, 2.1e11, 7850.0)
    >>> found = stepped_speeds([1.2], bar, [Node(held=True, clamped=True), Node()], modes=1)
    >>> print(f"{found.speed[0]:.3f}")
    157.860
    """
    whole = stepped_line(length, section, nodes)
    losing = [one for one in nodes if one.polar_inertia > one.diametral_inertia and not one.clamped]
    return SteppedSpeeds(
        speed=speeds(whole, modes, spin=spin),
        rigid=int(rigid_motions(whole).shape[-1]),
        lost=len(losing) if spin is None else 0,
    )


def placed_speeds(
    length: ArrayLike,
    section: Section,
    *,
    springs: Sequence[tuple[float, float]] = (),
    masses: Sequence[tuple[float, float]] = (),
    supports: Sequence[tuple[float, Literal["pinned", "fixed"]]] = (),
    modes: int = 2,
) -> Array:
    """Return the lowest critical speeds of a stepped shaft with springs, masses and supports anywhere along it.

    Parameters
    ----------
    length : array (e,) [m]
        Of each section.
    section : Section
        Stiffness and inertia of each section, arrays (e,).
    springs, masses : sequences of (float, float) [m, N/m] and [m, kg]
        Places from the start of the shaft, and stiffness or mass.
    supports : sequence of (float, str) [m]
        Places, and ``pinned`` or ``fixed``.
    modes : int
        How many.

    Returns
    -------
    array (modes,) [rad/s]

    Raises
    ------
    InputError
        The shaft can move without bending.

    Examples
    --------
    >>> from cardan.maths.linear.rotor_beams import round_section
    >>> from cardan.units import rpm
    >>> tube = round_section(0.07, 0.064, 2.06e11, 7850.0)
    >>> ends = [(0.0, "pinned"), (1.5, "pinned")]
    >>> (placed_speeds([1.5], tube, masses=[(0.75, 3.0)], supports=ends) / rpm).round(1)
    array([ 3779.5, 20352.2])
    """
    start = np.concatenate(([0.0], np.cumsum(np.atleast_1d(np.asarray(length, dtype=float)))))
    wanted = np.sort([*start, *(one[0] for one in (*springs, *masses, *supports))])
    place = wanted[np.concatenate(([True], np.diff(wanted) > SAME * start[-1]))]
    nodes = []
    for k in range(len(place)):
        kinds = {kind for x, kind in supports if _at(place, x) == k}
        nodes.append(
            Node(
                held=bool(kinds),
                clamped="fixed" in kinds,
                stiffness=sum(size for x, size in springs if _at(place, x) == k),
                mass=sum(size for x, size in masses if _at(place, x) == k),
            )
        )
    within = np.searchsorted(start[1:-1], 0.5 * (place[1:] + place[:-1]), side="right")
    spread = Section(*(np.broadcast_to(part, start[1:].shape)[within] for part in section))
    whole = stepped_line(np.diff(place), spread, nodes)
    if rigid_motions(whole).shape[-1]:
        text = _("the shaft can move without bending: hold it at two places, or fix it at one")
        raise refuse("supports", text, "singular")
    return speeds(whole, modes)


def _at(place: Array, x: float) -> int:
    return int(np.argmin(np.abs(place - x)))
