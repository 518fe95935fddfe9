"""The kernel of stability maps begins near motions that are known, and at rest where none is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.maths.periodic.floquet import monodromy
from cardan.questions.torsion.model.torsional_layouts import Turning
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.stability.stability_kernel import mapped
from cardan.questions.torsion.steady.run_stability import linear_motion
from cardan.questions.torsion.steady.steady import steady_orbits


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_matrices_do_not_depend_on_where_the_motion_begins(sense: float, known: bool) -> None:
    speeds = sense * np.linspace(40.0, 60.0, 8)
    model = torsional_line(
        [[1.0, 0.02], [0.02, 0.4]],
        stiffness=[[4000.0], [6000.0]],
        damping=[[1.0], [1.0]],
        joint_angle=[0.35],
        input_speed=speeds,
    )
    turning = Turning(model, (8,), speeds, np.pi).part(np.arange(8))
    near = mapped(turning, 5, moves_only=True)
    if not known:
        near = replace(near, moved=np.full(8, np.nan))
    whole, again = mapped(turning, 12), mapped(turning, 12, near=near)
    np.testing.assert_allclose(again.matrix, whole.matrix, atol=1e-9)  # what Newton's last steps leave
    np.testing.assert_allclose(again.coefficient, whole.coefficient, atol=1e-12)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_disturbances_with_a_damping_of_their_own_leave_the_motion_as_it_is(sense: float) -> None:
    """The kernel and array expressions say the same of them, and both find the motion of the drive's own damping."""
    speeds = sense * np.linspace(40.0, 60.0, 8)
    plain = torsional_line(
        [[1.0, 0.02], [0.02, 0.4]],
        stiffness=[[4000.0], [6000.0]],
        damping=[[1.0], [1.0]],
        joint_angle=[0.35],
        input_speed=speeds,
    )
    model = replace(plain, disturbed_damping=np.asarray([2.0, 2.5]))
    orbit, _status = steady_orbits(model, speed=speeds)
    rows = np.arange(8)
    found = mapped(Turning(model, (8,), speeds, np.pi).part(rows), 12)
    np.testing.assert_allclose(found.coefficient[:, :, :9], orbit.coefficient[:, 1:, :9], atol=1e-11)
    np.testing.assert_allclose(orbit.coefficient, steady_orbits(plain, speed=speeds)[0].coefficient, atol=1e-12)
    matrix = monodromy(linear_motion(orbit, rows), orbit.time)
    np.testing.assert_allclose(found.matrix, matrix, rtol=1e-5, atol=1e-6)  # steps of the kernel err by 2e-7 of a phase
    assert np.max(np.abs(matrix - monodromy(linear_motion(replace(orbit, model=plain), rows), orbit.time))) > 0.01
