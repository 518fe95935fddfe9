"""What is said of the power loss: the numbers of the analysis, for any reader; ties and what is left out."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.io import example
from cardan.questions.losses.answer import answer, ask, lacking
from cardan.questions.losses.losses import loss_map, losses
from cardan.report.block import page
from cardan.texts import speaking

INCHES = Reader(units={"torque": "lbft", "power": "kW"}, decimal=",")
TRUCK = example("truck-supports")


def of(drive):
    return answer(drive, ask(drive))


def test_the_sentence_tells_efficiency_loss_and_where_most_is_lost():
    assert told(of(TRUCK).sentence, USUAL) == (
        "efficiency 99.77 % at 1\u202f600 N·m and 1\u202f800 rpm; of 302.3 kW, 695.0 W are lost, most in joint 2 "
        "(centre): 263.8 W."
    )
    assert [key.name for key in of(TRUCK).keys] == ["efficiency", "power_loss"]


def test_what_loses_alike_is_named_together():
    joint = Hooke(name="gearbox", joint_angle=0.3, friction=0.02, cross=TRUCK.joints[0].cross)
    twice = Drive(joints=(joint, joint), duty=Duty(speed=100.0, torque=100.0))
    found = losses(twice)
    tied = replace(found, driving_pins=found.driving_pins[[0, 0]], driven_pins=found.driven_pins[[0, 0]])
    said = told(answer(twice, tied).sentence, USUAL)
    assert "most in joint 1 (gearbox) and joint 2 (gearbox): " in said
    assert said.endswith(" W each.")


def test_the_table_has_every_part_and_their_sum():
    found = losses(TRUCK)
    (parts,) = answer(TRUCK, found).tables
    shown = printed(parts, USUAL)
    assert len(shown.rows) == 3 + 5 + 1 + 1
    assert sum(cell.amount for row in shown.rows[:-1] if (cell := row[1]).amount) == pytest.approx(found.heat)
    assert [cell.text for cell in shown.rows[8]][1:] == ["–"] * 4


@pytest.mark.slow
def test_readers_are_told_in_their_units_and_language():
    said = data(of(TRUCK), INCHES)
    assert said["power_loss_kW"] == pytest.approx(0.695, abs=1e-4)
    assert said["torque_lbft"] == pytest.approx(1180.1, abs=0.1)
    assert "0,6950 kW are lost" in told(of(TRUCK).sentence, INCHES)
    over = answer(TRUCK, losses(TRUCK), loss_map(TRUCK))
    heads = [column.heading for column in printed(over.tables[0], INCHES).columns]
    assert heads[:2] == ["speed", "118 lbf·ft"]
    with speaking("ru"):
        assert printed(of(TRUCK).tables[0], USUAL).columns[0].heading == "деталь"


@pytest.mark.slow
def test_the_map_leaves_the_curves_of_the_turn_to_programs():
    over = answer(TRUCK, losses(TRUCK), loss_map(TRUCK))
    assert {"losses", "map"} <= set(data(over, USUAL))
    assert [table.title for table in page(over, USUAL).blocks if hasattr(table, "rows")][:2] == [
        "Efficiency over speed and torque",
        "Power loss over speed and torque",
    ]


def test_a_drive_that_locks_says_no_more():
    locked = replace(TRUCK, joints=(*TRUCK.joints[:2], replace(TRUCK.joints[2], friction=40.0)))
    said = of(locked)
    assert (told(said.sentence, USUAL), said.tone, said.code) == ("friction locks joint 3.", "failed", 1)
    assert (said.tables, said.keys, said.figures()) == ((), (), ())
    assert [one.alarm for one in said.remarks] == [True]


def test_the_balance_is_told_as_closed_to_rounding_or_not_at_all():
    found = losses(TRUCK)
    (good,) = [one for one in of(TRUCK).remarks if "balance" in told(one.text, USUAL)]
    assert told(good.text, USUAL).endswith("closes to rounding.")
    (bad,) = [one for one in answer(TRUCK, replace(found, residual=0.02)).remarks if one.tone == "failed"]
    assert told(bad.text, USUAL).endswith("closes to 0.1.")


def test_what_the_drive_file_lacks_is_told():
    assert lacking(TRUCK) == ()
    assert lacking(replace(TRUCK, duty=Duty())) == (("duty.torque", "duty.cases"), ("duty.speed",))
    assert lacking(Drive.from_angles([0.3]))[-1] == (
        "joints[0].friction",
        "supports[0].friction",
        "shafts[1].spline.friction",
    )
