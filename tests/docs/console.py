"""Console blocks of the pages: what they show, and what the commands really print.

``python -m tests.docs.console PAGE …`` writes what the commands print now into the pages; read the difference before
committing it. A line that is only ``...`` stands for any number of lines and is kept.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from doctest import ELLIPSIS, OutputChecker
from io import BytesIO, TextIOWrapper
from pathlib import Path

ROOT = Path(__file__).parents[2]

FILE = re.compile(
    r"^```\{code-block\} \w+\n:caption: (\S+)\n\n?(.*?)^```$|^<!-- file: (\S+) -->\n```\w+\n(.*?)^```$", re.M | re.S
)
BLOCK = re.compile(r"^```console\n(.*?)^```$", re.M | re.S)

SHELL = set("|&;<>*?$`")
"""Signs of a command that only a shell understands."""


@dataclass
class Shown:
    """A command and the output a page shows for it."""

    command: str
    output: str

    @property
    def runs(self) -> bool:
        """Whether it is one of ours; what is not cannot be run everywhere."""
        return self.command.startswith("cardan")


def pages() -> list[Path]:
    """Return the pages that show commands of ours."""
    found = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [
        p
        for p in found
        if "_build" not in p.parts and "generated" not in p.parts and "$ cardan" in p.read_text("utf-8")
    ]


def steps(text: str) -> Iterator[re.Match[str]]:
    """Yield files and console blocks of a page in their order."""
    yield from sorted([*FILE.finditer(text), *BLOCK.finditer(text)], key=lambda match: match.start())


def shown(block: str) -> list[Shown]:
    """Return the commands of a console block."""
    found: list[Shown] = []
    for line in block.splitlines():
        if line.startswith("$ "):
            found.append(Shown(line[2:], ""))
        elif found and not found[-1].output and found[-1].command.endswith("\\"):
            found[-1].command = found[-1].command[:-1] + line.strip()
        elif found:
            found[-1].output += line + "\n"
    return found


def folder(where: Path) -> dict[str, str]:
    """Prepare an empty folder with the examples and a ``cardan`` of this very Python; return the environment."""
    tools = where / ".tools"
    tools.mkdir()
    ours = tools / "cardan"
    ours.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m cardan "$@"\n')
    ours.chmod(0o755)
    shutil.copytree(ROOT / "examples", where / "examples")
    path = f"{tools}{os.pathsep}{os.environ['PATH']}"
    return os.environ | {
        "PATH": path,
        "COLUMNS": "100",
        "NO_COLOR": "1",
        "TERM": "dumb",
        "PYTHONUTF8": "1",
        "CARDAN_LANG": "en",
    }


def run(command: str, where: Path, environment: dict[str, str]) -> str:
    """Return what a command prints, answer and complaint together: in this process, unless it needs a shell."""
    printed = shelled(command, where, environment) if set(command) & SHELL else called(command, where, environment)
    return "\n".join(line.rstrip() for line in printed.decode("utf-8").splitlines()) + "\n" * bool(printed)


def shelled(command: str, where: Path, environment: dict[str, str]) -> bytes:
    """Return what a command line prints."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    return subprocess.run(["sh", "-c", command], cwd=where, env=environment, timeout=300, check=False, **pipes).stdout


def called(command: str, where: Path, environment: dict[str, str]) -> bytes:
    """Return what a command of ours prints."""
    from cardan.cli.main import main

    stream = TextIOWrapper(BytesIO(), encoding="utf-8", write_through=True)
    before = dict(os.environ)
    os.environ.update(environment)
    try:
        with chdir(where), redirect_stdout(stream), redirect_stderr(stream):
            main(shlex.split(command)[1:])
    finally:
        os.environ.clear()
        os.environ.update(before)
    printed: bytes = stream.buffer.getvalue()  # type: ignore[attr-defined]
    return printed


def agree(want: str, got: str) -> bool:
    """Tell whether an output is what the page shows; ``...`` stands for anything."""
    if "Traceback" in got:
        return False
    return OutputChecker().check_output(" ".join(want.split()), " ".join(got.split()), ELLIPSIS)


def follow(page: Path, where: Path) -> Iterator[tuple[Shown, str]]:
    """Do what a page says, in its order, and yield each command with what it printed."""
    environment = folder(where)
    for match in steps(page.read_text("utf-8")):
        if match.re is FILE:
            name, text = (match[1], match[2]) if match[1] else (match[3], match[4])
            (where / name).write_text(text, "utf-8")
            continue
        for one in shown(match[1]):
            if one.runs:
                yield one, run(one.command, where, environment)


def rewrite(page: Path) -> None:
    """Put what the commands print now into a page, except where it shows only a part."""
    text = page.read_text("utf-8")
    with tempfile.TemporaryDirectory() as where:
        for one, got in follow(page, Path(where)):
            if "..." not in one.output and not agree(one.output, got):
                old = f"$ {one.command}\n{one.output}"
                text = text.replace(old, f"$ {one.command}\n{got.rstrip()}\n", 1)
    page.write_text(text, "utf-8")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        rewrite(Path(name))
