"""What the joints of a drive weigh: their yokes as parts that the shafts carry."""

from __future__ import annotations

from dataclasses import replace

from .body import body_length
from .drive import Drive
from .fields.parts import known_lengths
from .joints import Joint
from .shaft import PointMass, Shaft

BESIDE = 1.5  # spans of a joint within which a part that a shaft carries is taken for its yoke


def yoke_mass(joint: Joint) -> float:
    """Return the mass of one yoke of a joint [kg]: half of the joint without its cross; 0 where not given."""
    cross = joint.cross.mass if joint.cross is not None else 0.0
    return 0.0 if joint.mass is None else max(0.5 * (joint.mass - cross), 0.0)


def with_yokes(drive: Drive, *, at_joint: bool = False) -> Drive:
    """Return a drive whose shafts carry the yokes of its joints.

    drive: with joints that say what they weigh, by their size or their ``mass``.
    at_joint: put them at the joints themselves, as for torsion: a yoke hardly twists.
    Returns Drive: a shaft whose whole mass is given, and one that carries a part of its own beside the joint, stay as
    they are; one whose inertia is given gets mass alone.
    A yoke counts as a solid cylinder as thick and as long as the span d of its joint, half of it away from the centre:
    m d²/8 about the shaft and m (d²/16 + d²/12) across.
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
    return replace(drive, shafts=tuple(shafts))


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
    inset = 0.0 if at_joint else min(0.5 * span, span if length is None else 0.5 * length)
    turning = 0.0 if shaft.inertia is not None else mass * span**2 / 8.0
    across = 0.0 if shaft.transverse_inertia is not None else mass * span**2 * (1.0 / 16.0 + 1.0 / 12.0)
    return PointMass(position=place + way * inset, mass=mass, polar_inertia=turning, diametral_inertia=across)
