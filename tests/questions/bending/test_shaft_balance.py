"""Balance of the shafts of a drive: by hand, and by cancelling what was measured."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, check
from cardan.drive.duty import Block, Duty
from cardan.drive.shaft import Shaft, Unbalance
from cardan.questions.bending.balance import balance
from cardan.units import mm, rpm

PLANES = (
    Unbalance(position=0.1, amount=180e-6, angle=0.4),
    Unbalance(position=0.7, amount=90e-6, angle=2.9),
    Unbalance(position=1.1, amount=60e-6, angle=-1.0),
)


def drive(**changes):
    tube = Shaft(number=2, outer=80 * mm, wall=2.5 * mm, length=1.2, **changes)
    return replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,), duty=Duty(speed=2400 * rpm))


def test_what_a_grade_allows_by_hand():
    found = balance(drive(), grade="G16")
    mass = 7850 * math.pi / 4 * (0.08**2 - 0.075**2) * 1.2
    one = found.shafts[0]
    assert one.mass == pytest.approx(mass, rel=1e-12)
    assert one.allowed == pytest.approx(mass * 0.016 / (2400 * math.pi / 30), rel=1e-12)
    assert one.allowed_plane == pytest.approx(one.allowed / 2)
    assert one.force == pytest.approx(mass * 0.016 * 2400 * math.pi / 30, rel=1e-12)
    assert (found.balanced, found.needed, found.assumed) == (None, True, False)
    assert balance(drive()).assumed
    assert not balance(drive(), Duty(speed=499 * rpm)).needed


def test_corrections_cancel_force_and_moment():
    found = balance(drive(unbalance=PLANES)).shafts[0]
    every = [(u.position, u.amount, u.angle) for u in PLANES]
    every += [(c.position, c.unbalance, c.angle) for c in found.corrections]
    place, size, angle = np.asarray(every).T
    assert [c.mass * 0.04 for c in found.corrections] == pytest.approx([c.unbalance for c in found.corrections])
    for turned in (np.cos(angle), np.sin(angle)):
        assert np.sum(size * turned) == pytest.approx(0.0, abs=1e-18)
        assert np.sum(size * place * turned) == pytest.approx(0.0, abs=1e-18)


def test_the_check_says_the_same():
    base = replace(drive(unbalance=PLANES), duty=Duty(speed=2400 * rpm, balance_grade="G16", balance_class="gaz_66"))
    found = balance(base).shafts[0]
    grade, norm = check(base, only=["balance"])
    assert (grade.value, grade.limit) == (pytest.approx(found.unbalance), pytest.approx(found.allowed))
    assert norm.limit == pytest.approx(found.norm)
    assert found.balanced == (bool(grade.passed) and bool(norm.passed))


def test_the_fastest_part_of_the_duty_counts():
    blocks = (Block(torque=1.0, speed=50.0, share=0.5), Block(torque=1.0, speed=260.0, share=0.5))
    assert balance(drive(), Duty(speed=100.0, blocks=blocks)).speed == 260.0
    assert balance(drive(), Duty(speed=100.0, speed_range=(0.0, 300.0))).speed == 300.0


def test_what_is_missing_or_unknown_is_named():
    bare = Drive.from_angles([0.1, 0.1])
    assert balance(bare, Duty(speed=100.0)).shafts[0].missing == ("shafts[1].mass",)
    with pytest.raises(InputError, match=r"duty\.speed: missing"):
        balance(bare)
    with pytest.raises(InputError, match="the nearest is G16"):
        balance(drive(), grade="G17")
