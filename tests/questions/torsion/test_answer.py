"""What is said of torsional vibration: the numbers of the analyses, for any reader, where the file asks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

from cardan import Drive, example, torsion_modes, torsion_response
from cardan.answers.answer import Answer
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Block, Duty
from cardan.drive.shaft import Shaft
from cardan.errors import InputError
from cardan.questions.gathering import principal
from cardan.questions.torsion.answer import answer, ask, lacking
from cardan.questions.torsion.model.answer import answer as answer_of_modes
from cardan.questions.torsion.model.answer import modes_said
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.register import QUESTIONS
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import rpm

OTHER = Reader(units={"torque": "lbft", "angular_speed": "rad_s", "length": "in"}, decimal=",")


@cache
def of(drive: Drive) -> Answer:
    """Return the answer on a drive, asked once for all tests."""
    return answer(drive, ask(drive))


def alarms(said: Answer) -> list[tuple[str, str]]:
    return [(one.tone, told(one.text, USUAL)) for one in said.remarks if one.alarm]


def test_it_is_asked_only_where_masses_or_stiffnesses_are_given() -> None:
    assert lacking(example("z-arrangement")) == (("stations", "shafts[1].stiffness"),)
    assert lacking(example("truck-supports"))
    assert not lacking(example("truck-power-unit"))


@pytest.mark.slow
def test_the_first_page_tells_frequency_and_alternating_torque() -> None:
    drive = example("truck-power-unit")
    said, swing = of(drive), torsion_response(drive).swing
    first, _second, torque = said.keys
    assert first.value.value == float(torsion_modes(drive).omega[0])
    assert (torque.value.value, torque.verdict) == (float(np.max(swing)), "stable")
    assert "the alternating torque in shaft 3 is ±1\u202f304 N·m about 410.1 N·m" in told(said.sentence, USUAL)
    assert alarms(said) == []


def test_unstable_vibration_is_an_alarm() -> None:
    said = of(example("unstable-drive"))
    assert said.tone == "failed"
    ((tone, text),) = alarms(said)
    assert tone == "failed"
    assert "principal zone of mode 1" in text
    assert "the motion is unstable" in told(said.sentence, USUAL)
    assert alarms(of(example("cured-drive"))) == []


def test_what_is_met_in_the_operating_range_is_an_alarm() -> None:
    drive = example("truck-power-unit")
    low = replace(drive, duty=replace(drive.duty, speed_range=(35.0, 85.0)))
    found = torsion_modes(low)
    said = answer_of_modes(low, found)
    assert [tone for tone, _text in alarms(said)] == ["failed", "warning"]
    assert modes_said(low, found)[0] == "failed"
    assert "mode 1 is parametrically unstable in the operating range, stable from a damping 2ζ of 2.6" in told(
        said.sentence, USUAL
    )
    assert said.tables[0].tones[0] == "failed"


def test_at_an_edge_of_a_zone_the_exact_equations_are_said_to_decide() -> None:
    """First order has it stable at 1,321.1 rpm, between its own edge of 1,321.3 and the exact one of 1,320.9."""
    drive = example("unstable-drive")

    def judged(low: float, high: float) -> tuple[str, str, str]:
        one = replace(drive, duty=replace(drive.duty, speed=None, speed_range=(low * rpm, high * rpm)))
        found = torsion_modes(one)
        tone, text = modes_said(one, found)
        return tone, told(text, USUAL), answer_of_modes(one, found).tables[0].tones[0]

    found = torsion_modes(drive)
    assert not found.zone[0, 0] <= 1321.1 * rpm
    assert float(stability(replace(drive, duty=replace(drive.duty, speed=1321.1 * rpm))).growth_rate) > 0.0
    tone, text, row = judged(1000.0, 1321.1)
    assert (tone, row) == ("warning", "warning")
    assert "the exact equations decide" in text
    tone, text, row = judged(1000.0, 1330.0)
    assert (tone, row) == ("failed", "failed")
    tone, text, row = judged(1000.0, 1310.0)
    assert (tone, row) == ("warning", "plain")
    assert "exact" not in text


def test_terms_of_second_order_move_an_edge_no_further_than_told() -> None:
    """Edges of Mathieu's equation by SciPy's characteristic values: a = (ω/Ω)², q = m a."""
    found = torsion_modes(example("unstable-drive"))

    def edge(share: float, m: float, characteristic: Callable[[int, float], float]) -> float:
        return characteristic(1, m * share**2) - share**2

    for m in (0.01, 0.1, 0.3):
        one = replace(found, omega=np.asarray([100.0]), modulation=np.asarray([m]), damping_ratio=np.asarray([0.0]))
        for characteristic, k in ((mathieu_a, 0), (mathieu_b, 1)):
            share = brentq(edge, 0.6, 1.5, args=(m, characteristic))
            outer, inner = float(one.zone_perhaps[0, k]), float(one.zone_surely[0, k])
            low, high = sorted((outer, inner))
            assert low <= 100.0 / share <= high


def test_what_is_missing_is_refused() -> None:
    drive = replace(example("z-arrangement"), shafts=(Shaft(number=2, stiffness=1e4),))
    assert not lacking(drive)
    with pytest.raises(InputError, match="nothing here has inertia"):
        ask(drive)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-power-unit", "pto-flywheel"])
def test_every_check_passes(name: str) -> None:
    texts = [told(one.text, USUAL) for one in of(example(name)).remarks]
    checked = [one for one in texts if one.startswith("Checked:")]
    assert len(checked) == 2
    assert not [one for one in texts if "balance only" in one]


def test_torques_that_are_only_rounding_are_zero() -> None:
    shown = page(of(example("pto-flywheel-absorber")), USUAL)
    table = next(one for one in shown.blocks if "Torques in steady running" in getattr(one, "title", ""))
    ring = next(row for row in table.rows if "absorber" in row[0].text)  # type: ignore[union-attr]
    assert ring[1].text == "0"


@pytest.mark.slow
def test_readers_are_told_in_their_units_and_language() -> None:
    drive = example("truck-power-unit")
    said = of(drive)
    assert "±961 lbf·ft about 302,5 lbf·ft" in told(said.sentence, OTHER)
    content = data(said, OTHER)
    assert content["modes"][0]["order_2_rad_s"] == pytest.approx(float(torsion_modes(drive).order2_speed[0]))
    assert content["running"]["max_lbft"][2] == pytest.approx(1276.0, abs=0.5)
    with speaking("ru"):
        assert "лбс" not in told(of(drive).sentence, USUAL)


@pytest.mark.slow
def test_a_node_is_told_in_shares_where_the_lengths_are_not_known() -> None:
    drive = example("truck-power-unit")
    (node,) = [told(one.text, OTHER) for one in of(drive).remarks if "node" in told(one.text, USUAL)][:1]
    assert node == "Mode 1 has a node 80 % of the way from engine to joint 1, driving yoke."


def test_stations_that_part_a_body_are_called_by_their_places() -> None:
    drive = example("truck-power-unit")
    found = torsion_modes(drive, pieces=2)
    names = [told(one, Reader(units={"length": "m"})) for one in found.train.elements]
    assert any(name.endswith(" m to joint 2") for name in names)
    assert not any(" mm" in name for name in names)


def test_the_page_names_the_torques_that_its_running_leaves_out() -> None:
    """The speeds of all parts of a duty cycle are in use, so that the page is of none of them alone."""
    stand = example("unstable-drive")
    parts = tuple(Block(torque=60.0, speed=speed * rpm, share=0.5) for speed in (700.0, 900.0))
    for duty, acts in (
        (Duty(blocks=parts), "No mean torque acts here"),
        (Duty(torque=9.0, blocks=parts), "9.000 N·m,"),
    ):
        drive = replace(stand, duty=replace(duty, speed=900.0 * rpm))
        said = [told(one.text, USUAL) for one in of(drive).remarks if one.code == "torques_left_out"]
        assert len(said) == 1
        assert acts in said[0]
        assert principal(QUESTIONS["torsion"], drive) == drive
