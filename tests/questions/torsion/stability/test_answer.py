"""What is said of parametric stability: of a point, over a quantity and of a map, and where there is nothing to map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, check, example, stability, torsion_response
from cardan.answers.data import as_csv, data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty
from cardan.drive.machine import HarmonicTorque
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station, ToNext
from cardan.io import loads
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.stability import answer as home
from cardan.questions.torsion.stability import torsion_stability as asking
from cardan.questions.torsion.stability.torsion_stability import EDGE, no_smooth_motion, proved_in_use
from cardan.questions.torsion.steady import answer as told_running
from cardan.questions.torsion.steady import torsion_response as running
from cardan.questions.torsion.steady.answer import answer as running_answer
from cardan.units import deg

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


def test_what_may_stop_a_proof_is_named_by_what_the_drive_has() -> None:
    """A spring by a table bends, and only backlash that is there opens."""
    bent = ((-0.07, -0.05, 0.0, 0.05, 0.07), (-900.0, -300.0, 0.0, 300.0, 900.0))
    for backlash, table, want in (
        (0.0, None, "the motion jumps"),
        (0.01, None, "backlash opens or the motion jumps"),
        (0.0, bent, "a spring bends or the motion jumps"),
        (0.01, bent, "backlash opens, a spring bends or the motion jumps"),
    ):
        train = torsional_train(example("unstable-drive"))
        model = replace(train.model, backlash=np.full_like(train.model.backlash, backlash))
        springs = () if table is None else ((0, ToNext(twists=table[0], torques=table[1])),)
        assert no_smooth_motion(replace(train, model=model, springs=springs)) == want


def engined(amplitude: float) -> Drive:
    """Return a drive at 29.8 rad/s, where a torque of order 3.315 meets its mode twice."""
    return replace(
        Drive.from_angles([25 * deg]),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=3.0),),
        stations=(Station(shaft=2, inertia=0.4, name="load"),),
        duty=Duty(speed=29.8, torques=(HarmonicTorque(amplitude=amplitude, order=3.315, station="load"),)),
    )


@pytest.mark.slow
def test_at_a_point_orders_that_do_not_repeat_count_and_every_answer_says_so() -> None:
    """Whether the drive is unstable by that order alone is one answer in stability, response and check."""
    held = "Stability is that of the motion with the orders that do not repeat within two turns (3.315)."
    for amplitude, grows in ((120.0, True), (10.0, False)):
        drive = engined(amplitude)
        found, running = stability(drive), torsion_response(drive)
        assert bool(found.together)
        assert bool(running.together)
        assert float(found.growth_rate) == pytest.approx(float(running.floquet.growth_rate), rel=1e-6)
        assert (float(found.growth_rate) > 0.0) == grows
        assert check(drive, only=["parametric_stability"])[0].passed != grows
        for said in (home.answer(drive, found), running_answer(drive, running)):
            assert held in [told(one.text, USUAL) for one in said.remarks]
            assert ("torques of an order that does not repeat" in told(said.sentence, USUAL)) == grows


@pytest.mark.slow
def test_over_speeds_and_maps_they_count_as_at_each_point_and_the_answers_say_so() -> None:
    drive, speeds = engined(120.0), np.linspace(26.0, 34.0, 5)
    over = stability(drive, over={"duty.speed_rad_s": speeds})
    both = stability(drive, over={"duty.speed_rad_s": speeds, "duty.torques[0].amplitude_Nm": [10.0, 120.0]})
    swept = torsion_response(drive, speed=speeds)
    held = "Stability is that of the motion with the orders that do not repeat within two turns (3.315)."
    answers = [home.answer(drive, one) for one in (over, both)]
    for said in (*answers, running_answer(drive, swept)):
        assert held in [told(one.text, USUAL) for one in said.remarks]
    assert over.together.all()
    assert swept.together.all()
    assert both.together.all()
    alone = [stability(replace(drive, duty=replace(drive.duty, speed=float(one)))) for one in speeds]
    assert [float(one.growth_rate) for one in alone] == pytest.approx(over.growth_rate, rel=1e-3)
    assert over.growth_rate == pytest.approx(swept.floquet.growth_rate, rel=1e-3)
    assert over.growth_rate == pytest.approx(both.growth_rate[:, 1], rel=1e-3)
    assert (over.growth_rate > 0.0).any()
    assert (both.growth_rate[:, 0] < 0.0).all()
    assert over.proof is not None
    assert over.proof.stable  # without these orders, which no verdict and no picture may take for the whole
    assert answers[0].tone == "failed"
    (figure,) = answers[0].figures()
    assert any(type(one).__name__ == "Band" for one in figure.rows[0].panels[0].series)
    texts = [told(one.text, USUAL) for one in answers[0].remarks]
    assert any(one.startswith("Only points") and "nothing is proved with orders" in one for one in texts)
    assert "What is proved leaves out the orders that do not repeat within two turns." in texts


@pytest.mark.slow
def test_where_they_cannot_count_the_answers_say_so(monkeypatch: pytest.MonkeyPatch) -> None:
    drive, speeds = engined(120.0), np.linspace(26.0, 34.0, 5)
    orders = stability(drive, over={"duty.torques[0].order": [3.315, 3.415]})  # points with other torques each
    monkeypatch.setattr(asking, "MANY", 4)
    monkeypatch.setattr(home, "MANY", 4)
    monkeypatch.setattr(running, "COUNTED", 4)
    monkeypatch.setattr(told_running, "COUNTED", 4)
    over, swept = stability(drive, over={"duty.speed_rad_s": speeds}), torsion_response(drive, speed=speeds)
    without = "Stability is judged without the orders that do not repeat within two turns (3.315)"
    for said, why in (
        (home.answer(drive, over), "; at up to 4 points they count."),
        (running_answer(drive, swept), "; at up to 4 points they count."),
        (home.answer(drive, orders), ": how disturbances of the motion with them grow is not known here."),
    ):
        assert without + why in [told(one.text, USUAL) for one in said.remarks]
    for found in (over, swept, orders):
        assert not found.together.any()


@pytest.mark.slow
def test_the_check_over_a_range_finds_where_that_order_alone_makes_vibration_grow() -> None:
    drive = engined(120.0)
    ranged = replace(drive, duty=replace(drive.duty, speed=None, speed_range=(25.0, 40.0)))
    proof = proved_in_use(ranged)
    assert proof is not None
    assert proof.zone.by_torques.tolist() == [True]
    for edge, beyond in ((proof.lowest[0], -1.0), (proof.highest[0], 1.0)):
        there = [edge, edge * (1.0 + 2.0 * beyond * EDGE)]
        assert (stability(drive, over={"duty.speed_rad_s": there}).growth_rate > 0.0).tolist() == [True, False]
    (verdict,) = check(ranged, only=["parametric_stability"])
    assert not verdict.passed
    assert "count at single speeds, not between them" in told(verdict.note, USUAL)
    (calm,) = check(
        replace(ranged, duty=replace(ranged.duty, torques=engined(10.0).duty.torques)), only=["parametric_stability"]
    )
    assert calm.passed


@pytest.mark.slow
def test_who_stops_amid_these_orders_is_told_so() -> None:
    asked: list[float] = []

    def stop(share: float) -> str | None:
        asked.append(share)
        return "stop" if share > 0.25 else None

    found = stability(engined(120.0), over={"shafts[0].damping_Nms_per_rad": np.linspace(1.0, 3.0, 80)}, progress=stop)
    assert found.cancelled
    assert 0 < np.sum(found.together) < 80


FREE_TRIPOD = """
format = 1
joints = [
  { kind = "tripod", joint_angle_deg = 20, track_radius_mm = 20 },
  { joint_angle_deg = 15, plane_twist_deg = 40 },
]
shafts = [
  { number = 2, length_mm = 300, yoke_angle_deg = 25, stiffness_Nm_per_rad = 6000, damping_Nms_per_rad = 0.3 },
  { number = 3, stiffness_Nm_per_rad = 9000, damping_Nms_per_rad = 0.3 },
]
stations = [{ shaft = 1, inertia_kg_m2 = 0.9 }, { shaft = 3, inertia_kg_m2 = 0.1 }]
duty = { input = "free", torque_Nm = 200, speed_rpm = SPEED }
"""


@pytest.mark.parametrize(("turns", "jumps"), [(1700, False), (1910, True)])
def test_a_motion_to_which_another_grows_is_no_good_news(turns: int, jumps: bool) -> None:
    """Amid a parametric zone order 1 of a wobble leads to a wide steady motion, stable in itself."""
    drive = loads(FREE_TRIPOD.replace("SPEED", str(turns)))
    found = stability(drive)
    said = home.answer(drive, found)
    assert bool(found.stable)
    assert (bool(found.jumped), said.tone) == (jumps, "warning" if jumps else "good")
    assert any(one.code == "jumped" for one in said.remarks) == jumps
    assert ("another_motion_grows" in said.facts) == jumps
    near = {"duty.speed_rpm": [turns - 2.0, turns, turns + 2.0]}
    for over in (near, {**near, "shafts[1].damping_Nms_per_rad": [0.3, 0.31]}):
        mapped = stability(drive, over=over)
        assert not np.any(mapped.verdict)
        assert np.all(mapped.jumped == jumps)
        assert (home.answer(drive, mapped).tone != "good") == jumps
