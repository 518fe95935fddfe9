"""Centres, bends and slopes describe the same drive."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import Drive, InputError, equivalent_joint, motion
from cardan.drive.forms import in_form
from cardan.drive.geometry import geometry

RNG = np.random.default_rng(7)


def spatial(n: int) -> Drive:
    steps = RNG.uniform([0.2, -0.15, -0.15], [1.0, 0.15, 0.15], (n + 2, 3))
    yokes = RNG.uniform(-1.5, 1.5, n - 1)
    return Drive.from_points(np.cumsum(steps, axis=0).tolist(), yoke_angles=yokes.tolist(), start_phase=0.3)


@pytest.mark.parametrize("n", range(1, 7))
@pytest.mark.parametrize("form", ["points", "angles", "slopes"])
@pytest.mark.parametrize("back", ["points", "angles", "slopes"])
def test_motion_is_the_same_in_every_form(n: int, form: str, back: str) -> None:
    drive = spatial(n)
    other = in_form(in_form(drive, form), back)  # type: ignore[arg-type]
    assert other.form == back
    # The forms go through sines and cosines of the bends: some roundings of 1e-16 each.
    np.testing.assert_allclose(motion(other).shaft_angle, motion(drive).shaft_angle, atol=1e-13)
    np.testing.assert_allclose(geometry(other).length, geometry(drive).length, rtol=1e-13)
    assert equivalent_joint(other).irregularity == pytest.approx(float(equivalent_joint(drive).irregularity), abs=1e-14)


def test_bends_of_a_level_input_shaft_keep_the_drive_in_place() -> None:
    drive = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0.1, -0.2), (2, 0.3, -0.2)])
    again = in_form(in_form(drive, "angles"), "points")
    np.testing.assert_allclose(geometry(again).points, geometry(drive).points, atol=1e-14)


def test_slopes_read_as_a_technician_measures_them() -> None:
    drive = in_form(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 1, -1)]), "slopes")
    assert np.rad2deg(drive.shafts[1].side_slope) == pytest.approx(-45)  # falling along the power flow
    assert np.rad2deg(drive.shafts[1].plan_slope) == pytest.approx(45)  # to the left


def test_a_shaft_that_does_not_run_forwards_has_no_slopes() -> None:
    drive = Drive.from_points([(0, 0, 0), (0, 1, 0), (0.1, 2, 0)])
    with pytest.raises(InputError, match="does not run along") as caught:
        in_form(drive, "slopes")
    assert [problem.field for problem in caught.value.problems] == ["shafts[0]"]


def test_lengths_not_said_stay_unsaid() -> None:
    drive = in_form(Drive.from_angles([0.1, 0.2]), "slopes")
    assert all(shaft.length is None for shaft in drive.shafts)


def test_what_stands_in_coordinates_is_not_carried_over() -> None:
    from cardan import example

    with pytest.raises(InputError) as caught:
        in_form(example("truck-rear-axle"), "angles")
    assert {problem.field for problem in caught.value.problems} == {"movements", "poses"}
