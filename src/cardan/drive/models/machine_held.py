"""Which shafts of a drive its machines hold, and the supports that are missing, as tables for its file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths, spline_place
from cardan.drive.support import Support
from cardan.errors import InputError, Problem
from cardan.texts import _

from .geometry import geometry

NEAR = 0.9  # share of its length at which a shaft is proposed to have its centre bearing: before its second joint
SAME = 1e-9  # share of a length up to which two places are one
REACH = 0.1  # distance [m] of the proposed bearings of an end shaft from its joint and from each other


def balls_of(drive: Drive, *, pivots: bool = False) -> dict[int, float]:
    """Return the joints, from 0, with a sliding ball that holds their driven shaft, and how far behind them [m].

    None where supports stand on that shaft, where the next joint stands in the ball's place and holds it, or where it
    is not known how long the shafts are.
    pivots: whatever else holds such a shaft in a place of its own is among them.
    """
    stood = {one.shaft for one in drive.supports}
    places = {i: joint.held(None) if pivots else joint.ball for i, joint in enumerate(drive.joints)}
    found = {i: far for i, far in places.items() if far is not None and i + 2 not in stood}
    if not found or len(known_lengths(drive)) < len(drive.joints) - 1:
        return {}
    length = geometry(drive).length[:-1]
    return {i: far for i, far in found.items() if i + 1 >= len(length) or abs(far / length[i + 1] - 1.0) > SAME}


def machines_of(drive: Drive) -> tuple[int, ...]:
    """Return the numbers of the end shafts that their machines hold, as no support of the drive stands on them."""
    stood = {one.shaft for one in drive.supports} | {i + 2 for i in balls_of(drive)}
    return tuple(number for number in (1, len(drive.shafts)) if number not in stood) if stood else ()


def machine_held(drive: Drive) -> Drive:
    """Return a drive with supports whose end shafts without any are held by their machines, at the joint.

    The sliding ball that a joint brings along for its driven shaft is a support too.

    Returns Drive: a machine holds its shaft sideways and against tilting; lengthwise too where no other axial support
    holds the part of the drive up to the next spline or joint that slides.
    """
    made = list(drive.supports)
    for i, far in balls_of(drive).items():
        name = _("ball behind joint {number}").format(number=i + 1)
        made.append(Support(name=name, shaft=i + 2, position=far, bore=1e-3, friction=0.0))
    for number in machines_of(drive):
        axial = not any(one.axial and segment_of(drive, one) == _segment_of_end(drive, number) for one in made)
        place = 0.0
        if drive.shafts[number - 1].spline is not None:  # beyond it, as it slides on the shaft of the machine
            place = 2.0 * spline_place(drive, number, float(geometry(drive).length[number - 1]))
        one = Support(name=_("machine"), shaft=number, position=place, axial=axial, tilt=True, bore=1e-3, friction=0.0)
        made.append(one)
    return replace(drive, supports=tuple(made))


def _segment_of_end(drive: Drive, shaft: int) -> int:
    """Return in which part of the drive, cut where it slides, an end shaft is."""
    return 0 if shaft == 1 else cuts_before(drive, len(drive.shafts)) + (drive.shafts[-1].spline is not None)


def cuts_before(drive: Drive, shaft: int) -> int:
    """Return how many splines and joints that slide lie before a shaft."""
    splines = sum(one.spline is not None for one in drive.shafts[: shaft - 1])
    return splines + sum(one.slides or one.loose for one in drive.joints[: shaft - 1])


def _beginnings(drive: Drive) -> list[tuple[int, float]]:
    """Return behind every spline and joint that slides a shaft of the part that begins there, and a share of it."""
    found = []
    for shaft in drive.shafts:
        before = drive.joints[shaft.number - 2] if shaft.number > 1 else None
        splined = shaft.spline is not None
        found += [(shaft.number, REACH if splined else NEAR)] if before and (before.slides or before.loose) else []
        found += [(shaft.number, NEAR)] if splined else []
    return found


def segment_of(drive: Drive, support: Support) -> int:
    """Return in which part of the drive, cut where it slides, a support stands."""
    before = cuts_before(drive, support.shaft)
    if drive.shafts[support.shaft - 1].spline is None:
        return before
    cut = spline_place(drive, support.shaft, known_lengths(drive).get(support.shaft, 0.0))
    return before + int(support.position > cut)


def proposed(drive: Drive) -> tuple[Support, ...]:
    """Return supports that would hold a drive just enough, beside those it has.

    Across, n joints need n + 2 bearings: two on each end shaft, one on a shaft between, before the joint behind it; one
    that holds the slope counts twice. Each part of the drive between sliding splines needs one axial support.
    """
    known, count, found = known_lengths(drive), len(drive.shafts), list[Support]()
    across = [one.shaft for one in machine_held(drive).supports for hold in (one.radial, one.tilt) if hold]
    need = len(drive.joints) + 2 - len(across)
    spare = len(drive.joints) - 2 - sum(1 < shaft < count for shaft in across)
    for number in range(2, count):
        if spare > 0 and number not in across:
            place = round(NEAR * known.get(number, 1.0), 3)
            found.append(Support(name=_("centre bearing"), shaft=number, position=place))
            spare, need = spare - 1, need - 1
    for segment, (number, share) in enumerate(_beginnings(drive)[:-1], 1):
        if any(one.axial and segment_of(drive, one) == segment for one in drive.supports):
            continue
        inside = [k for k, one in enumerate(found) if segment_of(drive, one) == segment]
        if inside:
            found[inside[0]] = replace(found[inside[0]], axial=True)
        else:
            place = round(share * known.get(number, 1.0), 3)
            found.append(Support(shaft=number, position=place, radial=False, axial=True))
    for number, way in ((1, -1.0), (count, 1.0)):
        own = [one for one in drive.supports if one.shaft == number]
        if drive.supports and not own:
            continue
        for k in range(max(0, min(need, 2 - across.count(number)))):
            place = max((abs(one.position) for one in own), default=0.0) + (k + 1) * REACH
            found.append(Support(shaft=number, position=way * round(place, 3)))
            need -= 1
        segment = _segment_of_end(drive, number)
        if any(one.axial and segment_of(drive, one) == segment for one in (*drive.supports, *found)):
            continue
        ends = [k for k, one in enumerate(found) if one.shaft == number]
        if ends:
            found[ends[0]] = replace(found[ends[0]], axial=True)
        elif own:
            found.append(Support(shaft=number, position=own[0].position, radial=False, axial=True))
    return tuple(sorted(found, key=lambda one: (one.shaft, abs(one.position))))


def tables_of(supports: Iterable[Support]) -> str:
    """Return supports as tables to paste into a drive file."""
    texts = []
    for one in supports:
        lines = ["[[supports]]", f'name = "{one.name}"' if one.name else "", f"shaft = {one.shaft}"]
        lines += [f"position_mm = {1e3 * one.position:.6g}", "" if one.radial else "radial = false"]
        texts.append("\n".join(line for line in [*lines, "axial = true" if one.axial else ""] if line))
    return "\n\n".join(texts)


@contextmanager
def tables_proposed(drive: Drive) -> Iterator[None]:
    """Give an error about the supports the tables that would hold the drive, and what is no table its name."""
    try:
        yield
    except InputError as error:
        tables = tables_of(proposed(drive))
        told = [_of_a_table(drive, one) for one in error.problems]
        named = [replace(one, paste=tables) if one.field == "supports" else one for one in told]
        raise InputError(named, where=error.where) from None


def _of_a_table(drive: Drive, problem: Problem) -> Problem:
    """Return a problem by name where it is with a machine or a ball that holds a shaft without a table of its own."""
    for k, one in enumerate(machine_held(drive).supports):
        if k >= len(drive.supports) and problem.field == f"supports[{k}].stiffness":
            text = _("{name}: stiffness {problem}").format(name=one.name, problem=problem.message)
            return replace(problem, field="supports", message=text)
    return problem
