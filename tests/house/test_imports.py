"""Imports stand at the top of a file, and what is heavy is loaded when it is needed."""

import subprocess
import sys
from pathlib import Path

import pytest

import cardan
from cardan.drive.joints import hooke

from .imports import borrowed, circles, hidden, imports

LATER = {
    "cardan.answers.question": {"if"},  # the register of questions is light: help must not load numpy
    "cardan.batch.table.store": {"try"},  # `fcntl` is not on every system
}
"""Modules with another import than at their top, and where; all else that is loaded late is `cardan.later.later`."""


@pytest.mark.slow
def test_imports_stand_at_the_top():
    assert hidden() == LATER


@pytest.mark.slow
def test_private_names_stay_in_their_module():
    assert borrowed() == []


@pytest.mark.slow
def test_no_module_needs_itself():
    """Whatever the folders: not through imports for type checking, nor through those made later."""
    assert circles(imports()) == []


def test_the_package_alone_loads_nothing_heavy():
    told = "import sys, cardan; sys.exit(', '.join({'numpy', 'pathlib', 'typer'} & {*sys.modules}) or 0)"
    run = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=False)
    assert not run.returncode, run.stderr


@pytest.mark.slow
def test_a_command_loads_the_kinds_of_joints_that_its_drive_has():
    """What a command loads and does not need is time that everybody waits."""
    file = Path(cardan.__file__).parents[2] / "examples" / "truck-printed-angles.toml"
    asked = f"from cardan.cli.main import main; main(['motion', {str(file)!r}])"
    told = f"import sys; {asked}; print(*sorted(sys.modules), file=sys.stderr)"
    loaded = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True).stderr.split()
    kinds = {f"cardan.drive.joints.{path.stem}" for path in Path(hooke.__file__).parent.glob("[!_]*.py")}
    base = {"cardan.drive.joints.joint", "cardan.drive.joints.hooke"}
    assert kinds & {*loaded} == base
    assert not {
        "cardan.questions.motion.articulation",
        "cardan.questions.accuracy.accuracy",
        "cardan.mechanism.turning",
        "cardan.catalogue.rows",
        "cardan.figures.figure",
        "rich.progress",
    } & {*loaded}
