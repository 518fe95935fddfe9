"""Words that the trade does not use, or uses for something else: they stand in no text that a user reads.

The prose above the shipped examples is not asked here.
"""

import re

import pytest

from tests.locale.messages import extracted

BANNED = (
    *(r"bows?", r"bounces", r"lets? go", r"held too often", r"held just enough", r"nought", r"cure[sd]?"),
    *(r"belief", r"dividing lever", r"in the mean", r"ahead and back", r"runs ahead", r"irregular"),
    *(r"swings?", r"dies? out", r"what becomes of", r"misfits?", r"norms?", r"weighs", r"halving plane"),
    *(
        r"half-cardan",
        r"inside shafts?",
        r"evenly",
        r"uneven(?:ly|ness)?",
        r"product of speed and bend",
        r"bends? (?:too|of|from|up)",
    ),
    *(r"is no (?!longer|larger|smaller|more|less|better)", r"are no (?!longer|larger|smaller|more|less|better)"),
)
"""Patterns of whole words; "there is no" is good English."""

WORDS = re.compile(rf"(?<!there )(?<!There )\b(?:{'|'.join(BANNED)})(?:(?<= )|\b)")

TRADE = (
    "Performance Composites, mechanical properties of carbon fibre composite materials, 120 C cure epoxy, Vf 60 % UD, "
    "50 % fabric (performance-composites.com/carbonfibre/mechanicalproperties_2.asp)",
    "swing the joint by hand: it sticks or catches",
    "The lightest tube that passes weighs {mass}: {outer} by {wall}; now it is {now}.",
    "sizes 800-3000 daN m, norm ON 025 311-68 (Fig. 41)",
)
"""Texts that say a word in its plain sense, or in a name."""


def said():
    """Return every text of the program, but for the prose of its examples."""
    for message in extracted():
        if message.id and not all(name.startswith("examples/") for name, _line in message.locations):
            yield from message.id if isinstance(message.id, tuple) else (message.id,)


@pytest.mark.slow
def test_no_text_says_a_banned_word():
    found = {text for text in said() if WORDS.search(text)}
    assert sorted(found.difference(TRADE)) == []


@pytest.mark.parametrize("text", ["'foo' is no check", "shaft 3 bows at 7095 rpm", "2 are no recordings"])
def test_a_banned_word_is_seen(text):
    assert WORDS.search(text)


@pytest.mark.parametrize(
    "text", ["there is no shaft 3", "it is no longer than that", "normal", "the speed fluctuation δ"]
)
def test_good_english_is_left_alone(text):
    assert not WORDS.search(text)
