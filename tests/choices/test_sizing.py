"""Sizes: at their limit by the checks, by closed forms where there are any, and no smaller one passes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, example
from cardan.answers.data import data
from cardan.answers.reader import USUAL
from cardan.catalogue import catalogue, completed
from cardan.catalogue.rows import JointSize
from cardan.checks import check
from cardan.checks.strength.strength import strength
from cardan.choices.size_search import CHECKS, R20, R40, round_up
from cardan.choices.sizing import size
from cardan.choices.sizing_answer import answer
from cardan.choices.trade_off import trade_off
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Duty, Limits
from cardan.drive.fields.paths import with_values
from cardan.drive.joint_parts import Needles
from cardan.drive.material import Material
from cardan.drive.shaft import Layup, Ply, Segment, Shaft
from cardan.formulas.shaft_strength import shaft_diameter
from cardan.io import dumps, loads
from cardan.io.edit import edit
from cardan.units import deg, hour, mm, rpm

C45 = Material(grade="C45")


def drive(**changes):
    cross = Cross(span=80 * mm, journal=20 * mm, bending_arm=10 * mm, journal_bore=3 * mm, material=C45)
    joints = tuple(
        replace(joint, cross=cross, needles=Needles(capacity=20e3))
        for joint in Drive.from_angles([14 * deg, 14 * deg]).joints
    )
    tube = Shaft(number=2, outer=70 * mm, wall=3 * mm, length=1.1, material=C45)
    duty = Duty(speed=1800 * rpm, torque=900.0, shock_factor=1.25, life=3000 * hour)
    return replace(Drive(joints=joints, shafts=(tube,), duty=duty), **changes)


def worst(whole, part, subject):
    return max(
        (v for v in check(whole, only=CHECKS[part]) if v.subject in ("", subject) and v.run and not v.advice),
        key=lambda v: float(v.utilisation),
    )


def test_a_tube_that_whirls_first_sits_at_its_critical_speed():
    long = drive(shafts=(Shaft(number=2, outer=70 * mm, wall=2 * mm, length=1.9, material=C45),))
    found = size(long, None, "tube:2", hold="wall")
    assert found.governing.check == "critical_speed"
    assert float(found.governing.utilisation) == pytest.approx(1.0, rel=1e-9)
    alone = 0.25 * math.sqrt(206e9 / 7850) * (math.pi / 1.9) ** 2  # of a slender tube, over √(D² + d²)
    outer = 1e-3 * found.exact["shafts[1].outer_mm"]
    assert alone * math.hypot(outer, outer - 0.004) == pytest.approx(1800 * rpm / 0.7, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("part", "hold", "subject"),
    [
        ("tube:2", "ratio", "shafts[1]"),
        ("tube:2", "wall", "shafts[1]"),
        ("tube:2", "outer", "shafts[1]"),
        ("shaft:2", "ratio", "shafts[1]"),
        ("journal:1", "ratio", "joints[0]"),
        ("journal:2", "ratio", "joints[1]"),
        ("needles:2", "ratio", "joints[1]"),
    ],
)
def test_a_sized_part_sits_exactly_at_its_limit(part, hold, subject):
    base = drive(limits=Limits(critical_speed=1.2))
    found = size(base, None, part, hold=hold)
    kind = part.partition(":")[0]
    start = found.drive
    at = worst(with_values(start, found.exact), kind, subject)
    assert float(at.utilisation) == pytest.approx(1.0, rel=1e-9)
    assert float(at.utilisation) <= 1.0
    smaller = {name: value * (1 - 1e-6) for name, value in found.exact.items()}
    assert float(worst(with_values(start, smaller), kind, subject).utilisation) > 1.0
    assert float(worst(start, kind, subject).utilisation) <= 1.0
    assert all(found.values[name] >= found.exact[name] * (1 - 1e-9) for name in found.exact)
    assert found.governing.title == at.title


def test_the_diameter_for_a_shear_stress_is_the_closed_form():
    """Largest shear stress: Book (261) solved for D by hand, D = [16 M/(π τ (1 - k⁴))]^(1/3), M = 1.25·900/cos 14°."""
    base = drive(limits=Limits(shear_stress=60e6, fatigue_safety=1.0, twist=1.0, critical_speed=0.01))
    soft = replace(base, shafts=(replace(base.shafts[1], material=None),), duty=replace(base.duty, life=None))
    found = size(soft, None, "tube:2")
    moment = 1.25 * 900.0 / math.cos(14 * deg)
    by_hand = (16 * moment / (math.pi * 60e6 * (1 - (64 / 70) ** 4))) ** (1 / 3)
    assert found.exact["shafts[1].outer_mm"] == pytest.approx(1e3 * by_hand, rel=1e-7)
    assert by_hand == pytest.approx(float(shaft_diameter(moment, 60e6, 64 / 70)), rel=1e-12)
    assert found.governing.check == "tube_strength"
    assert "shafts[1].material.ultimate_strength" in found.skipped


def test_the_journal_is_the_root_of_its_quartic():
    """σ = 32 Q e d/(π(d⁴ - d0⁴)) = 355/1.5 MPa: d⁴ - 32 Q e/(π σ) d - d0⁴ = 0."""
    found = size(drive(), None, "journal:2")
    force = 1.25 * 900.0 / math.cos(14 * deg) / 0.080
    roots = np.roots([1.0, 0.0, 0.0, -32 * force * 0.010 / (math.pi * 355e6 / 1.5), -(0.003**4)])
    by_hand = max(root.real for root in roots if abs(root.imag) < 1e-12)
    assert found.exact["joints[1].cross.journal_mm"] == pytest.approx(1e3 * by_hand, rel=1e-7)


def test_a_journal_is_not_made_too_small_for_its_needles():
    needles = Needles(count=30, diameter=2.5 * mm, length=12 * mm)
    joints = tuple(replace(j, cross=replace(j.cross, journal=24 * mm), needles=needles) for j in drive().joints)
    found = size(drive(joints=joints, duty=Duty(torque=20.0)), None, "journal:1")
    touching = 2.5 * (1 / math.sin(math.pi / 30) - 1)
    assert found.exact["joints[0].cross.journal_mm"] == pytest.approx(touching, rel=1e-8)


def test_the_capacity_for_a_life_is_the_tenth_root_law():
    base = drive()
    found = size(base, None, "needles:1")
    from cardan.questions.life.life import life

    now = float(life(base).of("iso")[0])
    assert found.exact["joints[0].needles.capacity_N"] == pytest.approx(20e3 * (3000 * hour / now) ** 0.3, rel=1e-9)
    force = 1.25 * 900.0 / math.cos(14 * deg) / 0.080  # of joint 1: torque of shaft 1 is that of shaft 3
    assert found.exact["joints[0].needles.static_capacity_N"] == pytest.approx(force, rel=1e-7)


@pytest.mark.slow
def test_the_smallest_row_of_the_catalogue_passes_and_no_smaller_one_does():
    base = drive(duty=Duty(speed=1200 * rpm, torque=600.0, life=1000 * hour))
    found = size(base, None, "joint")
    row = found.values["joints[0].size"]
    assert found.values == {"joints[0].size": row, "joints[1].size": row}
    passing = [one.id for one in found.tried if one.passed]
    assert passing[0] == row
    rows = catalogue().rows(JointSize)
    spaces = [rows[one.id].space for one in found.tried]
    assert spaces == sorted(spaces)
    assert {one.id for one in found.tried} == {one.id for one in rows.values() if one.confidence != "made_up"}
    for one in (one for one in found.tried if rows[one.id].cross is not None):
        joints = tuple(replace(j, cross=None, needles=None, size=one.id) for j in base.joints)
        mine = strength(replace(base, joints=joints))
        own = max(u.utilisation for u in mine.binding if u.subject.startswith("joints"))
        assert own <= one.utilisation + 1e-9  # the checks of a maker's ratings come on top
        assert not one.passed or own <= 1.0
    assert found.drive == completed(found.drive)


@pytest.mark.slow
def test_no_row_is_large_enough():
    found = size(drive(duty=Duty(speed=1200 * rpm, torque=1e6)), None, "joint:1")
    assert not found.found
    assert len(found.tried) == sum(one.confidence != "made_up" for one in catalogue().rows(JointSize).values())


def test_a_joint_of_a_series_is_offered_its_series_and_rows_of_the_user():
    base = drive(duty=Duty(speed=1200 * rpm, torque=600.0, life=1000 * hour))
    joints = tuple(replace(j, cross=None, needles=None, size="example-90") for j in base.joints)
    found = size(replace(base, joints=joints), None, "joint")
    assert {catalogue().rows(JointSize)[one.id].series for one in found.tried} == {"example"}


@pytest.mark.slow
def test_a_size_whose_life_nobody_can_tell_is_not_taken_where_a_life_is_asked():
    found = size(drive(duty=Duty(speed=1200 * rpm, torque=600.0, life=1000 * hour)), None, "joint")
    bare = [one for one in found.tried if one.id.startswith("ml-")]
    assert bare
    assert not any(one.passed for one in bare)
    short = size(drive(duty=Duty(speed=1200 * rpm, torque=600.0)), None, "joint")
    assert any(one.passed for one in short.tried if one.id.startswith("ml-"))


@pytest.mark.slow
def test_a_size_whose_torque_nobody_can_tell_is_not_taken():
    found = size(Drive.from_angles([0.05, 0.05]), Duty(speed=50.0, torque=900.0), "joint")
    rows = catalogue().rows(JointSize)
    bare = [one for one in found.tried if one.unknown]
    assert {"din808-16-6", "spicer-1330"} <= {one.id for one in bare}  # limits of speed alone, or of their type
    assert not any(one.passed for one in bare)
    assert all(rows[one.id].rating is None or rows[one.id].rating.max_torque is None for one in bare)
    assert rows[found.values["joints[0].size"]].rating.max_torque > 900.0
    told = {row["size"]: row["worst"] for row in data(answer(found.drive, found), USUAL)["tried"]}
    assert told["din808-16-6"] == "not judged: no torque rating"


def test_a_composite_tube_is_sized_against_buckling():
    layup = Layup(
        angles=(45 * deg, -45 * deg) * 3,
        ply_thickness=0.3 * mm,
        ply=Ply(along=135e9, across=10e9, shear=5e9),
    )
    shafts = (Shaft(number=2, outer=90 * mm, length=1.1, layup=layup),)
    found = size(drive(shafts=shafts), None, "tube:2", hold="outer")
    assert list(found.exact) == ["shafts[1].layup.ply_thickness_mm"]
    at = check(with_values(found.drive, found.exact), only=CHECKS["tube"])
    assert max(float(v.utilisation) for v in at if v.run and v.subject in ("", "shafts[1]")) == pytest.approx(
        1.0, rel=1e-9
    )


@pytest.mark.slow
def test_a_duty_cycle_is_sized_by_its_heaviest_part():
    blocks = (Block(torque=400.0, speed=100.0, share=0.5), Block(torque=950.0, speed=100.0, share=0.5))
    both = size(drive(duty=Duty(blocks=blocks)), None, "shaft:2")
    heavy = size(drive(duty=Duty(torque=950.0, speed=100.0)), None, "shaft:2")
    assert both.exact == pytest.approx(heavy.exact, rel=1e-9)


@pytest.mark.parametrize(
    ("part", "changes", "field"),
    [
        ("tub", {}, "part"),
        ("tube:3x", {}, "part"),
        ("joint:3", {}, "part"),
        ("journal", {}, "part"),
        ("tube:2", {"shafts": (Shaft(number=2, outer=70 * mm, length=1.0),)}, "shafts[1].material.yield_strength"),
        ("tube:2", {"duty": Duty(speed=10.0)}, "duty.torque"),
        ("joint", {"duty": Duty(speed=10.0)}, "duty.torque"),
    ],
)
def test_what_cannot_be_sized_says_why(part, changes, field):
    with pytest.raises(InputError) as caught:
        size(drive(**changes), None, part)
    assert field in {problem.field for problem in caught.value.problems}


def test_no_wall_is_thick_enough():
    with pytest.raises(InputError, match="no size passes"):
        size(drive(duty=Duty(torque=1e6)), None, "tube:2", hold="outer")


def test_preferred_numbers_are_those_of_the_standard():
    """ISO 3: rounded powers of the 20th and 40th root of ten, at most 1.3 % off."""
    for row in (R20, R40):
        exact = 10.0 ** (np.arange(len(row)) / len(row))
        np.testing.assert_allclose(row, exact, rtol=0.0131)
    assert [round_up(x, step=1.0, series="R20") for x in (9.01, 90.5, 100.0, 0.0331)] == [10.0, 100.0, 100.0, 0.0355]
    assert [round_up(x, step=0.5) for x in (18.0, 18.01, 17.5000000000001)] == [18.0, 18.5, 17.5]
    assert round_up(12345.0, step=100.0) == 12400.0


@pytest.mark.slow
def test_the_trade_off_is_what_the_checks_say_one_by_one():
    base = drive(duty=Duty(torque=900.0, speed=2500 * rpm))
    found = trade_off(base, None, 2, outer=np.asarray([50, 70, 90]) * mm, wall=np.asarray([1.5, 3.0, 30.0]) * mm)
    for i, outer in enumerate((50, 70, 90)):
        for j, wall in enumerate((1.5, 3.0, 30.0)):
            if 2 * wall > outer:
                assert math.isnan(found.mass[i, j])
                assert not found.passes[i, j]
                continue
            one = with_values(base, {"shafts[1].outer_mm": outer, "shafts[1].wall_mm": wall})
            verdicts = [v for v in check(one, only=CHECKS["tube"]) if v.run]
            used = max(v.utilisation for v in verdicts if v.check != "critical_speed")
            assert found.utilisation[i, j] == pytest.approx(used, rel=1e-9)
            assert found.passes[i, j] == all(v.passed for v in verdicts)
            ratio = next(v.value for v in verdicts if v.check == "critical_speed" and v.sense == "at_least")
            # many at once, the critical speed of the line goes with that of the slender shaft
            assert found.critical[i, j] == pytest.approx(ratio * 2500 * rpm, rel=1e-2)
            area = math.pi / 4 * (outer**2 - (outer - 2 * wall) ** 2) * mm**2
            assert found.mass[i, j] == pytest.approx(7850.0 * area * 1.1, rel=1e-12)
    assert found.now[0] == 0.07
    assert found.needed == pytest.approx(1.6 * 2500 * rpm)


def test_no_tube_of_the_front_is_beaten():
    found = trade_off(drive(duty=Duty(torque=900.0, speed=2500 * rpm)), None, 2)
    assert np.any(found.best)
    assert np.all(found.passes[found.best])
    best = [table[found.best] for table in (found.mass, found.utilisation, -found.critical)]
    every = [table[found.passes] for table in (found.mass, found.utilisation, -found.critical)]
    for point in zip(*best, strict=True):
        beaten = np.all([column <= value for column, value in zip(every, point, strict=True)], axis=0)
        truly = np.any([column < value for column, value in zip(every, point, strict=True)], axis=0)
        assert not np.any(beaten & truly)
    assert found.lightest[2] == np.min(found.mass[found.passes])


def stepped():
    stretches = (
        Segment(length=0.2, outer=40 * mm, material=C45),
        Segment(length=0.9, outer=60 * mm, inner=52 * mm, material=C45),
    )
    return drive(shafts=(Shaft(number=2, length=1.1, segments=stretches),), limits=Limits(critical_speed=0.5))


def test_a_stepped_shaft_is_sized_in_proportion():
    base = stepped()
    found = size(base, None, "tube:2")
    now = {"segments[0].outer": 40.0, "segments[1].outer": 60.0, "segments[1].inner": 52.0}
    shares = {found.exact[f"shafts[1].{name}_mm"] / value for name, value in now.items()}
    assert max(shares) == pytest.approx(min(shares), rel=1e-12)
    at = worst(with_values(base, found.exact), "tube", "shafts[1]")
    assert float(at.utilisation) == pytest.approx(1.0, rel=1e-9)
    assert float(worst(found.drive, "tube", "shafts[1]").utilisation) <= 1.0
    assert found.values["shafts[1].segments[1].inner_mm"] <= found.exact["shafts[1].segments[1].inner_mm"]
    full = size(base, None, "shaft:2")
    assert full.values["shafts[1].segments[1].inner_mm"] is None
    assert [one.inner for one in with_values(base, full.values).shafts[1].segments] == [0.0, 0.0]
    with pytest.raises(InputError, match="ratio alone"):
        size(base, None, "tube:2", hold="wall")


@pytest.mark.slow
@pytest.mark.parametrize("part", ["tube:2", "shaft:2"])
@pytest.mark.parametrize("hold", ["ratio", "wall", "outer"])
@pytest.mark.parametrize("body", [{"wall": 3 * mm}, {"inner": 64 * mm}, {}])
def test_the_sizes_put_into_the_file_are_those_of_the_part(part, hold, body):
    """Whatever the file gives beside the outer diameter: nothing of it is left to make another part of it."""
    base = drive(
        shafts=(Shaft(number=2, outer=70 * mm, length=1.1, material=C45, **body),), limits=Limits(critical_speed=0.5)
    )
    found = size(base, None, part, hold=hold)
    text = dumps(base)
    for whole in (with_values(base, found.values), loads(edit(text, found.values))):
        for a, b in zip(check(whole, only=CHECKS["tube"]), check(found.drive, only=CHECKS["tube"]), strict=True):
            assert (a.title, a.utilisation) == (b.title, pytest.approx(b.utilisation, rel=1e-9))


@pytest.mark.slow
def test_only_cross_joints_are_sized():
    mixed = example("propshaft-with-rzeppa")
    assert set(size(mixed, None, "joint").values) == {"joints[0].size", "joints[2].size"}
    for part in ("joint:2", "journal:2", "needles:2"):
        with pytest.raises(InputError, match="only cross joints are sized"):
            size(mixed, None, part)
