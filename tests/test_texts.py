"""The language of sentences: whose it is, where it ends, and that no module freezes it."""

import ast
import asyncio
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from cardan.answers.reader import Reader
from cardan.texts import LANGUAGES, _, known, language, mark, plural, speaking

SOURCE = Path(__file__).parents[1] / "src" / "cardan"


def test_english_is_the_sentence_itself():
    with speaking("en"):
        assert _("speed ratio") == "speed ratio"
        assert plural("{count} problem", "{count} problems", 1) == "{count} problem"
        assert plural("{count} problem", "{count} problems", 0) == "{count} problems"


@pytest.mark.parametrize(
    ("count", "said"), [(1, "1 ошибка"), (2, "2 ошибки"), (5, "5 ошибок"), (11, "11 ошибок"), (21, "21 ошибка")]
)
def test_russian_has_three_forms(count, said):
    with speaking("ru"):
        assert plural("{count} problem", "{count} problems", count).format(count=count) == said


def test_a_language_ends_where_it_was_begun():
    with speaking("en"):
        with speaking("ru"):
            assert (language(), _("joint")) == ("ru", "шарнир")
            with speaking("en"):
                assert _("joint") == "joint"
            assert _("joint") == "шарнир"
        assert (language(), _("joint")) == ("en", "joint")


def test_a_marked_sentence_is_translated_where_it_is_shown():
    sentence = mark("joint")
    with speaking("ru"):
        assert (sentence, _(sentence)) == ("joint", "шарнир")


def test_what_nobody_translated_stays_as_it_is():
    with speaking("ru"):
        assert (_("no such sentence"), _("")) == ("no such sentence", "")


def test_threads_and_tasks_speak_each_their_own():
    def said(code):
        with speaking(code):
            return [_("joint") for _k in range(200)]

    codes = ["ru", "en"] * 8
    with ThreadPoolExecutor(4) as threads:
        assert [set(one) for one in threads.map(said, codes)] == [{"шарнир"}, {"joint"}] * 8

    async def task(code):
        with speaking(code):
            await asyncio.sleep(0)
            return _("joint")

    async def together():
        return await asyncio.gather(*map(task, codes))

    assert asyncio.run(together()) == ["шарнир", "joint"] * 8


@pytest.mark.parametrize(
    ("name", "code"), [("ru", "ru"), ("ru_RU.UTF-8", "ru"), ("RU", "ru"), ("en-GB", "en"), ("", "en"), ("C", "en")]
)
def test_names_of_environments(name, code):
    assert known(name) == code


def test_unknown_languages_are_english():
    with speaking("tlh"):
        assert language() == "en"


@pytest.mark.parametrize(("given", "said"), [("ru", "шарнир"), ("tlh", "joint"), ("", "joint")])
def test_the_environment_decides_where_nothing_else_does(given, said):
    code = (
        "import sys, cardan.texts as t; sys.stdout.buffer.write(t._('joint').encode()); print('gettext' in sys.modules)"
    )
    environment = {"CARDAN_LANG": given, "PATH": ""}
    done = subprocess.run([sys.executable, "-I", "-c", code], env=environment, capture_output=True, check=True)
    assert done.stdout.decode().startswith(said)


def test_languages_name_themselves():
    assert LANGUAGES["en"] == "English"
    assert LANGUAGES["ru"] == "Русский"


def at_import(tree):
    """Yield the calls of `_` and `plural` that run when the module is imported."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Lambda):
            continue
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            waiting += [*node.decorator_list, *node.args.defaults, *(one for one in node.args.kw_defaults if one)]
            continue
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("_", "plural"):
            yield node
        waiting += ast.iter_child_nodes(node)


@pytest.mark.slow
def test_no_module_freezes_the_language_when_it_is_imported():
    """Those of the command line may: they are imported once the language is chosen, and only for their process."""
    frozen = [
        f"{path.relative_to(SOURCE)}:{call.lineno}: write mark(...) and translate it where it is shown"
        for path in sorted(SOURCE.rglob("*.py"))
        if path.relative_to(SOURCE).parts[0] != "cli"
        for call in at_import(ast.parse(path.read_text("utf-8")))
    ]
    assert frozen == []


def test_the_guard_sees_what_runs_at_import():
    code = 'A = _("a")\nclass B:\n    c = {"d": plural("e", "f", 2)}\ndef g(h=_("i")):\n    return _("j")\n'
    code += 'k = lambda: _("l")\n'
    assert sorted(call.lineno for call in at_import(ast.parse(code))) == [1, 3, 4]


def test_numbers_have_the_decimal_sign_of_the_language_unless_the_reader_chose_one():
    with speaking("ru"):
        assert Reader().number(1.5) == "1,500"
        assert Reader(decimal=".").number(1.5) == "1.500"
    assert Reader().number(1.5) == "1.500"
