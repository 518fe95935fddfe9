"""Every number that an answer in JSON held when ``answers.json.xz`` was captured is still in it.

``CARDAN_GOLDEN_EXACT=1`` asks for equality to 1e-12 of the largest number of a column in all but residuals, which holds
on the processor that captured; without it tolerances hold that any processor keeps. ``python -m tests.golden.check``
tells the same faster, of one command or example.
"""

import json

import pytest

from tests.golden import compare, renamed, tolerances
from tests.golden.capture import record, stored
from tests.golden.check import asked_exactly, chosen, faults, suggested, told
from tests.golden.compare import differences

RECORDS = stored()

QUICK = [
    "motion examples/truck-printed-angles.toml",
    "phases examples/truck-wrong-yokes.toml",
    "articulation examples/pto-hitch.toml",
    "forces examples/truck-supports.toml",
    "losses examples/truck-supports.toml",
    "life examples/truck-duty-cycle.toml",
    "strength examples/car-propshaft.toml",
    "balance examples/car-propshaft.toml",
    "select examples/front-halfshaft.toml",
    "joint tripod --bend-deg 25 --speed-rpm 1000",
    "tolerance examples/instrument-joint.toml",
    "bending examples/two-piece-rubber-bearing.toml",
    "rotor examples/car-propshaft.toml",
    "assembly examples/overconstrained-pump.toml",
    "mobility examples/mechanisms/crank-slider.toml",
    "torsion modes examples/pto-flywheel.toml",
    "torsion response examples/pto-flywheel.toml",
    "torsion stability examples/unstable-drive.toml",
    "check examples/car-propshaft.toml",
    "diagnose examples/recordings/truck-unbalance.csv examples/truck-supports.toml",
    "simulate-fault examples/truck-supports.toml unbalance --run-up-s 2 --hold-s 1",
    "catalogue joint_sizes",
    "life examples/cured-drive.toml",
]


def command(line):
    return " ".join(line.split()[: 2 if line.startswith("torsion") else 1])


@pytest.mark.parametrize("line", QUICK)
def test_an_answer_keeps_its_numbers(line):
    found = faults(RECORDS, [line], exact=asked_exactly())
    assert not found, "\n" + told(found)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted({command(line) for line in RECORDS if line not in QUICK}))
def test_all_answers_of_a_command_keep_their_numbers(name):
    rest = [line for line in RECORDS if command(line) == name and line not in QUICK]  # those are asked above
    found = faults(RECORDS, rest, exact=asked_exactly())
    assert not found, "\n" + told(found)


OLD = {
    "life_h": 5943.25,
    "torque_Nm": None,
    "joints": [{"number": 1, "bend_deg": 3.5, "force_kN": 2.0}, {"number": 2, "bend_deg": None, "force_kN": "∞"}],
    "curves": [{"lead_deg": [k / 7 for k in range(90)]}],
}


def compared(new, *, exact=True, old=OLD):
    kept = json.loads(json.dumps(record({"code": 0, "answer": old})))
    return differences("life x.toml", kept, {"code": 0, "answer": new}, exact=exact)


def test_the_same_answer_has_no_difference():
    assert compared(OLD) == []


def test_order_of_keys_turned_tables_and_units_do_not_matter():
    new = {
        "curves": {"lead_rad": [[k / 7 * 3.14159265358979312 / 180 for k in range(90)]]},
        "joints": {"force_N": [2000.0, "∞"], "bend_deg": [3.5, None], "number": [1, 2]},
        "life_s": 5943.25 * 3600,
        "more": 1,
    }
    assert compared(new) == []


@pytest.mark.parametrize(
    ("change", "path", "kind", "said"),
    [
        ({"life_h": 5943.25 * (1 + 1e-11)}, "life_h", "differs", "has become"),
        ({"life_h": None}, "life_h", "missing", ""),
        ({"joints": OLD["joints"][:1]}, "joints.force_kN", "length", "2 numbers have become 1"),
        ({"curves": [{"lead_deg": [k / 7 + (k == 60) for k in range(90)]}]}, "curves.lead_deg", "differs", "[60]"),
        ({"curves": [{"lead_deg": [k / 7 + (k == 61) for k in range(90)]}]}, "curves.lead_deg", "differs", "sum"),
    ],
)
def test_a_changed_number_is_told(change, path, kind, said):
    found = compared(OLD | change)[0]
    assert (found.path, found.kind) == (path, kind)
    assert said in found.said


def test_a_missing_path_is_told_with_where_its_numbers_stand():
    new = {key: value for key, value in OLD.items() if key != "life_h"} | {"rating_life_h": OLD["life_h"]}
    (found,) = compared(new)
    assert (found.kind, found.same) == ("missing", ("rating_life_h",))
    assert "rating_life_h" in told([found])
    assert suggested([found]).strip() == '("life", r"life_h", "rating_life_h"),'


def test_renamed_paths_are_followed(monkeypatch):
    new = {key: value for key, value in OLD.items() if key != "life_h"} | {"rating": {"life_s": 5943.25 * 3600}}
    monkeypatch.setattr(renamed, "PATHS", (("life", r"(l)ife_h", r"rating.\1ife"),))
    assert compared(new) == []


def test_numbers_may_stand_in_another_order_where_it_is_said(monkeypatch):
    new = OLD | {"joints": [*OLD["joints"][::-1], {"number": 3, "bend_deg": 9.0, "force_kN": 1.0}]}
    assert {one.path for one in compared(new)} == {"joints.number", "joints.bend_deg", "joints.force_kN"}
    monkeypatch.setattr(renamed, "AMONG", (("life", r"joints\..*"),))
    assert compared(new) == []


def test_noise_of_rounding_is_all_alike_and_only_that(monkeypatch):
    assert compared({"lead_deg": -2e-14}, old={"lead_deg": 1e-13}) == []
    assert compared({"lead_deg": 2e-9}, old={"lead_deg": 1e-13}) != []
    assert compared({"residual_N": 2e-9}, old={"residual_N": 1e-12, "force_N": 40.0}) != []
    monkeypatch.setattr(tolerances, "RESIDUALS", (("life", "residual_N"),))
    assert compared({"residual_N": 2e-9, "force_N": 40.0}, old={"residual_N": 1e-12, "force_N": 40.0}) == []
    assert compared({"residual_N": 1.0, "force_N": 40.0}, old={"residual_N": 1e-12, "force_N": 40.0}) != []


def test_refusals_keep_their_fields_and_code(monkeypatch):
    old, line = {"code": 2, "fields": ["duty.torque_Nm"]}, "life x.toml"
    assert differences(line, old, {"code": 2, "fields": ["duty.torque_Nm"]}, exact=True) == []
    assert differences(line, old, {"code": 2, "fields": ["conditions[0].torque_Nm"]}, exact=True) != []
    assert differences(line, old, {"code": 0, "answer": {}}, exact=True) != []
    monkeypatch.setattr(renamed, "FIELDS", ((r"^duty\.", "conditions[0]."),))
    assert differences(line, old, {"code": 2, "fields": ["conditions[0].torque_Nm"]}, exact=True) == []
    monkeypatch.setattr(renamed, "ANSWERED", ("life",))
    assert differences(line, old, {"code": 0, "answer": {}}, exact=True) == []


def test_command_lines_are_chosen_by_command_and_example(monkeypatch):
    lines = ["life examples/a-b.toml", "life examples/a.toml --x 1", "lifetime examples/a.toml"]
    assert chosen(lines, "life", "a") == [lines[1]]
    monkeypatch.setattr(renamed, "COMMAND_LINES", ((r"^life ", "rating "),))
    assert chosen(lines, "rating") == lines[:2]
    assert compare.line_now(lines[0]) == "rating examples/a-b.toml"
