"""Tell what is not answered as stored: ``python -m tests.golden.check --command life --example truck-duty-cycle``.

Without options all command lines are asked, which takes some minutes. Exit code 1 where anything differs.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Mapping

from .capture import stored
from .compare import Difference, differences, line_now
from .running import answered, workplace

SHOWN = 40
"""So many lines of differences are shown, unless told otherwise."""

WIDE = 200


def asked_exactly() -> bool:
    """Tell whether the environment asks for equality to 1e-12: ``CARDAN_GOLDEN_EXACT=1``."""
    return os.environ.get("CARDAN_GOLDEN_EXACT", "") not in ("", "0")


def chosen(lines: Iterable[str], command: str = "", example: str = "") -> list[str]:
    """Return the command lines of one command, as it is called now or was, and of one example."""
    start = re.compile(rf"{re.escape(command)}(\s|$)") if command else re.compile("")
    part = re.compile(rf"(^|[\s/]){re.escape(example)}([\s./]|$)") if example else re.compile("")
    return [one for one in lines if (start.match(one) or start.match(line_now(one))) and part.search(one)]


def faults(records: Mapping[str, dict], lines: Iterable[str], *, exact: bool) -> list[Difference]:
    """Ask command lines and return all differences."""
    found = []
    with workplace():
        for line in lines:
            found += differences(line, records[line], answered(line_now(line)), exact=exact)
    return found


def told(found: list[Difference], *, shown: int = SHOWN) -> str:
    """Return differences as lines: the same one of several command lines is told once."""
    groups: dict[tuple[str, str, str], list[Difference]] = defaultdict(list)
    for one in found:
        command = " ".join(one.line.split()[: 2 if one.line.startswith(("torsion", "sweep show", "calc")) else 1])
        groups[command, one.kind, one.path].append(one)
    lines: list[str] = []
    last = ""
    for (_command, kind, path), group in list(groups.items())[:shown]:
        first = f"{group[0].line}" + (f" and {len(group) - 1} more" if len(group) > 1 else "")
        if first != last:
            lines.append(first)
        last = first
        lines.append(f"  {kind} {path} {group[0].said}"[:WIDE])
    if len(groups) > shown:
        lines.append(f"… and {len(groups) - shown} more; --shown tells more of them")
    return "\n".join(lines)


def suggested(found: list[Difference]) -> str:
    """Return entries for `tests.golden.renamed.PATHS`: where the numbers of a missing path stand, all over."""
    where: dict[tuple[str, str], list[str]] = {}
    for one in found:
        if one.kind == "missing":
            known = where.setdefault((one.line.split()[0], one.path), list(one.same))
            known[:] = [path for path in known if path in one.same]
    return "\n".join(
        f'    ("{command}", r"{path.replace(".", "[.]")}", "{new[0]}"),'
        + (f"  # or {', '.join(new[1:3])}" if len(new) > 1 else "")
        for (command, path), new in where.items()
        if new
    )


def main(words: list[str] | None = None) -> int:
    """Run as a command."""
    parser = argparse.ArgumentParser(prog="python -m tests.golden.check", description=__doc__)
    parser.add_argument("--command", default="", help="only this command: life, 'torsion modes'")
    parser.add_argument("--example", default="", help="only this example: truck-duty-cycle")
    parser.add_argument("--elsewhere", action="store_true", help="as any processor must, not equal to 1e-12")
    parser.add_argument("--shown", type=int, default=SHOWN, help=f"so many differences are shown: {SHOWN}")
    parser.add_argument("--suggest", action="store_true", help="print entries for the table of renamed paths, too")
    parser.add_argument("--lines", action="store_true", help="print the command lines, and ask none")
    given = parser.parse_args(words)
    records = stored()
    lines = chosen(records, given.command, given.example)
    if given.lines:
        print("\n".join(lines))
        return 0
    found = faults(records, lines, exact=not given.elsewhere)
    if found:
        print(told(found, shown=given.shown))
    if given.suggest:
        print(suggested(found))
    print(f"{len(lines)} command lines, {len({one.line for one in found})} of them with {len(found)} differences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
