"""The benchmarks run and say what they promise; how fast they are is judged by reading them."""

from __future__ import annotations

import json

import pytest

from benchmarks import __main__ as benchmarks
from benchmarks.__main__ import NAMES, main, store, table
from benchmarks.harness import Figure, fastest

APART = {"start_up", "app_frames", "app_latency"}
"""They start whole programs; tests of the command line and of the app do that."""


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in NAMES if name not in APART])
def test_quick_look(name, capsys):
    assert main([name, "--quick"]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert lines
    for line in lines:
        assert list(line) == ["bench", "value", "unit", "yardstick", "ratio"]
        assert line["value"] >= 0.0
        assert line["ratio"] >= 0.0


def test_every_job_runs_in_turns():
    ran: list[str] = []
    best = fastest({"a": lambda: ran.append("a"), "b": lambda: ran.append("b")}, rounds=2)
    assert ran == ["a", "b"] * 3
    assert set(best) == {"a", "b"}


def test_line_is_rounded():
    figure = Figure(bench="x", value=1.23456789, unit="s", yardstick="y", ratio=2.0)
    assert json.loads(figure.line())["value"] == 1.235


def test_figures_are_stored_in_the_place_of_the_old_ones_and_told(tmp_path, monkeypatch):
    monkeypatch.setattr(benchmarks, "STORED", tmp_path / "result.json")
    first = {"bench": "x", "value": 1234.5, "unit": "ms", "yardstick": "y, aim ≤ 1", "ratio": 0.25}
    store("single_drive", [first])
    store("stored_traces", [first])
    store("single_drive", [first | {"value": 2.0}])
    assert list(json.loads((tmp_path / "result.json").read_text("utf8"))) == ["stored_traces", "single_drive"]
    assert "| x | 2 ms | y, aim ≤ 1 | 0.25 |" in table()
    assert "| x | 1,234.5 ms | y, aim ≤ 1 | 0.25 |" in table()
    assert "Not measured this time: `without_positions`, " in table()


def test_the_stored_figures_are_of_benchmarks_there_are_and_the_others_are_named():
    stored = json.loads(benchmarks.STORED.read_text("utf8"))
    assert list(stored) == [name for name in NAMES if name in stored]
    assert all(stored.values())
    told = table()
    assert all(f"`{name}`" in told for name in NAMES)


def test_an_unknown_name_is_refused(capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["stored_traces", "sorted_races"])
    assert "sorted_races" in capsys.readouterr().err
