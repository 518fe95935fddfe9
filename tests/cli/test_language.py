"""The language of the command line: --lang wherever it stands, CARDAN_LANG, help, errors, pages."""

import json
import os
import re
import subprocess

import pytest

from tests.cli.conftest import EXAMPLES

DRIVE = EXAMPLES / "single-20deg.toml"
CYRILLIC = re.compile("[а-яё]", re.IGNORECASE)
LATIN_WORD = re.compile(r"(?<![\w-])[a-z]{4,}(?![\w-])")


@pytest.fixture
def spoken(process):
    """Run a command in a process of its own and return what it printed."""

    def run(*arguments, **environment):
        done = process(*arguments, environment=environment, capture_output=True, encoding="utf-8")
        assert "Traceback" not in done.stderr
        return done

    return run


@pytest.mark.parametrize(
    "arguments",
    [
        ("--lang", "ru", "motion", DRIVE),
        ("motion", "--lang", "ru", DRIVE),
        ("motion", DRIVE, "--lang=ru"),
        ("--lang=en", "motion", DRIVE, "--lang", "ru"),
    ],
)
def test_the_option_counts_wherever_it_stands_the_last_one_most(cardan, arguments):
    done = cardan(*arguments)
    assert done.code == 0
    assert "неравномерность" in done.out


def test_english_again_after_another_language(cardan):
    assert CYRILLIC.search(cardan("motion", DRIVE, "--lang", "ru").out)
    assert not CYRILLIC.search(cardan("motion", DRIVE).out)


def test_the_environment_chooses_and_the_option_wins(cardan, monkeypatch):
    monkeypatch.setenv("CARDAN_LANG", "ru_RU.UTF-8")
    assert "неравномерность" in cardan("motion", DRIVE).out
    assert "fluctuation" in cardan("--lang", "en", "motion", DRIVE).out
    assert os.environ["CARDAN_LANG"] == "ru_RU.UTF-8"


@pytest.mark.parametrize("given", ["de", "", "RU"])
def test_a_language_that_we_do_not_speak(cardan, given):
    done = cardan("motion", DRIVE, f"--lang={given}")
    assert (done.code, done.out) == (2, "")
    assert done.err == f"error: --lang: there is no language '{given}'; there are en, ru\n"


def test_a_missing_language_is_the_parsers_business(cardan):
    done = cardan("motion", DRIVE, "--lang")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("error: option '--lang' requires an argument")


def test_behind_two_dashes_it_is_a_word(cardan):
    done = cardan("motion", "--", "--lang")
    assert (done.code, done.out) == (2, "")
    assert "--lang" in done.err
    assert "there is no language" not in done.err


@pytest.mark.slow
@pytest.mark.parametrize("command", [(), ("check",), ("torsion",), ("torsion", "modes"), ("calc",)], ids=" ".join)
def test_help_speaks_the_language_and_fits(spoken, command):
    done = spoken(*command, "--help", CARDAN_LANG="ru")
    assert done.returncode == 0
    assert "--lang" in done.stdout
    assert "Использование: cardan" in done.stdout
    assert "Параметры" in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80
    told = [line for line in done.stdout.splitlines() if not line.startswith(" $")]
    assert [word for line in told for word in LATIN_WORD.findall(line) if word not in KEPT | set(command)] == []


KEPT = {
    *("cardan", "motion", "phasing", "articulation", "forces", "losses", "life", "strength", "balance", "select"),
    "road",
    *("joint", "accuracy", "bending", "assembly", "mobility", "torsion", "check", "report", "init", "example"),
    *(
        "convert",
        "schema",
        "catalogue",
        "calc",
        "keys",
        "help",
        "mathieu",
        "modes",
        "response",
        "simulate",
        "stability",
        "absorber",
        "optimise",
    ),
    *("path", "float", "toml", "html", "json", "list", "truck", "bool", "beta_deg", "alpha_deg", "diagnose", "faults"),
    *("signal", "measured", "traces", "stderr", "rotor", "sweep", "length", "torque", "lbft"),
}
"""Names of commands, of files and of types stay."""


@pytest.mark.slow
def test_a_group_and_nothing_else_show_their_help(spoken):
    assert spoken("--lang", "ru").stdout == spoken("--help", "--lang", "ru").stdout
    assert "Использование: cardan torsion" in spoken("torsion", "--lang", "ru").stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("motion", "none.toml"), "ошибка: none.toml: прочитать нельзя: Нет такого файла или папки"),
        (("motion", DRIVE, "--bogus"), "ошибка: нет параметра --bogus; см. cardan motion --help"),
        (
            ("motoin", DRIVE),
            "ошибка: нет команды 'motoin'. Возможно, вы имели в виду 'motion', 'torsion'?; см. cardan --help",
        ),
        (("motion", DRIVE, "--speed-rpm", "x"), "ошибка: недопустимое значение '--speed-rpm': здесь нужно число"),
        (("motion",), "ошибка: не задан аргумент 'FILE'"),
        (("motion", DRIVE, "--json", "--csv"), '{"error": {"message": "--csv: выберите --json или --csv, не то'),
    ],
    ids=lambda one: str(one[:3]),
)
def test_errors_speak_the_language(cardan, arguments, said):
    done = cardan(*arguments, "--lang", "ru")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(said)


def test_all_problems_of_a_file_speak_the_language(cardan, drive_file):
    path = drive_file('format = 1\ncolour = 3\n[[joints]]\nkind = "hooke"\njoint_angle_deg = 95\n')
    done = cardan("check", path, "--lang", "ru", "--json")
    problems = json.loads(done.err)["error"]["problems"]
    assert len(problems) == 2
    assert all(CYRILLIC.search(one["message"]) for one in problems)
    assert not any(LATIN_WORD.search(one["message"]) for one in problems if "joint_angle" in one["field"])


def test_numbers_and_keys_are_the_same_in_every_language(cardan):
    english, russian = (json.loads(cardan("motion", DRIVE, "--json", "--lang", code).out) for code in ("en", "ru"))

    def bare(tree):
        if isinstance(tree, dict):
            return {key: bare(value) for key, value in tree.items()}
        if isinstance(tree, list):
            return [bare(value) for value in tree]
        return tree if not isinstance(tree, str) else ""

    assert bare(english) == bare(russian)


def test_units_of_tables_speak_the_language(cardan):
    assert "рад/с²" in cardan("motion", DRIVE, "--speed-rpm", "500", "--lang", "ru").out


def test_schema_tells_the_keys_in_the_language(cardan):
    found = json.loads(cardan("schema", "--lang", "ru").out)
    told = [one["description"] for one in found["properties"].values() if "description" in one]
    assert told
    assert all(CYRILLIC.search(text) for text in told)


def test_the_report_says_its_language(cardan):
    assert cardan("report", DRIVE, "-o", "a.html", "--lang", "ru").code == 0
    with open("a.html", encoding="utf-8") as file:
        page = file.read()
    assert '<html lang="ru">' in page
    assert "Отчёт" in page


def test_a_figure_page_says_its_language(cardan):
    assert cardan("motion", DRIVE, "--plot", "a.html", "--lang", "ru").code == 0
    with open("a.html", encoding="utf-8") as file:
        assert file.read(200).startswith('<!doctype html>\n<html lang="ru">')


def test_english_help_needs_no_catalogue(process):
    done = process("--help", stdout=subprocess.PIPE, encoding="utf-8", environment={"CARDAN_LANG": "en"})
    assert not CYRILLIC.search(done.stdout.replace("Русский", ""))
