"""What is said of a drive that moves: worst instants, joint angles, sliding shafts, for any reader."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.questions.motion.articulation_answer import answer, ask, lacking
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import deg

INCHES = Reader(units={"length": "in", "time": "ms"}, decimal=",")


def of(drive):
    return answer(drive, ask(drive))


def words(said, reader=USUAL):
    return " ".join([told(said.sentence, reader), *(told(one.text, reader) for one in said.remarks)])


def tight():
    drive = example("pto-hitch")
    spline = replace(drive.shafts[1].spline, gap=0.003)
    return replace(drive, shafts=(drive.shafts[0], replace(drive.shafts[1], spline=spline), *drive.shafts[2:]))


def test_the_sentence_says_when_the_output_fluctuates_most():
    said = of(example("pto-hitch"))
    assert told(said.sentence, USUAL) == "over 10.0 s the speed fluctuation is at most δ = 0.6841 %, at 3.48 s."
    assert "Including the articulation rate: δ = 0.6829 % peak to peak, at 3.48 s." in words(said)
    assert said.code == 0


def test_a_spline_that_runs_out_fails_in_every_form():
    said = of(tight())
    assert (said.tone, said.code) == ("failed", 1)
    assert "Failed: the spline of shaft 2 bottoms" in words(said)
    assert not data(said, USUAL)["passed"]
    gap = next(one for one in said.keys if one.name == "spline_gap_2")
    assert (gap.verdict, gap.tone) == ("too little", "failed")
    assert [figure.name for figure in said.figures()] == ["joint_angles", "sliding"]


def test_tables_and_worst_instants_are_those_of_the_analysis():
    drive = example("pto-hitch")
    found, said = ask(drive), of(drive)
    worst = {(one.what, one.number): one.value for one in found.worst}
    told_worst = {(one["what"], one["number"]): one["value"] for one in data(said, USUAL)["worst"]}
    assert told_worst["joint_angle", 1] == pytest.approx(worst["joint_angle", 1] / deg)
    titles = [block.title for block in page(said, USUAL).blocks if getattr(block, "title", "")]
    assert titles[-2:] == ["Sliding shafts", "Worst instants"]


def test_readers_are_told_in_their_units_and_language():
    said = of(tight())
    assert "the way left falls to −2,427 in at 2\u202f946 ms." in words(said, INCHES)
    assert data(said, INCHES)["splines"][0]["stroke_in"] == pytest.approx(95.7 / 25.4, abs=1e-2)
    with speaking("ru"):
        assert of(tight()).title != "Articulation"


def test_a_drive_that_stands_still_lacks_movements():
    assert lacking(Drive.from_angles([0.2, 0.2])) == (("movements",),)
    assert lacking(example("pto-hitch")) == ()
