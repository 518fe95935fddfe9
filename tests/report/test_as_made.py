"""A drive with measured errors of its joints is told in the same words and numbers wherever it is told."""

import re
from dataclasses import replace

import pytest

from cardan.answers.quantity import Quantity, told
from cardan.answers.reader import USUAL
from cardan.drive.accuracy import Error
from cardan.io import example, example_names
from cardan.questions.accuracy.as_made import AsMade, made
from cardan.questions.gathering import gather, principal
from cardan.register import QUESTIONS
from cardan.report.answers import subject
from cardan.report.summary import changes, judgement, uniformity, warnings
from cardan.units import arcmin

EXACT = re.compile(r"exactly (uniform|constant|even)|synchronous|uniformly by itself, and so|for a uniform output")
"""Words of a drive without errors."""


def erring(name):
    """Return an example whose cross joints have measured errors."""
    drive = example(name)
    error = Error(alpha1=5 * arcmin, alpha3=-3 * arcmin, s1=2e-5)
    joints = tuple(replace(joint, error=error) if joint.single_cross else joint for joint in drive.joints)
    return replace(drive, joints=joints)


def said(question, drive):
    one = principal(question, drive)
    if question.lacking(one) or (result := question.ask(one)) is None:
        return None
    return gather(question, drive, question.answer(one, result))


CROSSED = [name for name in example_names() if any(joint.single_cross for joint in example(name).joints)]


@pytest.mark.slow
@pytest.mark.parametrize("name", CROSSED)
def test_errors_are_told_in_the_same_words_and_numbers_everywhere(name):
    drive = erring(name)
    found, texts = made(drive), []
    answers = {key: said(QUESTIONS[key], drive) for key in ("motion", "phasing", "forces")}
    for key, answer in answers.items():
        if answer is None:
            continue
        own = [told(answer.sentence, USUAL), *(told(remark.text, USUAL) for remark in answer.remarks)]
        own += [told(figure.verdict, USUAL) for figure in answer.keys]
        assert any("as made" in text for text in own), key
        texts += own
    on = subject(drive)
    first = [uniformity(on).text, judgement(on).text, *(one.text for one in warnings(on))]
    first.append(getattr(changes(on), "text", ""))
    texts += [told(text, USUAL) for text in first]
    assert [text for text in texts if EXACT.search(text)] == []
    if not isinstance(found, AsMade):
        return
    share = told(Quantity(found.fluctuation, "share"), USUAL)
    for key in ("motion", "phasing"):
        figures = {figure.name: figure.value.value for figure in answers[key].keys}
        assert figures["speed_fluctuation_as_made"] == found.fluctuation
        assert figures["angle_error_as_made"] == found.angle_error
        assert any(share in told(remark.text, USUAL) for remark in answers[key].remarks)
    assert f"With the errors of its joints as made the speed fluctuation is {share}." in told(first[0], USUAL)


def test_joints_whose_sizes_are_not_given_count_as_made_true_and_the_answers_say_so():
    drive = erring("propshaft-with-rzeppa")
    texts = [told(one.text, USUAL) for one in said(QUESTIONS["motion"], drive).remarks]
    assert any("With the errors of its joints as made" in text for text in texts)
    texts = [told(one.text, USUAL) for one in said(QUESTIONS["accuracy"], drive).remarks]
    others = [(number, joint) for number, joint in enumerate(drive.joints, 1) if not joint.single_cross]
    assert others
    for number, joint in others:
        assert not any(joint.sizes().values())
        own = next(text for text in texts if text.startswith(f"Of joint {number} only alpha4"))
        assert ", ".join(joint.law_sizes) in own
