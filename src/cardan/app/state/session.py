"""A session: the drive one user works on, how it came to be, and who wants to know when it changes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields, replace
from functools import partial
from typing import Any, Literal, Protocol, TypeAlias

from cardan.answers.reader import Reader, reading
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.report.swept import Wanted
from cardan.texts import LANGUAGES, _, speaking
from cardan.units import DIMENSIONS

from .document import Change as TextChange
from .document import Document, History, Workspace, changed, full_name, heavy, read, sent
from .kept import Kept
from .recordings import Recordings
from .variants import Variants

Change: TypeAlias = Literal["text", "drive", "file", "selection", "choices", "variants", "instant"]
"""What can change: the text (always first), the last sound drive, name and saved state of the file, the part of the
drive the user looks at, the user's choices, the variants kept, the instant of its movements."""

Listener: TypeAlias = Callable[[], None]
Step: TypeAlias = "Callable[[], tuple[TextChange, Callable[[Document], None]]]"
"""Tells, once it is its turn, how the text changes and who takes the document behind the change."""


class Elsewhere(Protocol):
    """What makes steps of heavy files, one after the other."""

    @property
    def busy(self) -> bool:
        """Whether it has steps to make, so that later ones have to wait."""

    def __call__(self, step: Step) -> None:
        """Make a step once those before it are made."""


class Session:
    """What one user works on; two sessions share nothing but the folder.

    workspace: the folder with the user's files; choices: how the user likes to see things.
    document: the file as it stands.
    drive: the last sound drive; answers are about this one.
    name: name of the file in the workspace; empty for one that was never saved.
    example: the shipped example that the drive began as; empty for others.
    foreign: what stands in the file now, where somebody else wrote it after we did; None where nobody did.
    selected: path of the part the user looks at, ``joints[1]``, ``shafts[2]``; empty for none.
    instant: time of its movements at which the drive is looked at [s]; None as drawn.
    notice: what the user should be told first; empty for nothing.
    dark: whether the system of the user is dark; asked of the browser.
    variants: the variants kept, also while another file is opened.
    recordings: the recording that is open, which nobody else sees.
    sweep: what is wanted of a sweep over keys of the drive.
    apart: makes steps of heavy files elsewhere, one after the other; None makes them here.
    opened: how many files were opened.
    rebuild: builds the parts of the page anew: another file, another language.
    later: calls a function once what cannot wait has gone out to the browser; at once unless a page says otherwise.
    """

    def __init__(self, workspace: Workspace, choices: Choices | None = None) -> None:
        self.workspace = workspace
        self.choices = choices or Choices()
        self.document = Document(text="")
        self.drive: Drive | None = None
        self.name = ""
        self.example = ""
        self.foreign: str | None = None
        self.selected = ""
        self.instant: float | None = None
        self.notice = ""
        self.dark = False
        self.history = History()
        self.variants = Variants()
        self.recordings = Recordings(workspace)
        self.sweep = Wanted()
        self._saved = ""
        self._stamp: object = None
        self._gesture = ""
        self.apart: Elsewhere | None = None
        self.opened = 0
        self.rebuild: Listener = _nothing
        self.later: Callable[[Listener], None] = _at_once
        self._listeners: dict[Change, list[Listener]] = {}
        self._first: dict[Change, list[Listener]] = {}
        self._lasting: dict[Change, list[Listener]] = {}
        self._behind: tuple[Change, ...] = ()

    def listen(self, change: Change, listener: Listener, *, first: bool = False, lasting: bool = False) -> None:
        """Have a function called after every change of a sort.

        first: of an edit it is told before all others and at once: it shows what the user waits for.
        lasting: it stays when the parts of the page are built anew.
        """
        kept = self._lasting if lasting else self._first if first else self._listeners
        kept.setdefault(change, []).append(listener)

    def forget_parts(self) -> None:
        """Forget all listeners but the lasting ones, before the parts of the page are built anew."""
        self._first, self._listeners = {}, {}

    def tell(self, change: Change) -> None:
        """Call all who want to know of a change, in the user's language; one that fails keeps it from no other."""
        self._call(self._heard(change, self._lasting, self._first, self._listeners))

    @staticmethod
    def _heard(change: Change, *kept: Mapping[Change, Sequence[Listener]]) -> list[Listener]:
        return [listener for some in kept for listener in some.get(change, ())]

    def _call(self, listeners: Iterable[Listener]) -> None:
        failed: Exception | None = None
        with self.speaking():
            for listener in listeners:
                try:
                    listener()
                except Exception as error:
                    failed = failed or error
        if failed is not None:
            raise failed

    @contextmanager
    def speaking(self) -> Iterator[None]:
        """Speak the user's language within a block, in the units that the user likes."""
        with speaking(self.choices.language), reading(self.reader):
            yield

    @property
    def reader(self) -> Reader:
        """The units and the decimal sign that the user likes."""
        return Reader(units=dict(self.choices.units), decimal=self.choices.decimal, keys="page")

    def read(self, text: str) -> Document:
        """Return the document that a text is in this workspace."""
        with self.speaking():
            return read(text, self.workspace.enclosed)

    @property
    def saved(self) -> bool:
        """Whether the file holds what the user sees."""
        return self.document.text == self._saved

    @property
    def heavy(self) -> bool:
        """Whether work on the drive would keep other windows waiting."""
        return heavy(self.document.text)

    @property
    def empty(self) -> bool:
        """Whether no drive was opened yet."""
        return not self.document.text and not self.history.before

    @property
    def losing(self) -> bool:
        """Whether something would be lost if the user went away."""
        return bool((self.history.before and not self.saved) or len(self.variants))

    def open(self, text: str, name: str = "", *, saved: bool = True, example: str = "") -> None:
        """Begin with another file; the page is built anew for it.

        name: its name in the workspace; empty for a new one; example: the shipped example that it is.
        """
        self._begin(Kept(text=text, saved=text if saved else "", name=name, example=example, variants=self.variants))

    def kept(self) -> Kept:
        """Return all that the user would miss."""
        return Kept(
            text=self.document.text,
            saved=self._saved,
            name=self.name,
            example=self.example,
            history=self.history,
            variants=self.variants,
        )

    def resume(self, kept: Kept) -> None:
        """Go on where a window was left."""
        self._begin(kept)
        self.look()

    def _begin(self, kept: Kept) -> None:
        self.history, self.variants, self.selected, self.instant = kept.history, kept.variants, "", None
        self.name, self.example, self._saved = kept.name, kept.example, kept.saved
        self.foreign, self._stamp, self.sweep = None, None, Wanted()
        self.opened += 1
        self.end_gesture()
        elsewhere = self.apart is not None and heavy(kept.text)
        self.document = Document(text=kept.text) if elsewhere else self.read(kept.text)
        self.drive = self.document.drive
        self.rebuild()
        if elsewhere:
            self._make(lambda: (partial(_whole, kept.text), self._now))

    def take(self, name: str, content: bytes) -> None:
        """Begin with a file that the user sent; it is read as data and written nowhere."""
        self.open(sent(name, content, self.workspace.enclosed), saved=False)

    def rewrite(self, text: str) -> None:
        """Take a whole new text, as from the editor."""
        if text != self.document.text:
            self._make(lambda: (partial(_whole, text), self._stepped), text)

    def change(self, how: TextChange, *, gesture: str = "") -> None:
        """Change the text by a function of it.

        how: text before -> text behind, such that another process can take it.
        gesture: changes of the same gesture, such as a drag, are undone together.
        Raises InputError: the change cannot be made; everything stays as it was.
        """
        self._make(lambda: (how, partial(self._stepped, gesture=gesture)))

    def _make(self, step: Step, text: str = "") -> None:
        """Make a step here, or elsewhere where it would keep others waiting."""
        if self.apart is not None and (self.apart.busy or heavy(self.document.text) or heavy(text)):
            self.apart(step)
            return
        how, then = step()
        with self.speaking():
            then(changed(self.document, how, self.workspace.enclosed))

    def _stepped(self, after: Document, gesture: str = "") -> None:
        if after.text == self.document.text:
            return
        if not gesture or gesture != self._gesture:
            self.history = self.history.after(self.document.text)
        self._gesture = gesture
        self._now(after)

    @property
    def moving(self) -> bool:
        """Whether a gesture goes on, whose browser waits to be followed before it sends the next place."""
        return bool(self._gesture)

    def end_gesture(self) -> None:
        """End a gesture: what follows is a step of its own."""
        self._gesture = ""

    def undo(self) -> None:
        """Go a step back."""
        self.end_gesture()
        self._make(lambda: self._walked(self.history.undone))

    def redo(self) -> None:
        """Go a step forward again."""
        self.end_gesture()
        self._make(lambda: self._walked(self.history.redone))

    def _walked(self, walk: Callable[[str], tuple[str, History]]) -> tuple[TextChange, Callable[[Document], None]]:
        text, history = walk(self.document.text)

        def then(document: Document) -> None:
            self.history = history
            self._now(document)

        return partial(_whole, text), then

    def save(self, name: str = "", *, over: bool = False) -> None:
        """Write the file into the workspace.

        over: write over what somebody else wrote there.
        Raises InputError: it cannot be written, or `obstacle` tells what is in its way.
        """
        full = full_name(name or self.name)
        if not over and self.obstacle(full):
            raise refuse(full, _("another file stands there; nothing was written"))
        self.name = self.workspace.write(full, self.document.text)
        self._settled(self.document.text)
        self.tell("file")

    def obstacle(self, name: str = "") -> Literal["", "another", "changed"]:
        """Tell what saving would write over: another file, or what somebody else wrote into ours."""
        full = full_name(name or self.name)
        there = self.workspace.there(full)
        if there is None or there == self.document.text:
            return ""
        if full != self.name:
            return "another"
        return "" if there == self._saved else "changed"

    def look(self) -> None:
        """See whether somebody else changed the file, or took it away."""
        if not self.name or self.workspace.stamp(self.name) == self._stamp:
            return
        before = self.foreign, self._saved
        self._stamp = self.workspace.stamp(self.name)
        there = self.workspace.there(self.name)
        self.foreign = None if there in (None, self._saved, self.document.text) else there
        if there is None:
            self._saved = ""
        elif there == self.document.text:
            self._saved = there
        if before != (self.foreign, self._saved):
            self.tell("file")

    def reload(self) -> None:
        """Take what somebody else wrote into the file; undo goes back to what was here."""
        there = self.workspace.read(self.name)
        self._settled(there)
        if there == self.document.text:
            self.tell("file")
        else:
            self.rewrite(there)

    def _settled(self, text: str) -> None:
        self._saved, self.foreign, self._stamp = text, None, self.workspace.stamp(self.name)

    def keep(self, variants: Variants) -> None:
        """Take other variants to be kept."""
        self.variants = variants
        self.tell("variants")

    def select(self, path: str) -> None:
        """Look at a part of the drive."""
        if path != self.selected:
            self.selected = path
            self.tell("selection")

    def stand(self, instant: float | None) -> None:
        """Look at the drive where its movements have brought it at an instant [s]; None as drawn."""
        if instant != self.instant:
            self.instant = instant
            self.tell("instant")

    def choose(self, **choices: Any) -> None:
        """Change how the user likes to see things; another language builds the page anew."""
        before, self.choices = self.choices, replace(self.choices, **choices)
        if self.document.problems:  # they are told in the words and units of before
            self.document = self._still(self.read(self.document.text))
            self.tell("text")
        self.tell("choices")
        if self.choices.language != before.language:
            self.rebuild()

    def _still(self, document: Document) -> Document:
        """Return a document that is of what it was of: its text may be no TOML for a moment."""
        return replace(document, of_mechanism=self.document.of_mechanism) if document.tree is None else document

    def _now(self, document: Document) -> None:
        """Show another document: first what the user waits for, then all the rest, for several edits in a row once."""
        document = self._still(document)
        other = document.of_mechanism != self.document.of_mechanism
        self.document = document
        if other:
            self.drive = document.drive
            self.rebuild()
        changes: tuple[Change, ...] = ("text", "file")
        if document.drive is not None:
            self.drive = document.drive
            changes = ("text", "drive", "file")
        waiting, self._behind = bool(self._behind), max(changes, self._behind, key=len)
        try:
            self._call(one for change in changes for one in self._heard(change, self._first))
        finally:
            if not waiting:
                self.later(self._follow)

    def _follow(self) -> None:
        """Tell all who could wait."""
        changes, self._behind = self._behind, ()
        self._call(one for change in changes for one in self._heard(change, self._lasting, self._listeners))


def _whole(text: str, _before: str) -> str:
    return text


def _nothing() -> None:
    """Stand where no page is."""


def _at_once(what: Listener) -> None:
    what()


# How one user likes to see things: language, units, decimal sign, light or dark.

Theme: TypeAlias = Literal["auto", "light", "dark"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choices:
    """What a user chose."""

    language: str = "en"  # one of `cardan.texts.LANGUAGES`
    # dimension -> unit, as in the keys of a drive file, where it is not the usual one
    units: Mapping[str, str] = field(default_factory=dict)
    decimal: str = ""  # sign between whole and part, ``"."`` or ``","``; empty for that of the language
    theme: Theme = "auto"  # auto, light or dark

    def kept(self) -> dict[str, Any]:
        """Return the choices as plain data, to be kept for the next time."""
        return {**asdict(self), "units": dict(self.units)}


def choices_of(kept: Mapping[str, Any]) -> Choices:
    """Return the choices kept as plain data; what makes no sense is left at its default."""
    units = kept.get("units")
    given = dict(units) if isinstance(units, Mapping) else {}
    sound = {
        "language": kept.get("language") in tuple(LANGUAGES),
        "decimal": kept.get("decimal") in (".", ","),
        "theme": kept.get("theme") in ("auto", "light", "dark"),
    }
    return Choices(
        units={one: unit for one, unit in given.items() if unit in tuple(DIMENSIONS.get(one, {}))},
        **{one.name: kept[one.name] for one in fields(Choices) if sound.get(one.name)},
    )
