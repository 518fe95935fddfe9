"""Run commands as a user does: in this process where that is enough, in one of their own where it matters."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from cardan.cli.main import main

EXAMPLES = Path(__file__).parents[2] / "examples"

PLAIN = {"NO_COLOR": "1", "TERM": "dumb", "COLUMNS": "80", "PYTHONUTF8": "1", "CARDAN_LANG": "en"}


@dataclass
class Done:
    """What a command left: its exit code and what it printed."""

    code: int
    out: str
    err: str

    @property
    def content(self):
        return json.loads(self.out)

    @property
    def complaint(self):
        return json.loads(self.err)["error"]


@pytest.fixture
def cardan(capsys, monkeypatch, tmp_path):
    """Run a command in this process, in an empty folder."""
    for name, value in PLAIN.items():
        monkeypatch.setenv(name, value)
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        code = main([str(argument) for argument in arguments])
        printed = capsys.readouterr()
        assert "Traceback" not in printed.out + printed.err
        return Done(code, printed.out, printed.err)

    return run


@pytest.fixture
def process(tmp_path):
    """Run a command in a process of its own, in an empty folder."""

    def run(*arguments, start=subprocess.run, **how):
        environment = os.environ | PLAIN | how.pop("environment", {})
        command = [sys.executable, "-m", "cardan", *(str(argument) for argument in arguments)]
        return start(command, cwd=tmp_path, env=environment, **how)

    return run


@pytest.fixture
def drive_file(tmp_path):
    """Write a drive file and return its path."""

    def write(text, name="drive.toml"):
        path = tmp_path / name
        path.write_text(text, "utf-8")
        return path

    return write
