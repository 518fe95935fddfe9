"""What is said of assembly: what misalignment loads, for any reader; ties, what to release, what does not fit."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.drive.support import Support
from cardan.io import example
from cardan.maths.kernel import frames
from cardan.questions.forces.assembly import assembly
from cardan.questions.forces.assembly_answer import answer, ask, lacking, otherwise
from cardan.report.block import page
from cardan.texts import speaking

POUNDS = Reader(units={"force": "lbf", "displacement": "mil"}, decimal=",")
PUMP = example("overconstrained-pump")


def of(drive):
    return answer(drive, ask(drive))


def column(table, key):
    return list(next(one for one in table.columns if one.key == key).values)


def crossed():
    """Two shafts that have to meet, alike on both sides of the joint."""
    base = Drive.from_points([[-0.3, 0, 0], [0, 0, 0], [0.29, 0, -0.078]])
    places = ((1, -0.26, 0.0), (1, -0.06, 0.0), (2, 0.06, 5e-5), (2, 0.26, 0.0))
    supports = tuple(
        Support(shaft=shaft, position=place, stiffness=1e8, offset=(0.0, off, 0.0)) for shaft, place, off in places
    )
    return replace(base, supports=supports)


def test_the_sentence_tells_the_degree_and_who_is_loaded_most():
    assert told(of(PUMP).sentence, USUAL) == (
        "statically indeterminate, degree 3; misalignment loads support 1 (motor, far) with up to 2\u202f175 N."
    )
    truck = of(example("truck-supports"))
    assert (truck.sentence, truck.tone) == ("statically determinate: no misalignment can load it.", "good")
    assert truck.figures() == ()


def test_supports_that_are_loaded_alike_by_symmetry_are_named_together():
    assert told(of(crossed()).sentence, USUAL) == (
        "statically indeterminate, degree 1; misalignment loads supports 2 and 3 with up to 2\u202f374 N each."
    )
    texts = [told(one.text, USUAL) for one in of(crossed()).remarks]
    assert any(text.startswith("No support can be released without freeing a shaft") for text in texts)


def test_the_tables_are_those_of_the_analysis():
    found = assembly(PUMP)
    supports, joints = of(PUMP).tables
    assert column(supports, "radial_max") == [one.value for one in found.radial_peak]
    assert column(supports, "release") == [None, "radial", None, "axial"]
    assert column(joints, "gap_max") == pytest.approx(np.max(frames.norm(found.gap), axis=-1))
    assert printed(joints, USUAL).columns[-1].unit == "µm"
    assert [one.value.value for one in of(PUMP).keys] == [found.joint_peak[0].value]


def test_readers_are_told_in_their_units_and_language():
    said = data(of(PUMP), POUNDS)
    assert said["joints"][0]["gap_max_mil"] == pytest.approx(50.0 / 25.4)
    assert said["answer"].endswith("with up to 488,9 lbf.")
    with speaking("ru"):
        assert printed(of(PUMP).tables[0], USUAL).columns[0].heading == "опора"


def test_the_first_page_is_told_that_misalignment_strains_the_drive():
    made = page(of(PUMP), USUAL)
    (alarm,) = made.alarms
    assert alarm.text.startswith("Misalignment strains the drive without any torque; the strain stores up to 0.129 J")


def test_parts_that_fit_load_nothing():
    fits = replace(
        PUMP,
        joints=(replace(PUMP.joints[0], error=None),),
        supports=tuple(replace(one, offset=(0.0, 0.0, 0.0)) for one in PUMP.supports),
    )
    said = of(fits)
    assert "as drawn all parts fit" in told(said.sentence, USUAL)
    assert (said.figures(), said.keys) == ((), ())


def test_a_stiffness_that_other_questions_ask_for_says_nothing_of_assembly():
    loose = replace(PUMP, supports=tuple(replace(one, offset=(0.0, 0.0, 0.0)) for one in PUMP.supports[:1]))
    loose = replace(loose, supports=(*loose.supports, Support(shaft=2, position=0.1)))
    assert ask(loose) is None
    assert "do not hold the whole drive" in otherwise(loose)
    assert lacking(loose) == ()
    assert lacking(Drive.from_angles([0.3])) == (
        ("supports[0].offset", "supports[0].stiffness", "supports[0].axial_stiffness"),
    )
