"""What answers take for granted where a drive does not say it: masses of yokes, what holds its ends and its joints."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.answer import Remark
from cardan.answers.quantity import Joined, Written, say
from cardan.drive.drive import Drive
from cardan.texts import _, plural


def yokes_estimated(drive: Drive) -> Iterator[Remark]:
    """Yield that yokes and crosses weigh what their geometry says, where nothing else does."""
    which = [str(i) for i, joint in enumerate(drive.joints, 1) if joint.estimable]
    if which:
        text = plural(
            "The mass of joint {which} is estimated from its span and journals; mass_kg or size of the joint says it.",
            "The masses of joints {which} are estimated from their spans and journals; mass_kg or size of a joint says "
            "it.",
            len(which),
        )
        yield Remark(text=say(text, which=Joined(which, last=_(" and "))), code="estimated_mass")


def held_by_machines(machines: tuple[int, ...]) -> Iterator[Remark]:
    """Yield that machines hold the end shafts on which no support stands."""
    if machines:
        text = plural(
            "Shaft {which} is held by its machine, at the joint; {key} on it would tell its bearings apart.",
            "Shafts {which} are held by their machines, at the joints; {key} on them would tell their bearings apart.",
            len(machines),
        )
        which = Joined([str(number) for number in machines], last=_(" and "))
        yield Remark(text=say(text, which=which, key=Written("[[supports]]", _("supports"))), code="held_by_machines")


def centred_by_housings(drive: Drive) -> Iterator[Remark]:
    """Yield which joints count as if a housing centred their shafts."""
    if centred := [str(i) for i, joint in enumerate(drive.joints, start=1) if joint.centred]:
        text = plural(
            "Joint {which} counts with its couple alone, as where a housing centres both shafts; between rigid "
            "bearings its parts would push the shafts aside too.",
            "Joints {which} count with their couples alone, as where a housing centres both shafts; between rigid "
            "bearings their parts would push the shafts aside too.",
            len(centred),
        )
        yield Remark(text=say(text, which=Joined(centred, last=_(" and "))), code="centred")
