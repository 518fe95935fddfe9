"""What is said of an absorber: the numbers of the search, for any reader, and what to mind of it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.questions.torsion.absorber.answer import answer, ask, cautions, lacking
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import deg

DRIVE = replace(
    Drive.from_angles([14 * deg, 14 * deg], plane_twists=[25 * deg]),
    shafts=(Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02),),
    stations=(Station(shaft=3, name="pump", inertia=0.8),),
    duty=Duty(torque=60.0, speed=30.0),
)
POUNDS = Reader(units={"torque": "lbft"}, decimal=",")


@pytest.fixture(scope="module")
def found():
    return ask(DRIVE, progress=lambda _share: "stop")


@pytest.mark.slow
def test_the_sentence_and_the_settings_are_those_of_the_search(found):
    said = answer(DRIVE, found, chosen=True)
    assert told(said.sentence, USUAL).startswith("with an absorber on pump the largest alternating torque falls from ±")
    settings, hosts, station = said.tables
    torques = next(one for one in settings.columns if one.key == "alternating_torque")
    assert list(torques.values) == [found.bare.peak, found.closed_form.peak, found.best.peak]
    assert next(one for one in hosts.columns if one.key == "chosen").values[-1] is True
    assert "absorber.stiffness_Nm_per_rad" in station.columns[0].values
    assert any("of the modal inertia of mode 1 there" in told(one.text, USUAL) for one in said.remarks)
    assert page(said, USUAL).blocks


def test_readers_are_told_in_their_units_and_language(found):
    said = answer(DRIVE, found)
    torque = found.best.peak / (12 * 0.0254 * 0.45359237 * 9.80665)
    content = data(said, POUNDS)
    assert content["best"]["alternating_torque_lbft"] == pytest.approx(torque)
    assert content["curves"]["best_alternating_torque_1_lbft"][0] == pytest.approx(
        found.after[0, 0] * torque / found.best.peak
    )
    assert "lbf·ft" in told(said.sentence, POUNDS)
    with speaking("ru"):
        assert "об/мин" in told(answer(DRIVE, found).sentence, USUAL)


def test_a_drive_that_runs_elsewhere_is_told_so(found):
    asked = answer(DRIVE, found, chosen=True)
    assert "the drive runs at 286.5 rpm" not in " ".join(told(one.text, USUAL) for one in asked.remarks)
    slow = replace(DRIVE, duty=replace(DRIVE.duty, speed=5.0))
    said = answer(slow, found)
    assert said.tone == "warning"
    assert any("the drive runs at 47.75 rpm, outside these speeds" in told(one.text, USUAL) for one in said.remarks)


def test_lost_motions_are_told():
    found = SimpleNamespace(
        drive=DRIVE,
        after=np.asarray([[1.0, 2.0], [np.nan, np.nan], [3.0, 1.0]]),
        unstable_after=[],
        unstable_before=[],
        proof=None,
        play=False,
        cancelled=False,
        converged=True,
        assumed=(),
    )
    (said,) = cautions(found)
    assert "at 1 of 3 speeds no steady motion was found" in told(said.text, USUAL)
    found.after = found.after[::2]
    assert not list(cautions(found))


def test_something_that_twists_is_asked_for():
    assert not lacking(DRIVE)
    assert lacking(Drive.from_angles([0.2])) == (("stations", "shafts[1].stiffness"),)


@pytest.mark.slow
def test_speeds_that_read_alike_are_told_once(found):
    at = np.asarray([100.0, 100.01, 110.0]) * np.pi / 30.0
    said = answer(DRIVE, replace(found, unstable_before=at))
    (told_of,) = (one for one in (told(remark.text, USUAL) for remark in said.remarks) if one.startswith("As built"))
    assert told_of.startswith("As built the drive is unstable at 100.0 rpm, 110.0 rpm: ")
