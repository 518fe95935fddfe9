"""What is said of accuracy: the numbers of the analysis, for any reader, of errors, of tolerances, of both."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.questions.accuracy.allocation import allocate
from cardan.questions.accuracy.answer import answer, answer_of_allocation, ask, lacking, otherwise
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.questions.accuracy.tolerance import WorstCase, tolerance
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import arcmin

INSTRUMENT = example("instrument-joint")
INCHES = Reader(units={"displacement": "in", "angle": "deg"}, decimal=",")


def with_errors(drive, error, spread=None):
    joints = tuple(replace(joint, error=error, tolerance=spread) for joint in drive.joints)
    return replace(drive, joints=joints)


def of(drive, **given):
    return answer(drive, ask(drive, **given))


def column(table, key):
    return next(one for one in table.columns if one.key == key)


def test_bounds_and_what_makes_them():
    said, found, worst = of(INSTRUMENT), tolerance(INSTRUMENT), tolerance(INSTRUMENT, method=WorstCase())
    assert told(said.sentence, USUAL) == (
        "angle error of the output up to ±2.41′ (root of squares), ±4.11′ in the worst case; yoke phase of joint 1 "
        "makes 75 % of the variance."
    )
    turned, shifted, _cross, parts, lengths, _checks = said.tables
    assert list(column(turned, "largest").values) == [found.output.largest, worst.output.largest]
    assert list(column(shifted, "peak_to_peak").values) == [found.shift.peak_to_peak, worst.shift.peak_to_peak]
    assert list(column(parts, "share").values) == [one.share for one in found.output.contributions]
    assert list(column(lengths, "tolerance").values) == [one.tolerance for one in found.shift.contributions]
    assert [key.value.value for key in said.keys] == [found.output.largest, worst.output.largest]


@pytest.mark.parametrize(
    ("method", "name"), [(WorstCase(), "worst"), (MonteCarlo(samples=256), "samples")], ids=["worst", "samples"]
)
def test_the_method_is_told_in_every_language(method, name):
    with speaking("ru"):
        assert data(of(INSTRUMENT, method=method), USUAL)["method"] == name


def test_what_is_alike_is_told_together():
    drive = Drive.from_angles([0.3, 0.3])
    drive = with_errors(drive, None, Tolerance(alpha2=2 * arcmin, phase=1 * arcmin))
    assert "α₂ of joint 1 and α₂ of joint 2 make 40 % of the variance each" in told(of(drive).sentence, USUAL)


def test_readers_are_told_in_their_units_and_language():
    said = of(INSTRUMENT)
    assert told(said.sentence, INCHES).startswith("angle error of the output up to ±0,0401° (root of squares)")
    content = data(said, INCHES)
    assert content["shift"]["largest_in"] == pytest.approx(tolerance(INSTRUMENT).shift.largest / 0.0254)
    assert "error_upper_deg" in content["bounds"]
    with speaking("ru"):
        assert "шарнир 1" in told(of(INSTRUMENT).sentence, USUAL)


def test_known_errors_stand_beside_the_bounds_they_shift():
    both = with_errors(INSTRUMENT, Error(alpha2=2 * arcmin), INSTRUMENT.joints[0].tolerance)
    said = of(both)
    table = said.tables[0]
    assert table.columns[0].values[0] == "known errors"
    assert any("the bounds hold that" in told(one.text, USUAL) for one in said.remarks)
    alone = of(with_errors(INSTRUMENT, Error(alpha2=2 * arcmin)))
    assert told(alone.sentence, USUAL).startswith("known errors make an angle error of up to 2.13′ at the output")
    np.testing.assert_allclose(column(alone.full(), "error_exact").values, ask(both).known.error)
    assert [figure.name for figure in alone.figures()] == ["errors"]


def test_errors_that_do_nothing_and_joints_that_do_not_close():
    none = with_errors(Drive.from_angles([0.3]), Error())
    assert ask(none) is None
    assert otherwise(none) == "The errors given do nothing to the output."
    said = of(with_errors(Drive.from_angles([0.3, 0.2]), Error(alpha2=1.3)))
    assert "cannot be assembled" in told(said.sentence, USUAL)
    assert [one.tone for one in page(said, USUAL).alarms] == ["failed"]


def test_checks_hold_and_errors_are_asked_for():
    found = data(of(INSTRUMENT), USUAL)["checks"]
    assert found
    assert all(one["residual"] <= one["allowed"] for one in found)
    assert lacking(Drive.from_angles([0.3])) == (("joints[0].tolerance", "joints[0].error"),)


def test_allotted_tolerances_in_the_units_of_the_reader():
    found = allocate(INSTRUMENT, 5e-6, of="shift")
    said = answer_of_allocation(INSTRUMENT, found)
    assert "within ±0,000197 in" in told(said.sentence, INCHES)
    content = data(said, USUAL)
    assert content["target_um"] == pytest.approx(5.0)
    assert [one["allotted_um"] for one in content["tolerances"]] == pytest.approx(
        [one.tolerance / 1e-6 for one in found.rows]
    )
