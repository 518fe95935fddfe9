"""Life of the bearings of supports: closed forms of one joint, integrations of its own, what is said where it lacks."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from cardan.answers.data import as_csv, data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Case, Duty, Harmonic
from cardan.drive.joint_parts import Needles
from cardan.drive.movement import Harmonic as Swing
from cardan.drive.settings import Pose
from cardan.drive.shaft import Spline
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.questions.forces.forces import forces
from cardan.questions.life.answer import COLUMNS, answer, lacking
from cardan.questions.life.bearing_life import reliability_factor
from cardan.questions.life.figure import life_figures
from cardan.questions.life.life import life
from cardan.units import deg, hour, rpm

C, C0 = 25.7e3, 15.3e3
PLACE = 0.2  # of the rated bearing behind its joint [m]
SPEED, TORQUE = 1000 * rpm, 800.0
DUTY = Duty(speed=SPEED, torque=TORQUE)
TURN = 2.0 * np.pi / SPEED
SWUNG = 4.0 / (3.0 * np.pi)  # mean of |sin|^3


def supports(shaft=2, **fields):
    """Return two bearings on one shaft of a joint and a rated one on the other, which balances its couple alone."""
    way = 1.0 if shaft == 2 else -1.0
    own = {"capacity": C, "static_capacity": C0} | fields
    return (
        Support(shaft=3 - shaft, position=-way * 0.1, axial=True),
        Support(shaft=3 - shaft, position=-way * 0.3),
        Support(shaft=shaft, position=way * PLACE, **own),
    )


def single(joint_angle=20 * deg, **fields):
    """Return one joint with a rated bearing on its output shaft."""
    return replace(Drive.from_angles([joint_angle]), **{"supports": supports(), "duty": DUTY} | fields)


def load(joint_angle, torque=TORQUE):
    """Return the largest force on the bearing of the output shaft: its couple is T tan α |sin θ| [N]."""
    return torque * np.tan(joint_angle) / PLACE


def closed(joint_angle, torque=TORQUE):
    """Return the life of this bearing [s]."""
    return 1e6 * TURN * (C / load(joint_angle, torque)) ** 3 / SWUNG


def test_the_output_shaft_swings_by_the_closed_form():
    found = life(single())
    assert found.supports.number == (3,)
    assert found.of_supports == pytest.approx(closed(20 * deg), rel=1e-9)
    assert found.supports.loads.radial == pytest.approx(load(20 * deg), rel=1e-9)
    assert found.supports.loads.axial == 0.0


def test_the_input_shaft_carries_the_torque_it_is_given():
    alpha = 20 * deg

    def cubed(phi):
        ratio = np.cos(alpha) / (1.0 - (np.sin(alpha) * np.cos(phi)) ** 2)
        return (ratio * load(alpha) * np.sin(phi)) ** 3

    by_hand = 1e6 * TURN * C**3 / (quad(cubed, 0.0, np.pi, epsrel=1e-12)[0] / np.pi)
    assert life(single(supports=supports(1))).of_supports == pytest.approx(by_hand, rel=1e-8)  # steps of 1°


def test_shocks_reliability_and_parts_count_as_for_joints():
    plain = closed(20 * deg)
    shaken = life(single(duty=replace(DUTY, shock_factor=2.0))).of_supports[0]
    assert shaken == pytest.approx(plain / 8.0, rel=1e-9)
    sure = life(single(duty=replace(DUTY, reliability=0.95)))
    assert sure.of_supports[0] == pytest.approx(0.64 * plain, rel=1e-9)
    half = life(single(duty=replace(DUTY, reliability=0.5))).of_supports[0]
    assert half == pytest.approx(plain * (np.log(0.5) / np.log(0.9)) ** 0.9, rel=1e-9)  # point contact: slope 10/9
    assert half / plain > reliability_factor(0.5)
    hill = Case(name="hill", torque=2 * TORQUE, share=0.25)
    parts = life(single(duty=replace(DUTY, cases=(hill,))))
    assert parts.of_supports[0] == pytest.approx(plain / (0.75 + 0.25 * 8.0), rel=1e-9)
    assert parts.support_damage[:, 0] == pytest.approx([0.75 / 2.75, 2.0 / 2.75], rel=1e-9)


def test_poses_add_their_damage_by_their_shares():
    steep = Pose(name="turned", share=0.2, set=(("joints[0].joint_angle_deg", 30.0),))
    found = life(single(poses=(steep,)))
    rate = 0.8 / closed(20 * deg) + 0.2 / closed(30 * deg)
    assert found.of_supports == pytest.approx(1.0 / rate, rel=1e-9)


def test_poses_without_shares_leave_the_worst():
    steep = Pose(name="turned", set=(("joints[0].joint_angle_deg", 30.0),))
    found = life(single(poses=(steep,)))
    assert found.worst_pose == "turned"
    assert found.of_supports == pytest.approx(closed(30 * deg), rel=1e-9)


@pytest.mark.slow
def test_a_slow_movement_adds_the_damage_of_its_instants():
    base = Drive.from_points([(-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, 0.1)])
    rise = Swing(moves=("output",), amplitude=(0.0, 0.0, 0.05), frequency=0.1)
    still = replace(base, supports=supports(), duty=DUTY)
    found = life(replace(still, movements=(rise,)))
    height = 0.1 + 0.05 * np.sin(np.linspace(0.0, 2.0 * np.pi, 4001))
    mean = np.mean([(h / 0.5) ** 3 for h in height[:-1]])
    by_hand = 1e6 * TURN * (C * PLACE / TORQUE) ** 3 / SWUNG / mean
    # 167 turns in a swing: the speed of the axis beside that of the shafts is what is left
    assert found.of_supports[0] == pytest.approx(by_hand, rel=2e-3)
    assert found.of_supports[0] < 0.9 * life(still).of_supports[0]


def two_piece():
    """Return two joints with a centre bearing, weights and a spline that pushes."""
    drive = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.8, 0, -0.15), (1.6, 0, -0.1)])
    shafts = tuple(
        replace(one, mass=8.0, centre_of_mass=0.4, spline=Spline(position=0.2, mean_diameter=0.03, friction=0.1))
        if one.number == 2
        else one
        for one in drive.shafts
    )
    own = {"capacity": C, "static_capacity": C0}
    supports = (
        Support(shaft=1, position=-0.05, axial=True, **own),
        Support(shaft=1, position=-0.25),
        Support(shaft=2, position=0.7, axial=True, **own),
        Support(shaft=3, position=0.5, axial=False, **own),
    )
    return replace(drive, shafts=shafts, supports=supports, duty=Duty(speed=SPEED, torque=300.0, shock_factor=1.3))


TABLE = np.asarray(
    [
        (0.014, 0.19, 2.30),
        (0.028, 0.22, 1.99),
        (0.056, 0.26, 1.71),
        (0.084, 0.28, 1.55),
        (0.110, 0.30, 1.45),
        (0.170, 0.34, 1.31),
        (0.280, 0.38, 1.15),
        (0.420, 0.42, 1.04),
        (0.560, 0.44, 1.00),
    ]
)
"""Axial force over C0, e and Y of deep groove ball bearings, ISO 281."""


def equivalent(across, along):
    """Return the equivalent load of one pair of forces [N]."""
    e, y = (float(np.interp(along / C0, TABLE[:, 0], TABLE[:, k])) for k in (1, 2))
    return across if along <= e * across else 0.56 * across + y * along


def test_a_drive_with_a_centre_bearing_by_the_forces_told():
    drive = two_piece()
    found, told_forces = life(drive), forces(drive)
    places = np.arange(360) * (2.0 * np.pi / 360)
    for place, k in enumerate((0, 2, 3)):
        damage = []
        for way in (told_forces, told_forces.reverse):  # the spline slides out for one half of the time and in
            spin = np.asarray(way.speed)[drive.supports[k].shaft - 1, :-1]
            size = [
                equivalent(1.3 * across, 1.3 * abs(along) if drive.supports[k].axial else 0.0)
                for across, along in zip(way.radial[k, :-1], way.axial[k, :-1], strict=True)
            ]
            assert len(size) == len(places)
            damage.append(np.mean(np.abs(spin) / (2.0 * np.pi) * (np.asarray(size) / C) ** 3))
        assert found.of_supports[place] == pytest.approx(1e6 / np.mean(damage), rel=1e-9)
    assert np.max(found.supports.loads.axial[0, :2]) > 1000.0
    assert found.supports.number == (1, 3, 4)


def test_the_drive_lasts_as_long_as_the_first_of_both():
    needles = {"cross": Cross(span=0.08), "needles": Needles(capacity=20e3)}
    joints = tuple(replace(one, **needles) for one in single().joints)
    rated = single(joints=joints)
    alone = life(replace(rated, supports=()))
    both = life(rated)
    assert both.governing_support == 0
    assert both.drive == alone.drive
    small = replace(rated, supports=supports(capacity=3000.0), duty=replace(DUTY, life=1000 * hour))
    found = life(small)
    assert found.governing_support == 3
    assert found.drive == np.min(found.of_supports) < alone.drive
    grown = replace(small, duty=replace(small.duty, torque=found.torque_margin * TORQUE))
    assert life(grown).drive == pytest.approx(1000 * hour, rel=1e-9)
    assert COLUMNS[0].of_one(small) == (found.drive,)
    said = answer(small, found)
    assert told(said.sentence, USUAL).startswith("too short; support 3 fails after ")
    facts = data(said, Reader())
    assert (facts["governing_joint"], facts["governing_support"]) == (None, 3)
    assert [one["life_h"] for one in facts["supports"]] == pytest.approx(found.of_supports / hour)
    (key,) = said.keys
    assert told(key.called, USUAL) == "life of the support that fails first, support 3"
    (failed,) = [told(one.text, USUAL) for one in said.remarks if one.tone == "failed"]
    need = 3000.0 * (1000 * hour / found.drive) ** (1 / 3)
    assert f"a capacity of {need:,.0f} N".replace(",", "\u202f") in failed
    bored = replace(small, supports=supports(capacity=3000.0, bore=0.015))
    (larger,) = [
        told(one.text, USUAL) for one in answer(bored, life(bored)).remarks if "bore of" in told(one.text, USUAL)
    ]
    assert larger.endswith("15 mm these have that capacity: 6002, 6002-2RS, 6202, 6202-2RS, 6302, 6302-2RS.")
    (over,) = [figure for figure in life_figures(found) if figure.name == "life"]
    assert "support 3" in [getattr(one, "label", "") for one in over.rows[0].panels[0].series]
    rows = "".join(as_csv(said.full(), Reader())).splitlines()
    assert len(rows) == 1 + 1 + 1


def test_supports_alone_are_an_answer():
    drive = single()
    assert lacking(drive) == (("duty.life", *lacking(drive)[0][1:]),)
    found = life(drive)
    said = answer(drive, found)
    assert found.drive == np.min(found.of_supports)
    assert told(said.sentence, USUAL).startswith("support 3 fails first")
    assert life_figures(found)[0].rows[1:] == ()
    with pytest.raises(InputError, match="no joint has what maker needs"):
        life(drive, method="maker")
    with pytest.raises(InputError, match="ISO 281 cannot rate joint 1"):
        life(replace(drive, supports=()))


def test_what_cannot_be_rated_is_said():
    needles = {"cross": Cross(span=0.08), "needles": Needles(capacity=20e3)}
    joints = tuple(replace(one, **needles) for one in single().joints)
    bound = (*supports(), Support(shaft=2, position=0.3))  # one too many, and no stiffness
    found = life(single(joints=joints, supports=bound))
    assert found.supports is None
    assert any("their forces are not known: supports" in one.message for one in found.uncounted)
    with pytest.raises(InputError, match="their forces are not known"):
        life(single(supports=bound))
    fixed = single(joints=joints, supports=supports(tilt=True))
    (tilted,) = [one for one in life(fixed).uncounted if "tilt" in one.field]
    assert "holds the slope of its shaft too" in tilted.message
    bare = single(joints=joints, supports=supports(axial=True, static_capacity=None))
    assert [one.field for one in life(bare).uncounted] == ["supports[2].static_capacity"]
    with pytest.raises(InputError, match=r"supports\[2\].static_capacity"):
        life(replace(bare, joints=single().joints))
    swung = replace(DUTY, harmonics=(Harmonic(order=2.0, torque=100.0),))
    rise = Swing(moves=("output",), amplitude=(0.0, 0.0, 0.05), frequency=0.1)
    base = Drive.from_points([(-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, 0.1)])
    moving = replace(
        base, joints=tuple(replace(one, **needles) for one in base.joints), supports=supports(), duty=swung
    )
    found = life(replace(moving, movements=(rise,)))
    assert any("while the points move the torque is constant" in one.message for one in found.uncounted)


def test_loads_beyond_the_rating_are_said():
    mean = load(20 * deg) * SWUNG ** (1 / 3)
    for share, codes in ((1.99, ["heavy_load"]), (2.01, [])):
        found = life(single(supports=supports(capacity=share * mean)))
        assert [one.code for one in found.cautions] == codes
    pushed = two_piece()
    thin = tuple(replace(one, static_capacity=2000.0) for one in pushed.supports)
    assert "heavy_thrust" in [one.code for one in life(replace(pushed, supports=thin)).cautions]
