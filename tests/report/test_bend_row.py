"""The largest joint angle among the key figures: held against the same limit as on the page on limits."""

from dataclasses import replace

import pytest

from cardan.checks import check
from cardan.checks.verdict_table import tone_of
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.units import deg
from tests.report.first_page import key_rows


def row(drive):
    return next(one for one in key_rows(drive) if one[0].text.startswith("largest joint angle"))


@pytest.mark.parametrize("name", ["truck-duty-cycle", "pto-drive"])
def test_the_rating_of_the_joint_is_the_limit_in_both_places(name):
    drive = example(name)
    worst = max((one for one in check(drive, only=["joint_angle"]) if one.run), key=lambda one: one.utilisation)
    shown = row(drive)
    assert float(shown[3].full) == pytest.approx(worst.limit / deg)
    assert float(shown[4].full) == pytest.approx(worst.utilisation)
    assert (shown[0].text[-1], shown[5].tone) == (worst.title[-1], tone_of(worst))


def test_a_joint_without_a_rating_passes_nothing_but_nears_the_utmost_of_its_kind():
    plain = row(example("single-20deg"))
    assert [cell.text for cell in plain[3:]] == ["–", "–", ""]
    steep = row(Drive.from_angles([42 * deg]))
    assert [cell.text for cell in steep[3:]] == ["≤ 45", "0.93", "near the limit"]


@pytest.mark.slow
def test_a_bend_while_moving_says_so():
    drive = example("truck-rear-axle")
    drive = replace(drive, limits=replace(drive.limits, joint_angle=12 * deg))
    shown = row(drive)
    assert shown[0].text == "largest joint angle, joint 2 (axle), while the drive moves, at 0.371 s; in the pose empty"
    assert shown[3].text == "≤ 12"
