"""Plan files: what they say arrives, and everything wrong with one is told at once with its path."""

import json
from pathlib import Path

import numpy as np
import pytest

from cardan import InputError
from cardan.batch.table.reductions import Reduce
from cardan.io.plan_file import plan_of, read_plan
from cardan.sweeps import GridAxis, Normal, SampledAxis, TableAxis, Uniform

EXAMPLES = Path(__file__).parents[2] / "examples"

HEAD = 'format = 1\ndrive = "truck-rear-axle.toml"\nask = ["speed_fluctuation"]\n'


def read(text):
    return plan_of(text, folder=EXAMPLES)


def wrong(text):
    with pytest.raises(InputError) as error:
        read(text)
    return {problem.field: problem.message for problem in error.value.problems}


def test_every_form_of_an_axis_arrives():
    plan = read(
        HEAD
        + """
seed = 7
[[vary]]
key = "duty.speed_rpm"
from = 1000
to = 2000
count = 3
[[vary]]
key = "limits.spline_overlap_mm"
values = [50, 60.5]
[[vary]]
name = "make"
facts = ["price_eur"]
rows = [
  { name = "A", price_eur = 90, "joints[0].centre_mm" = [0, 0, 0], "shafts[1].yoke_angle_deg" = 0 },
  { name = "B", price_eur = 70, "joints[0].centre_mm" = [0, 0, 5], "shafts[1].yoke_angle_deg" = 3 },
]
[[vary]]
design = "lhs"
name = "fit"
count = 16
fields = [
  { key = "output.point_mm[1]", distribution = "normal", std = 0.5 },
  { key = "output.point_mm[2]", distribution = "uniform", plus_minus = 2 },
]
correlations = [["output.point_mm[1]", "output.point_mm[2]", 0.5]]
"""
    )
    speeds, overlaps, makes, fits = plan.axes
    assert speeds == GridAxis(field="duty.speed_rpm", start=1000, stop=2000, count=3)
    assert overlaps == TableAxis(fields=("limits.spline_overlap_mm",), rows=((50,), (60.5,)))
    assert makes.facts == ("price_eur", "make")
    assert makes.values(np.asarray([1])) == {
        "make": "B",
        "price_eur": 70.0,
        "joints[0].centre_mm[0]": 0.0,
        "joints[0].centre_mm[1]": 0.0,
        "joints[0].centre_mm[2]": 5.0,
        "shafts[1].yoke_angle_deg": 3.0,
    }
    assert isinstance(fits, SampledAxis)
    assert fits.seed == 10  # of the plan, and another one for each axis
    assert fits.distributions == {
        "output.point_mm[1]": Normal(mean=45.0, std=0.5),
        "output.point_mm[2]": Uniform(low=-302.0, high=-298.0),
    }
    assert plan.work().size == 3 * 2 * 2 * 16


def test_what_is_told_of_all_points_arrives():
    plan = read(
        HEAD
        + """
constraints = ["speed_fluctuation_percent <= 1"]
rows = "none"
title = "a title"
reduce = ["max alpha_eq_deg", { kind = "histogram", of = "speed_fluctuation_percent", bins = 5, low = 0, high = 1 }]
[engine]
kind = "processes"
workers = 3
chunk_rows = 100
"""
    )
    assert plan.reduce == (
        Reduce(kind="max", of="alpha_eq_deg"),
        Reduce(kind="histogram", of="speed_fluctuation_percent", bins=5, low=0.0, high=1.0),
    )
    assert (plan.engine, plan.workers, plan.chunk, plan.rows, plan.title) == ("processes", 3, 100, "none", "a title")
    assert plan.constraints == ("speed_fluctuation_percent <= 1",)


def test_axes_written_as_the_plan_file_has_them_read_alike():
    given = read_plan(EXAMPLES / "sweeps" / "truck-suspension.toml")
    tree = {
        "format": 1,
        "drive": "truck-rear-axle.toml",
        "ask": ["joint_angle"],
        "vary": [axis.told() for axis in given.axes],
    }
    tree["reduce"] = [one.told() for one in given.reduce]
    again = plan_of(json.dumps(tree), folder=EXAMPLES, form="json")
    assert (again.axes, again.reduce) == (given.axes, given.reduce)


def test_everything_wrong_is_told_at_once_with_its_path():
    found = wrong(
        """
format = 2
drive = "truck-rear-axle.toml"
ask = []
sead = 3
rows = "some"
constraints = ["speed fluctuation about 3"]
reduce = ["most speed fluctuation", 3]
[[vary]]
key = "duty.speed_rpm"
from = 1000
count = "3"
[[vary]]
key = "duty.speed_rpm"
values = 3
stop = 4
[[vary]]
design = "sobel"
count = 3
fields = [{ key = "duty.sped_rpm", distribution = "normal" }, { key = "duty.speed_rpm", distribution = "uniform" }]
[engine]
kind = "abacus"
workers = -1
"""
    )
    for path in (
        "format",
        "ask",
        "sead",
        "rows",
        "constraints[0]",
        "reduce[0]: reduce",
        "reduce[1]",
        "vary[0].to",
        "vary[0].count",
        "vary[1].values",
        "vary[1].stop",
        "vary[2].design",
        "vary[2].fields[0].key: duty.sped_rpm",
        "vary[2].fields[1].low",
        "vary[2].fields[1].high",
        "engine.kind",
        "engine.workers",
    ):
        assert path in found, (path, found)
    assert "seed" in found["sead"]


def test_rows_give_the_same_keys():
    rows = 'rows = [{ name = "A", "duty.speed_rpm" = 1 }, { name = "B" }]\n'
    assert "vary[0].rows[1]" in wrong(HEAD + '[[vary]]\nname = "make"\n' + rows)


def test_what_is_wrong_with_the_drive_file_is_told():
    found = wrong('format = 1\ndrive = "no-such.toml"\nask = ["speed_fluctuation"]\n')
    assert any(field.startswith("drive") for field in found)


def test_questions_and_paths_are_held_against_the_drive():
    text = HEAD.replace('"speed_fluctuation"', '"speed_fluctation"')
    found = wrong(text + '[[vary]]\nkey = "joints[5].centre_mm[0]"\nfrom = 0\nto = 1\ncount = 2\n')
    assert "no index 5" in found["vary[0]: joints[5].centre_mm[0]"]
    assert "speed_fluctuation" in found["ask"]


def test_what_constraints_need_is_told_when_the_plan_becomes_work():
    plan = read(HEAD.replace("ask", 'constraints = ["life_h >= 3"]\nask'))
    with pytest.raises(InputError, match="life_h"):
        plan.work()


@pytest.mark.parametrize("path", sorted((EXAMPLES / "sweeps").glob("*.toml")), ids=lambda path: path.stem)
def test_shipped_plans_become_work(path):
    plan = read_plan(path)
    work = plan.work()
    rows = work.evaluate(0, 1)
    assert rows["status"].tolist() == [0]


BIG = "1" + 400 * "0"


@pytest.mark.parametrize(
    ("table", "field"),
    [
        ('key = "duty.speed_rpm"\nvalues = [' + BIG + "]\n", "vary[0]: duty.speed_rpm[0]"),
        ('key = "joints[0].centre_mm"\nvalues = [[0, 0, 0], 3]\n', "vary[0]: joints[0].centre_mm"),
        ('key = "duty.speed_rpm"\nvalues = [{ a = 1 }]\n', "vary[0]: duty.speed_rpm[0]"),
        ('key = "duty.speed_rpm"\nfrom = -1e308\nto = 1e308\ncount = 3\n', "vary[0]: duty.speed_rpm: to"),
        ('key = "duty.speed_rpm"\nfrom = 1\nto = 3\ncount = ' + BIG + "\n", "vary[0].count"),
        ('key = "duty.speed_rpm"\nfrom = 1\nto = 3\ncount = 0\n', "vary[0]: duty.speed_rpm: count"),
        ('design = "random"\ncount = 3\nseed = -1\nfields = []\n', "vary[0].fields"),
        ('name = "make"\nrows = []\n', "vary[0].rows"),
    ],
)
def test_odd_values_of_an_axis_are_refused(table, field):
    text = HEAD + "[[vary]]\n" + table
    with pytest.raises(InputError) as error:
        read(text).work()
    assert field in {problem.field for problem in error.value.problems}


def test_a_scheduler_belongs_to_a_cluster():
    assert "only a cluster" in wrong(HEAD + '[engine]\nscheduler = "tcp://host:8786"\n')["engine.scheduler"]


def test_a_drive_file_without_a_name_is_refused():
    assert "names no file" in wrong(HEAD.replace("truck-rear-axle.toml", ""))["drive"]
