"""Balance of the shafts of a drive: by hand, and by cancelling what was measured."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, check
from cardan.drive.duty import Block, Duty
from cardan.drive.shaft import PointMass, Shaft, Unbalance
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


def test_correction_masses_that_leave_nothing_are_no_unbalance():
    """Large masses that cancel each other: what counts is what they leave in each plane, not the largest of them."""
    planes = balance(drive(unbalance=PLANES)).shafts[0].corrections
    fixed = (*PLANES, *(Unbalance(position=c.position, amount=0.999 * c.unbalance, angle=c.angle) for c in planes))
    found = balance(drive(unbalance=fixed))
    assert max(2.0 * one.amount for one in fixed) > found.shafts[0].allowed / 2
    assert found.balanced
    for plane, before in zip(found.shafts[0].planes, planes, strict=True):
        assert plane.unbalance == pytest.approx(1e-3 * before.unbalance)


def test_a_static_part_that_cancels_is_none():
    """Two unbalances that are opposite turn no force, whatever rounding leaves of their angles."""
    opposite = (
        Unbalance(position=0.1, amount=101.967e-6, angle=0.7),
        Unbalance(position=0.9, amount=101.967e-6, angle=0.7 + math.pi),
    )
    found = balance(drive(unbalance=opposite)).shafts[0]
    assert (found.unbalance, found.force) == (0.0, 0.0)
    assert found.couple == pytest.approx(0.8 * 101.967e-6)


def test_one_plane_may_be_too_much_where_the_whole_is_not():
    """At one end of a symmetrical shaft only half of what is allowed in all may be."""
    allowed = balance(drive()).shafts[0].allowed
    for share, good in ((0.49, True), (0.51, False), (0.85, False)):
        at_end = (Unbalance(position=0.0, amount=share * allowed, angle=1.0),)
        assert balance(drive(unbalance=at_end)).balanced is good
    assert balance(drive(unbalance=(Unbalance(position=0.6, amount=0.99 * allowed),))).balanced


def test_a_couple_is_too_much_without_any_resultant():
    allowed = balance(drive()).shafts[0].allowed
    pair = tuple(Unbalance(position=x, amount=0.8 * allowed, angle=a) for x, a in ((0.1, 0.3), (1.1, 0.3 + math.pi)))
    found = balance(drive(unbalance=pair)).shafts[0]
    assert found.unbalance == pytest.approx(0.0, abs=1e-12)
    assert found.couple == pytest.approx(0.8 * allowed * 1.0)
    assert [one.unbalance for one in found.planes] == pytest.approx([found.couple / 1.2] * 2)
    assert found.balanced is False


@pytest.mark.parametrize(("heavy", "first"), [(0.0, 0.5), (2.0, None), (200.0, 0.3)])
def test_planes_share_by_the_place_of_the_centre_of_mass(heavy, first):
    """Levers of the centre of mass by hand; no plane gets less than 0.3 of it."""
    made = drive(masses=(PointMass(position=1.2, mass=heavy),) if heavy else ())
    found = balance(made).shafts[0]
    tube = found.mass - heavy
    share = 1.0 - (tube * 0.6 + heavy * 1.2) / found.mass / 1.2
    assert found.planes[0].allowed == pytest.approx(found.allowed * (share if first is None else first))
    assert sum(one.allowed for one in found.planes) == pytest.approx(found.allowed)


def test_the_first_shaft_counts_from_its_end():
    """Its positions are negative before joint 1, where its second plane is."""
    shaft = Shaft(
        number=1, outer=80 * mm, wall=2.5 * mm, length=0.5, unbalance=(Unbalance(position=-0.5, amount=1e-5),)
    )
    one = balance(replace(Drive.from_angles([0.1]), shafts=(shaft,), duty=Duty(speed=2400 * rpm))).shafts[0]
    assert [plane.position for plane in one.planes] == [-0.5, 0.0]
    assert [plane.unbalance for plane in one.planes] == pytest.approx([1e-5, 0.0])


@pytest.mark.parametrize("norm", ["gaz_66", "truck_up_to_5t", ""])
@pytest.mark.parametrize("grade", ["G16", ""])
@pytest.mark.parametrize("scale", [0.1, 0.5, 1.0, 3.0])
def test_the_check_says_the_same(norm, grade, scale):
    planes = tuple(replace(one, amount=scale * one.amount) for one in PLANES)
    base = replace(drive(unbalance=planes), duty=Duty(speed=2400 * rpm, balance_grade=grade, balance_class=norm))
    verdicts = check(base, only=["balance"])
    found = balance(base).shafts[0]
    assert found.balanced == all(bool(one.passed) for one in verdicts)
    assert max(one.utilisation for one in verdicts) == pytest.approx(found.worst.utilisation)
    assert [one.value for one in verdicts] == [pytest.approx(found.worst.unbalance)] * len(verdicts)
    assert len(verdicts) == bool(norm) + bool(grade or not norm)


def test_many_drives_are_judged_as_one_by_one():
    base = replace(drive(unbalance=PLANES), duty=Duty(speed=2400 * rpm, balance_grade="G16"))
    places = [0.0, 300.0, 1200.0]
    (many,) = check(base, only=["balance"], vary={"shafts[1].unbalance[0].position_mm": places})
    for place, value, used in zip(places, many.value, many.utilisation, strict=True):
        moved = replace(
            base, shafts=(drive(unbalance=(replace(PLANES[0], position=place * mm), *PLANES[1:])).shafts[1],)
        )
        assert (value, used) == pytest.approx(
            (balance(moved).shafts[0].worst.unbalance, check(moved, only=["balance"])[0].utilisation)
        )


def test_the_fastest_part_of_the_duty_counts():
    blocks = (Block(torque=1.0, speed=50.0, share=0.5), Block(torque=1.0, speed=260.0, share=0.5))
    assert balance(drive(), Duty(speed=100.0, blocks=blocks)).speed == 260.0
    assert balance(drive(), Duty(speed=100.0, speed_range=(0.0, 300.0))).speed == 300.0


def test_what_is_missing_or_unknown_is_named():
    bare = Drive.from_angles([0.1, 0.1])
    assert balance(bare, Duty(speed=100.0)).shafts[0].missing == ("shafts[1].mass",)
    short = replace(
        bare, shafts=(Shaft(number=2, mass=3.0, unbalance=PLANES),), duty=Duty(speed=100.0, balance_grade="G16")
    )
    assert (balance(short).balanced, balance(short).shafts[0].missing) == (None, ("shafts[1].length",))
    assert check(short, only=["balance"])[0].missing == ("shafts[1].length",)
    with pytest.raises(InputError, match=r"duty\.speed: missing"):
        balance(bare)
    with pytest.raises(InputError, match=r"the nearest .*G16"):
        balance(drive(), grade="G17")
