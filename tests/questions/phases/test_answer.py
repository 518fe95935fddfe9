"""What is said of the phasing of the yokes: settings, what they leave, and why no less is possible."""

import re

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.io import example, loads
from cardan.questions.phases.answer import answer, ask, spread
from cardan.texts import speaking
from cardan.units import deg

RADIANS = Reader(units={"angle": "rad"}, decimal=",")


def posed(kind: str, joint_angle: float) -> Drive:
    """Return two joints of a kind with this joint angle [°], and a pose with 20° at the first."""
    joints = f'[[joints]]\nkind = "{kind}"\njoint_angle_deg = {joint_angle}\n' * 2
    return loads(f'format = 1\n{joints}[[poses]]\nname = "low"\nset = {{ "joints[0].joint_angle_deg" = 20 }}\n')


def of(drive):
    return answer(drive, ask(drive))


def said_of(drive, reader=USUAL):
    said = of(drive)
    return " ".join([told(said.sentence, reader), *(told(one.text, reader) for one in said.remarks)])


@pytest.mark.parametrize(
    ("kind", "joint_angle", "said"),
    [
        ("rzeppa", 10.0, "the yokes may stand anyhow"),
        ("rzeppa", 0.0, "the yokes may stand anyhow"),
        ("hooke", 0.0, "as drawn every joint turns uniformly by itself, the yokes count"),
    ],
)
def test_yokes_count_in_poses_where_a_straight_joint_is_not_of_constant_velocity(kind, joint_angle, said):
    assert said in told(of(posed(kind, joint_angle)).sentence, USUAL)


def test_what_is_only_rounding_in_the_worst_pose_is_no_cost_of_a_yoke():
    """One bent joint in the only pose: whatever its yokes, it fluctuates as much, and the drive drawn straight not."""
    drive = posed("hooke", 0.0)
    (costs,) = [one for one in of(drive).tables if one.title.startswith("Growth")]
    assert [list(one.values) for one in costs.columns[1:]] == [[0.0], [0.0]]
    assert [told(one.text, USUAL) for one in spread(ask(drive))] == ["A yoke 1° off adds 0 % to δ on shaft 2."]


@pytest.mark.parametrize(
    ("drive", "text"),
    [
        (Drive.from_angles([0.3]), "a single joint has no yokes to phase."),
        (Drive.from_angles([0.3, 0.3]), "the yokes are phased right, the output is exactly uniform as specified."),
        (Drive.from_angles([0.3, 0.3], yoke_angles=[0.7]), "as specified, exactly uniform with other yoke angles."),
        (example("pto-spline-thrust"), "the yokes are phased right, uniform but for the rounding of its figures"),
        (Drive.from_angles([10 * deg, 30 * deg, 20 * deg]), "no yoke angles leave less than"),
    ],
)
def test_the_sentence_says_what_the_yokes_can_do(drive, text):
    assert told(of(drive).sentence, USUAL).endswith(text) or text in told(of(drive).sentence, USUAL)


def test_the_settings_are_those_of_the_analysis():
    drive = example("truck-printed-angles")
    found, said = ask(drive), of(drive)
    table = said.tables[0]
    assert list(table.columns[0].values)[:4] == ["as specified", "A", "B", "C"]
    assert list(table.columns[1].values)[1:4] == [one.yoke_angle[0] for one in found.settings]
    facts = data(said, USUAL)["settings"]
    assert [one["label"] for one in facts[:2]] == ["as specified", "A"]
    assert facts[1]["yoke_angle_deg"] == pytest.approx((found.settings[0].yoke_angle / deg).tolist())


def test_readers_are_told_in_their_units_and_language():
    drive = example("truck-printed-angles")
    assert data(of(drive), RADIANS)["settings"][1]["yoke_angle_rad"][0] == pytest.approx(-1.9 * deg, abs=1e-3)
    assert "A yoke 1° off adds 0,14 % / 0,11 % / 0,29 % to δ" in said_of(drive, RADIANS)
    with speaking("ru"):
        assert "4 шарнира" in told(of(drive).sentence, USUAL)


def test_sides_of_small_joint_angles_have_three_digits():
    text = said_of(example("two-piece-rubber-bearing"))
    sides = re.search(r"here ([0-9., ]+)\. The yoke", text)
    assert sides is not None
    longest = max(sides[1].split(", "), key=float)
    assert len(longest.lstrip("0.")) == 3
