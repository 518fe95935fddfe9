import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.reference.__main__ import main, result_of
from tests.reference.judge import faults

FOLDER = Path(__file__).parent
CASES = [case for path in sorted(FOLDER.glob("*.json")) for case in json.loads(path.read_text("utf8"))["cases"]]


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_a_reference_case_passes(case):
    assert faults(case, result_of(case)) == []


@pytest.mark.slow
def test_every_capability_of_the_cases_is_known():
    assert {case["id"] for case in CASES if result_of(case) is None} == set()


def test_an_unknown_capability_gives_no_result(tmp_path):
    cases = [{"id": "x", "capability": "perpetual_motion", "inputs": {}}]
    (tmp_path / "in.json").write_text(json.dumps({"cases": cases}), encoding="utf8")
    main(str(tmp_path / "in.json"), str(tmp_path / "out.json"))
    assert json.loads((tmp_path / "out.json").read_text("utf8")) == {"results": []}


@pytest.mark.slow
def test_the_runner_runs_as_a_module(tmp_path):
    out = tmp_path / "out.json"
    command = [sys.executable, "-m", "tests.reference", str(FOLDER / "kinematics.json"), str(out)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=FOLDER.parents[1], timeout=300)
    assert done.returncode == 0, done.stderr
    results = json.loads(out.read_text("utf8"))["results"]
    cases = json.loads((FOLDER / "kinematics.json").read_text("utf8"))["cases"]
    assert [result["id"] for result in results] == [case["id"] for case in cases]


NEAR = {"id": "y", "rtol": 1e-9, "atol": 0.0, "expected": {"delta": 0.25, "psi_mod180_deg": [179.0], "phi_deg": 10.0}}


@pytest.mark.parametrize(
    ("computed", "verdict"),
    [
        ({"delta": 0.25, "psi_mod180_deg": [-1.0], "phi_deg": 10.0}, []),
        ({"delta": 0.26, "psi_mod180_deg": [-1.0], "phi_deg": 10.0}, ["delta is 0.26, not 0.25"]),
        ({"delta": 0.25, "psi_mod180_deg": [-1.0], "phi_deg": 370.0}, ["phi_deg is 370.0, not 10.0"]),
        ({"delta": float("nan"), "psi_mod180_deg": [-1.0], "phi_deg": 10.0}, ["delta is nan, not 0.25"]),
        ({"delta": 0.25, "phi_deg": 10.0}, ["psi_mod180_deg is missing"]),
        ({"delta": 0.25, "psi_mod180_deg": [], "phi_deg": 10.0}, ["psi_mod180_deg is [], not 1 values"]),
    ],
)
def test_the_judge_tells_right_from_wrong(computed, verdict):
    assert faults(NEAR, {"id": "y", "computed": computed}) == verdict


def test_the_judge_wants_the_right_field_named():
    case = {"id": "z", "expected": {"error_field": "alpha_deg"}, "rtol": 0, "atol": 0}
    assert faults(case, {"id": "z", "computed": {}})
    assert faults(case, {"id": "z", "error": {"field": "beta_deg", "message": ""}})
    assert not faults(case, {"id": "z", "error": {"field": "alpha_deg", "message": ""}})
