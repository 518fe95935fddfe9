"""What is said of the strength of a drive: the numbers of the analysis, for any reader, and what they leave out."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader, significant
from cardan.checks.strength.answer import answer, ask, lacking, otherwise
from cardan.checks.strength.strength import strength
from cardan.drive.duty import Case, Duty
from cardan.drive.machine import LinearTorque
from cardan.io import example
from cardan.questions.forces.forces import forces
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.report.block import page
from cardan.texts import speaking

POUNDS = Reader(units={"torque": "lbft", "stress": "psi"}, decimal=",")
LBFT = 1.3558179483314004
"""1 lbf·ft [N·m]."""


def of(drive):
    return answer(drive, ask(drive))


def alarms(drive):
    return [one for one in of(drive).remarks if one.alarm]


def test_the_torque_rating_and_what_governs_it_stand_first():
    drive = example("car-propshaft")
    said, found = of(drive), strength(drive)
    title = found.governing.title
    rated = significant(found.rated_torque)
    assert (
        told(said.sentence, USUAL)
        == f"carries 560.0 N·m (part 3 of the duty cycle); torque rating {rated} N·m, governed by {title}."
    )
    (key,) = said.keys
    assert (key.value.value, key.limit.value, key.better) == (found.rated_torque, found.torque, "more")
    assert key.utilisation == pytest.approx(1.0 / found.torque_factor)
    assert [block.name for block in [page(said, USUAL)]] == ["strength"]


def test_every_limit_is_told_in_the_units_of_the_reader():
    drive = example("car-propshaft")
    said, found = data(of(drive), POUNDS), strength(drive)
    assert said["rated_torque_lbft"] == pytest.approx(found.rated_torque / LBFT)
    rows = {row["title"]: row for row in said["limits"]}
    core = next(one for one in found.judged if "core" in one.title)
    assert rows[core.title]["unit"] == "psi"
    assert rows[core.title]["value"] == pytest.approx(float(core.value) / 6894.757293168361)
    assert rows[core.title]["limit_torque_lbft"] == pytest.approx(found.torque * core.torque_factor / LBFT)
    shown = printed(of(drive).tables[0], POUNDS)
    assert [column.unit for column in shown.columns if column.heading == "limit torque"] == ["lbf·ft"]
    assert any(cell.text == "≤ 23\u202f689 psi" for row in shown.rows for cell in row)


def test_the_verdicts_speak_the_language_of_the_reader():
    with speaking("ru"):
        titles = [one.title for one in strength(example("car-propshaft")).judged]
    assert any("вала 2" in title for title in titles)


def test_a_weak_drive_is_told_as_failed_and_says_what_to_size():
    drive = example("car-propshaft")
    weak = replace(drive, duty=Duty(torque=50 * drive.duty.torque, speed=100.0))
    said = of(weak)
    assert told(said.sentence, USUAL).startswith("too weak for ")
    assert said.code == 1
    assert "failed" in [one.tone for one in said.remarks]
    assert not any(one.alarm for one in said.remarks)  # the first page has it from the checks


def test_torsional_vibration_is_named_beside_the_torques_without_it():
    drive = example("cured-drive")
    runs, (said,) = torsion_response(drive), alarms(drive)
    assert runs.floquet.verdict == Verdict.STABLE
    least, most = (significant(float(one[1]), 4) for one in (runs.torque_lowest, runs.torque_highest))
    assert f"the torque in shaft 2 runs from −{least.strip('-−')} to {most} N·m" in told(said.text, USUAL)
    assert said.tone == "warning"  # 243 N·m, and the weakest part holds 818
    assert f"{strength(drive).shafts[1].torque:.4g}" == most
    weak = replace(drive, limits=replace(drive.limits, twist=0.02))
    assert [one.tone for one in alarms(weak)] == ["failed"]  # what raises its torque; what failed is told by the checks
    assert alarms(example("car-propshaft")) == []


@pytest.mark.slow
def test_a_rating_in_proportion_is_told_where_machines_keep_laws_of_their_own():
    plain = replace(example("pto-baler"), movements=())
    law = LinearTorque(standstill=36.9, slope=2.0)
    driven = replace(plain, duty=replace(plain.duty, load=law))
    for drive, there in ((plain, False), (driven, True)):
        said = [told(one.text, USUAL) for one in of(drive).remarks]
        assert any("keep their laws: the torque rating is in proportion" in one for one in said) is there


def test_no_torque_is_told_of_torsional_vibration_that_is_unstable():
    drive = example("unstable-drive")
    (said,) = alarms(drive)
    assert torsion_response(drive).floquet.verdict == Verdict.UNSTABLE
    assert "unstable" in told(said.text, USUAL)
    assert "N·m" not in told(said.text, USUAL)
    assert said.tone == "failed"


@pytest.mark.parametrize("name", ["truck-supports", "propshaft-with-rzeppa"])
def test_a_drive_that_carries_no_torque_is_not_rated(name):
    drive = example(name)
    assert of(drive).keys
    assert ask(replace(drive, duty=replace(drive.duty, torque=0.0))) is None


def test_loads_that_the_stresses_leave_out_are_told():
    drive = example("truck-supports")
    said = [told(one.text, USUAL) for one in of(drive).remarks]
    journal = max(float(one.journals.size.max()) for one in (forces(drive), forces(drive).reverse))
    assert any(f"{significant(journal)} N, 5.3 % more" in one for one in said)


def test_what_the_drive_file_lacks_is_told():
    drive = example("single-20deg")
    assert lacking(replace(drive, duty=replace(drive.duty, torque=None, blocks=())))
    bare = replace(drive, duty=replace(drive.duty, torque=10.0))
    assert ask(bare) is None
    assert otherwise(bare) == (("joints[0].rating.max_torque",),)


def test_load_cases_alone_are_torque_enough():
    drive = example("truck-duty-cycle")
    cases = (Case(name="road", torque=500.0, speed=200.0, share=1.0), Case(name="start", torque=2500.0, speed=50.0))
    peak = replace(drive, duty=replace(drive.duty, torque=None, blocks=(), torque_history=None, cases=cases))
    assert lacking(peak) == ()
    assert told(answer(peak, ask(peak)).sentence, USUAL).startswith("carries 2\u202f500 N·m")


def test_every_number_says_in_which_load_case_it_arises():
    drive = example("truck-duty-cycle")
    road = Case(name="road", torque=600.0, speed=200.0, share=1.0)
    start = Case(name="start", torque=2000.0, speed=50.0)
    both = replace(drive, duty=replace(drive.duty, torque=None, blocks=(), torque_history=None, cases=(road, start)))
    result = ask(both)
    said = answer(both, result)
    assert told(said.sentence, USUAL).startswith("carries 2\u202f000 N·m (start); ")
    assert told(said.keys[0].place, USUAL).endswith(", start")
    rows = data(said, Reader())
    assert {row["case"] for row in rows["shafts"]} == {row["case"] for row in rows["joints"]} == {"start"}
    assert (rows["load_case"], rows["torque_Nm"]) == ("start", 2000.0)
    # Alone each load case has its own torque; the life is that of the road, which alone takes time.
    alone = replace(both, duty=replace(both.duty, torque=600.0, speed=200.0, cases=()))
    lives = [[one.fatigue_life for one in each.shafts] for each in (result, ask(alone))]
    assert lives[0] == pytest.approx(lives[1], nan_ok=True)
    single = answer(alone, ask(alone))
    assert "case" not in data(single, Reader())["shafts"][0]
    assert "(" not in told(single.sentence, USUAL).partition(";")[0]


def test_a_limit_that_governs_without_the_highest_utilisation_is_explained():
    drive = example("pto-drive")
    found = strength(drive)
    assert found.governing.utilisation < found.utilisation
    assert any("a life falls with the power 10/3" in told(one.text, USUAL) for one in of(drive).remarks)
    assert not any("a life falls" in told(one.text, USUAL) for one in of(example("car-propshaft")).remarks)
