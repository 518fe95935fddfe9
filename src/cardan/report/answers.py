"""Every question that can be asked about a drive by itself: the pages of the report, one by one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from typing import Any, TypeAlias

from cardan.answers.answer import Answer, Tone
from cardan.answers.quantity import Quantity, say
from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import needed
from cardan.errors import InputError
from cardan.questions.gathering import gather, principal
from cardan.questions.motion.equivalence import SPECK
from cardan.questions.motion.kinds import kind_name
from cardan.register import QUESTIONS
from cardan.texts import _, plural
from cardan.version import VERSION

from .block import Listing, Page, Points, Words, page
from .description import signs
from .subject import Progress, Subject
from .summary import steep_joints

Choices: TypeAlias = Mapping[str, Any]  # what the user chose beside the drive


def subject(drive: Drive, *, known: Catalogue | None = None) -> Subject:
    """Return a drive of joints of any kinds to be asked about; known: what it is judged by instead of shipped norms."""
    return Subject(drive=drive, known=known)


def answered(
    name: str,
    on: Subject,
    progress: Progress | None = None,
    choices: Choices | None = None,
    kept: MutableMapping[str, Answer] | None = None,
) -> Page:
    """Return the answer to one question about a drive; where there is none, a page that says what it lacks.

    name: one of `cardan.register.QUESTIONS`; on: the drive, as of `subject`.
    choices: what the user chose: of "selection" the number of the ``joint``.
    kept: answers about the same drive and choices in the same language, each by its name: one that is there is told
    to who reads here and not calculated again, one that is not there is added.
    """
    return page_of(QUESTIONS[name], on, progress, choices or {}, kept)


def page_of(
    question: Question,
    on: Subject,
    progress: Progress | None,
    choices: Choices,
    kept: MutableMapping[str, Answer] | None = None,
) -> Page:
    """Return the page of a question of the register; what it lacks or why it refuses, where it has no answer."""
    title = _(question.title)
    drive = principal(question, on.drive)
    missing = question.lacking(drive)
    if not missing:
        found = found_page(question, on, progress, choices, kept)
        if found is not None:
            return found
        why = question.otherwise(drive)
        if isinstance(why, str):
            return Page(name=question.name, title=title, answer=why, blocks=())
        missing = why
    return Page(name=question.name, title=title, answer=needed(missing), blocks=(), lacking=missing)


def found_page(
    question: Question,
    on: Subject,
    progress: Progress | None = None,
    choices: Choices | None = None,
    kept: MutableMapping[str, Answer] | None = None,
    *,
    whole: bool = True,
) -> Page | None:
    """Return the page of a question about a drive that has what it needs; None where nothing can be told."""
    if kept is not None and question.name in kept:
        return page(kept[question.name], reader())
    drive = principal(question, on.drive)
    try:
        result = question.ask(drive, known=on.known, progress=progress, **(choices or {}))
    except InputError as error:
        return refused(question.name, _(question.title), error)
    if result is None:
        return None
    found = gather(question, on.drive, question.answer(drive, result))
    if kept is not None:
        kept[question.name] = found
    return page(found, reader(), whole=whole)


# What a part of the report says where the drive file does not answer it: what is missing, or why it is refused.


def refused(name: str, title: str, error: InputError) -> Page:
    """Return the page of a question that the drive file does not answer, with what is missing."""
    left = [f"{one.field}: {one.message}" for one in error.problems]
    alarm = _("{part} not calculated: {first}").format(part=title, first=left[0])
    answer = _("Not calculated; the drive file leaves open:")
    if all(one.code == "unknown_kind" for one in error.problems):
        answer = _("Not calculated for joints of these kinds:")
    blocks = [Words(text=text, tone="warning") for text in left]
    return Page(name=name, title=title, answer=answer, blocks=blocks, alarms=[Words(text=alarm, tone="warning")])


# The report of a drive with joints that turn by laws of their own, without what a chain of Hooke joints would tell.
#
# Motion is followed from joint to joint and its extremes are seen over a turn; there is no single joint that the drive
# amounts to, and no polygon of yoke angles.


def judgement_by_laws(on: Subject, pages: Sequence[Page]) -> Words:
    """Return the one sentence the reader came for."""
    share = on.fluctuation
    said = {"name": on.drive.name or _("The drive"), "share": Quantity(share, "share", 3)}
    text = _("{name} has {share} speed fluctuation.")
    if share < SPECK:
        text = _("{name} is uniform, but for {share} that nobody notices.")
    alarms = [alarm.tone for page in pages for alarm in page.alarms]
    tone: Tone = "good" if share < SPECK and "warning" not in alarms else "warning"
    if "failed" in alarms or any(steep_joints(on.drive, on.joint_angle)):
        tone = "failed"
    return Words(text=say(text, **said), tone=tone)


def warnings_by_laws(on: Subject, pages: Sequence[Page]) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    yield from (alarm for page in pages for alarm in page.alarms)
    yield from steep_joints(on.drive, on.joint_angle)


def changes_by_laws(on: Subject) -> Words:
    """Return what would make the drive even."""
    if on.fluctuation < SPECK:
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


def method_by_laws(on: Subject, source_text: str | None) -> Page:
    """Return the page of the method."""
    own = [f"{k}: {kind_name(joint)}" for k, joint in enumerate(on.drive.joints, start=1)]
    blocks: list[Words | Points | Listing] = [
        signs(),
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
