"""What is made before the pages are read: the pictures, and the reference of keys, commands and names."""

from __future__ import annotations

import os
import re
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.util.display import status_iterator


def newest(folder: Path) -> float:
    """Return when anything in a folder of sources was last changed."""
    return max(file.stat().st_mtime for file in folder.rglob("*.py"))


def make_pictures(app: Sphinx) -> None:
    """Draw the pictures, unless those there are younger than everything that draws them."""
    import pictures

    import cardan

    here = Path(app.srcdir)
    folder, stamp = here / "_build" / "pictures", here / "_build" / "pictures" / ".drawn"
    changed = max(newest(here / "pictures"), newest(Path(cardan.__file__).parent))
    if not stamp.exists() or stamp.stat().st_mtime < changed:
        count = len(pictures.names())
        for _name in status_iterator(
            pictures.drawn(folder, os.cpu_count() or 1), "drawing pictures... ", "brown", count, app.verbosity
        ):
            pass
        stamp.touch()


def make_reference(app: Sphinx) -> None:
    """Write the reference pages."""
    import reference_pages

    reference_pages.write(Path(app.srcdir) / "reference" / "generated")


def keep_bars(_app: Sphinx, _what: str, _name: str, _thing: object, _options: object, lines: list[str]) -> None:
    """Keep |x| in docstrings an absolute value, not a substitution."""
    for number, line in enumerate(lines):
        if not line.lstrip().startswith((">>>", "...")) and "`" not in line:
            lines[number] = re.sub(r"(?<!\\)\|", r"\\|", line)


def close_blocks(_app: Sphinx, _name: str, source: list[str]) -> None:
    """Leave out the empty line with which a doctest ends before its fence."""
    source[0] = source[0].replace("\n\n```\n", "\n```\n")


def setup(app: Sphinx) -> dict[str, bool]:
    """Hook both in before the pages are read."""
    app.connect("builder-inited", make_pictures)
    app.connect("builder-inited", make_reference)
    app.connect("source-read", close_blocks)
    app.connect("autodoc-process-docstring", keep_bars, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
