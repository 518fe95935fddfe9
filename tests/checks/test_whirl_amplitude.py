"""The whirl of the line against its clearance and a standard: the numbers of the question, over all load cases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.checks.checks import check
from cardan.drive.conditions import load_cases, under
from cardan.drive.duty import Limits
from cardan.io import example
from cardan.questions.bending.line_whirl import line_whirl
from cardan.units import rpm

CAR = example("car-propshaft")


def judged(drive, **vary):
    return check(drive, only=["whirl_amplitude"], **vary)


@pytest.mark.slow
def test_the_amplitude_is_that_of_the_worst_load_case_against_the_clearance():
    limited = replace(CAR, limits=replace(CAR.limits, whirl=0.1e-3))
    first, second = judged(limited)
    most = max(line_whirl(under(CAR, case)).peak()[0] for case in load_cases(CAR.duty))
    assert float(first.value) == pytest.approx(most)
    assert (first.state, first.advice, float(first.limit)) == ("failed", False, 0.1e-3)
    assert second.advice
    (wide, _advice) = judged(replace(CAR, limits=replace(CAR.limits, whirl=1.1 * most)))
    assert wide.state in ("passed", "close")


def test_the_standard_is_advice_and_looks_at_every_speed_in_use():
    """9000/√n µm from peak to peak, at the speed in use where most of it is used."""
    one = replace(CAR, duty=replace(CAR.duty, blocks=()))
    (told,) = judged(one)
    found = line_whirl(one)
    size = np.max(found.whirl, axis=-1) / (4.5e-3 / np.sqrt(found.speed / rpm))
    inside = (found.speed >= 600 * rpm * (1 - 1e-9)) & (found.speed <= 4000 * rpm * (1 + 1e-9))
    assert told.advice
    assert told.confidence == "recalled"
    assert float(told.utilisation) == pytest.approx(float(np.max(size[inside])))


def test_what_lacks_is_named_and_many_drives_are_not_judged():
    (told,) = judged(example("single-20deg"))
    assert told.missing
    (many,) = judged(CAR, vary={"shafts[1].outer_mm": [70.0, 80.0]})
    assert "one drive at a time" in many.unfit
    # A limit that varies leaves the line as it is.
    limited = replace(CAR, limits=Limits(whirl=1e-3))
    first = judged(limited, vary={"limits.whirl_um": [100.0, 1000.0]})[0]
    np.testing.assert_allclose(first.limit, [1e-4, 1e-3])
