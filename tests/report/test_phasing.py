"""The page of the yoke angles of drives with poses."""

import pytest

from cardan.cli.phasing import spread
from cardan.drive.drive import Drive
from cardan.io import loads
from cardan.report.block import Table
from cardan.report.phasing import phasing
from cardan.report.subject import Subject


def posed(kind: str, bend: float) -> Drive:
    """Return two joints of a kind with this bend [°], and a pose with 20° at the first."""
    joints = f'[[joints]]\nkind = "{kind}"\nbend_deg = {bend}\n' * 2
    return loads(f'format = 1\n{joints}[[poses]]\nname = "low"\nset = {{ "joints[0].bend_deg" = 20 }}\n')


@pytest.mark.parametrize(
    ("kind", "bend", "said"),
    [
        ("rzeppa", 10.0, "The yokes may stand anyhow"),
        ("rzeppa", 0.0, "The yokes may stand anyhow"),
        ("hooke", 0.0, "As drawn every joint turns evenly by itself; the yokes count"),
    ],
)
def test_yokes_count_in_poses_where_a_straight_joint_is_not_of_constant_velocity(kind, bend, said):
    assert phasing(Subject(drive=posed(kind, bend))).answer.startswith(said)


def test_what_is_only_rounding_in_the_worst_pose_is_no_cost_of_a_yoke():
    """One bent joint in the only pose: whatever its yokes, it stays as uneven, and the drive drawn straight is even."""
    on = Subject(drive=posed("hooke", 0.0))
    (costs,) = [one for one in phasing(on).blocks if isinstance(one, Table) and one.title.startswith("Growth")]
    assert [cell.text for row in costs.rows for cell in row[1:]] == ["0", "0"]
    assert [one.text for one in spread(on.phasing)] == ["A yoke 1° off costs 0 % on shaft 2."]
