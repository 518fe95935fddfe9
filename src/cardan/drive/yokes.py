"""What the joints of a drive weigh, as given or by their geometry: their yokes as parts that the shafts carry."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

from cardan.maths.kernel.meshes import MassProperties, joined, mass_properties

from .body import body_length
from .cross import Cross
from .drive import Drive
from .fields.parts import known_lengths
from .joint_parts import Needles
from .joints import Joint
from .joints.common.site import joint_size
from .material import Material
from .shaft import PointMass, Shaft
from .shapes import caps, fork

BESIDE = 1.5  # spans of a joint within which a part that a shaft carries is taken for its yoke


OPENS = math.radians(25.0)
"""Joint angle for which an estimated yoke leaves room, where its rating says none."""

BARS = 1.4
"""Thickness of the bars of an estimated cross over the diameter of its journals."""


def estimated(joint: Joint) -> Joint:
    """Return a joint with the mass that its geometry gives yokes and cross, where it says none itself."""
    if not joint.estimable or joint.cross is None:
        return joint
    cross = joint.cross if joint.cross.mass else solid_cross(joint.cross)
    return replace(joint, cross=cross, mass=cross.mass + 2.0 * _density(joint) * solid_yoke(joint).mass)


def solid_cross(cross: Cross) -> Cross:
    """Return a cross with mass and inertia of a solid one: two bars at right angles that end in its journals.

    cross: with span d, journals d_j thick and l_j long; bars 1.4 d_j thick reach to the roots of the journals. Two
    cylinders 2R thick at right angles share 16 R³/3, which counts once.
    """
    span, thick, length = float(cross.span or 0.0), float(cross.journal or 0.0), float(cross.journal_length or 0.0)
    density = (cross.material or Material()).density
    arm = 0.5 * length if cross.bending_arm is None else cross.bending_arm
    root, bar, pin, bore = max(0.5 * span - arm, 0.0), 0.5 * BARS * thick, 0.5 * thick, 0.5 * cross.journal_bore
    volume = 2.0 * math.pi * bar**2 * root
    each = density * max(volume - 0.5 * 16.0 / 3.0 * bar**3, 0.5 * volume)
    journal = density * math.pi * (pin**2 - bore**2) * length
    at = root + 0.5 * length
    across = 2.0 * journal * ((3.0 * (pin**2 + bore**2) + length**2) / 12.0 + at**2)
    across += each * (3.0 * bar**2 + (2.0 * root) ** 2) / 12.0
    along = journal * (pin**2 + bore**2) + 0.5 * each * bar**2
    inertia = (across + along, across + along, 2.0 * across)
    return replace(cross, mass=2.0 * each + 4.0 * journal, inertia=inertia if not any(cross.inertia) else cross.inertia)


def solid_yoke(joint: Joint) -> MassProperties:
    """Return what a yoke with its bearing caps weighs at a density of 1 kg/m³: that as it is drawn, its hub along x."""
    rating = joint.rating
    most = rating.max_joint_angle if rating is not None and rating.max_joint_angle is not None else OPENS
    return _solid_yoke(joint.span, joint.cross, joint.needles, most)


@lru_cache(maxsize=256)
def _solid_yoke(span: float | None, cross: Cross | None, needles: Needles | None, joint_angle: float) -> MassProperties:
    size = joint_size(span, cross, needles, joint_angle)
    body = 0.66 * size.radius
    made = fork(size.radius, size.ear, size.lug, size.cap, size.cavity, size.reach, body)
    return mass_properties(joined(made, caps(size.radius, size.ear, size.cap)))


def _density(joint: Joint) -> float:
    return (joint.yoke.material if joint.yoke is not None and joint.yoke.material else Material()).density


def yoke_mass(joint: Joint) -> float:
    """Return the mass of one yoke of a joint [kg]: half of the joint without its cross; 0 where it is not known."""
    joint = estimated(joint)
    cross = joint.cross.mass if joint.cross is not None else 0.0
    return 0.0 if joint.mass is None else max(0.5 * (joint.mass - cross), 0.0)


def with_yokes(drive: Drive, *, at_joint: bool = False) -> Drive:
    """Return a drive whose shafts carry the yokes of its joints.

    drive: with joints that say what they weigh, by their size or their ``mass``, or how large they are.
    at_joint: put them at the joints themselves, as for torsion: a yoke hardly twists.
    Returns Drive: a shaft whose whole mass is given, and one that carries a part of its own beside the joint, stay as
    they are; one whose inertia is given gets mass alone.
    A yoke counts as a solid cylinder as thick and as long as the span d of its joint, half of it away from the centre:
    m d²/8 about the shaft and m (d²/16 + d²/12) across; one whose mass follows from geometry as the body drawn of it.
    The joints have their estimated masses, crosses included.
    """
    known, last = known_lengths(drive), len(drive.shafts)
    joints = drive.joints
    shafts = []
    for shaft in drive.shafts:
        length = body_length(shaft, known.get(shaft.number))
        here = [_yoke(shaft, joints[shaft.number - 2], 0.0, 1.0, length, at_joint)] if shaft.number > 1 else []
        if shaft.number == 1:
            here.append(_yoke(shaft, joints[0], 0.0, -1.0, length, at_joint))
        elif shaft.number < last and length is not None:
            here.append(_yoke(shaft, joints[shaft.number - 1], length, -1.0, length, at_joint))
        added = tuple(one for one in here if one is not None)
        shafts.append(replace(shaft, masses=(*shaft.masses, *added)) if added else shaft)
    return replace(drive, shafts=tuple(shafts), joints=tuple(map(estimated, joints)))


def unweighed(drive: Drive) -> tuple[int, ...]:
    """Return the numbers of the joints of which a shaft with a body carries no yoke."""
    known, found = known_lengths(drive), set[int]()
    for shaft in drive.shafts:
        ends = ((shaft.number - 1, 0.0), (shaft.number, 0.0 if shaft.number == 1 else known.get(shaft.number)))
        for number, place in ends:
            if not shaft.has_body or not 1 <= number <= len(drive.joints):
                continue
            joint = drive.joints[number - 1]
            if not yoke_mass(joint) and not _carries(shaft, joint, place):
                found.add(number)
    return tuple(sorted(found))


def _carries(shaft: Shaft, joint: Joint, place: float | None) -> bool:
    """Tell whether the mass of a shaft says its yoke at a joint: as a whole, or by a part beside the joint."""
    reach = BESIDE * (joint.span or 0.1)
    return shaft.mass is not None or any(
        place is not None and abs(one.position - place) <= reach for one in shaft.masses
    )


def _yoke(
    shaft: Shaft, joint: Joint, place: float, way: float, length: float | None, at_joint: bool
) -> PointMass | None:
    """Return the yoke of a joint on a shaft, None where the shaft says what it weighs there, or nothing does."""
    mass, span = yoke_mass(joint), joint.span or 0.0
    if not mass or _carries(shaft, joint, place):
        return None
    inset, turning, across = 0.5 * span, mass * span**2 / 8.0, mass * span**2 * (1.0 / 16.0 + 1.0 / 12.0)
    if joint.estimable:
        solid = solid_yoke(joint)
        inset = float(solid.centre[0])
        turning, one, two = (mass / solid.mass * float(value) for value in solid.inertia.diagonal())
        across = 0.5 * (one + two)
    inset = 0.0 if at_joint else min(inset, span if length is None else 0.5 * length)
    return PointMass(
        position=place + way * inset,
        mass=mass,
        polar_inertia=0.0 if shaft.inertia is not None else turning,
        diametral_inertia=0.0 if shaft.transverse_inertia is not None else across,
    )
