"""A session: the drive one user works on, how it came to be, and who wants to know when it changes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, Literal, TypeAlias

from cardan.answers.reader import Reader, reading
from cardan.drive.drive import Drive
from cardan.texts import LANGUAGES, speaking
from cardan.units import DIMENSIONS

from .document import Document, History, Workspace, changed, read, sent
from .recordings import Recordings
from .variants import Variants

Change: TypeAlias = Literal["text", "drive", "file", "selection", "choices", "variants"]
"""What can change: the text (always first), the last sound drive, name and saved state of the file, the part of the
drive the user looks at, the user's choices, the variants kept."""

Listener: TypeAlias = Callable[[], None]


class Session:
    """What one user works on; two sessions share nothing but the folder.

    workspace: the folder with the user's files; choices: how the user likes to see things.
    document: the file as it stands.
    drive: the last sound drive; answers are about this one.
    name: name of the file in the workspace; empty for one that was never saved.
    selected: path of the part the user looks at, ``joints[1]``, ``shafts[2]``; empty for none.
    notice: what the user should be told first; empty for nothing.
    dark: whether the system of the user is dark; asked of the browser.
    variants: the variants kept, also while another file is opened.
    recordings: the recording that is open, which nobody else sees.
    rebuild: builds the parts of the page anew: another file, another language.
    later: calls a function once what cannot wait has gone out to the browser; at once unless a page says otherwise.
    """

    def __init__(self, workspace: Workspace, choices: Choices | None = None) -> None:
        self.workspace = workspace
        self.choices = choices or Choices()
        self.document = Document(text="")
        self.drive: Drive | None = None
        self.name = ""
        self.selected = ""
        self.notice = ""
        self.dark = False
        self.history = History()
        self.variants = Variants()
        self.recordings = Recordings(workspace)
        self._saved = ""
        self._gesture = ""
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
        return Reader(units=dict(self.choices.units), decimal=self.choices.decimal)

    @property
    def saved(self) -> bool:
        """Whether the file holds what the user sees."""
        return self.document.text == self._saved

    @property
    def empty(self) -> bool:
        """Whether no drive was opened yet."""
        return not self.document.text and not self.history.before

    def open(self, text: str, name: str = "", *, saved: bool = True) -> None:
        """Begin with another file; the page is built anew for it.

        name: its name in the workspace; empty for a new one.
        """
        self.history, self.selected, self.name = History(), "", name
        self.end_gesture()
        self._saved = text if saved else ""
        self.document = read(text, self.workspace.enclosed)
        self.drive = self.document.drive
        self.rebuild()

    def take(self, name: str, content: bytes) -> None:
        """Begin with a file that the user sent; it is read as data and written nowhere."""
        self.open(sent(name, content, self.workspace.enclosed), saved=False)

    def rewrite(self, text: str) -> None:
        """Take a whole new text, as from the editor."""
        if text != self.document.text:
            self._step(read(text, self.workspace.enclosed))

    def change(self, how: Callable[[str], str], *, gesture: str = "") -> None:
        """Change the text by a function of it.

        how: text before -> text behind; gesture: changes of the same gesture, such as a drag, are undone together.
        Raises InputError: the change cannot be made; everything stays as it was.
        """
        after = changed(self.document, how, self.workspace.enclosed)
        if after.text == self.document.text:
            return
        if gesture and gesture == self._gesture:
            self._now(after)
        else:
            self._step(after)
        self._gesture = gesture

    def end_gesture(self) -> None:
        """End a gesture: what follows is a step of its own."""
        self._gesture = ""

    def undo(self) -> None:
        """Go a step back."""
        self.end_gesture()
        text, self.history = self.history.undone(self.document.text)
        self._now(read(text, self.workspace.enclosed))

    def redo(self) -> None:
        """Go a step forward again."""
        self.end_gesture()
        text, self.history = self.history.redone(self.document.text)
        self._now(read(text, self.workspace.enclosed))

    def save(self, name: str = "") -> None:
        """Write the file into the workspace."""
        self.name = self.workspace.write(name or self.name, self.document.text)
        self._saved = self.document.text
        self.tell("file")

    def keep(self, variants: Variants) -> None:
        """Take other variants to be kept."""
        self.variants = variants
        self.tell("variants")

    def select(self, path: str) -> None:
        """Look at a part of the drive."""
        if path != self.selected:
            self.selected = path
            self.tell("selection")

    def choose(self, **choices: Any) -> None:
        """Change how the user likes to see things; another language builds the page anew."""
        before, self.choices = self.choices, replace(self.choices, **choices)
        self.tell("choices")
        if self.choices.language != before.language:
            self.rebuild()

    def _step(self, document: Document) -> None:
        self.history, self._gesture = self.history.after(self.document.text), ""
        self._now(document)

    def _now(self, document: Document) -> None:
        """Show another document: first what the user waits for, then all the rest, for several edits in a row once."""
        self.document = document
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
