import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import Drive, InputError, equivalent_joint, motion
from cardan.book.comparison import (
    arrangement_phase,
    blokh,
    blokh_coefficients,
    book_comparison,
    book_series,
    collinear_joint_angle,
    double_joint,
    double_joint_law,
    mean_phases,
    rule_of_practice,
)
from cardan.book.single_joint import book_coefficients, fourier, joint_extremes
from cardan.sweeps import Drives
from cardan.units import arcmin, deg
from tests.builders.drives import plans

PHI = np.linspace(-8.0, 15.0, 93)
TURN = np.arange(360) * deg
TRUCK = Drive.from_angles(
    [11.5 * deg, 15 * deg + 20 * arcmin, 15 * deg, 16.5 * deg],
    plane_twists=[1.9 * deg, -22 * deg - 56 * arcmin, 49 * deg + 59 * arcmin],
)


@pytest.mark.slow
@given(plans())
def test_blokh_is_exact_once_its_poles_are_gone(plan):
    exact, closed = motion(plan.drive, PHI), blokh(plan.drive, PHI)
    assert np.allclose(closed.angle_error, exact.angle_error[-1], rtol=0, atol=3e-14)
    assert np.allclose(closed.ratio, exact.ratio, rtol=0, atol=3e-14)
    assert np.allclose(closed.slope, exact.slope, rtol=0, atol=1e-13)


@pytest.mark.parametrize("start", [0.0, math.pi / 2, -math.pi / 2])
def test_blokh_has_no_poles_at_quarter_turns(start):
    drive = Drive.from_angles([0.3, 0.4, 0.2], start_phase=start)
    assert np.allclose(blokh(drive, PHI).output_angle, motion(drive, PHI).output_angle, rtol=0, atol=2e-14)


@pytest.mark.slow
@given(plans(straight=False, most=4), st.floats(-1.5, 1.5))
def test_blokh_as_printed_is_the_same_where_it_has_no_pole(plan, phi):
    """Book (35) with its tangents, for phases away from ±90°."""
    from cardan.questions.motion.motion import initial_phases

    psi = initial_phases(plan.drive)
    if np.any(np.abs(np.cos(psi)) < 0.05):
        return
    alpha, t = np.asarray(plan.joint_angles), np.tan(psi)
    a, b, c = np.cos(alpha) * (1 + t**2), np.sin(alpha) ** 2 * t, np.cos(alpha) ** 2 + t**2
    big_b = sum(np.prod(a[:k]) * b[k] * np.prod(c[k + 1 :]) for k in range(len(a)))
    mine = np.asarray(blokh_coefficients(plan.drive)) / np.prod(np.cos(psi) ** 2)
    assert np.allclose(mine, [np.prod(a), big_b, np.prod(c)], rtol=1e-9, atol=1e-9 * np.prod(c))


def test_the_series_of_the_truck_gives_the_known_irregularities():
    seen = book_comparison(TRUCK)
    assert seen.speed_fluctuation == pytest.approx(0.12512, abs=5e-6)
    assert seen.speed_fluctuation_80 == pytest.approx(0.12333, abs=5e-6)
    assert seen.speed_fluctuation_mean_phases == pytest.approx(0.12335, abs=5e-6)
    assert seen.speed_fluctuation_without_theta == pytest.approx(0.12272, abs=5e-6)


@pytest.mark.parametrize(
    ("limit", "first", "second"), [(5, 2.6e-5, 9.8e-8), (10, 5.3e-4, 9.3e-6), (20, 8.1e-3, 4.4e-4)]
)
def test_the_series_err_as_much_as_measured_before(limit, first, second):
    """Worst of 200 random four-joint drives; another draw of 200 may be a factor off, an order of magnitude never."""
    rng = np.random.default_rng(11)
    drives = Drives.from_angles(
        rng.uniform(0, limit * deg, (200, 4)),
        plane_twist=rng.uniform(-math.pi, math.pi, (200, 3)),
        yoke_angle=rng.uniform(-math.pi, math.pi, (200, 3)),
        start_phase=rng.uniform(-math.pi, math.pi, 200),
    )
    seen = book_comparison(drives, TURN)
    assert first / 4 < seen.worst_first_order.max() < 2 * first
    assert second / 4 < seen.worst_second_order.max() < 2 * second


@pytest.mark.slow
@given(plans(joint_angle=8 * deg, straight=False), st.floats(0.2, 0.5))
def test_the_orders_of_the_series_deserve_their_names(plan, share):
    """Bends smaller by k: the first order errs by k⁴ less, the second by k⁶."""
    small = Drive.from_angles(
        [share * joint_angle for joint_angle in plan.joint_angles],
        plane_twists=plan.plane_twists,
        yoke_angles=plan.yoke_angles,
        start_phase=plan.start_phase,
    )
    one, two = book_comparison(plan.drive, TURN), book_comparison(small, TURN)
    scale = sum(joint_angle**2 for joint_angle in plan.joint_angles)
    # Bounds with a constant of one: errors ≤ (Σα²)², (Σα²)³, at both sizes.
    for seen, size in ((one, scale), (two, share**2 * scale)):
        assert seen.worst_first_order <= size**2
        assert seen.worst_second_order <= size**3 + 1e-15


@given(plans())
def test_ratio_and_slope_of_the_series_are_its_derivatives(plan):
    series = book_series(plan.drive, 2, amplitude="tau")
    h = 1e-4
    angle_error = [series.angle_error(PHI + k * h) for k in (-2, -1, 1, 2)]
    first = (angle_error[0] - 8 * angle_error[1] + 8 * angle_error[2] - angle_error[3]) / (12 * h)
    assert np.allclose(series.ratio(PHI), 1 + first, rtol=0, atol=1e-10)
    ratio = [series.ratio(PHI + k * h) for k in (-2, -1, 1, 2)]
    second = (ratio[0] - 8 * ratio[1] + 8 * ratio[2] - ratio[3]) / (12 * h)
    assert np.allclose(series.slope(PHI), second, rtol=0, atol=1e-10)


@given(plans(), st.floats(-3, 3))
def test_mean_phases_do_not_mind_the_start(plan, later):
    other = Drive.from_angles(
        plan.joint_angles,
        plane_twists=plan.plane_twists,
        yoke_angles=plan.yoke_angles,
        start_phase=plan.start_phase + later,
    )
    one, two = (book_series(drive, phases="mean") for drive in (plan.drive, other))
    assert one.speed_fluctuation == pytest.approx(two.speed_fluctuation, abs=1e-14)
    assert one.angle_error([0.0])[0] == pytest.approx(0.0, abs=1e-15)
    arms = np.sum(np.asarray(plan.joint_angles) ** 2 / 4 * np.exp(2j * mean_phases(plan.drive)))
    assert one.amplitude == pytest.approx(abs(arms), abs=1e-15)


def test_a_single_joint_in_the_series_is_its_first_harmonic():
    series = book_series(Drive.from_angles([0.2], start_phase=0.3))
    want = 0.01 * (np.sin(2 * (PHI + 0.3)) - math.sin(0.6))
    assert np.allclose(series.angle_error(PHI), want, rtol=0, atol=1e-15)
    assert series.phase == pytest.approx(0.3)


def test_the_second_order_takes_exact_phases_only():
    with pytest.raises(ValueError, match="exact phases"):
        book_series(TRUCK, 2, phases="mean")


@pytest.mark.parametrize(
    ("joint_angles", "sign", "exact", "rule"),
    [
        ([20, 15], [1, -1], 13.384, 13.229),
        ([12, 20], [1, -1], 16.119, 16.000),
        ([10, 20, 30], [1, -1, 1], 24.824, 24.495),
        ([40, 30], [1, -1], 27.804, 26.458),
        ([20, 15], [1, 1], 24.814, 25.000),
    ],
)
def test_the_rule_of_practice_and_the_exact_one(joint_angles, sign, exact, rule):
    yokes = [0.0 if one != other else math.pi / 2 for one, other in pairwise(sign)]
    drive = Drive.from_angles(np.radians(joint_angles), yoke_angles=yokes)
    assert np.degrees(rule_of_practice(drive)) == pytest.approx(rule, abs=6e-4)
    assert np.degrees(collinear_joint_angle(np.radians(joint_angles), sign)) == pytest.approx(exact, abs=6e-4)
    assert equivalent_joint(drive).joint_angle == pytest.approx(
        float(collinear_joint_angle(np.radians(joint_angles), sign)), abs=1e-13
    )


JOINT_ANGLE = st.floats(0.0, 60 * deg)
ANGLE = st.floats(-math.pi, math.pi)


@given(JOINT_ANGLE, JOINT_ANGLE, ANGLE)
def test_the_double_joint_moves_as_its_chain(one, two, phase):
    drive = Drive.from_angles([one, two], yoke_angles=[math.pi / 2 - phase])
    exact, closed = motion(drive, PHI), double_joint(one, two, phase, PHI)
    assert np.allclose(closed.output_angle, exact.output_angle, rtol=0, atol=3e-14)
    assert np.allclose(closed.ratio, exact.ratio, rtol=0, atol=1e-13)
    assert np.allclose(closed.slope, exact.slope, rtol=0, atol=1e-12)
    law = double_joint_law(one, two, phase)
    whole = equivalent_joint(drive)
    # δ is differenced from the law of cosines without cancelling: rounding only. α_eq is a root of it.
    assert law.speed_fluctuation == pytest.approx(float(whole.speed_fluctuation), abs=1e-14)
    assert law.joint_angle**2 == pytest.approx(float(whole.joint_angle) ** 2, abs=1e-13)


@given(JOINT_ANGLE, JOINT_ANGLE, st.floats(-1.5, 1.5))
def test_worst_and_best_phase_have_book_tangents(one, two, phi):
    worst = np.arctan(np.tan(phi) / (np.cos(one) * np.cos(two)))
    best = np.arctan(np.cos(two) / np.cos(one) * np.tan(phi))
    assert double_joint(one, two, 0.0, [phi]).output_angle[0] == pytest.approx(worst, abs=1e-14)
    assert double_joint(one, two, math.pi / 2, [phi]).output_angle[0] == pytest.approx(best, abs=1e-14)


@given(JOINT_ANGLE, JOINT_ANGLE)
def test_unequal_bends_leave_the_known_rest_at_the_best_phase(one, two):
    ratio = np.cos(two) / np.cos(one)
    law = double_joint_law(one, two, math.pi / 2)
    assert np.cos(law.joint_angle) == pytest.approx(min(ratio, 1 / ratio), abs=1e-15 * 4)


def test_the_arrangements_have_their_phases():
    assert arrangement_phase("a") == 0.0
    assert arrangement_phase("b", yoke_angle=0.3) == pytest.approx(math.pi / 2 - 0.3)
    assert arrangement_phase("c", plane_twist=0.4) == pytest.approx(math.pi / 2 - 0.4)
    assert arrangement_phase("d", plane_twist=0.4, yoke_angle=0.3) == pytest.approx(math.pi / 2 - 0.7)


@pytest.mark.parametrize(
    ("letter", "given_", "field"),
    [
        ("e", {}, "arrangement"),
        ("a", {"yoke_angle": 1.0}, "yoke_angle"),
        ("b", {}, "yoke_angle"),
        ("b", {"yoke_angle": 1.0, "plane_twist": 0.0}, "plane_twist"),
        ("c", {"plane_twist": 1.0, "yoke_angle": 0.0}, "yoke_angle"),
        ("d", {"plane_twist": 1.0}, "yoke_angle"),
    ],
)
def test_a_contradictory_arrangement_is_named(letter, given_, field):
    with pytest.raises(InputError) as caught:
        arrangement_phase(letter, **given_)
    assert caught.value.field == field


def test_table_4_has_the_digits_of_the_book_but_for_its_slips():
    """α, i_max, i_min, lead [minutes], δ, max ε/ω²; book's slips put right (0.8119 at 35°, 9°50' at 45°)."""
    rows = [
        (5, 1.0038, 0.9962, 6.6, 0.007625, 0.0076253),
        (10, 1.0154, 0.9848, 26.3, 0.030619, 0.0306260),
        (15, 1.0353, 0.9659, 59.6, 0.069350, 0.0694336),
        (20, 1.0642, 0.9397, 60 + 46.9, 0.124485, 0.1249656),
        (25, 1.1034, 0.9063, 120 + 49.0, 0.197070, 0.1989655),
        (30, 1.1547, 0.8660, 240 + 7.0, 0.288675, 0.2945711),
        (35, 1.2208, 0.8192, 300 + 42.3, 0.401623, 0.4172325),
        (40, 1.3054, 0.7660, 420 + 36.8, 0.539363, 0.5762153),
        (45, 1.4142, 0.7071, 540 + 52.8, 0.707107, 0.7872003),
    ]
    table = joint_extremes(np.asarray([row[0] for row in rows]) * deg)
    columns = (
        table.ratio_max,
        table.ratio_min,
        table.angle_error / arcmin,
        table.speed_fluctuation,
        table.acceleration,
    )
    for k, tolerance in enumerate((5e-5, 5e-5, 0.05, 5e-7, 5e-8)):
        assert np.allclose(columns[k], [row[k + 1] for row in rows], rtol=0, atol=1.01 * tolerance)


@given(st.floats(0.5 * deg, 85 * deg))
def test_extremes_are_extreme(joint_angle):
    found = joint_extremes(np.asarray([joint_angle]))
    drive = Drive.from_angles([joint_angle])
    at = motion(drive, [0.0, math.pi / 2, found.angle_of_error[0], found.angle_of_acceleration[0]])
    assert at.ratio[0] == pytest.approx(found.ratio_max[0], rel=1e-12)
    assert at.ratio[1] == pytest.approx(found.ratio_min[0], rel=1e-12)
    assert at.angle_error[1, 2] == pytest.approx(found.angle_error[0], rel=1e-12)
    assert at.slope[3] == pytest.approx(-found.acceleration[0], rel=1e-10)
    turn = motion(drive, np.arange(0, 180, 0.25) * deg)
    assert np.max(np.abs(turn.slope)) <= found.acceleration[0] * (1 + 1e-12)
    assert np.max(np.abs(turn.angle_error[1])) <= found.angle_error[0] * (1 + 1e-12)
    assert found.speed_fluctuation[0] == pytest.approx(
        found.ratio_max[0] - found.ratio_min[0], abs=1e-14 * found.ratio_max[0]
    )


@pytest.mark.parametrize("joint_angle", [5.0, 20.0, 40.0, 60.0])
def test_fourier_amplitudes_against_a_discrete_sum(joint_angle):
    count = 512
    phi = np.arange(count) * (2 * np.pi / count)
    angle_error = motion(Drive.from_angles([joint_angle * deg]), phi).angle_error[-1]
    spectrum = np.fft.rfft(angle_error) / count * 2
    # Aliases are smaller than τ^250: nothing but rounding.
    assert np.allclose(-spectrum.imag[2:12:2], fourier(np.asarray(joint_angle * deg), 5), rtol=0, atol=2e-16 * 8)
    odd = np.abs(spectrum[1:20:2])
    assert np.all(odd < 1e-15)


@pytest.mark.parametrize("joint_angle", [5.0, 20.0, 40.0])
def test_the_books_coefficients_are_the_first_terms_of_the_exact_ones(joint_angle):
    book = book_coefficients(np.asarray(joint_angle * deg))
    with mpmath.workdps(30):
        # Coefficients of T^m in √(1+T)^-1-free form: the exact τ, τ²/2, τ³/3 times cos α, expanded in T = tan² α.
        def scaled(k):
            def of(t):
                c = 1 / mpmath.sqrt(1 + t)
                return ((1 - c) / (1 + c)) ** k / k * c

            return [float(x) for x in mpmath.taylor(of, mpmath.mpf("1e-12"), 3)]

        series = {k: scaled(k) for k in (1, 2, 3)}
    t, c = math.tan(joint_angle * deg) ** 2, math.cos(joint_angle * deg)
    assert book.c11 == pytest.approx(sum(x * t**m for m, x in enumerate(series[1])) / c, rel=1e-9, abs=1e-10)
    assert book.c12 == pytest.approx(sum(x * t**m for m, x in enumerate(series[2])) / c, rel=1e-9, abs=1e-10)
    assert book.c13 == pytest.approx(sum(x * t**m for m, x in enumerate(series[3])) / c, rel=1e-9, abs=1e-10)
    assert book.c11_quarter == (joint_angle * deg) ** 2 / 4


def test_the_constant_of_the_series_tends_to_one():
    assert book_coefficients(np.asarray(5 * deg)).constant == pytest.approx(1.0, abs=2e-9)
    assert book_coefficients(np.asarray(20 * deg)).constant == pytest.approx(1.0, abs=1e-4)
    # Printed as 0.000232 for tan⁶ 20°: ten times too small.
    assert math.tan(20 * deg) ** 6 == pytest.approx(0.00232, abs=5e-6)
