"""What is said of a choice of joints: what does the job, under which conditions, why not the others, for any reader."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.catalogue import catalogue, filled
from cardan.choices.selection import JointDuty, fitting_sizes, select_joint
from cardan.choices.selection_answer import answer, ask, lacking, selected
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.questions.life.life import life
from cardan.texts import speaking
from cardan.units import deg, rpm

NEED = JointDuty(torque=700.0, joint_angle=10 * deg, speed=900 * rpm)
POUNDS = Reader(units={"torque": "lbft", "length": "in"}, decimal=",")


def test_the_job_and_how_many_do_it_stand_first():
    found = select_joint(NEED)
    accepted, under = (sum(one.state == state for one in found) for state in ("ok", "conditional"))
    text = told(answer(None, selected(NEED)).sentence, USUAL)
    assert text.startswith("700.0 N·m at 10.0° and 900.0 rpm: ")
    assert f"{under} more under conditions." in text
    assert accepted == 0 or str(accepted) in text or "one type" in text


def test_every_type_and_size_is_told_in_the_units_of_the_reader():
    said = answer(None, selected(NEED))
    sizes, types = (printed(one, POUNDS) for one in said.tables)
    known = [one for one in select_joint(NEED) if one.state != "unrated" and not one.headroom < 0.1]
    assert [row[1].text for row in types.rows] == [one.row.id for one in known]
    assert len(data(said, POUNDS)["types"]) == len(select_joint(NEED)) > len(known)
    assert any("lbf·ft" in cell.text for row in types.rows for cell in row)
    assert [column.unit for column in sizes.columns if column.heading == "outer diameter"] == ["in"]
    content = data(said, POUNDS)
    assert content["need"]["torque_lbft"] == pytest.approx(700.0 / 1.3558179483314004)
    fits = [one.fits for one in fitting_sizes(NEED)]
    assert [row["fits"] for row in content["sizes"]] == fits


def test_a_size_whose_maker_gives_no_largest_joint_angle_says_so():
    shown = printed(answer(None, selected(replace(NEED, torque=300.0))).tables[0], USUAL)
    why = {row[1].text: " ".join(cell.text for cell in row) for row in shown.rows}
    rated = {row.id: row.rating.max_joint_angle for row in catalogue().offered() if row.id in why and row.rating}
    fits = {one.row.id for one in fitting_sizes(replace(NEED, torque=300.0)) if one.fits}
    unrated = {id for id, text in why.items() if "no largest joint angle given" in text}
    assert unrated == {id for id, angle in rated.items() if angle is None and id in fits} != set()


def test_no_instrument_joint_is_a_candidate_at_kilonewton_metres():
    found = {one.row.id: one.state for one in select_joint(replace(NEED, torque=5000.0))}
    assert found["instrument_ball_disc"] == "rejected"
    assert found["instrument_ring_tip"] == "unrated"
    said = answer(None, selected(replace(NEED, torque=5000.0)))
    shown = [row[1].text for row in printed(said.tables[1], USUAL).rows]
    assert "instrument_ball_disc" not in shown
    assert any("instrument_ball_disc" in told(one.text, USUAL) for one in said.remarks)


def test_sizes_that_fit_come_first_by_space_and_the_next_smaller_one_says_what_it_lacks():
    need = replace(NEED, torque=1500.0, life=2000 * 3600.0)
    said = printed(answer(None, selected(need)).tables[0], USUAL)
    names = [row[1].text for row in said.rows]
    assert names[0] == "spicer-1610"  # 135 mm over its caps
    short = next(row for row in said.rows if row[1].text == "gwb-687.30")
    assert any("less than the 2" in cell.text for cell in short)
    rows = {one.row.id: one for one in fitting_sizes(need)}
    # by hand: 5000 h at 3° and 100 rpm, (10/3)rd power of the torque
    lasts = 5000.0 * (100.0 * 3.0) / (900.0 * 10.0) * (3800.0 / 1500.0) ** (10.0 / 3.0)
    assert rows["gwb-687.35"].life / 3600.0 == pytest.approx(lasts, rel=1e-9)


def test_a_drive_asks_for_the_largest_of_its_joints_or_for_one():
    drive = example("car-propshaft")
    assert ask(drive).need.joint_angle >= ask(drive, joint=1).need.joint_angle
    assert lacking(Drive.from_angles([0.1])) == (("duty.torque",), ("duty.speed",))


@pytest.mark.parametrize("name", ["pickup-two-piece", pytest.param("pto-baler", marks=pytest.mark.slow)])
def test_a_size_lasts_as_long_as_the_drive_that_has_it(name):
    """Over load cases, poses and movements: what `life` says of the drive with this size in it."""
    drive = example(name)
    found = {one.row.id: one for one in ask(drive).sizes}["spicer-1350"]
    joints = tuple(replace(one, size="spicer-1350", rating=None) for one in drive.joints)
    whole = life(filled(replace(drive, joints=joints)), method="maker")
    assert found.life == pytest.approx(float(np.min(whole.of("maker"))), rel=1e-9)


def test_reasons_speak_the_language_of_the_reader():
    with speaking("ru"):
        said = [told(cell, USUAL) for cell in answer(None, selected(NEED)).full().columns[3].values]
    assert any("наибольш" in text or "больше" in text for text in said)
