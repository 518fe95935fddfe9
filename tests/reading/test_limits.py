"""Files made to be slow are refused before a parser sees them."""

from __future__ import annotations

import os
import tomllib
from pathlib import Path
from typing import Any

import pytest

from cardan import InputError, load
from cardan.app.state.document import read
from cardan.catalogue import catalogue, with_files
from cardan.cli.main import main
from cardan.files import Enclosed
from cardan.io import loads, loads_mechanism
from cardan.io.amend import amend
from cardan.io.text import parsed
from cardan.reading import limits
from cardan.reading.limits import MAX_BYTES, MAX_JOINTS, MAX_KEYS, MAX_LEVELS, MAX_PAIRS, MAX_TABLES, limits_hold

HEAD = "format = 1\n"
JOINT = "[[joints]]\njoint_angle_deg = 1\n"
DOTTED = HEAD + ".".join("a" * 50_000) + " = 1\n"
JOINTS = HEAD + JOINT * 3000


@pytest.fixture
def unparsed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every parser fail the test."""

    def called(*_given: Any, **_named: Any) -> None:
        raise AssertionError("the parser was called")

    catalogue()
    for name in ("tomllib.loads", "json.loads", "tomlkit.parse"):
        monkeypatch.setattr(name, called)


def refused(text: str, form: str = "toml") -> dict[str, str]:
    with pytest.raises(InputError) as caught:
        loads(text, form=form)
    return {problem.field: problem.message for problem in caught.value.problems}


@pytest.mark.usefixtures("unparsed")
@pytest.mark.parametrize(
    ("text", "field", "given", "limit"),
    [
        pytest.param(DOTTED, "file", "49999 levels", MAX_LEVELS, id="a key of 50,000 parts"),
        pytest.param(HEAD + '"a" . ' * 40 + "a = 1", "file", "40 levels", MAX_LEVELS, id="parts in quotes"),
        pytest.param(HEAD + f"[{'a.' * 40}a]", "file", "41 levels", MAX_LEVELS, id="the head of a table"),
        pytest.param(HEAD + "a = " + "[" * 33, "file", "33 levels", MAX_LEVELS, id="brackets"),
        pytest.param(HEAD + "a = " + "{a.b = " * 20, "file", "40 levels", MAX_LEVELS, id="brackets and dotted keys"),
        pytest.param(HEAD + 'a = ["""a"""", ' + "[" * 40, "file", "41 levels", MAX_LEVELS, id="behind a quote"),
        pytest.param(HEAD + 'a = ["\\"", ' + "[" * 40, "file", "41 levels", MAX_LEVELS, id="behind an escaped quote"),
        pytest.param(JOINTS, "joints", "3000 [[joints]]", MAX_PAIRS, id="joints"),
        pytest.param(HEAD + JOINT + "[[stations]]\n" * 501, "stations", "501 [[stations]]", MAX_TABLES, id="stations"),
        pytest.param("".join(f"k{k} = 1\n" for k in range(MAX_KEYS + 1)), "file", "20001 keys", MAX_KEYS, id="keys"),
        pytest.param("#" * (MAX_BYTES + 1), "file", "2000001 bytes", MAX_BYTES, id="bytes"),
    ],
)
def test_what_is_too_large_is_never_parsed(text: str, field: str, given: str, limit: int) -> None:
    found = refused(text)
    assert list(found) == [field]
    assert found[field].startswith(given)
    assert f"; the limit is {limit}. A file may have 2 MB, 32 levels, 20000 keys, 100 joints" in found[field]
    assert not read(text, Enclosed(Path("."))).valid
    with pytest.raises(InputError, match="the limit is"):
        amend(text, {"name": "x"})


@pytest.mark.usefixtures("unparsed")
def test_json_that_is_too_deep_is_never_parsed() -> None:
    assert refused('{"a":' * 33, "json")["file"].startswith("33 levels")


@pytest.mark.slow
def test_tokens_are_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The work for a text is one pass over it: as many tokens as it has marks, strings and comments, no more."""
    seen = []
    real = limits._TOKEN

    class Counting:
        def finditer(self, text: str) -> Any:
            for token in real.finditer(text):
                seen.append(token)
                yield token

    monkeypatch.setattr(limits, "_TOKEN", Counting())
    refused(DOTTED)
    assert len(seen) == 49_999 + 2 + 2  # dots, equals signs, ends of lines
    seen.clear()
    refused(JOINTS)
    assert len(seen) == 3000 * 4 + 2  # of a joint: its head, its equals sign, two ends of lines


@pytest.mark.parametrize(
    ("text", "form"),
    [
        (HEAD + "joints = [" + "{joint_angle_deg = 1}, " * (MAX_JOINTS + 1) + "]", "toml"),
        ('{"format": 1, "joints": [' + ", ".join(['{"joint_angle_deg": 1}'] * (MAX_JOINTS + 1)) + "]}", "json"),
        (HEAD + JOINT * (MAX_JOINTS + 1), "toml"),
    ],
)
def test_joints_are_counted_however_they_are_written(text: str, form: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cardan.io.drive_file.drive_from_tree", lambda *_given, **_named: pytest.fail("was judged"))
    assert refused(text, form)["joints"].startswith("101 [[joints]] given; the limit is 100.")


def test_what_is_at_the_limits_is_read() -> None:
    assert len(loads(HEAD + JOINT * MAX_JOINTS).joints) == MAX_JOINTS
    quoted = "[" * 100 + "." * 100
    text = HEAD + f'name = "{quoted}"\nnote = """\n{quoted}\n"" \\""" {quoted}"""\n# {quoted}\n' + JOINT
    assert loads(text).name == quoted
    deep = "a = " + "[" * MAX_LEVELS + "]" * MAX_LEVELS
    assert parsed(deep, "toml", "file") == tomllib.loads(deep)


def test_a_mechanism_may_have_more_joints() -> None:
    pair = '[[joints]]\ntype = "R"\npoint_mm = [0, 0, 0]\naxis = [0, 0, 1]\n'
    chain = "".join(f'{pair}id = "p{k}"\nlinks = ["l{k}", "l{k + 1}"]\n' for k in range(150))
    assert len(loads_mechanism(f'format = 1\nframe = "l0"\n{chain}').joints) == 150


def test_the_limits_are_lifted_by_keyword_environment_and_option(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "long.toml"
    file.write_text(HEAD + "[[joints]]\njoint_angle_deg = 0.1\n" * (MAX_JOINTS + 1))
    with pytest.raises(InputError, match=r"101 .* the limit is 100"):
        load(file)
    assert len(load(file, limits=False).joints) == MAX_JOINTS + 1
    with pytest.raises(InputError):
        load(file)
    monkeypatch.setenv("CARDAN_NO_LIMITS", "1")
    assert len(load(file).joints) == MAX_JOINTS + 1
    monkeypatch.delenv("CARDAN_NO_LIMITS")
    assert main(["motion", str(file)]) == 2
    assert "--no-limits" in capsys.readouterr().err
    assert main(["motion", str(file), "--no-limits"]) == 0
    assert "CARDAN_NO_LIMITS" not in os.environ


def test_a_large_file_is_not_read_to_its_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "large.toml"
    file.write_text("#" * (MAX_BYTES + 1))
    monkeypatch.setattr("cardan.io.text.check_text", lambda *_given, **_named: pytest.fail("was read"))
    with pytest.raises(InputError, match="2000001 bytes given; the limit is 2000000"):
        load(file)


def test_a_catalogue_is_guarded_too(tmp_path: Path) -> None:
    file = tmp_path / "rows.toml"
    file.write_text(DOTTED)
    with pytest.raises(InputError, match="49999 levels"):
        with_files(catalogue(), [file])


def test_only_the_first_unknown_keys_are_told_the_nearest() -> None:
    found = refused(HEAD + "".join(f"nam{k} = 1\n" for k in range(150)) + JOINT)
    assert len(found) == 150
    assert sum("nearest" in message for message in found.values()) == 100
    assert list(found.values()).count("unknown key") == 50


def test_what_is_lifted_stays_lifted_within() -> None:
    with limits_hold(False), limits_hold(True):
        assert not limits.limited()
    assert limits.limited()
