"""What is put down to the rounding of the figures that describe a drive."""

import math
from dataclasses import replace

import pytest

from cardan.drive.drive import Drive
from cardan.drive.duty import Limits
from cardan.io import example
from cardan.questions.motion.equivalence import SPECK
from cardan.report.block import Picture, Words
from cardan.report.content import moved, phased
from cardan.report.subject import Subject
from cardan.report.summary import uniformity
from tests.report.first_page import key_rows

SMALL = math.radians(0.05)


@pytest.mark.parametrize("joint_angles", [[SMALL], [0.0, SMALL], [0.3 * SMALL, SMALL]])
def test_a_small_bend_that_the_file_gives_by_itself_is_no_rounding(joint_angles):
    on = Subject(drive=Drive.from_angles(joint_angles))
    assert 1e-8 < float(on.whole.speed_fluctuation) < SPECK
    assert not on.rounded
    assert not on.curable
    said = [uniformity(on).text]
    for page in (phased(on), moved(on)):
        said += [page.answer, *(one.text for one in page.blocks if isinstance(one, Words))]
        said += [one.figure.sentence for one in page.blocks if isinstance(one, Picture)]
    assert not any("rounding" in text for text in said)


@pytest.mark.parametrize(
    "drive",
    [Drive.from_angles([0.2, 0.2 + 1e-6]), Drive.from_points([(0, 0, 0), (1, 0.0001, 0), (2, 0, 0)])],
    ids=["joints that undo each other", "joint drawn by points"],
)
def test_a_speck_is_rounding_unless_the_user_asks_for_less(drive):
    on = Subject(drive=drive)
    assert on.rounded
    limit = 0.5 * float(on.whole.speed_fluctuation)
    asked = Subject(drive=replace(drive, limits=Limits(speed_fluctuation=limit)))
    assert not asked.rounded
    assert not asked.curable
    assert [uniformity(one).tone for one in (on, asked)] == ["good", "warning"]
    assert Subject(drive=replace(drive, limits=Limits(speed_fluctuation=4.0 * limit))).rounded


def test_yokes_that_leave_a_speck_cure_a_drive_whose_joints_undo_each_other():
    drive = example("pto-spline-thrust")
    turned = replace(drive.shafts[1], yoke_angle=drive.shafts[1].yoke_angle + 0.5)
    assert Subject(drive=replace(drive, shafts=(drive.shafts[0], turned, *drive.shafts[2:]))).curable


@pytest.mark.parametrize("joint_angles", [[SMALL], [0.0, SMALL]])
def test_a_small_acceleration_is_told(joint_angles):
    (row,) = [row for row in key_rows(Drive.from_angles(joint_angles)) if "acceleration" in row[0].text]
    assert row[1].text == "7.615·10⁻⁷"
