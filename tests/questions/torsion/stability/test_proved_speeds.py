"""Ranges of unstable speed to their edges, and the proof that there are no others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from cardan import example, stability
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.station import ToNext
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.stability.answer import answer
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.stability.proved_speeds import _Drive, proved_speeds
from cardan.questions.torsion.stability.torsion_stability import proved_in_band
from cardan.questions.torsion.steady import steady
from cardan.questions.torsion.steady.run_stability import Verdict, floquet
from cardan.questions.torsion.steady.several import stable_motions
from cardan.questions.torsion.steady.steady import periodic_response, steady_orbits
from cardan.units import rpm
from tests.builders.torsion_in_time import drive
from tests.questions.torsion.transient.test_springs import drive as rubbing

SPEEDS = "duty.speed_rpm"


@pytest.mark.slow
def test_a_zone_between_the_points_asked_is_found_to_its_edges() -> None:
    """The stand runs amid a zone of 38 rpm; its points here are 132 rpm apart."""
    stand = example("unstable-drive")
    found = stability(stand, over={SPEEDS: np.linspace(500.0, 3000.0, 20)})
    assert not np.any(found.verdict == Verdict.UNSTABLE)
    proof = found.proof
    assert proof is not None
    assert proof.hidden < 0.2 * rpm  # where three motions meet at 669 rpm, see test_drift
    assert np.all((665 * rpm < proof.unproved) & (proof.unproved < 675 * rpm))

    def growth(speed):
        model = found.train.model
        return float(floquet(periodic_response(model, speed=speed * rpm)).spectral_radius) - 1.0

    edges = [brentq(growth, *ends, xtol=1e-7) for ends in ((1315.0, 1325.0), (1355.0, 1362.0))]
    np.testing.assert_allclose([proof.lowest[-1] / rpm, proof.highest[-1] / rpm], edges, rtol=1e-6)
    assert proof.zone.name((len(proof.lowest) - 1,)) == "principal zone of mode 1"
    assert proof.lowest[-1] < proof.worst[-1] < proof.highest[-1]
    found = stability(stand, over={SPEEDS: np.linspace(900.0, 3000.0, 5)})
    assert found.proof is not None
    assert found.proof.proved
    said = answer(stand, found)
    assert said.tone == "failed"
    assert "1 320.94 to 1 358.74 rpm; otherwise stable from 900 to 3 000 rpm, proved" in told(
        said.sentence, USUAL
    ).replace("\u202f", " ")


@pytest.mark.slow
def test_the_grid_does_not_move_the_edges() -> None:
    stand = example("unstable-drive")
    ends = [
        stability(stand, over={SPEEDS: np.linspace(900.0, 2000.0, count)}).proof.lowest  # type: ignore[union-attr]
        for count in (3, 14)
    ]
    assert np.array_equal(*ends)


@pytest.mark.slow
def test_what_is_proved_stands_against_many_samples() -> None:
    model = drive(damping=0.2, joint_angle=0.5)
    proof = proved_speeds(model, 60.0, 140.0)
    assert len(proof.lowest) == 2
    assert np.array_equal(proof.open, proof.unproved)
    (jump,) = proof.open  # there the motion followed is the middle one of three: another, stable, runs beside it
    assert 0.0 < jump[1] - jump[0] < 0.2
    orbit = stable_motions(*steady_orbits(model, speed=np.linspace(*jump, 5)[1:-1]))[0]
    assert floquet(orbit).stable.all()
    speeds = np.sort(np.random.default_rng(1).uniform(60.0, 140.0, 600))
    verdict = floquet_map(model, speed=speeds).floquet.verdict
    ends = np.concatenate([[proof.lowest, proof.highest], proof.open.T], axis=-1)
    inside = np.any((ends[0] <= speeds[:, None]) & (speeds[:, None] <= ends[1]), axis=-1)
    near = np.min(np.abs(ends.ravel() - speeds[:, None]), axis=-1) < 1e-3
    assert np.array_equal((verdict == Verdict.UNSTABLE)[~near], inside[~near])


@pytest.mark.slow
def test_open_backlash_is_not_called_proved() -> None:
    proof = proved_speeds(drive(backlash=0.004, load=40.0), 36.0, 95.0)
    assert not proof.proved
    assert proof.shown(np.asarray([36.5, 90.0])).tolist() == [True, False]
    assert np.array_equal(proof.open, proof.unproved)


@pytest.mark.slow
def test_without_damping_zones_are_found_to_a_width() -> None:
    model = drive(damping=0.0)
    model = replace(model, torques=model.torques[:1])
    proof = proved_speeds(model, 55.0, 75.0)
    assert proof.neutral
    assert not proof.proved
    assert 0.0 < proof.hidden < 0.01


def test_a_line_that_takes_too_long_says_that_points_are_points() -> None:
    proof = proved_speeds(drive(), 40.0, 60.0, work=1.0)
    assert not proof.looked_at
    assert proof.hidden == pytest.approx(20.0)
    stand = example("unstable-drive")
    found = replace(stability(stand, over={SPEEDS: [1330.0, 1340.0, 1350.0]}), proof=proof)
    said = answer(stand, found)
    assert told(said.sentence, USUAL).startswith("unstable at 1\u202f330 to 1\u202f350 rpm")
    assert any("points 10 rpm apart" in told(one.text, USUAL) for one in said.remarks)


@pytest.mark.slow
def test_what_takes_too_long_is_left_unsettled_and_told() -> None:
    """The stand again, with too little work for the edges of its zones."""
    stand = example("unstable-drive")
    found = stability(stand, over={SPEEDS: np.linspace(500.0, 3000.0, 5)})
    proof = proved_speeds(found.train.model, 500.0 * rpm, 3000.0 * rpm, work=60_000.0)
    assert proof.looked_at
    assert proof.samples <= 60_000.0 / 500.0
    assert len(proof.unsettled)
    assert not proof.proved
    said = answer(stand, replace(found, proof=proof))
    assert any("Not settled at" in told(one.text, USUAL) for one in said.remarks)
    assert len(data(said, USUAL)["proof"]["unsettled_rpm"]) == len(proof.unsettled)


@pytest.mark.slow
def test_a_stable_range_is_a_statement() -> None:
    found = stability(example("two-piece-rubber-bearing"), over={SPEEDS: np.linspace(700.0, 900.0, 5)})
    said = answer(example("two-piece-rubber-bearing"), found)
    assert told(said.sentence, USUAL) == "stable from 700 to 900 rpm: proved throughout."
    facts = data(said, USUAL)["proof"]
    assert facts["proved"]
    assert facts["unstable"] == []
    assert facts["widest_zone_hidden_rpm"] == 0.0


@pytest.mark.slow
def test_friction_that_sticks_is_proved_and_motions_in_which_it_slips_are_not_searched_for(monkeypatch) -> None:
    """No polynomial in the speed holds a motion with kinks, and a search for each is minutes for nothing."""

    def searched(*_args) -> None:
        raise AssertionError

    monkeypatch.setattr(steady, "_along", searched)
    monkeypatch.setattr(steady, "_sharp", searched)
    sticks, slips = (ToNext(stiffness=4000.0, damping=1.0, friction=torque) for torque in (300.0, 5.0))
    assert proved_in_band(rubbing(sticks), 45.0, 50.0).stable
    found = proved_in_band(rubbing(slips), 45.0, 50.0)
    assert found.unproved.tolist() == found.open.tolist() == [[45.0, 50.0]]


def test_where_a_drive_that_turns_backwards_has_no_motion_its_matrix_is_none_and_no_rounding():
    """The basis without the shift in time needs a direction there too, not one against itself."""
    model = torsional_line([[0.5], [0.1, 0.3]], stiffness=[[], [900.0]], damping=[[], [0.2]], joint_angle=[0.4])
    drive = _Drive(model, 40.0, None)
    turning = drive._turning(np.asarray([-40.0, 40.0]))
    size = len(drive.energy)
    coefficient = np.full((2, turning.coordinates, 5), np.nan + 0j)
    found = drive._reduced(np.zeros((2, size, size)), coefficient, turning)
    assert np.all(found == 0.0)
