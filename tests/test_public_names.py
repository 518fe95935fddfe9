import subprocess
import sys

import pytest

import cardan

HEAVY = ("scipy", "matplotlib", "plotly", "numba", "jinja2", "tomlkit", "typer", "rich")


def run(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.slow
@pytest.mark.parametrize("name", cardan.__all__)
def test_every_public_name_is_there(name):
    assert getattr(cardan, name) is not None


def test_public_names_are_declared_for_type_checkers_too():
    """The block under TYPE_CHECKING names the same things from the same places."""
    import ast
    from pathlib import Path

    tree = ast.parse(Path(cardan.__file__).read_text("utf8"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    declared = {alias.name: node.module for node in block.body for alias in node.names}
    assert declared == cardan._HOMES


def test_importing_cardan_is_light():
    loaded = run("import sys, cardan; print(*sys.modules)")
    assert not set(HEAVY) & set(loaded)
    assert "numpy" not in loaded


def test_asking_for_motion_is_light():
    loaded = run("import sys; from cardan import Drive, motion; motion(Drive.from_angles([0.1])); print(*sys.modules)")
    assert not set(HEAVY) & set(loaded)


@pytest.mark.slow
def test_a_question_is_not_hidden_by_the_package_of_its_name():
    code = (
        "import cardan, cardan.calc.motion.kinematics; from cardan import calc; print(type(calc).__name__, calc is {})"
    )
    assert run(code.format("cardan.calc")) == ["function", "True"]


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'colour'"):
        _ = cardan.colour
    assert set(dir(cardan)) >= {"Drive", "motion"}
