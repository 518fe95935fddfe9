"""The report of a drive with joints that turn by laws of their own, without what a chain of Hooke joints would tell.

Motion is followed from joint to joint and its extremes are seen over a turn; there is no single joint that the drive
amounts to, and no polygon of yoke angles.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.catalogue import Catalogue
from cardan.drive.bodies.solids import Solids, solids
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.laws import NEGLIGIBLE, has_map, lawless, left_over
from cardan.errors import InputError
from cardan.figures.wording import fixed, percent, significant
from cardan.maths.arrays import Array
from cardan.questions.forces.swing import Swing, swing
from cardan.questions.motion.equivalence import SPECK, SYNCHRONOUS
from cardan.questions.motion.figures.motion import motion_figure
from cardan.questions.motion.joint_by_joint import followed as by_laws
from cardan.questions.motion.kinds import kind_name, too_steep
from cardan.questions.motion.motion import Motion, motion
from cardan.questions.phases.phases import phases
from cardan.questions.phases.setting import YokeSetting
from cardan.texts import _, plural
from cardan.units import deg, rpm

from .balance import refused
from .block import (
    Cell,
    Column,
    Listing,
    Page,
    Picture,
    Points,
    Table,
    Words,
    key,
    number,
    verdict_columns,
    words,
)
from .turning import extremes_table

ORDERS = 4
"""Orders of the angle error that are listed."""


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
    def bend(self) -> Array:
        """Bend of every joint, array (n) [rad]."""
        return np.asarray(self.place.bend)

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
        phase=by_laws(whole, np.zeros(1))["joint_angle"][:, 0],
    )


def turning_by_laws(on: Followed) -> Page:
    """Return the page of the motion."""
    figure = motion_figure(on.found)
    return Page(
        name="motion",
        title=_("Motion"),
        answer=_("Followed from joint to joint, each by its own law; extremes are those seen over a turn."),
        blocks=[Picture(figure=figure), _extremes(on), _orders(on)],
    )


def _extremes(on: Followed) -> Table:
    seen = on.whole
    parts = (seen.ratio_min, seen.ratio_max, seen.irregularity, seen.max_lead, seen.max_acceleration)
    return extremes_table(np.stack(parts, axis=-1), on.drive.duty.speed, even=SYNCHRONOUS)


def _orders(on: Followed) -> Table:
    rows = [
        [number(str(order), float(order)), number(significant(size / deg, 3), size / deg)]
        for order, size in on.whole.orders(ORDERS)
    ]
    return Table(
        title=_("Largest orders of the output's angle error"),
        columns=(Column(heading=_("times a turn")), Column(heading=_("amplitude"), unit="°")),
        rows=rows,
    )


def yokes_refused(on: Followed) -> Page:
    """Return the page of the yoke angles: which joints keep them from being found."""
    left = [left_over(joint, float(bend)) for joint, bend in zip(on.drive.joints, on.bend, strict=True)]
    far = [i for i, rest in enumerate(left) if not rest <= NEGLIGIBLE]
    if far:
        problems = [lawless(i, on.drive.joints[i], _("yoke angles")) for i in far]
        return replace(refused("phases", _("Yoke angles"), InputError(problems)), alarms=())
    rows = [
        [words(one.label), *(number(fixed(float(g) / deg), float(g) / deg) for g in one.yoke_angle), _left(one)]
        for found in [phases(on.drive)]
        for one in (found.as_built, *found.settings, *found.spline_settings[:3])
    ]
    between = [Column(heading=_("γ shaft {number}").format(number=k), unit="°") for k in range(2, on.joints + 1)]
    columns = (Column(heading=_("setting"), left=True), *between, Column(heading=_("leaves δ"), unit="%"))
    text = _("What joints leave by laws of their own, below {most} rad, is not in these figures.")
    table = Table(columns=columns, rows=rows, title=_("Settings to choose from"), note=text.format(most="10⁻⁶"))
    answer = _("Yoke angles of the joints beside those that turn by laws of their own.")
    return Page(name="phases", title=_("Yoke angles"), answer=answer, blocks=[table])


def _left(one: YokeSetting) -> Cell:
    return number(percent(one.irregularity).removesuffix(" %"), 100.0 * one.irregularity)


def judgement_by_laws(on: Followed, pages: Sequence[Page]) -> Words:
    """Return the one sentence the reader came for."""
    name, share = on.drive.name or _("The drive"), float(on.whole.irregularity[-1])
    text = _("{name} is {share} irregular.").format(name=name, share=percent(share))
    if share < SPECK:
        text = _("{name} turns evenly, but for {share} that nobody notices.").format(name=name, share=percent(share))
    alarms = [alarm.tone for page in pages for alarm in page.alarms]
    steep = any(too_steep(joint, 1, float(bend)) for joint, bend in zip(on.drive.joints, on.bend, strict=True))
    if steep or "failed" in alarms:
        return Words(text=text, tone="failed")
    return Words(text=text, tone="good" if share < SPECK and "warning" not in alarms else "warning")


def warnings_by_laws(on: Followed, pages: Sequence[Page]) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    yield from (alarm for page in pages for alarm in page.alarms)
    for k, (joint, bend) in enumerate(zip(on.drive.joints, on.bend, strict=True), start=1):
        text = too_steep(joint, k, float(bend))
        if text:
            yield Words(text=text, tone="failed")


def figures_by_laws(on: Followed, pages: Sequence[Page]) -> Table:
    """Return the figures a reader compares drives by."""
    share, speed = float(on.whole.irregularity[-1]), on.drive.duty.speed
    steep = float(on.whole.max_acceleration[-1])
    rows = [
        key(_("irregularity δ of the output"), 100.0 * share, "%", words(""), percent(share, 4).removesuffix(" %")),
        key(_("output ahead and back of its mean by"), float(on.whole.max_lead[-1]) / deg, "°", words("")),
    ]
    if speed is None:
        rows.append(key(_("largest acceleration of the output over ω₁²"), steep, "–", words("")))
    else:
        name = _("largest acceleration of the output at {speed} rpm").format(speed=significant(abs(speed) / rpm))
        rows.append(key(name, steep * speed**2, "rad/s²", words("")))
    rows += [list(row) for page in pages for row in page.keys]
    return Table(columns=verdict_columns(), rows=rows)


def changes_by_laws(on: Followed) -> Words:
    """Return what would make the drive even."""
    if float(on.whole.irregularity[-1]) < SPECK:
        return Words(text=_("Nothing needs to be changed for an even output."))
    own = [str(i) for i, joint in enumerate(on.drive.joints, 1) if not has_map(joint)]
    text = plural(
        "Joint {own} is even where the parts of both its shafts are alike.",
        "Joints {own} are even where the parts of both their shafts are alike.",
        len(own),
    ).format(own=", ".join(own))
    if len(own) < on.joints:
        text += " " + _("What the other joints add, yoke angles may undo.")
    return Words(text=text)


def method_by_laws(on: Followed, source_text: str | None) -> Page:
    """Return the page of the method."""
    from cardan import __version__

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
    answer = _("Calculated by cardan {version}.").format(version=__version__)
    return Page(name="method", title=_("Method and evidence"), answer=answer, blocks=blocks)
