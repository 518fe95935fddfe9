"""Reports of the shipped examples, asked once for all tests of a run."""

from __future__ import annotations

from functools import cache

from cardan import example
from cardan.io.examples import example_text
from cardan.report.content import Content, content
from cardan.report.render.html import text
from cardan.texts import speaking


def content_of(name: str, *, full: bool = False, language: str = "en") -> Content:
    """Return what the report of an example says, with its file where it is full."""
    return _content(name, full, language)


@cache
def _content(name: str, full: bool, language: str) -> Content:
    """Return the same, kept by what was asked however it was asked."""
    with speaking(language):
        return content(example(name), source_text=example_text(name) if full else None, full=full)


@cache
def page_of(name: str) -> str:
    """Return the full report of an example as HTML."""
    return text(content_of(name, full=True))
