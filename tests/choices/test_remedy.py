from collections.abc import Callable
from dataclasses import replace
from functools import cache

import pytest

from cardan import Drive, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.catalogue import completed
from cardan.checks import Verdict, check
from cardan.choices.remedy import Remedy, apply_remedy, most_helpful, remedies
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Duty, Limits
from cardan.drive.joint_parts import Needles, Rating
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft, Spline, Unbalance
from cardan.io import dumps, loads
from cardan.io.edit import edit
from cardan.units import deg, hour, mm, rpm


def car(**duty: object) -> Drive:
    spline = Spline(
        teeth=16, outer=38 * mm, root=33 * mm, tooth_width=3.5 * mm, length=40 * mm, engaged=60 * mm, gap=30 * mm
    )
    tube = Shaft(
        number=2,
        outer=60 * mm,
        wall=1.5 * mm,
        material=Material(grade="C22"),
        spline=spline,
        unbalance=(Unbalance(position=0.1, amount=3e-4),),
    )
    drive = Drive.from_points([(-0.25, 0, 0), (0, 0, 0), (1.25, 0, -0.07), (1.5, 0, -0.05)])
    joints = tuple(replace(joint, size="example-58") for joint in drive.joints)
    use = {"speed": 2800 * rpm, "torque": 520.0, "life": 3000 * hour, "balance_grade": "G16", **duty}
    return completed(
        replace(
            drive,
            joints=joints,
            shafts=(tube,),
            duty=Duty(**use),
            limits=Limits(speed_fluctuation=0.001, spline_pressure=60e6),
        )
    )


def plain() -> Drive:
    """Joints whose sizes stand in the file, given by angles."""
    cross = Cross(span=60 * mm, journal=15 * mm, bending_arm=10 * mm, material=Material(yield_strength=500e6))
    needles = Needles(count=24, diameter=2.0 * mm, length=10 * mm)
    rating = Rating(torque=800.0, max_torque=1200.0, max_joint_angle=20 * deg, speed_angle=9000 * rpm * deg)
    drive = Drive.from_angles([22 * deg, 17 * deg])
    joints = tuple(replace(joint, cross=cross, needles=needles, rating=rating) for joint in drive.joints)
    tube = Shaft(number=2, outer=50 * mm, wall=2 * mm, length=1.6, material=Material(grade="45"))
    blocks = (Block(torque=900.0, speed=800 * rpm, share=0.5), Block(torque=1500.0, speed=300 * rpm, share=0.5))
    return replace(drive, joints=joints, shafts=(tube,), duty=Duty(life=1000 * hour, shock_factor=1.2, blocks=blocks))


def running_at_half() -> Drive:
    tube = Shaft(number=2, outer=76 * mm, inner=72 * mm, length=1.5)
    return replace(Drive.from_angles([3 * deg, 3 * deg]), shafts=(tube,), duty=Duty(speed=2835 * rpm))


@cache
def solved(make: Callable[[], Drive]) -> tuple[Drive, tuple[Verdict, ...], tuple[Remedy, ...]]:
    drive = make()
    verdicts = check(drive)
    return drive, verdicts, remedies(drive, verdicts)


@pytest.mark.slow
@pytest.mark.parametrize("make", [car, plain, running_at_half])
def test_every_cure_lets_its_check_pass_and_the_file_edited_says_the_same(make):
    drive, verdicts, found = solved(make)
    failed = [one for one in verdicts if one.state == "failed" and not one.advice]
    assert failed
    text = dumps(drive)
    for remedy in found:
        for new in (apply_remedy(drive, remedy), loads(edit(text, {remedy.path: remedy.value}))):
            after = next(one for one in check(new, only=[remedy.check]) if one.title == remedy.title)
            assert after.state in ("passed", "close", "unconfirmed"), remedy
    assert {one.title for one in failed} - {remedy.title for remedy in found} == set()


@pytest.mark.slow
@pytest.mark.parametrize("make", [car, plain])
def test_a_cure_is_the_smallest_round_change(make):
    """Half the way does not do; where the change has only a few steps, one step less does not."""
    drive, _verdicts, found = solved(make)
    for remedy in found[::2]:
        if isinstance(remedy.value, str) or remedy.unit == "":
            continue
        less = replace(remedy, value=remedy.now + 0.5 * (remedy.value - remedy.now))
        after = next(one for one in check(apply_remedy(drive, less), only=[remedy.check]) if one.title == remedy.title)
        assert after.state == "failed" or abs(remedy.value - remedy.now) < 0.03 * abs(remedy.now) + 2.0, remedy


@pytest.mark.slow
def test_what_a_cure_solves_and_breaks_is_what_happens():
    drive, verdicts, found = solved(car)
    before = {one.title: one.state for one in verdicts if one.run and not one.advice}
    for remedy in found[::4]:
        after = {one.title: one.state for one in check(apply_remedy(drive, remedy)) if one.run and not one.advice}
        mended = {title for title, state in before.items() if state == "failed" and after[title] != "failed"}
        broken = {title for title, state in before.items() if state != "failed" and after[title] == "failed"}
        assert set(remedy.solves) == mended, remedy
        assert set(remedy.breaks) == broken, remedy


@pytest.mark.slow
def test_a_joint_of_a_series_becomes_the_next_size_that_does():
    _drive, _verdicts, found = solved(car)
    sizes = [remedy for remedy in found if remedy.path == "joints[0].size"]
    assert sizes
    assert all(remedy.value in ("example-75", "example-90", "example-120") for remedy in sizes)
    assert not any("cross" in remedy.path or "needles" in remedy.path for remedy in found)


@pytest.mark.slow
def test_a_stronger_material_is_named():
    drive = car(torque=780.0)
    found = remedies(drive, check(drive, only=["tube_strength"]))
    assert [remedy.value for remedy in found if remedy.path == "shafts[1].material.grade"] == ["12KhMF"]
    own = replace(drive, shafts=(*drive.shafts[:1], replace(drive.shafts[1], material=Material(yield_strength=200e6))))
    asked = [remedy for remedy in remedies(own, check(own, only=["tube_strength"])) if "yield_strength" in remedy.path]
    assert asked[0].value == 260.0
    assert asked[0].note == "12KhMF"


@pytest.mark.slow
def test_the_most_helpful_changes_come_first_and_ask_no_less_of_the_drive():
    _drive, _verdicts, found = solved(car)
    best = most_helpful(found)
    assert 1 <= len(best) <= 3
    assert not any(remedy.demand for remedy in best)
    for remedy in best[:1]:
        assert len(remedy.solves) - len(remedy.breaks) == max(
            len(one.solves) - len(one.breaks) for one in found if not one.demand
        )


def test_a_drive_that_passes_needs_no_cure():
    assert remedies(replace(Drive.from_angles([0.1, 0.1]), duty=Duty(speed=100.0))) == ()


@pytest.mark.slow
def test_what_fails_only_in_a_pose_while_moving_is_cured_where_one_key_can():
    """The poses set where the axle is, so that only the other joint can be moved."""
    drive = example("truck-rear-axle")
    drive = replace(drive, limits=replace(drive.limits, joint_angle=9 * deg))
    verdicts = check(drive)
    failed = [one for one in verdicts if one.check == "joint_angle" and one.state == "failed"]
    assert {told(one.note, USUAL) for one in failed} == {
        f"while the drive moves, at {time} s; in the pose empty" for time in ("0.437", "0.371")
    }
    found = [remedy for remedy in remedies(drive, [one for one in verdicts if one.check == "joint_angle"])]
    assert {one.title for one in failed} == {remedy.title for remedy in found}
    for remedy in found:
        after = next(
            one for one in check(apply_remedy(drive, remedy), only=["joint_angle"]) if one.title == remedy.title
        )
        assert after.state in ("passed", "close", "unconfirmed"), remedy


@pytest.mark.slow
def test_a_search_of_cures_tells_how_far_it_is_and_can_be_stopped():
    drive, verdicts, found = solved(plain)
    told = []
    part = remedies(drive, verdicts, progress=lambda share: told.append(share) or "stop")
    assert 0.0 < told[0] < 1.0
    first = next(one.check for one in verdicts if one.state == "failed" and not one.advice)
    assert part == tuple(one for one in found if one.check == first)


@pytest.mark.parametrize(("limit", "value"), [(0.005, 3.0), (0.03, 18.0), (0.002, None)])
def test_a_yoke_on_a_spline_is_turned_from_tooth_to_tooth(limit: float, value: float | None) -> None:
    """24 teeth at 33°: 18° and 3° exist, 8° does not; where no tooth is good enough, the yoke is no remedy."""
    tube = Shaft(number=2, yoke_angle=33 * deg, length=0.8, spline=Spline(teeth=24))
    drive = replace(
        Drive.from_angles([12 * deg, 12 * deg]), shafts=(tube,), limits=Limits(speed_fluctuation=limit), duty=Duty()
    )
    free = replace(drive, shafts=(replace(tube, spline=None),))

    def turned(one: Drive) -> list[float]:
        found = remedies(one, check(one, only=["speed_fluctuation"]))
        return [float(each.value) for each in found if each.path == "shafts[1].yoke_angle_deg"]

    assert turned(drive) == ([] if value is None else [value])
    assert turned(free)
    assert turned(free) != turned(drive)
