"""Forces over a whole movement: the positions of `forces`, turn by turn, and what the largest of them are."""

from dataclasses import fields, replace

import numpy as np
import pytest

from cardan import InputError, example, forces
from cardan.drive.movement import Harmonic, Hitch, Table
from cardan.questions.forces import moving_forces as module
from cardan.questions.forces.moving_forces import AMOUNTS, VECTORS, moving_forces
from cardan.units import deg, rpm

PTO = example("pto-spline-thrust")
SWING = Hitch(
    moves=("joints[1]", "output"), pivot=(0.47, 0.0, -0.3), yaw=20 * deg, pitch=4 * deg, frequency=2 * np.pi * 0.5
)


def test_the_turns_are_those_of_the_movement_and_the_forces_those_of_their_instants():
    found = moving_forces(PTO, None, [SWING])
    assert found.turns == pytest.approx(2.0 * 540 / 60)
    assert found.complete
    assert found.times[0] == 0.0
    assert found.times[-1] == pytest.approx(2.0)
    some = [0, 17, 400, found.times.size - 1]  # of several blocks
    alone = forces(PTO, angle=PTO.duty.speed * found.times[some], movement=[SWING])
    scale = float(np.max(found.reaction_size))
    # Each position is calculated by itself, so blocks change nothing but rounding.
    np.testing.assert_allclose(found.forces.reaction[:, some], alone.reaction, atol=1e-9 * scale)
    np.testing.assert_allclose(found.forces.shaft_torque[:, some], alone.shaft_torque, rtol=1e-9)
    np.testing.assert_allclose(found.forces.journals.load[:, some], alone.journals.load, atol=1e-9 * scale)


def test_every_field_with_positions_is_joined():
    found = moving_forces(PTO, None, [SWING]).forces
    arrays = {one.name for one in fields(found) if isinstance(getattr(found, one.name), np.ndarray)}
    assert arrays - {"status"} == set(AMOUNTS) | set(VECTORS)
    for name in (*AMOUNTS, *VECTORS):
        axis = -1 if name in AMOUNTS else -2
        assert getattr(found, name).shape[axis] == found.angle.size, name


def test_a_drive_that_hardly_moves_carries_what_it_carries_standing_still():
    calm = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 1e-9), frequency=2 * np.pi * 0.5)
    found, still = moving_forces(PTO, None, [calm]), forces(replace(PTO, movements=()))
    # The spline slides out and in by turns, so only what its thrust has no part in is the same.
    assert found.extreme(found.forces.bending_couple).high == pytest.approx(
        np.max(still.bending_couple, axis=-1), rel=1e-3
    )
    low, high = found.each_turn(found.forces.shaft_torque[1])
    assert low.shape == high.shape == found.turn_times.shape == (18,)
    # Steps of 5° miss the crest of a torque that swings twice a turn by 0.4 % of its swing.
    np.testing.assert_allclose(high, np.max(still.shaft_torque[1]), rtol=1e-3)
    np.testing.assert_allclose(low, np.min(still.shaft_torque[1]), rtol=1e-3)


def test_extremes_are_told_with_their_instants():
    found = moving_forces(PTO, None, [SWING])
    size = found.reaction_size
    most = found.extreme(size)
    for k in range(len(PTO.supports)):
        assert most.high[k] == np.max(size[k])
        assert size[k, np.flatnonzero(found.times == most.high_time[k])[0]] == most.high[k]
        assert most.low[k] <= np.min(size[k])


def test_long_movements_are_looked_at_here_and_there(monkeypatch):
    monkeypatch.setattr(module, "MOST_TURNS", 7)
    found = moving_forces(PTO, None, [SWING])
    assert not found.complete
    assert found.turn_times.size == 7
    per_turn = 2 * np.pi / PTO.duty.speed
    np.testing.assert_allclose(np.diff(found.times[: found.samples]), per_turn / found.samples)
    assert found.times[-1] < 2.0
    assert found.times[-found.samples] == pytest.approx(2.0 - per_turn)


def test_a_drive_turning_the_other_way_is_followed_too():
    back = replace(PTO, duty=replace(PTO.duty, speed=-540 * rpm))
    found = moving_forces(back, None, [SWING])
    assert np.all(np.diff(found.forces.angle) < 0.0)
    assert np.max(found.forces.force_left) < 1e-9


def test_the_reader_can_stop_it():
    told = []

    def stop(share):
        told.append(share)
        return "stop"

    found = moving_forces(PTO, None, [SWING], progress=stop)
    assert found.cancelled
    assert len(told) == 1
    assert found.times.size == found.forces.angle.size == module.AT_ONCE * found.samples


def test_what_it_needs_is_named():
    with pytest.raises(InputError, match="nothing moves"):
        moving_forces(PTO)
    with pytest.raises(InputError, match="how fast the axes move"):
        moving_forces(replace(PTO, duty=replace(PTO.duty, speed=None)), None, [SWING])
    with pytest.raises(InputError, match="has not been read"):
        moving_forces(PTO, None, [Table(moves=("output",), file="x.csv")])
