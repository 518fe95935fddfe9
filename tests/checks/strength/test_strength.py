"""Strength of whole drives: by hand, against the checks, against statics, and by loading a drive with its rating."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, example, forces
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.catalogue import completed
from cardan.checks import check
from cardan.checks.strength.answer import answer
from cardan.checks.strength.strength import STRENGTH, strength
from cardan.drive.cross import Cross
from cardan.drive.duty import Block, Duty, Harmonic, History, Limits
from cardan.drive.joint_parts import Needles, Section, Yoke
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.models.kinematics_model import chain
from cardan.drive.shaft import Layup, Notch, Ply, PointMass, Segment, Shaft, Spline
from cardan.maths.kernel import mobius
from cardan.questions.forces.turn_loads import turn_loads
from cardan.units import deg, hour, mm, rpm

STEEL = Material(yield_strength=355e6, ultimate_strength=600e6)


def hand_drive():
    """Two joints of 12°, mirrored yokes in one plane, and a tube 76 × 3: everything can be checked by hand."""
    cross = Cross(span=80 * mm, journal=18 * mm, journal_bore=4 * mm, bending_arm=9 * mm, material=STEEL)
    needles = Needles(count=22, diameter=2.5 * mm, length=14 * mm)
    yoke = Yoke(
        bending_arm=25 * mm,
        torsion_arm=10 * mm,
        section=Section(shape="ellipse", height=30 * mm, width=20 * mm),
        material=STEEL,
    )
    joint = Hooke(joint_angle=12 * deg, cross=cross, needles=needles, yoke=yoke)
    spline = Spline(teeth=8, outer=46 * mm, root=40 * mm, tooth_width=8 * mm, length=70 * mm)
    tube = Shaft(number=2, outer=76 * mm, wall=3 * mm, length=1.2, material=STEEL, spline=spline)
    return replace(
        Drive(joints=(joint, joint), shafts=(tube,)),
        duty=Duty(speed=1500 * rpm, torque=700.0, shock_factor=1.2, life=1000 * hour),
        limits=Limits(spline_pressure=60e6),
    )


def use(found, check_name, part="", title=""):
    (one, *_more) = [u for u in found.verdicts if u.check == check_name and part in u.subject and title in u.title]
    return one


def test_the_torque_rating_of_a_whole_drive_by_hand():
    """Every number with pencil and pocket calculator; torque at the output, one angle, shocks 1.2."""
    found = strength(hand_drive())
    tangent, cosine = math.tan(12 * deg), math.cos(12 * deg)
    # Shaft 2 turns between cos α and 1/cos α of the output; its torque is the largest where it turns slowest.
    torque = 700.0 / cosine
    assert found.shafts[1].torque == pytest.approx(1.2 * torque, rel=1e-9)
    assert found.shafts[0].torque == pytest.approx(1.2 * 700.0, rel=1e-9)  # equal joints undo each other
    # Couple of a cross: at joint 2 the output has 700 N·m always, K = 700/cos α where the journals stand askew.
    assert found.joints[1].couple == pytest.approx(1.2 * torque, rel=1e-7)
    assert found.joints[1].journal_force == pytest.approx(1.2 * torque / 0.080, rel=1e-7)
    # The tube: at joint 2 torque 700·s², couple M tan α |sin φ| ... largest √(4M² + 3T²) where T is largest.
    resisting = math.pi * (0.076**4 - 0.070**4) / (16 * 0.076)
    one = use(found, "tube_strength")
    phi = np.linspace(0, math.pi, 100_001)
    rising = 1.0 / (cosine + math.sin(12 * deg) ** 2 / cosine * np.cos(phi) ** 2)  # T_2/T_3 = ω_3/ω_2 over a turn
    assert rising.max() == pytest.approx(1 / cosine, rel=1e-9)
    assert one.value >= 1.2 * math.sqrt(3.0) * torque / resisting * (1 - 1e-12)
    assert one.value <= 1.2 * math.hypot(2 * 700.0 * tangent, math.sqrt(3.0) * torque) / resisting
    assert one.limit == pytest.approx(355e6 / 1.5)
    # Journal 18 with bore 4: σ = 32 Q e d/(π(d⁴ - d0⁴)).
    force = 1.2 * torque / 0.080
    bent = 32 * force * 0.009 * 0.018 / math.pi / (0.018**4 - 0.004**4)
    assert use(found, "journal_strength", "joints[1]").value == pytest.approx(bent, rel=1e-7)
    # Yoke: W_b = π b h²/32, W_t = π h b²/16.
    bending, shear = (
        32 * force * 0.025 / (math.pi * 0.020 * 0.030**2),
        16 * force * 0.010 / (math.pi * 0.030 * 0.020**2),
    )
    yoke = use(found, "yoke_strength", "joints[1]")
    assert yoke.value == pytest.approx(math.sqrt(bending**2 + 3 * shear**2), rel=1e-7)
    # Needles: C0 = 44(1 - γ) z L D, γ = 2.5/20.5.
    at_rest = use(found, "needle_static", "joints[1]")
    assert at_rest.limit == pytest.approx(44 * (1 - 2.5 / 20.5) * 22 * 14 * 2.5, rel=1e-9)
    assert at_rest.value == pytest.approx(force, rel=1e-7)
    # Spline: force on each of 6 carrying teeth 2T/(43 mm·6), flank 3 × 70 mm.
    press = use(found, "spline_pressure")
    assert press.value == pytest.approx(2 * 1.2 * torque / 0.043 / 6 / (0.003 * 0.070), rel=1e-7)
    core = use(found, "spline_strength", title="core")
    assert core.value == pytest.approx(math.sqrt(3) * 16 * 1.2 * torque / math.pi / 0.040**3, rel=1e-7)
    # Twist without shocks: T l/(G J), G = E/2.6 where it is not given.
    polar = math.pi * (0.076**4 - 0.070**4) / 32
    assert use(found, "twist").value == pytest.approx(torque * 1.2 / (206e9 / 2.6 * polar), rel=1e-7)
    # The rating is that of the part that ends first.
    first = found.governing
    assert first is min(found.binding, key=lambda u: u.torque_factor)
    assert found.rated_torque == pytest.approx(700.0 * min(u.torque_factor for u in found.binding), rel=1e-12)


def test_a_drive_loaded_with_its_rating_is_just_at_its_limit():
    drive = hand_drive()
    rated = strength(drive).rated_torque
    at = strength(drive, replace(drive.duty, torque=rated))
    # lives are integrals that rest at 1e-10
    assert at.utilisation == pytest.approx(1.0, rel=1e-8)
    assert at.torque_factor == pytest.approx(1.0, rel=1e-8)
    for one, before in zip(at.judged, strength(drive).judged, strict=True):
        if one.check == "bearing_life" and one is not at.governing:
            continue  # by the power of the torque alone; masses count as well
        assert one.torque_factor * rated == pytest.approx(700.0 * before.torque_factor, rel=1e-8), one.title


def shaken():
    """The stand that is unstable at 1340 rpm, beside its zone: what its joint makes of the torque stays."""
    drive = example("unstable-drive")
    return replace(drive, duty=replace(drive.duty, speed=1290 * rpm))


@pytest.mark.parametrize(
    ("name", "torque"),
    [
        ("shaken", 60.0),  # vibration that joints make: four times the torque, twice as much at the rating
        ("shaken", 1000.0),  # too weak: the rating lies below the torque
        pytest.param("pto-baler", 150.0, marks=pytest.mark.slow),  # vibrates while it turns on the headland alone
        pytest.param("pto-flywheel", 300.0, marks=pytest.mark.slow),  # backlash that opens under little torque
    ],
)
def test_a_drive_that_vibrates_is_at_its_limit_under_its_rating(name, torque):
    drive = shaken() if name == "shaken" else example(name)
    found = strength(drive, replace(drive.duty, torque=torque))
    at = strength(drive, replace(drive.duty, torque=found.rated_torque))
    # the rating lies on a chord at most 5 % long
    assert at.utilisation == pytest.approx(1.0, rel=2e-3)
    assert at.rated_torque == pytest.approx(found.rated_torque, rel=2e-3)
    if not name.endswith("baler"):  # whose drawn position does not vibrate
        assert found.vibration.factor > 1.05
    # a torque in proportion would be another one
    plain = found.torque / found.utilisation
    assert abs(plain / found.rated_torque - 1.0) > 0.03


def test_a_drive_that_vibration_alone_breaks_has_no_rating():
    drive = shaken()
    weak = replace(drive, limits=Limits(twist=0.5 * deg))
    found = strength(weak)
    assert strength(weak, replace(drive.duty, torque=1e-3)).utilisation > 1.0
    assert found.rated_torque == 0.0
    assert found.governing.check == "twist"
    assert "even without load" in told(answer(weak, found).sentence, USUAL)


def everything():
    """A drive in space with a duty cycle and all that can be judged."""
    drive = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.9, 0.02, -0.2), (2.1, 0.06, -0.3), (2.4, 0.06, -0.4)])
    cross = Cross(span=90 * mm, journal=20 * mm, journal_length=18 * mm, material=Material(grade="20Kh"))
    joints = tuple(replace(one, cross=cross) for one in drive.joints)
    joints = (replace(joints[0], size="example-90", cross=replace(cross, journal=22 * mm)), *joints[1:])
    plies = Ply(along=135e9, across=10e9, shear=5e9)
    layup = Layup(angles=(45 * deg, -45 * deg) * 4, ply_thickness=0.4 * mm, ply=plies)
    stubs = (
        Segment(length=0.2, outer=45 * mm, material=Material(grade="C45")),
        Segment(length=0.72224, outer=70 * mm, inner=64 * mm, material=Material(grade="C22")),
    )
    return completed(
        replace(
            drive,
            joints=joints,
            shafts=(
                Shaft(number=2, segments=stubs, yoke_angle=0.2, notch=Notch(bending=1.4, torsion=1.2)),
                Shaft(number=3, outer=90 * mm, layup=layup),
            ),
            duty=Duty(
                speed=2000 * rpm,
                torque=500.0,
                shock_factor=1.3,
                life=2000 * hour,
                blocks=(
                    Block(torque=300.0, speed=1800 * rpm, share=0.7),
                    Block(torque=900.0, speed=900 * rpm, share=0.3, joint_angle=5 * deg),
                ),
            ),
        )
    )


@pytest.mark.parametrize("drive", [hand_drive(), everything()], ids=["two joints", "in space"])
def test_strength_is_the_verdicts_of_the_checks(drive):
    found = strength(drive)
    verdicts = check(drive, only=tuple(one.name for one in STRENGTH))
    shown = {(one.check, one.title): one for one in found.verdicts}
    for one in verdicts:
        same = shown.pop((one.check, one.title), None)
        if same is None:
            assert "book's rule" in one.title or not one.run
            continue
        assert (same.subject, same.missing, same.source) == (one.subject, one.missing, one.source)
        if one.run:
            assert (same.value, same.limit, same.utilisation) == (one.value, one.limit, one.utilisation)
    assert not shown


@pytest.mark.parametrize("at", ["output", "input"])
def test_loads_are_those_of_statics(at):
    """The balance of forces of the whole drive, position by position, with a torque that swings twice a turn."""
    swings = (Harmonic(order=2.0, torque=30.0, phase=0.7),)
    drive = Drive.from_angles([0.3, 0.5, 0.2], plane_twists=[0.4, 0.9], yoke_angles=[0.3, 1.0])
    drive = replace(drive, joints=tuple(replace(joint, cross=Cross(span=0.1)) for joint in drive.joints))
    duty = Duty(speed=10.0, torque=100.0, torque_at=at, harmonics=swings)
    found = forces(drive, duty, np.linspace(0, 2 * math.pi, 3601))
    mine = turn_loads(chain(drive), 100.0, torque_at=at, harmonics=swings, scale=100.0)
    # 3600 places a tenth of a degree apart miss a peak of order 4 by up to 3e-6 of its swing.
    np.testing.assert_allclose(mine.couple / 0.1, np.max(found.journals.size, axis=(-2, -1)), rtol=1e-6)
    np.testing.assert_allclose(mine.high, np.max(found.shaft_torque, axis=-1), rtol=1e-6)
    np.testing.assert_allclose(mine.low, np.min(found.shaft_torque, axis=-1), rtol=1e-6)
    for couple, axis, own in (
        (found.driving_couple, found.axis[:-1], mine.driving),
        (found.driven_couple, found.axis[1:], mine.driven),
    ):
        across = couple - np.sum(couple * axis, axis=-1, keepdims=True) * axis
        np.testing.assert_allclose(own, np.max(np.linalg.norm(across, axis=-1), axis=-1), rtol=3e-6)


def test_the_largest_torques_of_a_chain_are_closed_forms():
    """A chain turns like one joint of some bend α: torques swing between M cos α and M/cos α."""
    whole = chain(Drive.from_angles([0.4, 0.25, 0.3], plane_twists=[0.8, 0.3], yoke_angles=[0.5, 1.2]))
    found = turn_loads(whole, 100.0, torque_at="input")
    for k, pair in enumerate(whole.products(), start=1):
        joint_angle = float(mobius.joint_angle(pair))
        assert found.high[k] == pytest.approx(100.0 / math.cos(joint_angle), rel=2e-10)  # quartic, places 1.5° apart
        assert found.low[k] == pytest.approx(100.0 * math.cos(joint_angle), rel=2e-10)


def test_many_drives_at_once_are_the_single_ones():
    torque = np.asarray([50.0, 400.0, -100.0])
    whole = chain(Drive.from_angles([0.3, 0.2]))
    many = turn_loads(whole, torque)
    for k, one in enumerate(torque):
        single = turn_loads(whole, one)
        np.testing.assert_allclose(many.couple[k], single.couple, rtol=1e-12)
        np.testing.assert_allclose(many.high[k], single.high, rtol=1e-12)


def test_miner_s_rule_by_hand():
    """Two blocks that both break the shaft in the end: damage a second is share · turns a second / cycles."""
    drive = replace(
        Drive.from_angles([25 * deg]),
        shafts=(Shaft(number=2, outer=30 * mm, material=STEEL),),
        duty=Duty(
            blocks=(
                Block(torque=700.0, speed=1200 * rpm, share=0.25),
                Block(torque=900.0, speed=600 * rpm, share=0.75),
            )
        ),
    )
    found = strength(drive)
    lives = [
        strength(replace(drive, duty=Duty(torque=b.torque, speed=b.speed))).shafts[1].fatigue for b in drive.duty.blocks
    ]
    cycles = [float(one.cycles) for one in lives]
    assert all(math.isfinite(one) for one in cycles)
    rate = 0.25 * 20.0 / cycles[0] + 0.75 * 10.0 / cycles[1]
    assert found.shafts[1].fatigue_life == pytest.approx(1 / rate, rel=1e-9)


def test_a_measured_torque_counts_its_cycles():
    """A straight drive: nothing bends, so only the cycles of the history tire the shaft; one swing every 2 s."""
    history = History(file="x.csv", times=(0.0, 1.0, 2.0), torques=(0.0, 900.0, 0.0))
    shaft = Shaft(number=2, outer=30 * mm, material=STEEL, notch=Notch(torsion=2.0))
    drive = replace(Drive.from_angles([0.0]), shafts=(shaft,), duty=Duty(speed=600 * rpm, torque_history=history))
    found = strength(drive)
    swung = replace(drive, duty=Duty(speed=600 * rpm, torque=450.0, harmonics=(Harmonic(order=1.0, torque=450.0),)))
    cycles = float(strength(swung).shafts[1].fatigue.cycles)
    assert math.isfinite(cycles)
    assert found.shafts[1].fatigue_life == pytest.approx(2.0 * cycles, rel=1e-9)


def test_a_wall_buckles_as_timoshenko_has_it():
    """0.253 E (t/r)^1.5, the coefficient of the textbooks; the one for composites is 7 % higher."""
    tube = Shaft(number=2, outer=100 * mm, wall=0.5 * mm, length=1.0, material=STEEL)
    drive = replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,))
    found = use(strength(drive, Duty(torque=200.0)), "tube_buckling")
    radius, wall = 49.75 * mm, 0.5 * mm
    by_hand = 2 * math.pi * radius**2 * wall * 0.253 * 206e9 * (wall / radius) ** 1.5
    assert 1.5 * found.limit == pytest.approx(by_hand, rel=1e-3)  # three digits of the coefficient


def test_weight_bends_a_tube_as_handbooks_have_it():
    tube = Shaft(number=2, outer=80 * mm, wall=3 * mm, length=2.0, masses=(PointMass(position=0.5, mass=4.0),))
    drive = replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,))
    line = 7850.0 * math.pi / 4 * (0.08**2 - 0.074**2) * 9.80665
    at = np.linspace(0, 2, 200_001)
    moment = line * at * (2 - at) / 2 + 4 * 9.80665 * np.where(at < 0.5, at * 0.75, 0.25 * (2 - at))
    # 401 places along the shaft
    assert strength(drive, Duty(torque=1.0)).shafts[1].weight_bending == pytest.approx(moment.max(), rel=1e-4)


def test_masses_and_friction_are_told_of():
    drive = hand_drive()
    assert strength(drive).dynamic_factor == pytest.approx(1.0, abs=0.02)
    rough = replace(drive, joints=tuple(replace(one, friction=0.2) for one in drive.joints))
    assert strength(rough).dynamic_factor > 1.005
    smooth = use(strength(drive), "tube_strength")
    assert use(strength(rough), "tube_strength").value == smooth.value  # as the check has it


def test_what_is_missing_is_named():
    found = strength(Drive.from_angles([0.1, 0.2]), Duty(torque=10.0))
    assert found.judged == ()
    assert found.enough is None
    assert math.isnan(found.rated_torque)
    assert {"shafts[1].outer", "joints[0].cross.span", "joints[1].rating.max_torque"} <= set(found.missing)
    with pytest.raises(InputError, match=r"duty\.torque: missing"):
        strength(Drive.from_angles([0.1]))


def test_a_part_of_the_duty_that_never_runs_raises_no_couple():
    """Parts of 350 N·m and of 1 200 N·m that takes no time: masses and friction add nothing to either."""
    drive = Drive(
        joints=(Hooke(joint_angle=10 * deg), Hooke(joint_angle=10 * deg)),
        duty=Duty(
            blocks=(Block(torque=350.0, speed=100.0, share=1.0), Block(torque=1200.0, speed=100.0, share=0.0)),
            life=3.6e6,
        ),
    )
    assert strength(drive).dynamic_factor == pytest.approx(1.0, abs=1e-6)


def test_chamfers_that_leave_no_flank_are_refused_and_fail_among_many():
    shaft = Shaft(
        number=2,
        length=0.8,
        outer=0.06,
        wall=0.003,
        spline=Spline(outer=0.042, root=0.036, tooth_width=0.007, teeth=8, length=0.08, chamfer=0.0004),
    )
    joints = (Hooke(joint_angle=0.1), Hooke(joint_angle=0.1))
    drive = Drive(joints=joints, shafts=(shaft,), duty=Duty(torque=100.0), limits=Limits(spline_pressure=60e6))
    (found,) = check(drive, only=["spline_pressure"], vary={"shafts[1].spline.chamfer_mm": [0.4, 1.5, 2.0]})
    assert found.passed.tolist() == [True, False, False]
    with pytest.raises(InputError, match="flank"):
        replace(drive, shafts=(replace(shaft, spline=replace(shaft.spline, chamfer=0.0015)),))
