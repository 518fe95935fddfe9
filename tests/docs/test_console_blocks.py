"""Every ``$ cardan …`` line of the pages prints what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from .console import ROOT, agree, follow, pages, shown


@pytest.mark.slow
@pytest.mark.parametrize("page", pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_commands_print_what_the_page_shows(page: Path, tmp_path: Path) -> None:
    wrong = [
        f"$ {one.command}\n--- shown\n{one.output}--- printed\n{got}"
        for one, got in follow(page, tmp_path)
        if not agree(one.output, got)
    ]
    assert not wrong, "\n".join(wrong)


def test_a_block_is_read_as_commands_with_their_outputs() -> None:
    first, second = shown("$ cardan one \\\n    --two\nanswer\n$ ls\nfile\n")
    assert (first.command, first.output, first.runs) == ("cardan one --two", "answer\n", True)
    assert (second.command, second.output, second.runs) == ("ls", "file\n", False)


def test_outputs_are_compared_with_room_for_what_is_left_out() -> None:
    assert agree("a\n...\nd\n", "a\nb\nc\nd\n")
    assert not agree("a\nd\n", "a\nb\n")
    assert not agree("...\n", "Traceback (most recent call last)\n")
