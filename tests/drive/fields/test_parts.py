"""What contradicts itself in the parts of a drive is named, with the key to mend."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cardan import Drive, InputError
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.fields.paths import read, with_values
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support

DRIVE = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.0, 0, -0.1), (1.4, 0, -0.1)])


def fields(**parts: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        replace(DRIVE, **parts)  # type: ignore[arg-type]
    return [problem.field for problem in caught.value.problems]


def of_joint(**keys: object) -> list[str]:
    return fields(joints=(replace(DRIVE.joints[0], **keys), DRIVE.joints[1]))  # type: ignore[type-var, arg-type]


def of_support(**keys: object) -> list[str]:
    return fields(supports=(Support(**keys),))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("keys", "found"),
    [
        ({"friction": -0.1}, "joints[0].friction"),
        ({"friction": 0.01, "material_friction": 0.1}, "joints[0].material_friction"),
        ({"fit": "run_in"}, "joints[0].fit"),
        ({"cross": Cross(span=0.0)}, "joints[0].cross.span"),
        ({"cross": Cross(span=0.08, journal=0.08)}, "joints[0].cross.journal"),
        ({"cross": Cross(slides="sideways")}, "joints[0].cross.slides"),
        ({"cross": Cross(inertia=(0.1, -0.1, 0.1))}, "joints[0].cross.inertia[1]"),
    ],
)
def test_joints(keys: dict[str, object], found: str) -> None:
    assert of_joint(**keys) == [found]


@pytest.mark.parametrize(
    ("shaft", "found"),
    [
        (Shaft(number=2, wall=0.002), "shafts[1].wall"),
        (Shaft(number=2, material=Material()), "shafts[1].material"),
        (Shaft(number=2, outer=0.07, wall=0.04), "shafts[1].wall"),
        (Shaft(number=2, outer=0.07, inner=0.07), "shafts[1].inner"),
        (Shaft(number=2, outer=0.07, inner=0.06, wall=0.005), "shafts[1].wall"),
        (Shaft(number=2, centre_of_mass=0.5), "shafts[1].centre_of_mass"),
        (Shaft(number=2, spline=Spline(friction=0.1)), "shafts[1].spline.mean_diameter"),
        (Shaft(number=2, spline=Spline(friction=0.1, outer=0.05)), "shafts[1].spline.mean_diameter"),
        (Shaft(number=2, spline=Spline(sliding="in")), "shafts[1].spline.sliding"),
        (Shaft(number=2, spline=Spline(position=1.1)), "shafts[1].spline.position"),
    ],
)
def test_shafts(shaft: Shaft, found: str) -> None:
    assert fields(shafts=(shaft,)) == [found]


@pytest.mark.parametrize(
    ("keys", "found"),
    [
        ({"shaft": 4, "position": 0.0}, "supports[0].shaft"),
        ({"shaft": 1, "position": 0.1}, "supports[0].position"),
        ({"shaft": 2, "position": 1.1}, "supports[0].position"),
        ({"shaft": 3, "position": -0.1}, "supports[0].position"),
        ({"shaft": 1, "position": -0.1, "radial": False}, "supports[0].radial"),
        ({"shaft": 1, "position": -0.1, "axial_stiffness": 1e8}, "supports[0].axial_stiffness"),
        ({"shaft": 1, "position": -0.1, "friction": 0.1}, "supports[0].bore"),
        ({"shaft": 1, "position": -0.1, "friction": -0.1, "bore": 0.05}, "supports[0].friction"),
    ],
)
def test_supports(keys: dict[str, object], found: str) -> None:
    assert of_support(**keys) == [found]


def test_an_end_shaft_may_reach_as_far_as_it_likes() -> None:
    far = (Support(shaft=1, position=-5.0), Support(shaft=3, position=5.0), Support(shaft=2, position=1.0))
    assert replace(DRIVE, supports=far).supports == far


def test_a_length_that_is_not_said_limits_nothing() -> None:
    joint_angles = Drive.from_angles([0.1, 0.2])
    assert replace(joint_angles, supports=(Support(shaft=2, position=7.0),)).supports


def test_swinging_parts_belong_to_a_torque() -> None:
    assert fields(duty=Duty(harmonics=(Harmonic(order=2, torque=3.0),))) == ["duty.harmonics"]
    assert fields(duty=Duty(torque_at="input")) == ["duty.torque_at"]


def test_a_range_of_speeds_rises_from_standstill_on() -> None:
    assert fields(duty=Duty(speed_range=(300.0, 200.0))) == ["duty.speed_range"]
    assert fields(duty=Duty(speed_range=(-1.0, 200.0))) == ["duty.speed_range[0]"]
    assert replace(DRIVE, duty=Duty(speed_range=(0.0, 300.0))).duty.speed is None


def test_paths_reach_the_parts() -> None:
    drive = with_values(
        replace(DRIVE, supports=(Support(shaft=1, position=-0.1),)),
        {"joints[0].cross.span_mm": 80, "joints[1].cross.slides": "driven", "supports[0].position_mm": -90},
    )
    assert drive.joints[0].cross == Cross(span=0.08)
    assert read(drive, "joints[1].cross.slides") == "driven"
    with pytest.raises(InputError, match=r"supports\[0\].position_mm: 90 mm lies behind joint 1"):
        with_values(drive, {"supports[0].position_mm": 90})
    with pytest.raises(InputError, match="true, false or a word"):
        with_values(drive, {"joints[0].cross.slides": 3})


def test_a_joint_keeps_its_kind() -> None:
    assert type(with_values(DRIVE, {"joints[0].friction": 0.01}).joints[0]) is Hooke
