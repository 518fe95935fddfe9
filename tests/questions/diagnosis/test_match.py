"""Causes by their signs: the rule by hand, what the signs do to the ranking, and what is refused."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest

from cardan.catalogue import catalogue, with_files
from cardan.catalogue.rows import FLAGS, Fault
from cardan.errors import InputError
from cardan.questions.diagnosis import Signs, likely_causes
from cardan.questions.diagnosis.match import symptoms

FAULTS = catalogue().rows(Fault)


def by_hand(row: Fault, signs: Signs) -> Fraction:
    """Return the points of a fault, counted in fractions from decimals: no rounding at the edge of an order."""
    points = Fraction(0)
    for order in signs.orders:
        edge = [abs(Fraction(str(order)) - Fraction(str(own))) <= Fraction(5, 100) for own in row.orders]
        points += Fraction(2 * any(edge), len(signs.orders))
    if None not in (signs.torque_sensitive, row.torque_sensitive):
        points += 1 if signs.torque_sensitive is row.torque_sensitive else -1
    for flag in row.flags:
        points += 3 if flag in signs.flags else -1
    return points + (3 if signs.symptom in row.symptoms else 0)


@pytest.mark.parametrize(
    ("orders", "torque", "symptom"),
    list(
        product(
            [(), (1.0,), (2.05,), (1.95, 3.0, 0.3), (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)],
            [None, True, False],
            [None, "boom", "knock"],
        )
    ),
)
def test_every_fault_has_the_points_of_the_rule_and_its_place(orders, torque, symptom) -> None:
    for flags in (frozenset(), frozenset(FLAGS[:1]), frozenset(FLAGS[1:])):
        signs = Signs(orders=orders, torque_sensitive=torque, symptom=symptom, flags=flags)
        points = {name: by_hand(row, signs) for name, row in FAULTS.items()}
        found = likely_causes(signs)
        assert [one.fault.id for one in found] == sorted(points, key=lambda name: (-points[name], name))
        for one in found:
            assert one.score == pytest.approx(float(points[one.fault.id]), abs=1e-14)  # one rounded division


@pytest.mark.parametrize("row", [row for row in FAULTS.values() if row.flags], ids=lambda row: row.id)
def test_a_circumstance_brings_its_fault_to_the_front(row: Fault) -> None:
    signs = {"orders": row.orders, "torque_sensitive": row.torque_sensitive}
    held = likely_causes(Signs(**signs, flags=frozenset(row.flags)))
    scores = {one.fault.id: one.score for one in likely_causes(Signs(**signs))}
    assert held[0].fault == row
    assert held[0].score - scores[row.id] == 4.0  # from one point off to three on
    assert all(one.score == scores[one.fault.id] for one in held[1:])


def test_a_cause_tells_which_orders_it_explains() -> None:
    found = {one.fault.id: one for one in likely_causes(Signs(orders=(1.02, 2.0, 4.0)))}
    assert found["F15"].orders == (1.02, 2.0)
    assert found["F10"].orders == (2.0,)
    assert found["F30"].orders == ()


def test_a_fault_of_ones_own_is_ranked_with_the_others(tmp_path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(
        '[[faults]]\nid = "X1"\nfault = "hammer left inside"\nsymptoms = ["rattle"]\ninspection = "listen"\n'
        'repair = "take it out"\nsource = "own test"\n',
        encoding="utf-8",
    )
    known = with_files(catalogue(), [own])
    assert likely_causes(Signs(symptom="rattle"), known=known)[0].fault.id == "X1"
    assert "rattle" in symptoms(known)
    with pytest.raises(InputError, match="rattle"):
        likely_causes(Signs(symptom="rattle"))


def test_signs_that_cannot_be_are_all_named() -> None:
    with pytest.raises(InputError) as caught:
        Signs(orders=(1.0, -2.0, float("nan")), flags=frozenset({"full_moon"}))
    told = [(problem.field, problem.code) for problem in caught.value.problems]
    assert told == [("orders[1]", "not_positive"), ("orders[2]", "not_finite"), ("flags", "out_of_range")]
