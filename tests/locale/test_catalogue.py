"""The catalogues of other languages: whole, true to the sentences, and compiled as they stand.

Where one fails: ``python -m tests.locale update``, then translate what ``python -m tests.locale missing`` lists.
"""

import re

import pytest

from .messages import OTHERS, compiled, extracted, first, forms, merged, place, sentences, stored, untranslated, written

PLACE = re.compile(r"(?<!\{)\{[^{}]*\}(?!\})")


@pytest.fixture(scope="module", params=OTHERS)
def code(request):
    return request.param


@pytest.fixture(scope="module")
def catalogue(code):
    return stored(code)


@pytest.mark.slow
def test_the_catalogue_has_the_sentences_of_the_sources_and_no_others(catalogue):
    known = {message.id for message in catalogue if message.id}
    wanted = {message.id for message in extracted() if message.id}
    assert sorted(map(first, wanted - known)) == []
    assert sorted(map(first, known - wanted)) == []


def test_every_sentence_is_translated_in_all_its_forms(catalogue):
    assert untranslated(catalogue) == []


def test_nothing_is_a_guess(catalogue):
    assert [message.id for message in catalogue if message.fuzzy and message.id] == []


def places_differ(message):
    """Tell whether a form lacks a place of the sentence or has another; one form may leave a count unsaid."""
    if isinstance(message.id, str):
        return sorted(PLACE.findall(message.id)) != sorted(PLACE.findall(message.string))
    one, many = (set(PLACE.findall(text)) for text in message.id)
    singular, *others = (set(PLACE.findall(form)) for form in message.string)
    return not singular <= one | many or any(found != many for found in others)


def test_named_places_are_the_same_in_both_languages(catalogue):
    assert [first(message.id) for message in catalogue if message.id and places_differ(message)] == []


def test_the_ends_have_the_same_blanks(catalogue):
    def ends(text):
        return text[: len(text) - len(text.lstrip())], text[len(text.rstrip()) :]

    wrong = [
        message.id
        for message in catalogue
        if message.id and any(ends(form) != ends(first(message.id)) for form in forms(message))
    ]
    assert wrong == []


@pytest.mark.slow
def test_what_the_program_reads_is_what_people_edit(code):
    text = place(code, "po").read_bytes()
    assert place(code, "mo").read_bytes() == compiled(text, code)
    assert text == written(merged(code))


def test_the_tool_takes_whole_sentences_of_our_functions_only():
    code = '_("a")\nelement.mark("b")\nplural("one", "many", 3)\nX = (mark("c"), _(X))\n_("d "\n  "e")\n'
    assert list(sentences(code)) == ["a", ("one", "many"), "c", "d e"]
    with pytest.raises(ValueError, match=r"line 1: .* one whole sentence"):
        list(sentences('_(f"{x} joints")'))
