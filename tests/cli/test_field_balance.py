"""cardan field-balance: recordings of runs with trial masses in, masses out."""

import numpy as np
import pytest

from cardan.io.signals import write
from tests.questions.diagnosis.test_field_balance import HIDDEN, ONE_EACH, PLACES, recording


@pytest.fixture
def runs(tmp_path):
    added = [np.zeros(2), *ONE_EACH]
    for k, one in enumerate(added):
        write(recording(HIDDEN + one, joint=0.1), tmp_path / f"run{k}.csv")
    trials = []
    for k, one in enumerate(ONE_EACH):
        mass = f"{1e3 * PLACES[k]:g},{1e6 * abs(one[k]):g},{np.degrees(np.angle(one[k]))}"
        trials.append(f"--trial={tmp_path / f'run{k + 1}.csv'}={mass}")
    return tmp_path / "run0.csv", trials


def test_masses_are_those_that_cancel_what_was_hidden(cardan, runs):
    first, trials = runs
    said = cardan("field-balance", first, *trials, "--radius-mm", 40, "--json").content
    masses = said["corrections"]
    found = 1e-6 * np.asarray(masses["unbalance_g_mm"]) * np.exp(1j * np.radians(masses["angle_deg"]))
    # A recording as text keeps six digits or so, and a joint of 0.1 rad turns 1e-3 of it backward.
    np.testing.assert_allclose(found, -HIDDEN, rtol=5e-3)
    assert masses["mass_g"] == pytest.approx(1e6 * np.abs(found) / 40, rel=1e-9)
    assert masses["position_mm"] == pytest.approx(1e3 * PLACES)
    assert cardan("field-balance", first, *trials).out.count("order 2") >= 2


@pytest.mark.parametrize(
    ("trial", "said"),
    [("run1.csv", "is not SIGNAL="), ("run1.csv=60,0,90", "above 0"), ("run1.csv=60,1", "is not SIG")],
)
def test_a_trial_that_is_none_is_refused(cardan, runs, trial, said):
    done = cardan("field-balance", runs[0], "--trial", trial)
    assert done.code == 2
    assert said in done.err
