"""End shafts without supports: held by their machines, as by hand; and the tables that a loose drive lacks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.models.machine_held import machine_held, machines_of, proposed, tables_of
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.io import loads
from cardan.io.examples import example_text
from cardan.questions.bending.bending import bending_speeds
from cardan.questions.forces.answer import answer, ask
from cardan.questions.forces.assembly import assembly
from cardan.questions.forces.forces import forces
from cardan.questions.losses.losses import losses
from cardan.questions.mobility.mobility import mobility
from cardan.register import QUESTIONS
from cardan.units import deg

FRONT, REAR, BEARING, G = 0.8, 1.2, 0.7, 9.80665
TUBE = {"outer": 0.07, "inner": 0.066}


def drive(joint_angles=(0.0, 0.0, 0.0), **keys):
    made = Drive.from_angles(list(joint_angles))
    spline = Spline(teeth=16, position=0.2)
    return replace(
        made,
        shafts=(Shaft(number=2, length=FRONT, **TUBE), Shaft(number=3, length=REAR, spline=spline, **TUBE)),
        supports=(Support(shaft=2, position=BEARING),),
        duty=Duty(torque=100.0),
        **keys,
    )


def test_weights_are_carried_as_by_hand():
    """The rear tube hangs between the joints; the front one is a lever about joint 1 over the bearing."""
    found = forces(drive())
    density = 7850.0 * np.pi / 4 * (TUBE["outer"] ** 2 - TUBE["inner"] ** 2) * G
    front, rear = density * FRONT, density * REAR
    bearing = (0.5 * front * FRONT + 0.5 * rear * FRONT) / BEARING
    lifted = np.asarray(found.reaction)[:, 0, 2]
    np.testing.assert_allclose(lifted, [bearing, front + 0.5 * rear - bearing, 0.5 * rear], rtol=2e-3)
    assert found.support_shaft == (2, 1, 4)
    assert int(found.status) == 0
    # No machine has to hold a couple but that of the joint, which is straight.
    assert np.max(np.abs(found.support_couple)) < 1e-9


def test_a_machine_holds_the_couple_of_its_joint():
    """The couple on the driving yoke of joint 1 is T_1 tan α sin θ about the axis across: Book (86)."""
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    made = drive((10 * deg, 0.0, 10 * deg))
    found = forces(made, angle=angle)
    couple = np.linalg.norm(np.asarray(found.support_couple)[1], axis=-1)
    whole = np.asarray(found.shaft_torque)[0] * np.tan(10 * deg)
    assert np.max(couple) == pytest.approx(np.max(np.linalg.norm(found.secondary_couple[0], axis=-1)), rel=1e-9)
    assert np.max(couple / whole) == pytest.approx(1.0, rel=1e-2)


def test_a_machine_is_the_support_that_would_be_written_for_it():
    made = drive((8 * deg, 3 * deg, 5 * deg))
    written = replace(
        made,
        supports=(
            *made.supports,
            Support(shaft=1, position=0.0, axial=True, tilt=True),
            Support(shaft=4, position=0.0, axial=True, tilt=True),
        ),
    )
    assert (machines_of(made), machines_of(written)) == ((1, 4), ())
    assert machine_held(written) == written
    for name in ("reaction", "support_couple", "joint_force"):
        np.testing.assert_array_equal(getattr(forces(made), name), getattr(forces(written), name))
    assert assembly(made).degree == assembly(written).degree == 0


def test_without_a_spline_one_machine_lets_its_shaft_float():
    made = drive()
    stiff = replace(made, shafts=(made.shafts[1], replace(made.shafts[2], spline=None)))
    assert [one.axial for one in machine_held(stiff).supports] == [False, True, False]
    assert int(forces(stiff).status) == 0
    axial = replace(stiff, supports=(replace(stiff.supports[0], axial=True),))
    assert [one.axial for one in machine_held(axial).supports] == [True, False, False]


def test_the_answer_says_who_holds():
    made = drive((8 * deg, 3 * deg, 5 * deg))
    said = answer(made, ask(made))
    assert any("Shafts 1 and 4 are held by their machines" in told(one.text, USUAL) for one in said.remarks)
    assert said.facts["held_by_machines"] == [1, 4]
    assert not said.listings
    supported = example("truck-supports")
    assert answer(supported, ask(supported)).facts["held_by_machines"] == []


def test_a_machine_s_own_bearings_are_no_loss_of_the_drive():
    made = drive((8 * deg, 3 * deg, 5 * deg))
    cross = Cross(span=0.08, journal=0.02)
    joints = tuple(replace(one, cross=cross, friction=0.02) for one in made.joints)
    found = losses(replace(made, joints=joints, duty=Duty(torque=100.0, speed=100.0)))
    assert found.supports.tolist() == [0.0]  # its centre bearing alone
    assert found.efficiency < 1.0


LOOSE = {
    "no centre bearing": ((), (Support(shaft=1, position=-0.1), Support(shaft=4, position=0.1, tilt=True, axial=True))),
    "one bearing at an end": ((2,), (Support(shaft=1, position=-0.1),)),
    "nothing lengthwise": ((2,), (Support(shaft=1, position=-0.1), Support(shaft=1, position=-0.2))),
}


@pytest.mark.parametrize("case", LOOSE)
def test_the_tables_of_the_message_hold_the_drive(case):
    inner, ends = LOOSE[case]
    made = drive((8 * deg, 3 * deg, 5 * deg))
    loose = replace(made, supports=(*(one for one in made.supports if one.shaft in inner), *ends))
    with pytest.raises(InputError) as caught:
        forces(loose)
    (problem,) = caught.value.problems
    assert problem.field == "supports"
    assert problem.paste == tables_of(proposed(loose))
    assert problem.paste.startswith("[[supports]]")
    held = forces(replace(loose, supports=(*loose.supports, *proposed(loose))))
    assert int(held.status) == 0


@pytest.mark.parametrize("name", ["two-piece-rear-drive", "car-propshaft", "truck-printed-angles", "single-20deg"])
def test_tables_pasted_into_a_file_without_supports_hold_the_drive(name):
    text = example_text(name)
    made = loads(text + "\n\n" + tables_of(proposed(loads(text))) + "\n")
    found = forces(made, Duty(torque=100.0))
    assert found.reaction is not None


def test_bending_names_the_same_tables():
    made = replace(drive(), supports=())
    with pytest.raises(InputError) as caught:
        bending_speeds(made)
    assert "shaft = 2\nposition_mm = 720" in caught.value.problems[0].paste
    held = replace(made, supports=tuple(one for one in proposed(made) if one.shaft == 2))
    assert bending_speeds(held).held == (1, 3)


def test_mobility_takes_the_same_bearings_and_says_so():
    made = drive((8 * deg, 3 * deg, 5 * deg))
    found = mobility(made)
    written = mobility(machine_held(made))
    assert (found.mobility, found.parasitic, found.redundant) == (1, 0, assembly(made).degree)
    assert (found.mobility, found.redundant) == (written.mobility, written.redundant)
    said = QUESTIONS["mobility"].answer(made, QUESTIONS["mobility"].ask(made))
    assert any("Shafts 1 and 4 are held by their machines" in told(one.text, USUAL) for one in said.remarks)
    own = QUESTIONS["mobility"].answer(machine_held(made), written)
    assert not any("machines" in told(one.text, USUAL) for one in own.remarks)
