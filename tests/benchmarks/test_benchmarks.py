"""The benchmarks run and say what they promise; how fast they are is judged by reading them."""

from __future__ import annotations

import json

import pytest

from benchmarks.__main__ import NAMES, main
from benchmarks.harness import Figure, fastest

pytestmark = pytest.mark.slow
APART = {"start_up", "app_frames", "app_latency"}
"""They start whole programs; tests of the command line and of the app do that."""


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


def test_an_unknown_name_is_refused(capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["stored_traces", "sorted_races"])
    assert "sorted_races" in capsys.readouterr().err
