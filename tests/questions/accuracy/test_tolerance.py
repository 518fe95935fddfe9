from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.support import Support
from cardan.maths.kernel.loops import influence
from cardan.questions.accuracy.accuracy import course, sensitivity, transmission_error
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.questions.accuracy.tolerance import Linear, WorstCase, tolerance
from cardan.units import deg, mm

SINGLE = Drive.from_angles([30 * deg], start_phase=0.4)
DOUBLE = Drive.from_angles([30 * deg, 25 * deg], plane_twists=[0.5], yoke_angles=[0.3])
SQUARE = Tolerance(alpha1=0.05 * deg, alpha2=0.04 * deg, alpha3=0.03 * deg, alpha4=0.2 * deg, phase=0.02 * deg)
LONG = Tolerance(s1=0.05 * mm, a1=0.03 * mm, a2=0.04 * mm, a3=0.03 * mm, a4=0.1 * mm)
SMALL = MonteCarlo(samples=8192)


def test_one_joint_by_the_table_of_coefficients():
    limits = np.asarray([SQUARE.phase, SQUARE.alpha1, SQUARE.alpha2, SQUARE.alpha3, SQUARE.alpha4])
    band = tolerance(SINGLE, SQUARE)
    rows = influence(30 * deg, band.angle + 0.4)[:, 2] * limits
    assert band.output.upper == pytest.approx(np.linalg.norm(rows, axis=-1), rel=1e-13)
    assert band.output.lower == pytest.approx(-band.output.upper, abs=1e-18)
    worst = tolerance(SINGLE, SQUARE, method=WorstCase())
    assert worst.output.upper == pytest.approx(np.sum(np.abs(rows), axis=-1), rel=1e-13)
    assert band.output.deviation == pytest.approx(band.output.upper / 3, rel=1e-13)
    assert np.all(band.shift.upper == 0.0)
    assert band.shift.contributions == ()


def extreme_errors(method_band, drive, square):
    """All corners of the box of tolerances, to first order."""
    names = ("phase", "alpha1", "alpha2", "alpha3", "alpha4")
    limits = np.asarray([getattr(square, name) for name in names])
    corners = np.asarray(list(product([-1, 1], repeat=5 * len(drive.joints)))).reshape(-1, len(drive.joints), 5)
    table = sensitivity(drive, method_band.angle)
    return np.einsum("pnk,cnk->cp", table * limits, corners)


@pytest.mark.parametrize("drive", [SINGLE, DOUBLE])
def test_the_worst_case_is_the_worst_of_all_corners(drive):
    band = tolerance(drive, SQUARE, method=WorstCase()).output
    angle = tolerance(drive, SQUARE, method=WorstCase())
    curves = extreme_errors(angle, drive, SQUARE)
    assert band.upper == pytest.approx(np.max(curves, axis=0), rel=1e-12)
    parts = course(curves)
    assert band.mean == pytest.approx(np.max(parts.mean), rel=1e-12)
    # 90 phases are looked at: the best is at most 1° off, cos 1° = 0.99985.
    assert band.first == pytest.approx(np.max(parts.first), rel=2e-4)
    assert band.second == pytest.approx(np.max(parts.second), rel=2e-4)
    # Every third position only.
    coarse = curves[:, ::3]
    assert band.peak_to_peak == pytest.approx(np.max(np.max(coarse, axis=-1) - np.min(coarse, axis=-1)), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "sigma"), [("normal", 1 / 3), ("uniform", 3**-0.5), ("triangular", 6**-0.5)])
@pytest.mark.parametrize("points", ["sobol", "random"])
def test_samples_of_small_errors_spread_as_the_linear_rule_says(law, sigma, points):
    square = replace(SQUARE, s1=0.05 * mm, a2=0.1 * mm, distribution=law)
    drawn = tolerance(DOUBLE, square, method=replace(SMALL, points=points))
    linear = tolerance(DOUBLE, square)
    step = len(linear.angle) // len(drawn.angle)
    assert drawn.angle == pytest.approx(linear.angle[::step], abs=1e-14)
    # Four standard errors 1/√(2N) of random samples, and 0.1 % for terms of second order at 0.2°.
    share = 4 / np.sqrt(2 * 8192) + 1e-3
    assert drawn.output.deviation == pytest.approx(linear.output.deviation[::step], rel=share)
    assert drawn.shift.deviation == pytest.approx(linear.shift.deviation[::step], rel=share)
    half = np.sqrt(np.sum((sensitivity(DOUBLE, drawn.angle) * limits_of(square)) ** 2, axis=(-2, -1)))
    assert linear.output.upper[::step] == pytest.approx(half, rel=1e-12)
    assert linear.output.deviation[::step] == pytest.approx(sigma * half, rel=1e-12)
    assert drawn.convergence.samples[-1] == 8192
    assert drawn.convergence.lost == 0


def limits_of(square):
    return np.asarray([square.phase, square.alpha1, square.alpha2, square.alpha3, square.alpha4])


@pytest.mark.slow
def test_quantiles_of_a_normal_band():
    band = tolerance(SINGLE, Tolerance(phase=0.1 * deg), method=MonteCarlo(samples=65536)).output
    # One normal error alone: quantiles are those of the normal law. Sobol' points know them to 1e-3.
    assert band.upper == pytest.approx(2.9677 * band.deviation, rel=5e-3)
    assert band.upper_95 == pytest.approx(1.95996 * band.deviation, rel=2e-3)
    assert band.lower == pytest.approx(-band.upper, rel=1e-2)
    assert band.lower_95 == pytest.approx(-band.upper_95, rel=5e-3)
    linear = tolerance(SINGLE, Tolerance(phase=0.1 * deg)).output
    assert linear.upper_95[::5] == pytest.approx(band.upper_95, rel=3e-3)


def test_samples_stay_within_the_worst_case():
    square = replace(SQUARE, distribution="uniform")
    drawn = tolerance(DOUBLE, square, method=SMALL)
    worst = tolerance(DOUBLE, square, method=WorstCase())
    assert np.all(drawn.output.upper < 1.001 * worst.output.upper[::5])
    assert drawn.output.peak_to_peak < 1.01 * worst.output.peak_to_peak
    for name in ("mean", "first", "second"):
        assert getattr(drawn.output, name) < 1.001 * getattr(worst.output, name)
        assert getattr(drawn.output, name) > 0.3 * getattr(worst.output, name)


def test_samples_are_exact_not_linear():
    """A joint angle that errs by tens of degrees: the mean shows the second order, which no linear rule has."""
    wide = Tolerance(alpha1=15 * deg, distribution="uniform")
    band = tolerance(SINGLE, wide, method=MonteCarlo(samples=2048, positions=8)).output
    sizes = np.linspace(-15, 15, 2001) * deg
    turns = np.zeros((2001, 1, 5))
    turns[:, 0, 1] = sizes
    curves = transmission_error(SINGLE, np.arange(8) * (np.pi / 4), turns=turns).error
    # The trapezoid rule and 2048 Sobol' points.
    assert band.deviation == pytest.approx(np.std(curves, axis=0), rel=2e-3)
    assert band.upper == pytest.approx(np.quantile(curves, 0.9985, axis=0), rel=1e-2)


def test_a_seed_repeats_and_another_differs():
    one, same, other = (
        tolerance(DOUBLE, SQUARE, method=MonteCarlo(samples=1024, seed=seed)).output.upper for seed in (3, 3, 4)
    )
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


@pytest.mark.slow
def test_the_deviation_settles_and_its_error_is_true():
    exact = tolerance(SINGLE, SQUARE).output.deviation
    for points in ("sobol", "random"):
        found = tolerance(SINGLE, SQUARE, method=MonteCarlo(samples=16384, points=points)).convergence
        off = abs(found.deviation[-1] / np.max(exact) - 1)
        # Five of its own standard errors, and the second order at 0.2°.
        assert off < 5 * found.standard_error + 2e-4
        assert np.all(np.diff(found.samples) == 2048)
    sobol = tolerance(SINGLE, SQUARE, method=MonteCarlo(samples=16384)).convergence
    assert sobol.standard_error < 0.3 * found.standard_error


def test_contributions_rank_what_to_tighten_first():
    band = tolerance(DOUBLE, SQUARE).output
    shares = [row.share for row in band.contributions]
    assert sum(shares) == pytest.approx(1.0)
    assert shares == sorted(shares, reverse=True)
    assert len(shares) == 10

    def without(row):
        joint, name = int(row.field[7]), row.field.split(".")[-1]
        rows = [replace(SQUARE, **{name: 0.0}) if k == joint else SQUARE for k in range(2)]
        return np.mean(tolerance(DOUBLE, rows).output.deviation ** 2)

    left = [without(row) for row in band.contributions]
    assert left == sorted(left)
    whole = np.mean(band.deviation**2)
    assert [1 - one / whole for one in left] == pytest.approx(shares, abs=1e-12)
    # Pins out of square come once a turn, a wrong bend twice, a phase stays.
    by_name = {row.field: row for row in band.contributions}
    skew = by_name["joints[0].tolerance.alpha1"]
    assert skew.first > 0.9 * skew.largest
    assert skew.mean == pytest.approx(0.0, abs=1e-15)
    assert by_name["joints[1].tolerance.alpha4"].second > by_name["joints[1].tolerance.alpha4"].mean


def test_known_errors_shift_the_bounds():
    skew = Error(alpha1=0.3 * deg, s1=0.2 * mm)
    both = replace(SQUARE, s1=0.05 * mm)
    joint = replace(DOUBLE.joints[0], error=skew, tolerance=both)
    drive = replace(DOUBLE, joints=(joint, DOUBLE.joints[1]))
    centre = transmission_error(drive)
    band = tolerance(drive)
    assert np.array_equal(band.output.centre, centre.error)
    assert np.array_equal(band.shift.centre, centre.output_shift)
    assert 0.5 * (band.output.lower + band.output.upper) == pytest.approx(centre.error, abs=1e-16)
    drawn = tolerance(drive, method=SMALL)
    # The mean of the samples is the centre, to second order.
    assert 0.5 * (drawn.output.lower_95 + drawn.output.upper_95) == pytest.approx(drawn.output.centre, abs=2e-5)
    assert 0.5 * (drawn.shift.lower_95 + drawn.shift.upper_95) == pytest.approx(drawn.shift.centre, abs=2e-6)
    bare = tolerance(DOUBLE, [both, None])
    assert band.output.peak_to_peak == bare.output.peak_to_peak
    assert drawn.output.peak_to_peak == pytest.approx(
        tolerance(DOUBLE, [both, None], method=SMALL).output.peak_to_peak, rel=0.02
    )


@pytest.mark.slow
def test_a_bearing_that_holds_the_shaft_ends_its_shift():
    drive = replace(DOUBLE, supports=(Support(shaft=2, position=0.3, axial=True),))
    for method in (Linear(), WorstCase(), SMALL):
        free = tolerance(DOUBLE, [LONG, None], method=method)
        assert free.shift.largest > 1e-5
        assert tolerance(drive, [LONG, None], method=method).shift.largest == 0.0
        assert tolerance(drive, [None, LONG], method=method).shift.largest > 1e-5


def test_what_cannot_be_assembled_is_counted_and_left_out():
    steep = Drive.from_angles([75 * deg])
    found = tolerance(steep, Tolerance(alpha2=25 * deg, distribution="uniform"), method=SMALL)
    # A cross out of square by more than 90° - 75° cannot turn: 10 of 25 degrees, on both sides.
    assert found.convergence.lost / 8192 == pytest.approx(10 / 25, abs=0.002)
    assert np.all(np.isfinite(found.output.upper))


def test_where_nothing_can_be_assembled_there_are_no_numbers():
    joint = replace(Drive.from_angles([80 * deg]).joints[0], error=Error(alpha2=20 * deg))
    found = tolerance(Drive(joints=(joint,)), Tolerance(alpha2=0.1 * deg), method=SMALL)
    assert found.convergence.lost == 8192
    assert np.all(np.isnan(found.output.upper))
    assert np.isnan(found.output.first)


def test_sampling_can_be_stopped():
    seen = []

    def stop(share):
        seen.append(share)
        return "stop" if share > 0.4 else None

    found = tolerance(SINGLE, SQUARE, method=SMALL, progress=stop)
    assert found.cancelled
    assert seen == [0.125, 0.25, 0.375, 0.5]
    assert found.convergence.samples[-1] == 4096
    assert not tolerance(SINGLE, SQUARE, method=SMALL, progress=lambda share: None).cancelled


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: tolerance(SINGLE), "joints[0].tolerance"),
        (lambda: tolerance(DOUBLE, [SQUARE]), "spread"),
        (lambda: MonteCarlo(samples=3), "samples"),
        (lambda: MonteCarlo(seed=-1), "seed"),
        (lambda: MonteCarlo(positions=2), "positions"),
        (lambda: MonteCarlo(points="halton"), "points"),
    ],
)
def test_what_is_missing_or_wrong_is_named(make, field):
    with pytest.raises(InputError) as caught:
        make()
    assert caught.value.field == field
