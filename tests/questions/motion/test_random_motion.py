"""Random movements: closed forms of one joint, formulas of the book, and a long sample path as truths."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.reader import USUAL
from cardan.book.varying_joint_angle import random_joint_angle
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joint_parts import Needles
from cardan.drive.movement import Harmonic, Random, Spectrum
from cardan.errors import InputError
from cardan.maths.curves import paths
from cardan.questions.forces.answer import ask as carried
from cardan.questions.life.life import life
from cardan.questions.losses.losses import losses
from cardan.questions.motion import articulation_answer
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.random_motion import random_motion
from cardan.units import deg

SPECTRUM = Spectrum(frequency=(4.0, 12.0, 30.0), density=(1.0, 2.0, 0.3))
RATE = math.sqrt(
    paths.rate_variance(SPECTRUM.frequency, SPECTRUM.density) / paths.variance(SPECTRUM.frequency, SPECTRUM.density)
)


def shake(moves=("output",), deviation=0.02, axis=(0.0, 0.0, 1.0), duration=600.0, **more):
    return Random(moves=moves, axis=axis, deviation=deviation, duration=duration, spectrum=SPECTRUM, **more)


def bent(offset=0.0, deviation=0.02, reach=1.0):
    """Return one joint whose output point shakes across a shaft of 1 m."""
    bare = Drive.from_points([(-0.5, 0, 0), (0, 0, 0), (reach, 0, offset)])
    return replace(bare, movements=(shake(deviation=deviation),), duty=Duty(speed=100.0, torque=300.0))


def results(drive, **given):
    return {(one.what, one.number): one for one in random_motion(drive, **given).results}


def test_one_straight_joint_has_the_closed_forms():
    """α = arctan|x|/L, δ = sin α tan α = x²/(L√(L² + x²)): levels are those of x, by Rice for either side."""
    drive, sigma = bent(), 0.02
    found = results(drive)
    often = 1.0 / 600.0
    x = sigma * math.sqrt(2.0 * math.log(2.0 * RATE / (2.0 * math.pi * often)))
    at, weight = np.polynomial.hermite_e.hermegauss(60)
    share = (sigma * at) ** 2 / np.sqrt(1.0 + (sigma * at) ** 2)
    mean = weight @ share / math.sqrt(2.0 * math.pi)
    deviation = math.sqrt(weight @ (share - mean) ** 2 / math.sqrt(2.0 * math.pi))
    one = found["speed_fluctuation", 2]
    assert (one.mean, one.deviation) == pytest.approx((mean, deviation), rel=1e-6)
    assert one.high == pytest.approx(x * x / math.sqrt(1.0 + x * x), rel=1e-3)
    assert found["joint_angle", 1].high == pytest.approx(math.atan(x), rel=1e-3)
    assert all(math.isnan(found[name].low) for name in (("joint_angle", 1), ("speed_fluctuation", 2)))  # often straight
    assert found["joint_angle", 1].mean == pytest.approx(sigma * math.sqrt(2.0 / math.pi), rel=1e-3)


def test_a_bent_joint_agrees_with_the_formulas_for_a_random_joint_angle():
    """δ = 1/cos α - cos α: the means of the extreme ratios, at θ = 0 and 90°, which calc tells for a normal α."""
    reach, offset = 10.0, 10.0 * math.tan(15 * deg)
    sigma = 0.05
    found = results(bent(offset, sigma, reach))
    spread = sigma * math.cos(15 * deg) ** 2 / reach
    book = random_joint_angle(
        np.asarray([0.0, 90 * deg]), mean=15 * deg, deviation=spread, rate_deviation=0.0, speed=1.0
    )
    one = found["speed_fluctuation", 2]
    # The angle of a point on a line is normal but for (σ/L)² of itself.
    assert one.mean == pytest.approx(book.mean[0] - book.mean[1], rel=(sigma / reach) ** 2 * 10)
    assert one.deviation == pytest.approx(book.deviation[0] + book.deviation[1], rel=1e-2)
    assert found["joint_angle", 1].deviation == pytest.approx(spread, rel=1e-3)
    assert one.held == pytest.approx(1.0, abs=1e-6)


def test_the_spectrum_of_a_small_shake_is_that_of_the_shift_times_the_slope_squared():
    drive = bent(10.0 * math.tan(15 * deg), 0.05, 10.0)
    found = random_motion(drive)
    slope = math.cos(15 * deg) ** 2 / 10.0
    scale = 0.05**2 / paths.variance(SPECTRUM.frequency, SPECTRUM.density)
    for omega in (8.0, 12.0, 20.0):
        exact = slope**2 * scale * np.interp(omega, SPECTRUM.frequency, SPECTRUM.density)
        assert np.interp(omega, found.frequency, found.density[0]) == pytest.approx(exact, rel=0.02)


def three():
    points = [(-0.2, 0, 0), (0, 0, 0), (0.8, 0.02, -0.11), (1.3, 0.05, -0.16)]
    bare = Drive.from_points(points, yoke_angles=[0.4])
    moves = (shake(("joints[1]", "output"), 0.02), shake(("output",), 0.015, (0.0, 1.0, 0.2), seed=5))
    return replace(bare, movements=moves, duty=Duty(speed=150.0, torque=300.0))


@pytest.mark.slow
def test_a_long_sample_path_has_these_means_deviations_and_rates():
    drive = three()
    found = random_motion(drive)
    times = np.arange(0.0, 600.0, 0.03)
    path = articulation(drive, times=times)
    seen = {
        ("joint_angle", 1): path.joint_angle[:, 0],
        ("joint_angle", 2): path.joint_angle[:, 1],
        ("length", 2): path.length[:, 1],
        ("speed_fluctuation", 3): path.speed_fluctuation,
    }
    for k, one in enumerate(found.results):
        if (one.what, one.number) not in seen:
            continue
        values = seen[one.what, one.number]
        # Some 1500 independent values in 600 s: the mean errs by 3 % of the deviation, the deviation by 2 % of it.
        assert np.mean(values) == pytest.approx(one.mean, abs=0.08 * one.deviation)
        assert np.std(values) == pytest.approx(one.deviation, rel=0.06)
        level = one.mean + 2.0 * one.deviation
        rises = np.sum((values[1:] > level) & (values[:-1] <= level)) / 600.0
        assert rises == pytest.approx(found.chance.rate(k, level)[0], rel=0.2)


@pytest.mark.slow
def test_life_and_losses_are_expectations_and_not_of_one_sample_path():
    joints = [
        replace(one, friction=0.03, cross=Cross(span=0.08, journal=0.02), needles=Needles(capacity=30e3))
        for one in bent().joints
    ]
    sigma, offset = 0.05, 0.3
    drive = replace(bent(offset, sigma), joints=tuple(joints))
    one, other = drive, replace(drive, movements=(replace(drive.movements[0], seed=7),))
    assert losses(one).heat == losses(other).heat
    # Own integration: the drive standing at even steps of the normal law.
    z = np.linspace(-6.0, 6.0, 61)
    weight = np.exp(-0.5 * z**2) / np.sum(np.exp(-0.5 * z**2))
    stood = [replace(bent(offset + sigma * at), joints=tuple(joints), movements=()) for at in z]
    assert losses(one).heat == pytest.approx(weight @ [losses(at).heat for at in stood], rel=1e-5)
    rates = [1.0 / life(at).driving[0, 0] for at in stood]
    assert life(one).driving[0, 0] == pytest.approx(1.0 / (weight @ rates), rel=1e-4)


def test_forces_tell_the_couple_of_the_cross():
    """Without masses and friction it is M/cos α at most, with M at the output: M √(1 + tan²α)."""
    drive = bent(0.3, 0.05)
    drive = replace(drive, movements=(replace(drive.movements[0], duration=2.0),))
    found = {(one.what, one.number): one for one in carried(drive).random.results}
    at, weight = np.polynomial.hermite_e.hermegauss(40)
    couple = 300.0 / np.cos(np.arctan(0.3 + 0.05 * at))
    assert found["couple", 1].mean == pytest.approx(weight @ couple / math.sqrt(2.0 * math.pi), rel=1e-5)


@pytest.mark.slow
def test_what_is_told_names_the_span_and_that_other_movements_rest():
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.01), frequency=3.0, name="idle")
    drive = three()
    drive = replace(drive, movements=(*drive.movements, swing))
    result = articulation(drive, until=20.0)
    said = data(articulation_answer.answer(drive, result), USUAL)
    assert result.random.resting == ("idle",)
    assert said["random_span_s"] == 600.0
    row = next(one for one in said["random_results"] if one["what"] == "length")
    assert row["fallen_below_once_mm"] < row["mean_mm"] < row["exceeded_once_mm"]
    assert set(said["random_spectrum"]) >= {"frequency_Hz", "length_2_mm2_per_Hz"}


def test_a_drive_that_chance_bends_by_90_degrees_is_refused_with_a_word():
    drive = bent(0.0, 5.0)
    drive = replace(drive, movements=(replace(drive.movements[0], axis=(1.0, 0.0, 0.0)),))
    with pytest.raises(InputError, match="90° or more within 6 standard deviations"):
        random_motion(drive)
