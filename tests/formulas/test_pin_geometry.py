"""Against the contact in space, and slants tried one by one."""

import numpy as np
import pytest

from cardan import InputError
from cardan.drive.joints import pin_coupling
from cardan.formulas.joint_geometry import best_pins, pin_choices
from cardan.units import deg

TURN = np.linspace(0, 2 * np.pi, 361)


def test_every_choice_is_what_its_contact_says():
    joint_angle, radius = 30 * deg, 0.06
    found = pin_choices(joint_angle, radius, np.array([18.0, 30.0, 45.0, 70.0]) * deg)
    for k, slant in enumerate(found.slant):
        a = found.distance[k]
        contact = pin_coupling.pin_contact(TURN, joint_angle, a, a, slant, slant)
        assert np.max(contact.first) * np.sin(slant) == pytest.approx(radius, rel=1e-12), "it fills the room"
        assert found.stroke[k] == pytest.approx(np.ptp(contact.first), rel=1e-9)
        assert found.stroke[k] == pytest.approx(
            2 * radius * np.sin(joint_angle / 2) / np.cos(slant - joint_angle / 2), rel=1e-12
        )
        assert found.length[k] == pytest.approx(np.max(contact.first), rel=1e-12)
        assert found.force[k] == pytest.approx(np.max(contact.force), rel=1e-9), "both look at whole degrees"
        off = pin_coupling.pin_contact(TURN, joint_angle, a + 1e-7, a - 1e-7, slant, slant)
        assert found.angle_error[k] == pytest.approx(np.max(np.abs(off.deviation)) / 2e-7, rel=2e-3)


@pytest.mark.parametrize("joint_angle", [5, 30, 70])
def test_no_other_slant_touches_with_less_force(joint_angle):
    found = best_pins(joint_angle * deg, 0.06)
    low, high = np.array(found.slant_range) / deg
    tried = pin_choices(joint_angle * deg, 0.06, np.linspace(low + 3, high - 3, 400) * deg)
    assert found.force <= tried.force.min() * (1 + 1e-12)
    assert found.force == pytest.approx(tried.force.min(), rel=1e-3)
    assert found.slant_range[0] < found.slant < found.slant_range[1]


def test_the_largest_bend_is_the_worst():
    found = best_pins(40 * deg, 0.06)
    for joint_angle in np.linspace(0, 40, 9) * deg:
        force = pin_coupling.force_alike(TURN, joint_angle, found.distance, found.slant).max()
        assert force <= found.force * (1 + 1e-12)


def test_what_cannot_be():
    with pytest.raises(InputError) as error:
        pin_choices(90 * deg, 0.0, [0.5])
    assert {problem.field for problem in error.value.problems} == {"joint_angle_max", "radius"}
    with pytest.raises(InputError) as error:
        pin_choices(30 * deg, 0.06, [0.5, 14 * deg, 80 * deg])
    assert [problem.field for problem in error.value.problems] == ["slants[1]", "slants[2]"]
    with pytest.raises(InputError, match="leaves no slant"):
        best_pins(80 * deg, 0.06, margin=6 * deg)
