"""What there is to translate, and the catalogues that translate it: read, merged, compiled."""

from __future__ import annotations

import ast
import json
import tomllib
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

from babel.messages.catalog import Catalog, Message
from babel.messages.extract import extract_from_dir
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from cardan.calc import CALCULATIONS, GROUPS, Given
from cardan.catalogue import catalogue
from cardan.catalogue.rows import SENTENCES, TABLES, WORDS
from cardan.cli.files.example import about
from cardan.io import example_names, example_text, mechanism_names, recording_names
from cardan.io.schema import sections
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.reading.fields import fields_of
from cardan.texts import DOMAIN, FOLDER, LANGUAGES, speaking
from cardan.units import DIMENSIONS, LABELS

SOURCE = FOLDER.parent
WORDS_OF = {"_": 1, "mark": 1, "plural": 2}
"""Function of `cardan.texts` -> how many of its arguments are sentences."""
OTHERS = tuple(code for code in LANGUAGES if code != "en")
"""Languages that need a catalogue."""

LONG_AGO = datetime(2000, 1, 1, tzinfo=UTC)
"""What a compiled catalogue says of its age, so that the same sentences make the same file."""

Texts = str | tuple[str, ...]


@cache
def extracted() -> Catalog:
    """Return every sentence: of code and templates, of the catalogue, on keys; sources; and the units."""
    found = _empty()
    for path in sorted(SOURCE.rglob("*.py")):
        for text in sentences(path.read_text("utf-8")):
            found.add(text, locations=[(path.relative_to(SOURCE).as_posix(), None)])
    methods, options = [("**/templates/**.html", "jinja2")], {"**.html": {"trimmed": "true"}}
    for name, _line, text, _comments, _context in extract_from_dir(SOURCE, methods, options, {"_": None}):
        found.add(text, locations=[(name, None)])
    with speaking("en"):
        for name, text in _declared():
            found.add(text, locations=[(name, None)])
    return found


def sentences(code: str) -> Iterator[Texts]:
    """Yield the sentences that a Python module passes to the functions of `cardan.texts`, in their order.

    Raises
    ------
    ValueError
        An argument is made of parts, so that no translator sees it.
    """
    calls = [node for node in ast.walk(ast.parse(code)) if isinstance(node, ast.Call)]
    for call in sorted(calls, key=lambda node: (node.lineno, node.col_offset)):
        name = call.func.id if isinstance(call.func, ast.Name) else ""
        given = call.args[: WORDS_OF.get(name, 0)]
        if any(isinstance(one, ast.JoinedStr | ast.BinOp) for one in given):
            raise ValueError(f"line {call.lineno}: {name}() takes one whole sentence: {ast.unparse(call)}")
        texts = tuple(one.value for one in given if isinstance(one, ast.Constant) and one.value)
        if texts and len(texts) == WORDS_OF[name]:
            yield texts[0] if name != "plural" else texts


def _declared() -> Iterator[tuple[str, str]]:
    """Yield the sentences of tables, keys and rows, and the labels of units, each with where it stands."""
    for cls in dict.fromkeys((*(cls for _title, cls in sections()), Mechanism, Pair, *TABLES.values())):
        name = cls.__module__.removeprefix("cardan.").replace(".", "/") + ".py"
        yield name, (cls.__doc__ or "").strip().splitlines()[0]
        for one in fields_of(cls).values():
            yield name, one.key.doc
    for name in example_names():
        yield f"examples/{name}", tomllib.loads(example_text(name))["name"]
    for name in (*example_names(), *mechanism_names(), *recording_names()):
        yield f"examples/{name}", about(example_text(name))
    for group in GROUPS:
        yield "calc", group.title
    for one in CALCULATIONS.values():
        name = one.module.removeprefix("cardan.").replace(".", "/") + ".py"
        docs = [one.doc, one.source, *_meant(one.takes), *(output.doc for output in one.returns)]
        yield from ((name, text) for text in docs)
    for table, rows in catalogue().tables.items():
        for row in rows.values():
            words = [getattr(row, name, "") for name in SENTENCES]
            words += [word for name in WORDS for word in getattr(row, name, ())]
            yield from ((f"catalogue/{table}", word) for word in words if word)
    for unit in dict.fromkeys(unit for units in DIMENSIONS.values() for unit in units):
        if LABELS.get(unit, unit).strip("°′%1"):
            yield "units.py", LABELS.get(unit, unit)


def _meant(keys: Sequence[Given]) -> Iterator[str]:
    """Yield what keys of a calculation mean, and those of the tables under them."""
    for one in keys:
        yield one.meaning.doc
        yield from _meant([*one.columns, *(column for more in one.kinds.values() for column in more)])


def _empty(code: str | None = None) -> Catalog:
    return Catalog(locale=code, project="cardan", version="1", fuzzy=False, charset="utf-8", header_comment="")


def place(code: str, ending: str) -> Path:
    """Return where the catalogue of a language is: ``"po"`` is what people edit, ``"mo"`` what the program reads."""
    return FOLDER / code / "LC_MESSAGES" / f"{DOMAIN}.{ending}"


def stored(code: str) -> Catalog:
    """Return the catalogue of a language as it is in the tree, empty where there is none yet."""
    path = place(code, "po")
    if not path.exists():
        return _empty(code)
    with path.open("rb") as stream:
        return read_po(stream, locale=code, domain=DOMAIN)


def merged(code: str, more: Sequence[dict[str, Any]] = ()) -> Catalog:
    """Return the catalogue of a language with exactly the sentences of the sources.

    Parameters
    ----------
    code : str
        Language.
    more : sequence of dict
        Translations by the English sentence (its singular); a list of all forms for a plural. Later ones win.
    """
    before, after = stored(code), _empty(code)
    said: dict[str, Any] = {first(message.id): message.string for message in before if message.id}
    for one in more:
        said.update({english: tuple(text) if isinstance(text, list) else text for english, text in one.items()})
    for message in extracted():
        if message.id:
            text = said.get(first(message.id)) or ""
            fits = isinstance(text, tuple) == isinstance(message.id, tuple)
            nothing = ("",) * after.num_plurals if isinstance(message.id, tuple) else ""
            after.add(message.id, text if fits else nothing, message.locations, auto_comments=message.auto_comments)
    return after


def first(text: Texts | Any) -> str:
    """Return the sentence that names a message: the singular of a plural."""
    return text if isinstance(text, str) else str(text[0])


def forms(message: Message) -> tuple[str, ...]:
    """Return all translated forms of a message."""
    return (message.string,) if isinstance(message.string, str) else tuple(message.string)


def untranslated(catalogue: Catalog) -> list[str]:
    """Return the sentences that lack a translation, or one of its forms."""
    return [first(message.id) for message in catalogue if message.id and not all(forms(message))]


def written(catalogue: Catalog) -> bytes:
    """Return a catalogue as people edit it, the same for the same content."""
    stream = BytesIO()
    write_po(stream, catalogue, width=120, sort_by_file=True, omit_header=True, include_lineno=False)
    return _HEAD.format(language=catalogue.locale, plurals=catalogue.plural_forms).encode() + stream.getvalue()


_HEAD = """\
msgid ""
msgstr ""
"Project-Id-Version: cardan\\n"
"Language: {language}\\n"
"Plural-Forms: {plurals}\\n"
"MIME-Version: 1.0\\n"
"Content-Type: text/plain; charset=utf-8\\n"
"Content-Transfer-Encoding: 8bit\\n"

"""


def compiled(written_catalogue: bytes, code: str) -> bytes:
    """Return a catalogue as the program reads it."""
    stream = BytesIO()
    catalogue = read_po(BytesIO(written_catalogue), locale=code, domain=DOMAIN)
    for message in list(catalogue):
        if message.id and not all(forms(message)):
            catalogue.delete(message.id)
    catalogue.creation_date = catalogue.revision_date = LONG_AGO
    write_mo(stream, catalogue)
    return stream.getvalue()


def update(code: str, more: Sequence[dict[str, Any]] = ()) -> Catalog:
    """Bring the catalogue of a language up to date with the sources, compile it, and return it."""
    catalogue = merged(code, more)
    text = written(catalogue)
    for ending, content in (("po", text), ("mo", compiled(text, code))):
        path = place(code, ending)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return catalogue


def from_files(paths: Sequence[Path]) -> list[dict[str, Any]]:
    """Return translations from JSON files: English sentence -> translation, or a list of all plural forms."""
    return [json.loads(path.read_text(encoding="utf-8")) for path in paths]
