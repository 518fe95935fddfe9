"""The report of a drive with joints that turn by laws of their own, without what a chain of Hooke joints would tell.

Motion is followed from joint to joint and its extremes are seen over a turn; there is no single joint that the drive
amounts to, and no polygon of yoke angles.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.answer import Tone
from cardan.answers.quantity import Quantity, say
from cardan.catalogue import Catalogue
from cardan.drive.bodies.solids import Solids, solids
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import Geometry, geometry
from cardan.maths.arrays import Array
from cardan.questions.motion.equivalence import SPECK
from cardan.questions.motion.joint_by_joint import followed as by_laws
from cardan.questions.motion.kinds import kind_name
from cardan.questions.motion.motion import Motion, motion
from cardan.questions.motion.swing import Swing, swing
from cardan.texts import _, plural
from cardan.version import VERSION

from .block import Listing, Page, Points, Words
from .summary import steep_joints


@dataclass(frozen=True, eq=False, kw_only=True)
class Followed:
    """A drive and what is known of its motion; the names are those of `cardan.report.subject.Subject`."""

    drive: Drive
    place: Geometry
    seen: Solids
    found: Motion
    whole: Swing
    phase: Array
    complete: bool = True
    mixed: bool = True
    known: Catalogue | None = None

    @property
    def joint_angle(self) -> Array:
        """Joint angle of every joint, array (n) [rad]."""
        return np.asarray(self.place.joint_angle)

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.drive.joints)


def asked_by_laws(drive: Drive, duty: Duty | None) -> Followed:
    """Ask what can be asked about a drive with joints that turn by laws of their own."""
    whole = drive if duty is None else replace(drive, duty=duty)
    return Followed(
        drive=whole,
        place=geometry(whole),
        seen=solids(whole),
        found=motion(whole),
        whole=swing(whole),
        phase=by_laws(whole, np.zeros(1))["yoke_rotation"][:, 0],
    )


def judgement_by_laws(on: Followed, pages: Sequence[Page]) -> Words:
    """Return the one sentence the reader came for."""
    share = float(on.whole.speed_fluctuation[-1])
    said = {"name": on.drive.name or _("The drive"), "share": Quantity(share, "share", 3)}
    text = _("{name} has {share} speed fluctuation.")
    if share < SPECK:
        text = _("{name} is uniform, but for {share} that nobody notices.")
    alarms = [alarm.tone for page in pages for alarm in page.alarms]
    tone: Tone = "good" if share < SPECK and "warning" not in alarms else "warning"
    if "failed" in alarms or any(steep_joints(on.drive, on.joint_angle)):
        tone = "failed"
    return Words(text=say(text, **said), tone=tone)


def warnings_by_laws(on: Followed, pages: Sequence[Page]) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    yield from (alarm for page in pages for alarm in page.alarms)
    yield from steep_joints(on.drive, on.joint_angle)


def changes_by_laws(on: Followed) -> Words:
    """Return what would make the drive even."""
    if float(on.whole.speed_fluctuation[-1]) < SPECK:
        return Words(text=_("Nothing needs to be changed for a uniform output."))
    own = [str(i) for i, joint in enumerate(on.drive.joints, 1) if not joint.has_map]
    text = plural(
        "Joint {own} is uniform where the parts of both its shafts are alike.",
        "Joints {own} are uniform where the parts of both their shafts are alike.",
        len(own),
    ).format(own=", ".join(own))
    if len(own) < on.joints:
        text += " " + _("What the other joints add, yoke angles may undo.")
    return Words(text=text)


def method_by_laws(on: Followed, source_text: str | None) -> Page:
    """Return the page of the method."""
    own = [f"{k}: {kind_name(joint)}" for k, joint in enumerate(on.drive.joints, start=1)]
    blocks: list[Words | Points | Listing] = [
        Words(
            text=_(
                "Every joint turns its driven shaft by φ′ = T(φ), φ from the plane of its shafts: a Möbius map of the "
                "circle, or the law of its contacts. Angles, ratios and accelerations follow from joint to joint by "
                "the chain rule."
            )
        ),
        Points(title=_("Joints"), items=own),
    ]
    if source_text is not None:
        blocks.append(Listing(title=_("Input file"), text=source_text))
    answer = _("Calculated by cardan {version}.").format(version=VERSION)
    return Page(name="method", title=_("Method and evidence"), answer=answer, blocks=blocks)
