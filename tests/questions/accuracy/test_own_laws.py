"""Errors of the sizes inside joints: closed forms, difference quotients of exact loops, the inner mechanisms."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, allocate, tolerance
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.joints.pin_coupling import missed_by_pins, missed_plane
from cardan.errors import InputError
from cardan.io.drive_file import dumps, loads
from cardan.joints import (
    Clemens,
    ClemensProfile,
    ConstantVelocity,
    DoubleCardan,
    ElasticHalfCardan,
    HalfCardan,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.methods import MonteCarlo, WorstCase
from cardan.questions.accuracy import answer as told
from cardan.questions.accuracy.accuracy import one_turn, sensitivity, transmission_error
from cardan.questions.accuracy.own_laws import seats, table_of
from cardan.questions.motion.joint_mechanism import joint_carried
from cardan.questions.motion.motion import motion
from cardan.units import arcmin, deg, mm

BEND = 22 * deg
PLACE = {"joint_angle": BEND, "plane_twist": 0.0}
EVEN = Tracta(driving_distance=30 * mm, driven_distance=30 * mm, **PLACE)
PINS = PinCoupling(driving_distance=60 * mm, driven_distance=60 * mm, **PLACE)
SIZED = {
    "tracta": replace(EVEN, driven_distance=31 * mm),
    "rzeppa lever": Rzeppa(lever_b=0.35, lever_c=0.7, balls=3, **PLACE),
    "rzeppa grooves": Rzeppa(driving_offset=3 * mm, driven_offset=3.2 * mm, groove_radius=30 * mm, balls=3, **PLACE),
    "weiss": Weiss(driving_offset=12 * mm, driven_offset=12.5 * mm, groove_radius=40 * mm, **PLACE),
    "double cardan": DoubleCardan(centring_ratio=0.51, **PLACE),
    "pins": replace(PINS, driven_slant=46 * deg, driven_distance=61 * mm),
    "clemens": Clemens(
        driving=ClemensProfile(axial=50 * mm, radial=30 * mm, radius=62 * mm),
        driven=ClemensProfile(axial=50.5 * mm, radial=30 * mm, radius=62 * mm),
        **PLACE,
    ),
}
PLAIN = [
    ConstantVelocity(**PLACE),
    Tripod(**PLACE),
    HalfCardan(joint_angle=3 * deg, plane_twist=0.0),
    ElasticHalfCardan(joint_angle=3 * deg, plane_twist=0.0),
    OffsetCross(offset=5 * mm, reach=200 * mm, **PLACE),
]


def between(joint):
    """Return a drive with the joint before a Hooke joint and behind one."""
    cross = Hooke(joint_angle=15 * deg, plane_twist=0.3)
    return Drive(joints=(replace(cross, plane_twist=0.0), replace(joint, plane_twist=0.2), cross))


def off(joint, key, value):
    return table_of(joint, "error")(**{key: value})


@pytest.mark.slow
@pytest.mark.parametrize("joint", [*SIZED.values(), *PLAIN], ids=lambda one: one.kind)
def test_the_influence_is_the_slope_of_the_exact_law(joint):
    """Central differences of order four of the exact error, in a drive with cross joints on both sides."""
    drive, phi = between(joint), one_turn(24)
    table = sensitivity(drive, phi)
    names = seats(drive.joints)[1]
    for seat, key in enumerate(names):
        if not key:
            assert np.all(table[:, 1, seat] == 0.0)
            continue
        size = joint.sizes().get(key)
        step = 2e-4 * (1.0 if size is None else abs(size))

        def exact(value, key=key):
            return transmission_error(drive, phi, errors=[None, off(joint, key, value), None]).error

        slope = (8.0 * (exact(step) - exact(-step)) - exact(2.0 * step) + exact(-2.0 * step)) / (12.0 * step)
        scale = max(float(np.max(np.abs(slope))), 1e-3)
        assert np.max(np.abs(table[:, 1, seat] - slope)) < 1e-6 * scale


@pytest.mark.parametrize("joint", SIZED.values(), ids=SIZED)
def test_an_exact_error_is_the_motion_of_the_drive_with_that_size(joint):
    drive, phi = between(joint), one_turn(24)
    for key, size in joint.sizes().items():
        if size is None:
            continue
        made = joint.sized({key: size * 1.01})
        found = transmission_error(drive, phi, errors=[None, off(joint, key, 0.01 * size), None]).error
        actual, perfect = (motion(one, phi).output_angle for one in (between(made), drive))
        # motion counts angles from the start position, where the error is another one for each drive
        assert found - found[0] == pytest.approx(actual - perfect, abs=2e-11)


def test_unequal_distances_of_a_tracta_joint_turn_it_twice_a_turn():
    """Its lead is arctan of the law of tangents: ∓ tan²(α/2)/(2a) sin 2θ for each metre at equal distances."""
    drive, phi = Drive(joints=(EVEN,)), one_turn(36)
    closed = np.tan(BEND / 2) ** 2 / (2 * 30 * mm) * np.sin(2 * phi)
    table = sensitivity(drive, phi)[:, 0, 5:]
    assert np.allclose(table, np.stack((-closed, closed), axis=-1), rtol=0, atol=1e-9)


def test_unlike_distances_of_pins_miss_the_plane_that_halves_the_joint_angle():
    """A first-order closed form of its own: the contact misses the plane, and the output follows."""
    phi, slant = one_turn(36), 45 * deg
    table = sensitivity(Drive(joints=(PINS,)), phi)[:, 0]
    names = seats([PINS])[0]
    differ = table[:, names.index("driving_distance")] - table[:, names.index("driven_distance")]
    along = 60 * mm / (np.cos(slant) + np.sin(slant) * np.cos(phi) * np.tan(BEND / 2))
    closed = missed_plane(phi, BEND, missed_by_pins(phi, BEND, 1.0, slant), along * np.sin(slant))
    assert differ == pytest.approx(closed, abs=1e-8 * float(np.max(np.abs(closed))))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tracta", "double cardan", "pins", "clemens"])
def test_the_inner_mechanism_with_the_size_off_turns_as_the_error_says(name):
    """The speed ratio by the screws of the pairs, which know no law, against the slope of the error over the angle."""
    joint = SIZED[name]
    phi = one_turn(256)
    for key, size in joint.sizes().items():
        error = transmission_error(Drive(joints=(joint,)), phi, errors=[off(joint, key, 0.005 * size)]).error
        wave = np.fft.rfft(error)
        slope = np.fft.irfft(1j * np.arange(wave.size) * wave, phi.size)
        made, drawn = (joint_carried(one, BEND, phi).ratio for one in (joint.sized({key: 1.005 * size}), joint))
        assert np.max(np.abs(made - drawn - slope)) < 1e-8


def test_tolerances_of_sizes_go_the_way_of_those_of_a_cross():
    given = table_of(EVEN)(driving_distance=0.05 * mm, driven_distance=0.05 * mm, phase=0.1 * arcmin)
    cross = Hooke(joint_angle=5 * deg, plane_twist=0.4)
    drive = Drive(joints=(replace(EVEN, tolerance=given), cross))
    square, worst = tolerance(drive), tolerance(drive, method=WorstCase())
    drawn = tolerance(drive, method=MonteCarlo(samples=2048, positions=24))
    sides = {one.key: one.dimension for one in square.output.contributions}
    assert sides == {"driving_distance": "length", "driven_distance": "length", "phase": "angle"}
    assert square.output.largest < worst.output.largest
    # the distances act alike: √2 t tan²(α/2)/2a beside the phase, at the places where sin 2θ is one
    alone = 0.05 * mm * np.tan(BEND / 2) ** 2 / (2 * 30 * mm)
    assert square.output.largest == pytest.approx(np.hypot(np.sqrt(2) * alone, 0.1 * arcmin), rel=0.01)
    assert np.max(drawn.output.deviation) == pytest.approx(np.max(square.output.deviation), rel=0.03)
    found = allocate(drive, 0.5 * square.output.largest)
    assert found.largest == pytest.approx(0.5 * square.output.largest)
    assert {one.key for one in found.rows if one.joint == 1} == {"phase", "alpha4", *EVEN.law_sizes}
    assert found.spread[0].driving_distance < given.driving_distance
    values = told.values_of(found)
    assert "joints[0].tolerance.driving_distance_mm" in values
    assert "joints[0].tolerance.phase_arcmin" in values


def test_a_double_cardan_joint_takes_a_tolerance_without_a_unit():
    text = """format = 1
[[joints]]
kind = "double_cardan"
joint_angle_deg = 30
centring_ratio = 0.51
tolerance = { centring_ratio = 0.005, cost = { centring_ratio = 2 } }
"""
    drive = loads(text)
    assert drive.joints[0].tolerance.cost.centring_ratio == 2.0
    found = told.answer(drive, told.ask(drive))
    assert found.facts["angle"]["contributions"][0]["tolerance"].value == 0.005
    assert pickle.loads(pickle.dumps(drive)) == drive


def test_a_size_that_the_kind_does_not_have_is_refused_with_those_it_has():
    text = 'format = 1\n[[joints]]\nkind = "tracta"\njoint_angle_deg = 20\ntolerance = {{ {key} = 0.1 }}\n'
    with pytest.raises(InputError) as caught:
        loads(text.format(key="lever_b"))
    message = str(caught.value)
    assert "tolerance.lever_b" in message
    for name in ("alpha4_deg", "phase_deg", "driving_distance_mm", "driven_distance_mm"):
        assert name in message
    with pytest.raises(InputError, match="does not give this size"):
        loads(text.format(key="driving_distance_mm"))
    crossed = replace(Hooke(**PLACE), tolerance=table_of(EVEN)(driving_distance=1e-5))
    with pytest.raises(InputError, match="a joint of kind hooke has none"):
        loads(dumps(Drive(joints=(crossed,))))


@pytest.mark.parametrize("kind", JOINTS.values(), ids=JOINTS)
def test_every_kind_has_errors_or_says_in_a_sentence_why_its_sizes_do_nothing(kind):
    counting = set() if kind.single_cross else {*kind.law_sizes, *kind.place_sizes}
    assert kind.size_keys().keys() == counting
    if not kind.single_cross and not counting:
        assert kind.refusals["tolerance"]
    assert {"phase", "alpha4"} <= set(seats([next(iter(PLAIN))])[0])


def test_joints_whose_sizes_do_not_count_are_told():
    given = table_of(PLAIN[0])(phase=1 * arcmin)
    drive = Drive(joints=(replace(PLAIN[0], tolerance=given), Tracta(joint_angle=0.1, plane_twist=0.0)))
    remarks = [str(one.text) for one in told.answer(drive, told.ask(drive)).remarks if one.code == "made_true"]
    assert len(remarks) == 2
    assert "follows none of its sizes" in remarks[0]
    assert "driving_distance, driven_distance" in remarks[1]
