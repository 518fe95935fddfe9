"""A whole sweep: its rows are the same however they are cut, its name says all that decides them."""

import json
import pickle

import numpy as np
import pytest

from cardan import Drive, InputError, equivalent_joint, example
from cardan.batch import sweep as plan_module
from cardan.batch.sweep import work_of
from cardan.batch.work import Reduction, Work
from cardan.drive.fields.paths import with_values
from cardan.io import loads
from cardan.sweeps import GridAxis, SampledAxis, TableAxis, Uniform, sweep

DRIVE = Drive.from_angles([0.3, 0.2, 0.25], yoke_angles=[0.1, 0.2])
AXES = (
    GridAxis(field="joints[0].joint_angle_deg", start=0, stop=20, count=21),
    SampledAxis(distributions={"shafts[1].yoke_angle_deg": Uniform(low=0, high=90)}, count=300, method="sobol", seed=4),
    TableAxis(
        fields=("make", "joints[2].joint_angle_deg"), rows=(("a", 10.0), ("b", 95.0)), name="make", facts=("make",)
    ),
)


def work(**settings):
    told = {
        "reduce": [
            "max speed_fluctuation_percent by joints[0].joint_angle_deg",
            "p90 alpha_eq_deg",
            "mean speed_fluctuation_percent",
            "argmax speed_fluctuation_percent",
        ],
        "constraints": ["alpha_eq_deg <= 15"],
    }
    return work_of(DRIVE, AXES, ["speed_fluctuation", "alpha_eq"], **(told | settings))


def test_it_is_what_engines_and_readers_agreed_on():
    one = work()
    assert isinstance(one, Work)
    assert all(isinstance(reduction, Reduction) for reduction in one.reductions)
    assert [column.role for column in one.columns] == ["point"] * 4 + ["answer"] * 2 + ["status"] * 2
    assert list(one.evaluate(0, 1)) == [column.name for column in one.columns]


def test_rows_are_those_of_each_drive_made_anew():
    one = work()
    rows = one.evaluate(0, one.size)
    for row in (0, 8, 5_000, one.size - 2):
        given = {name: rows[name][row] for name in ("joints[0].joint_angle_deg", "shafts[1].yoke_angle_deg")}
        drive = with_values(DRIVE, {**{k: float(v) for k, v in given.items()}, "joints[2].joint_angle_deg": 10.0})
        assert rows["speed_fluctuation_percent"][row] == pytest.approx(
            100.0 * float(equivalent_joint(drive).speed_fluctuation), rel=1e-9
        )
    bad = rows["make"] == "b"
    assert np.all(rows["status"][bad] == 1)
    assert not np.any(rows["feasible"][bad])
    assert np.array_equal(rows["feasible"][~bad], rows["alpha_eq_deg"][~bad] <= 15)


def test_rows_are_the_same_bit_for_bit_however_they_are_cut(monkeypatch):
    monkeypatch.setattr(plan_module, "BLOCK", 512)
    one = pickle.loads(pickle.dumps(work()))
    whole = one.evaluate(0, one.size)
    for start, stop in ((0, 100), (511, 1537), (12_000, one.size), (5, 5)):
        part = one.evaluate(start, stop)
        for name, values in part.items():
            assert values.dtype.kind == whole[name].dtype.kind
            assert np.array_equal(values, whole[name][start:stop], equal_nan=values.dtype.kind == "f")


def test_reducing_without_rows_tells_what_reducing_them_tells(monkeypatch):
    monkeypatch.setattr(plan_module, "BLOCK", 256)
    monkeypatch.setattr(plan_module, "GATHERED", 1024)
    one = work()
    rows = one.evaluate(0, one.size)
    for reduction, state in zip(one.reductions, one.reduced(0, one.size), strict=True):
        plain = reduction.result(reduction.add(reduction.empty(), rows, 0))
        found = reduction.result(json.loads(json.dumps(state)))
        if plain["kind"] == "mean":  # sums of parts round differently
            assert found["value"] == pytest.approx(plain["value"], rel=1e-13)
        else:
            assert found == plain


def test_points_are_counted_by_how_they_went():
    one = work()
    (state, *_rest) = one.reduced(0, one.size)
    told = one.reductions[0].result(state)
    assert told["answered"] == told["no_drive"] == one.size // 2
    assert told["first"] == {"no_drive": 1}
    assert told["feasible"] == np.count_nonzero(one.evaluate(0, one.size)["feasible"])
    assert one.why(1)[0].field == "joints[2].joint_angle_deg"
    assert one.why(0) == ()


def test_the_name_tells_sweeps_apart_and_the_same_ones_alike():
    names = {work().name, work(constraints=[]).name, work(reduce=[]).name, work(title="other").name}
    names |= {work_of(with_values(DRIVE, {"joints[1].joint_angle_deg": 11.0}), AXES, ["speed_fluctuation"]).name}
    names |= {work(constraints=["alpha_eq_deg <= 15.0000001"]).name}
    assert len(names) == 6
    assert work().name == pickle.loads(pickle.dumps(work())).name


def test_the_provenance_holds_the_drive_and_goes_through_json():
    drive = example("truck-duty-cycle")
    one = work_of(drive, {"duty.shock_factor": [1.0, 1.5]}, ["life"])
    told = json.loads(json.dumps(one.provenance))
    assert loads(json.dumps(told["drive"]), form="json") == drive
    assert told["vary"] == [{"key": "duty.shock_factor", "values": [1.0, 1.5]}]
    assert told["units"]["life_h"] == "h"


def test_vectors_vary_by_their_numbers():
    drive = Drive.from_points([(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0)])
    found = sweep(drive, {"joints[0].centre_mm": [[300, 0, 0], [300, 0, 50]]}, ["joint_angle"]).table()
    assert found["joints[0].centre_mm[2]"].tolist() == [0, 50]
    assert found["joint_angle_deg[0]"][0] != found["joint_angle_deg[0]"][1]


def test_a_drive_as_it_is_is_one_point():
    found = sweep(DRIVE, {}, ["speed_fluctuation"])
    assert found.size == 1
    assert found.table()["speed_fluctuation_percent"][0] == pytest.approx(
        100.0 * float(equivalent_joint(DRIVE).speed_fluctuation)
    )


def test_everything_wrong_is_told_at_once():
    with pytest.raises(InputError) as error:
        work_of(
            DRIVE,
            {"joints[7].joint_angle_deg": [1.0], "joints[0].joint_angle_deg": 3, "joints[1].joint_angle_deg": []},
            ["speed_fluctation"],
            reduce=["most x"],
            constraints=["x is 3"],
        )
    text = str(error.value)
    for part in ("no index 7", "a list of values", "empty list", "speed_fluctation", "most x", "x is 3"):
        assert part in text


@pytest.mark.parametrize("values", [["steep", 2.0], [True, False]])
def test_fields_of_numbers_take_numbers(values):
    with pytest.raises(InputError, match="holds a number"):
        work_of(DRIVE, {"joints[1].joint_angle_deg": values}, ["speed_fluctuation"])


@pytest.mark.parametrize("fact", ["speed_fluctuation_percent", "Status", "feasible"])
def test_no_two_columns_have_one_name(fact):
    axes = [TableAxis(fields=(fact, "joints[2].joint_angle_deg"), rows=((1.0, 10.0),), name="make", facts=(fact,))]
    with pytest.raises(InputError, match="this name already"):
        work_of(DRIVE, axes, ["speed_fluctuation"], constraints=["speed_fluctuation_percent <= 100"])


def test_words_are_not_compared_with_numbers():
    with pytest.raises(InputError) as error:
        work_of(DRIVE, AXES, ["speed_fluctuation"], constraints=["make <= 3"], reduce=["max make", "count make <= 2"])
    assert [one.field for one in error.value.problems] == ["constraints: make <= 3", "reduce[0]", "reduce[1]"]


def test_the_order_of_columns_is_part_of_the_name():
    pairs = (("joints[1].joint_angle_deg", 5.0), ("joints[2].joint_angle_deg", 10.0))
    names = {
        work_of(
            DRIVE,
            [TableAxis(fields=tuple(k for k, _v in two), rows=(tuple(v for _k, v in two),), name="two")],
            ["joint_angle"],
        ).name
        for two in (pairs, pairs[::-1])
    }
    assert len(names) == 2


def test_constraints_are_on_columns():
    with pytest.raises(InputError, match="speed_fluctuation"):
        work_of(DRIVE, AXES, ["speed_fluctuation"], constraints=["speed_fluctuatio <= 3"])


@pytest.mark.parametrize("old", ["speed_fluctuation", "irregularity"])
def test_a_column_by_its_old_name_is_refused_with_the_new_one(old):
    """Where it was a fraction, a limit of 0.02 would now be 50 times as strict."""
    for told in ({"constraints": [f"{old} <= 0.02"]}, {"reduce": [f"max {old}"]}):
        with pytest.raises(InputError, match="the nearest is speed_fluctuation_percent"):
            work_of(DRIVE, AXES, ["speed_fluctuation"], **told)


@pytest.mark.parametrize(
    ("ask", "old"), [("check", "utilisation"), ("strength", "strength_used"), ("balance", "unbalance_used")]
)
def test_a_utilisation_is_in_per_cent_and_its_old_column_is_refused(ask, old):
    drive = example("truck-duty-cycle")
    for told in ({"constraints": [f"{old} <= 1"]}, {"reduce": [f"max {old}"]}):
        with pytest.raises(InputError, match=f"the nearest is {old}_percent"):
            work_of(drive, {}, [ask], **told)
