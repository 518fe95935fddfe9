"""The folders of the house: none too full, and none that needs what needs it."""

import pytest

from .imports import ROOT, between, circles, modules

MOST = 25
"""Modules of a folder, without its ``__init__``."""


def held():
    """Return how many modules each folder holds."""
    found = {}
    for path in modules().values():
        if path.name != "__init__.py":
            name = path.parent.relative_to(ROOT).as_posix()
            found[name] = found.get(name, 0) + 1
    return found


def folders():
    """Return every folder of the package that holds folders or modules, by its dotted name."""
    return sorted({name.rpartition(".")[0] for name in modules() if "." in name})


def rooms(folder):
    """Return the room within a folder for every module below it."""
    start = f"{folder}."
    return {name: name.removeprefix(start).split(".")[0] for name in modules() if name.startswith(start)}


def test_no_folder_holds_more_modules_than_one_can_look_over():
    assert {name: count for name, count in held().items() if count > MOST} == {}


@pytest.mark.slow
@pytest.mark.parametrize("folder", folders())
def test_no_circle_among_the_rooms_of_a_folder(folder):
    """Neither among the top folders nor further down, imports for type checking and within functions included."""
    assert circles(between(rooms(folder))) == []


@pytest.mark.slow
def test_a_circle_would_be_seen():
    arrows = between({"cardan.report.content": "a", "cardan.report.block": "b"})
    assert arrows["a"]["b"] == ("cardan.report.content", "cardan.report.block")
    assert circles({"a": ["b"], "b": ["c"], "c": ["a"], "d": ["a"]}) == [("a", "b", "c")]
