import numpy as np
import pytest

from cardan import Drive, tolerance
from cardan.backends import Compiled, Plain
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.joints import Hooke
from cardan.methods import MonteCarlo
from cardan.questions.accuracy import sampling
from cardan.questions.accuracy.accuracy import course, one_turn, sensitivity, transmission_error
from cardan.questions.accuracy.sampling import Exact, Sums
from cardan.sweeps import Drives
from cardan.units import deg, mm

TOLERANCE = Tolerance(alpha1=0.1 * deg, alpha2=0.2 * deg, alpha3=0.1 * deg, alpha4=0.3 * deg, phase=0.1 * deg)
JOINT_ANGLES = {1: [25 * deg], 2: [0.0, 60 * deg], 4: [11 * deg, 35 * deg, 5 * deg, 20 * deg]}


def drive_of(joints, **options):
    joint_angles = JOINT_ANGLES[joints]
    yokes = [0.3 + 0.4 * k for k in range(joints - 1)]
    rows = tuple(Hooke(joint_angle=joint_angle, plane_twist=0.2, **options) for joint_angle in joint_angles)
    base = Drive.from_angles(joint_angles, yoke_angles=yokes, start_phase=0.7)
    return Drive(joints=rows, shafts=base.shafts, input=base.input)


@pytest.mark.slow
@pytest.mark.parametrize("joints", JOINT_ANGLES)
def test_the_kernel_gives_what_every_chain_gives_alone(joints):
    """Sums, sizes and kept values against the array expressions, each sample a chain of its own."""
    drive, phi = drive_of(joints, error=Error(alpha1=0.2 * deg, phase=-0.3 * deg)), one_turn(24)
    known = np.tile(np.asarray([-0.3 * deg, 0.2 * deg, 0, 0, 0, 0, 0, 0, 0, 0]), (joints, 1))
    limits = np.zeros((joints, 10))
    limits[:, [0, 2, 4]] = 0.5 * deg
    rng = np.random.default_rng(1)
    errors = rng.uniform(-0.5, 0.5, (800, 3 * joints)) * deg
    centre = transmission_error(drive, phi)
    sums = (Sums(centre.error), Sums(centre.output_shift))
    exact = Exact(drive, phi, known=known, limits=limits, centre=centre, samples=800, method=Compiled(threads=2))
    assert exact.add(errors, sums) == 0
    turns = np.tile(known[:, :5], (800, 1, 1))
    turns[..., [0, 2, 4]] += errors.reshape(800, joints, 3)
    alone = transmission_error(drive, phi, turns=turns).error - centre.error
    # A few roundings of numbers of the order of one.
    kept = np.concatenate(sums[0].kept, axis=-1)
    np.testing.assert_allclose(kept.T, alone, rtol=0, atol=1e-14)
    count, one, two = sums[0].batches[0]
    assert np.all(count == 800)
    assert one == pytest.approx(alone.sum(axis=0), abs=1e-11)
    assert two == pytest.approx((alone**2).sum(axis=0), rel=1e-11)
    parts = course(alone)
    wanted = (np.abs(parts.mean), parts.first, parts.second, parts.peak_to_peak)
    assert sums[0].all_sizes() == pytest.approx(np.stack(wanted), abs=1e-14)


@pytest.mark.parametrize("joints", JOINT_ANGLES)
@pytest.mark.parametrize("points", ["sobol", "random"])
def test_both_ways_to_compute_give_the_same_band(joints, points):
    drive = drive_of(joints)
    compiled, plain = (
        tolerance(drive, TOLERANCE, method=MonteCarlo(samples=2000, points=points, compute=how)).output
        for how in (Compiled(), Plain())
    )
    for name in ("lower", "upper", "lower_95", "deviation"):
        assert getattr(compiled, name) == pytest.approx(getattr(plain, name), rel=1e-9, abs=1e-13)
    for name in ("mean", "first", "second", "peak_to_peak"):
        assert getattr(compiled, name) == pytest.approx(getattr(plain, name), rel=1e-9)


def test_values_are_kept_for_some_samples_only(monkeypatch):
    monkeypatch.setattr(sampling, "KEPT", 1024)
    drive = drive_of(1)
    found = [
        tolerance(drive, TOLERANCE, method=MonteCarlo(samples=4096, compute=how)).output
        for how in (Compiled(), Plain())
    ]
    assert found[0].upper == pytest.approx(found[1].upper, rel=1e-9)
    assert found[0].deviation == pytest.approx(found[1].deviation, rel=1e-9)


def test_what_the_kernel_does_not_know_is_left_to_expressions():
    """Lengths, and errors past the range of its arctangent: the answers are those of the plain form to the last bit."""
    drive = drive_of(1)
    for spread in (Tolerance(alpha2=0.1 * deg, a1=0.1 * mm), Tolerance(alpha2=20 * deg, distribution="uniform")):
        one, other = (
            tolerance(drive, spread, method=MonteCarlo(samples=1024, compute=how)) for how in (Compiled(), Plain())
        )
        assert np.array_equal(one.output.upper, other.output.upper)
        assert np.array_equal(one.shift.upper, other.shift.upper)


def test_known_lengths_shift_the_band_of_the_shift():
    drive = drive_of(2, error=Error(a1=0.1 * mm))
    found = tolerance(drive, Tolerance(alpha1=0.1 * deg), method=MonteCarlo(samples=1024, compute=Compiled()))
    assert found.shift.centre == pytest.approx(transmission_error(drive, found.angle).output_shift, abs=1e-18)
    assert np.max(np.abs(found.shift.upper - found.shift.centre)) < 2e-6
    assert np.max(found.shift.upper - found.shift.lower) > 1e-9


def test_a_large_job_is_compiled_by_itself():
    drive, phi = drive_of(1), one_turn(72)
    limits = np.zeros((1, 10))
    limits[0, 1] = 0.1 * deg
    centre = transmission_error(drive, phi)
    options = {"known": 0 * limits, "limits": limits, "centre": centre}
    assert isinstance(Exact(drive, phi, samples=65536, **options).method, Plain)
    assert isinstance(Exact(drive, phi, samples=2**20, **options).method, Compiled)


def test_the_largest_error_allowed_stays_in_the_range_of_the_arctangent():
    """REACH leaves room for second order: normal errors of 6.6 deviations at once on one joint of 60°."""
    drive, phi = Drive.from_angles([60 * deg]), one_turn(72)
    table = np.abs(sensitivity(drive, phi))
    limits = np.ones((1, 5))
    scale = sampling.REACH / np.max(np.sum(table * limits, axis=(-2, -1)))
    corners = np.stack(np.meshgrid(*[[-scale, scale]] * 5, indexing="ij"), axis=-1).reshape(-1, 1, 5)
    error = transmission_error(Drives.from_angles([60 * deg]), phi, turns=corners).error
    assert np.max(np.abs(error)) < np.tan(np.pi / 8)
