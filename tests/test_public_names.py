import subprocess
import sys
from types import ModuleType

import pytest

import cardan

HEAVY = ("scipy", "matplotlib", "plotly", "numba", "jinja2", "tomlkit", "typer", "rich")


def run(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def public_names():
    """Return everything public by its name, ``cardan.motion`` or ``cardan.sweeps.sweep``."""
    found = {}
    for name, home in cardan._HOMES.items():
        thing = getattr(cardan, name)
        found |= {f"cardan.{name}": thing} if home else {f"cardan.{name}.{n}": t for n, t in exported(thing).items()}
    return found


def exported(module):
    """Return what a public module holds, by name."""
    return {name: thing for name, thing in vars(module).items() if not name.startswith("_")}


def test_at_the_top_stands_what_a_newcomer_needs():
    assert len(cardan.__all__) <= 80
    assert {"Drive", "load", "motion", "forces", "check", "report", "sweeps"} <= set(cardan.__all__)


def test_every_public_thing_has_one_name():
    names = public_names()
    assert all(thing is not None for thing in names.values())
    kept = {id(thing) for thing in names.values()}
    assert len(kept) == len(names)


@pytest.mark.parametrize("module", [name for name, home in cardan._HOMES.items() if not home])
def test_public_modules_hold_names_of_other_modules_and_say_what(module):
    there = getattr(cardan, module)
    assert there.__doc__
    assert not [name for name, thing in exported(there).items() if isinstance(thing, ModuleType)]
    assert f"`cardan.{module}`" in cardan.__doc__


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
