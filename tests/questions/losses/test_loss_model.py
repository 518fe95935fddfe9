from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan.drive.duty import Harmonic
from cardan.questions.losses.loss_model import mean_powers, powers
from cardan.questions.losses.loss_parts import counted, model_of
from tests.builders.drives import plans
from tests.builders.rubbing import STEADY, loaded, single


@settings(max_examples=8)
@given(plans(most=3), st.integers(0, 2**32 - 1))
def test_means_are_those_of_many_places(plan, seed):
    drive, duty = loaded(plan, seed)
    model = model_of(drive, duty, counted(drive, duty)[0])
    assert model.halves == 4
    many = powers(model, (np.arange(40_000) + 0.5) * (4 * np.pi / 40_000))
    mean = mean_powers(model)
    size = float(np.max(np.abs(many.input)))
    # Each of some tens of kinks is missed by the square of the step, 1e-8, times a slope of order one.
    for name in ("input", "output", "driving", "driven", "resisting", "storing"):
        assert np.allclose(getattr(mean, name), np.mean(getattr(many, name), axis=-1), rtol=0, atol=3e-8 * size), name


def model(*harmonics):
    return model_of(single(), replace(STEADY, harmonics=harmonics), counted(single(), STEADY)[0])


@pytest.mark.parametrize(("orders", "halves"), [((), 1), ((2, 4), 2), ((0.5,), 4), ((0.5, 1 / 3), 12), ((2**0.5,), 24)])
def test_torques_are_averaged_over_the_turns_after_which_they_repeat(orders, halves):
    assert model(*(Harmonic(order=order, torque=1.0) for order in orders)).halves == halves
