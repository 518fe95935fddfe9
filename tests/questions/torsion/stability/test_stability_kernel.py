"""The kernel of stability maps begins near motions that are known, and at rest where none is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.questions.torsion.model.torsional_layouts import Turning
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.stability.stability_kernel import mapped


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
