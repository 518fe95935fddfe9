"""The scripts of the app without a browser, by node; skipped where there is none."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.mark.parametrize("file", sorted(one.name for one in HERE.glob("*.test.mjs")))
def test_scripts_do_what_their_tests_say(file: str) -> None:
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node")
    ran = subprocess.run([node, "--test", file], cwd=HERE, capture_output=True, text=True, timeout=300)
    assert ran.returncode == 0, ran.stdout + ran.stderr
