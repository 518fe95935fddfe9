"""The docstring is a contract: every public thing says what it takes, in which shape and unit, and shows it."""

import ast
import builtins
import doctest
import inspect
import re
from dataclasses import fields, is_dataclass
from importlib import import_module

import pytest

from tests.test_public_names import public_names

from .house.exported import exported
from .house.imports import modules

PUBLIC = public_names()

FUNCTIONS = {name: thing for name, thing in PUBLIC.items() if inspect.isfunction(thing)}
RECORDS = {name: thing for name, thing in PUBLIC.items() if inspect.isclass(thing) and is_dataclass(thing)}


def section(doc, title):
    """Return the entries of a numpydoc section as (name, what stands after its colon)."""
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^\S[^\n]*\n-{{3,}}\n|\Z)", doc, re.M | re.S)
    lines = found.group(1).splitlines() if found else []
    entries = []
    for line in lines:
        match = re.match(r"^(\*{0,2}\w[\w, *]*)(?: : (.*))?$", line)
        if match:
            entries += [(name.strip(" *"), match.group(2) or "") for name in match.group(1).split(",")]
    return entries


def test_every_public_thing_is_of_a_known_sort():
    other = set(PUBLIC) - set(FUNCTIONS) - set(RECORDS)
    assert all(inspect.isclass(PUBLIC[name]) or not callable(PUBLIC[name]) for name in other)


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if callable(thing)])
def test_the_summary_is_one_sentence(name):
    summary = inspect.getdoc(PUBLIC[name]).split("\n\n")[0]
    assert summary.endswith((".", "?"))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_are_those_of_the_signature_in_its_order(name):
    takes = [p.name for p in inspect.signature(FUNCTIONS[name]).parameters.values()]
    documented = section(inspect.getdoc(FUNCTIONS[name]), "Parameters")
    assert [entry for entry, _ in documented] == takes
    assert all(kind for _, kind in documented)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_say_what_they_return_and_show_it(name):
    doc = inspect.getdoc(FUNCTIONS[name])
    if inspect.signature(FUNCTIONS[name]).return_annotation not in (None, "None"):
        assert "\nReturns\n---" in doc
    assert "\nExamples\n---" in doc
    assert ">>> " in doc


def unknown(code):
    """Return the names that code uses and neither imports nor makes."""
    used, known = set(), set(dir(builtins))
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Name):
            (used if isinstance(node.ctx, ast.Load) else known).add(node.id)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            known |= {(one.asname or one.name).partition(".")[0] for one in node.names}
        elif isinstance(node, ast.arg):
            known.add(node.arg)
        elif isinstance(node, ast.FunctionDef):
            known.add(node.name)
    return used - known


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if callable(thing)])
def test_examples_can_be_copied(name):
    """They import all they use, public names from where they are public."""
    doc = inspect.getdoc(PUBLIC[name]).partition("\nExamples\n---")[2]
    code = "".join(one.source for one in doctest.DocTestParser().get_examples(doc))
    assert unknown(code) == set()


@pytest.mark.parametrize("name", RECORDS)
def test_results_document_every_field(name):
    kind = RECORDS[name]
    doc = inspect.getdoc(kind)
    documented = [entry for entry, _ in section(doc, "Attributes") + section(doc, "Parameters")]
    # Parts of the drive file carry a sentence with each field, from which schema and reference are made.
    bare = [field.name for field in fields(kind) if not field.name.startswith("_") and "cardan" not in field.metadata]
    assert set(bare) <= set(documented)
    assert set(documented) <= {field.name for field in fields(kind)}


@pytest.mark.parametrize("name", [*FUNCTIONS, *RECORDS])
def test_numbers_have_units_and_arrays_shapes(name):
    doc = inspect.getdoc(PUBLIC[name])
    entries = section(doc, "Parameters") + section(doc, "Attributes")
    for entry, kind in entries:
        if re.search(r"\barrays?\b", kind) and "optional" not in kind:
            assert "(" in kind, f"{name}.{entry} does not say its shape"
    assert "[rad]" in doc or "[deg]" not in doc, "Python is SI"


@pytest.mark.parametrize("name", RECORDS)
def test_properties_have_a_sentence(name):
    for attribute, thing in vars(RECORDS[name]).items():
        if isinstance(thing, property) and not attribute.startswith("_"):
            assert inspect.getdoc(thing), f"{name}.{attribute}"


@pytest.mark.parametrize("name", RECORDS)
def test_records_are_frozen_and_named(name):
    kind = RECORDS[name]
    if not issubclass(kind, Exception):
        assert kind.__dataclass_params__.frozen
        assert all(field.kw_only for field in fields(kind))


@pytest.mark.slow
def test_what_pages_additions_and_calculations_take_documents_all_parameters_or_none():
    """Those are told best in a sentence where they are plain."""
    wrong = {}
    for name in exported():
        home, _dot, own = name.rpartition(".")
        thing = getattr(import_module(home), own)
        documented = [entry for entry, _ in section(inspect.getdoc(thing), "Parameters")]
        if documented and not inspect.isclass(thing) and {*documented} != {*inspect.signature(thing).parameters}:
            wrong[name] = documented
    assert wrong == {}


@pytest.mark.slow
def test_what_is_not_exported_says_it_shortly():
    """One line, and below it at most what names and types do not say: no sections, which are for readers outside."""
    long = [name for name, doc in told_inside() if re.search(r"^(\w+ ?\w+)\n-{3,}$", doc, re.M)]
    assert long == []


def told_inside():
    """Yield the docstring of every function, class and method that is not exported, by its dotted name."""
    for home, path in modules().items():
        for node in ast.parse(path.read_text("utf-8")).body:
            yield from told_within(node, home, f"{home}.{getattr(node, 'name', '')}" in exported())


def told_within(node, home, known):
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        name = f"{home}.{node.name}"
        if not known:
            yield name, ast.get_docstring(node) or ""
        for inner in node.body:
            public = isinstance(node, ast.ClassDef) and not getattr(inner, "name", "_").startswith("_")
            yield from told_within(inner, name, known and public)
