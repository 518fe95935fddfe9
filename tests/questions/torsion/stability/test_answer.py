"""What is said of parametric stability: of a point, over a quantity and of a map, and where there is nothing to map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example, stability
from cardan.answers.data import as_csv, data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.questions.torsion.stability import answer as home

OTHER = Reader(units={"angular_speed": "rad_s", "angle": "rad"}, decimal=",")


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, count in (("ACROSS", 9), ("UP", 4), ("COARSE_ACROSS", 5), ("COARSE_UP", 3)):
        monkeypatch.setattr(home, name, count)


@pytest.mark.slow
def test_a_map_without_anything_on_it_is_a_sentence() -> None:
    drive = example("pto-flywheel-absorber")
    found = home.ask(drive)
    assert found is not None
    said = home.answer(drive, found)
    assert said.figures() == ()
    assert told(said.sentence, USUAL).startswith(
        "stable at every point: input speed 270 to 810 rpm; largest joint angle "
    )
    assert [one.name for one in home.answer(drive, found, signs=True).figures()] == ["stability-map"]


@pytest.mark.slow
def test_a_map_tells_its_share_and_its_zones() -> None:
    drive = example("unstable-drive")
    found = home.ask(drive)
    assert found is not None
    said = home.answer(drive, found)
    assert (said.tone, said.code) == ("failed", 0)
    assert "of the map is unstable: principal zone of mode 1" in told(said.sentence, USUAL)
    assert [one.name for one in said.figures()] == ["stability-map"]
    assert said.tables == ()  # signs are for terminals
    (picture,) = home.answer(drive, found, signs=True).tables
    assert "O" in "".join(picture.columns[1].values)


def test_straight_joints_have_no_map() -> None:
    drive = example("unstable-drive")
    straight = replace(drive, joints=Drive.from_angles([0.0] * len(drive.joints)).joints)
    assert home.ask(straight) is None
    assert "straight" in home.otherwise(straight)


@pytest.mark.slow
def test_backlash_makes_the_map_coarse_and_says_how_to_get_it_in_full() -> None:
    drive = example("pto-flywheel")
    found = home.ask(drive)
    assert found is not None
    assert found.verdict.shape == (5, 3)
    (hint,) = [told(one.text, USUAL) for one in home.answer(drive, found).remarks if one.depth == "full"]
    assert "cardan torsion stability FILE --speeds 270:810:9" in hint


@pytest.mark.slow
def test_axes_are_told_in_the_units_of_the_reader() -> None:
    drive = example("unstable-drive")
    found = stability(drive, over={"duty.speed_rpm": np.linspace(1300.0, 1400.0, 5), "joint_angle_deg": [5.0, 40.0]})
    said = home.answer(drive, found, signs=True)
    assert said.full is not None
    first = "".join(as_csv(said.full(), OTHER)).splitlines()[0]
    assert first.startswith("duty.speed_rad_s,joint_angle_rad,input_speed_rad_s,verdict,")
    assert told(said.tables[0].note, OTHER) == "Across: input speed 136 to 147 rad/s."
    assert data(said, OTHER)["verdict"][0][0] in ("stable", "unstable")
    over = stability(drive, over={"duty.speed_rpm": np.linspace(1300.0, 1400.0, 5)})
    assert "rad/s" in told(home.answer(drive, over).sentence, OTHER)
