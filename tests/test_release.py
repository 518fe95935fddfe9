"""What is released says the same everywhere: one version, one list of what it needs, targets that exist."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

from cardan.version import VERSION

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf8"))["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def test_the_citation_and_the_changelog_are_of_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf8"))
    releases = re.findall(r"^## ([\d.]+) \((.+)\)$", (ROOT / "CHANGELOG.md").read_text("utf8"), re.MULTILINE)
    assert citation["version"] == VERSION
    assert releases[0] == (VERSION, str(citation["date-released"]))
    assert f"version {VERSION}" in (ROOT / "docs" / "cite.md").read_text("utf8")


def test_the_changelog_tells_nothing_twice():
    told = [line for line in (ROOT / "CHANGELOG.md").read_text("utf8").splitlines() if line.startswith("- ")]
    begins = [line[:60] for line in told]
    assert {begin for begin in begins if begins.count(begin) > 1} == set()


def test_the_paper_is_by_those_who_are_cited_and_has_every_reference():
    text = (ROOT / "docs" / "paper" / "paper.md").read_text("utf8")
    head = yaml.safe_load(text.split("---")[1])
    entries = (ROOT / "docs" / "paper" / "paper.bib").read_text("utf8")
    bibliography = (ROOT / "docs" / "bibliography.md").read_text("utf8")
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf8"))
    assert [one["name"] for one in head["authors"]] == [one["name"] for one in citation["authors"]]
    assert head["title"] == citation["title"]
    assert set(re.findall(r"@(\w+\d*)\]", text)) == set(re.findall(r"@\w+\{(\w+),", entries))
    for name in re.findall(r"author = \{+([^,}]+)", entries):
        assert name in bibliography or name == "International Organization for Standardization", name


def test_the_recipe_needs_what_the_package_needs():
    recipe = (ROOT / "packaging" / "conda" / "meta.yaml").read_text("utf8")
    run = recipe.partition("  run:\n")[2].partition("\n\n")[0]
    needs = re.findall(r"- ([\w-]+) (>=[\d.]+)", run)
    names = {"matplotlib-base": "matplotlib"}
    found = sorted(f"{names.get(name, name)}{least}" for name, least in needs if name != "python")
    assert found == sorted(PROJECT["dependencies"])
    assert f"python {PROJECT['requires-python']}" in run


def test_the_container_installs_extras_that_exist():
    (extras,) = re.findall(r'"\.\[([\w,]+)\]"', (ROOT / "Containerfile").read_text("utf8"))
    assert set(extras.split(",")) <= set(PROJECT["optional-dependencies"])


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_workflows_call_what_there_is(path):
    content = yaml.safe_load(path.read_text("utf8"))
    targets = re.findall(r"^(\w+):", (ROOT / "Makefile").read_text("utf8"), re.MULTILINE)
    assert content["permissions"]["contents"] == "read"
    for name, job in content["jobs"].items():
        assert job["timeout-minutes"] <= 60, name
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step), name
            for target in re.findall(r"\bmake (\w+)", step.get("run", "")):
                assert target in targets, target
        for needed in [job["needs"]] if isinstance(job.get("needs"), str) else job.get("needs", []):
            assert needed in content["jobs"], name


def test_there_is_a_workflow_for_tests_docs_and_release():
    assert [path.stem for path in WORKFLOWS] == ["docs", "release", "tests"]
