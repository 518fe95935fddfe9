"""A drive straightened out as a line of beams: what bends, what is held, and which part each of it belongs to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.drive.body import Piece, body_length, pieces
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints import Joint
from cardan.drive.models.machine_held import tables_proposed
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.drive.yokes import with_yokes
from cardan.errors import InputError, Problem, check, refuse
from cardan.formulas.crack_compliance import crack_compliance
from cardan.maths.arrays import Array
from cardan.maths.linear.rotor_beams import Line, layout, line, rigid_motions, round_section
from cardan.texts import _
from cardan.units import mm

SAME = 2e-4
"""Places nearer than this share of a shaft are one: a beam between them would only cost digits."""


SHORT = 2e-3
"""Length of the beam behind a crack, over that of its shaft."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WhirlLine:
    """The shafts of a drive end to end, straightened out."""

    line: Line  # its beams
    place: Array  # (nodes,) [m]: where its nodes are, from joint 1 along the power flow
    shaft: Array  # array of int (beams,): number of the shaft that each beam belongs to
    joint_node: dict[int, int]  # number of a joint -> its node, where the joint is part of the line
    # number of a support -> its node, where it holds a shaft of the line sideways or against tilting
    support_node: dict[int, int]
    support_slope: dict[int, int]  # number of a support -> slope of its shaft there
    # numbers of the end joints that count as held by the machine, because their shaft is not part of the line
    held: tuple[int, ...]
    assumed: tuple[str, ...]  # paths of what the drive does not say and the answers assume


def whirl_line(drive: Drive) -> WhirlLine:
    """Return the line of beams that the shafts of a drive are.

    drive: with a body and a length for each shaft between two joints, and supports.
    Each shaft is taken along its own axis, as if the joints were straight: bends of usual size change the whirl by
    their squares. A joint is a hinge with the mass of its cross, half of whose inertia goes with each shaft. An end
    shaft is part of the line if it has a body and a support; else the machine holds its joint.

    >>> from cardan import example
    >>> found = whirl_line(example("truck-supports"))
    >>> found.held, sorted(found.joint_node), found.shaft.tolist()
    ((1, 3), [1, 2, 3], [2, 2, 3])
    """
    drive = with_yokes(drive)
    joints = len(drive.joints)
    known = known_lengths(drive)
    part = [shaft for shaft in drive.shafts if 1 < shaft.number <= joints or _stands(drive, shaft)]
    check([*_missing(drive, part, known), *_beyond(drive, part, known)])
    rows = [_row(drive, shaft, known.get(shaft.number)) for shaft in part]
    held = tuple(k for k, shaft in ((1, drive.shafts[0]), (joints, drive.shafts[-1])) if shaft not in part)
    found = _joined(drive, rows, tuple(dict.fromkeys(held)))
    _check_held(drive, found)
    return found


def _stands(drive: Drive, shaft: Shaft) -> bool:
    """Tell whether an end shaft is part of the line: it has a body, and something holds it."""
    return shaft.has_body and any(_holds(one) and one.shaft == shaft.number for one in drive.supports)


def _holds(support: Support) -> bool:
    return support.radial or support.tilt


def _missing(drive: Drive, part: list[Shaft], known: dict[int, float]) -> Iterator[Problem]:
    """Yield what the shafts of the line lack."""
    if not part:
        text = _("missing; critical speeds follow from the body of a shaft and from what holds it")
        for shaft in drive.shafts:
            if not shaft.has_body:
                yield Problem(f"shafts[{shaft.number - 1}].outer", text)
        if any(shaft.has_body for shaft in drive.shafts):
            yield Problem("supports", _("missing; no shaft with a body is held, so none has a critical speed"))
    for shaft in part:
        path = f"shafts[{shaft.number - 1}]"
        if not shaft.has_body:
            text = _("missing; give the outer diameter of shaft {number}, or its segments")
            yield Problem(f"{path}.outer", text.format(number=shaft.number))
        if 1 < shaft.number <= len(drive.joints) and shaft.number not in known:
            yield Problem(f"{path}.length", _("missing; critical speeds fall with the square of the length"))


def _beyond(drive: Drive, part: list[Shaft], known: dict[int, float]) -> Iterator[Problem]:
    """Yield supports and parts of end shafts that lie beyond the body."""
    for shaft in part:
        length = body_length(shaft, known.get(shaft.number))
        if shaft.number in known or length is None:
            continue
        text = _("lies beyond the end of its shaft, whose body is {length:.6g} mm long")
        message = text.format(length=1e3 * length)
        reach = length * (1.0 + SAME)
        for k, support in enumerate(drive.supports):
            if support.shaft == shaft.number and abs(support.position) > reach:
                yield Problem(f"supports[{k}].position", message)
        for k, lump in enumerate(shaft.masses):
            if abs(lump.position) > reach:
                yield Problem(f"shafts[{shaft.number - 1}].masses[{k}].position", message)


MASSLESS = 1e-6
"""Share of its own mass that a body keeps where a drive says that it has none: something has to whirl."""


@dataclass(frozen=True, eq=False)
class _Row:
    """One shaft: its nodes from its beginning on, its beams, and what stands at its nodes."""

    number: int
    place: Array
    sections: Array
    lumps: tuple[tuple[int, float, float, float], ...]
    supports: tuple[tuple[int, int], ...]
    assumed: tuple[str, ...]


def _row(drive: Drive, shaft: Shaft, known: float | None) -> _Row:
    """Return the beams of one shaft."""
    held = [(k, one.position) for k, one in enumerate(drive.supports, 1) if one.shaft == shaft.number and _holds(one)]
    length = body_length(shaft, known)
    assumed: tuple[str, ...] = ()
    if length is None:
        length = max(abs(position) for _k, position in held)
        length = max([length, *(abs(lump.position) for lump in shaft.masses)])
        # Where points give the geometry, only stretches can say how long an end shaft is.
        assumed = (f"shafts[{shaft.number - 1}].{'segments' if drive.form == 'points' else 'length'}",)
    origin = length if shaft.number == 1 else 0.0
    body = pieces(shaft, length)
    # The beam behind a crack turns with its jump but for its inertia: a short one.
    cracks = [crack_place(shaft, length) + origin + more * SHORT * length for more in (0, 1)] if shaft.crack else []
    wanted = [0.0, length, *(one.start for one in body)]
    wanted += cracks + [position + origin for _k, position in held] + [lump.position + origin for lump in shaft.masses]
    place = _apart(wanted, length)

    def node(position: float) -> int:
        return int(np.argmin(np.abs(place - position)))

    # A mass that is given stands over that of the body, and is spread as the body is.
    heavy = 1.0 if shaft.mass is None else max(shaft.mass / sum(one.mass for one in body), MASSLESS)
    sections = []
    for x in 0.5 * (place[1:] + place[:-1]):
        one = [piece for piece in body if piece.start <= x][-1]
        steel = one.material
        sections.append(
            round_section(
                one.outer,
                one.inner,
                steel.youngs,
                heavy * steel.density,
                poisson=steel.poisson,
                shear_modulus=steel.shear_modulus,
            )
        )
    return _Row(
        number=shaft.number,
        place=place,
        sections=np.asarray(sections),
        lumps=tuple(
            (node(one.position + origin), one.mass, one.diametral_inertia, one.polar_inertia) for one in shaft.masses
        ),
        supports=tuple((k, node(position + origin)) for k, position in held),
        assumed=assumed,
    )


def crack_place(shaft: Shaft, length: float) -> float:
    """Return where the crack of a shaft is, from joint 1 on shaft 1, else from the joint before [m]."""
    given = shaft.crack.position if shaft.crack is not None else None
    return (-0.5 if shaft.number == 1 else 0.5) * length if given is None else given


def cracked_piece(shaft: Shaft, length: float) -> Piece:
    """Return the piece of the body in which the crack of a shaft is, at a shoulder the one that bends more easily."""
    place = crack_place(shaft, length)
    x, near = place + (length if shaft.number == 1 else 0.0), SAME * length
    if not -near <= x <= length + near:
        text = _("{position:.6g} mm is outside the body of shaft {number}, {length:.6g} mm long")
        said = text.format(position=place / mm, number=shaft.number, length=length / mm)
        raise refuse(f"shafts[{shaft.number - 1}].crack.position", said, "out_of_range")
    touched = [one for one in pieces(shaft, length) if one.start - near <= x <= one.start + one.length + near]
    return min(touched, key=lambda one: one.material.youngs * one.second_moment)


def crack_hinge(shaft: Shaft, length: float) -> tuple[float, float]:
    """Return the compliance of an open crack along and across its direction [rad/(N·m)].

    By its depth; by its losses as of a crack amid a shaft between two joints that takes them of its stiffness there.
    """
    crack = shaft.crack
    assert crack is not None
    piece = cracked_piece(shaft, length)
    youngs = piece.material.youngs
    if crack.depth_ratio is not None:
        try:
            found = crack_compliance(
                0.5 * piece.outer, crack.depth_ratio, youngs, inner=0.5 * piece.inner, poisson=piece.material.poisson
            )
        except InputError as error:
            raise error.renamed(lambda field: f"shafts[{shaft.number - 1}].crack.{field}") from error
        return float(found.along), float(found.across)
    along, across = (loss / (1.0 - loss) * length / (3.0 * youngs * piece.second_moment) for loss in crack.losses)
    return along, across


def _apart(wanted: list[float], length: float) -> Array:
    """Return places in rising order, those that nearly coincide as one, the ends as they are."""
    found: list[float] = [0.0]
    for place in sorted(min(one, length) for one in wanted):
        if place - found[-1] > SAME * length:
            found.append(place)
    found[-1] = length
    return np.asarray(found)


def _joined(drive: Drive, rows: list[_Row], held_joints: tuple[int, ...]) -> WhirlLine:
    """Return the shafts as one line, hinged where two of them meet."""
    start = np.cumsum([0, *(len(row.place) - 1 for row in rows)])
    hinged = tuple(int(node) for node in start[1:-1])
    nodes = int(start[-1]) + 1
    slopes = nodes + len(hinged)
    origin = -rows[0].place[-1] if rows[0].number == 1 else 0.0
    ends = np.cumsum([origin, *(row.place[-1] for row in rows)])
    place = np.concatenate([[ends[0]], *(row.place[1:] + end for row, end in zip(rows, ends, strict=False))])
    spring, lump = np.zeros(nodes), np.zeros(nodes)
    tilt_spring, diametral, polar = np.zeros(slopes), np.zeros(slopes), np.zeros(slopes)
    joint_node: dict[int, int] = {}
    support_node: dict[int, int] = {}
    support_slope: dict[int, int] = {}
    held: set[int] = set()
    clamped: set[int] = set()
    for index, (row, first) in enumerate(zip(rows, start, strict=False)):
        for local, mass, across, about in row.lumps:
            slope = int(first) + local + index
            lump[first + local] += mass
            diametral[slope] += across
            polar[slope] += about
        for number, local in row.supports:
            node, slope, support = int(first) + local, int(first) + local + index, drive.supports[number - 1]
            support_node[number], support_slope[number] = node, slope
            if support.radial and support.stiffness is None:
                held.add(node)
            elif support.radial:
                spring[node] += support.stiffness
            if support.tilt and support.tilt_stiffness is None:
                clamped.add(slope)
            elif support.tilt:
                tilt_spring[slope] += support.tilt_stiffness
        last = int(first) + len(row.place) - 1
        for number, node, slope in ((row.number - 1, int(first), int(first) + index), (row.number, last, last + index)):
            if 1 <= number <= len(drive.joints):
                across, about = _half_cross(drive.joints[number - 1])
                diametral[slope] += across
                polar[slope] += about
                joint_node[number] = node
    for number, node in joint_node.items():
        cross = drive.joints[number - 1].cross
        lump[node] += cross.mass if cross else 0.0
        if number in held_joints:
            held.add(node)
    bending, shear, mass, rotary = np.concatenate([row.sections for row in rows]).T
    return WhirlLine(
        line=line(
            np.diff(place),
            bending,
            mass,
            shear=shear,
            rotary=rotary,
            spring=spring,
            lump=lump,
            tilt_spring=tilt_spring,
            diametral=diametral,
            polar=polar,
            hinged=hinged,
            held=tuple(held),
            clamped=tuple(clamped),
        ),
        place=place,
        shaft=np.repeat([row.number for row in rows], [len(row.place) - 1 for row in rows]),
        joint_node=joint_node,
        support_node=support_node,
        support_slope=support_slope,
        held=held_joints,
        assumed=tuple(path for row in rows for path in row.assumed),
    )


def _half_cross(joint: Joint) -> tuple[float, float]:
    """Return what inertia of a cross goes with each of its shafts: across, on the mean over a turn, and about."""
    if joint.cross is None:
        return 0.0, 0.0
    one, other, about = joint.cross.inertia
    return 0.25 * (one + other), 0.5 * about


def _check_held(drive: Drive, found: WhirlLine) -> None:
    """Refuse shafts that can move without bending."""
    motion = rigid_motions(found.line)
    if not motion.shape[-1]:
        return
    at = layout(found.line)
    moved = np.zeros(len(at.deflection) + len(at.slope))
    moved[at.free] = np.max(np.abs(motion), axis=-1)
    node = moved[at.deflection] > 1e-9 * np.max(moved[at.deflection])
    loose = sorted({int(n) for n in found.shaft[node[:-1] | node[1:]]})
    text = _("shaft {which} can pivot freely: hold it by one more support")
    if len(loose) > 1:
        text = _("shafts {which} can pivot freely: hold one of them by a support, as a centre bearing does")
    message = text.format(which=_(" and ").join(str(number) for number in loose))
    with tables_proposed(drive):
        check([Problem("supports", message if drive.supports else _("missing; {why}").format(why=message))])
