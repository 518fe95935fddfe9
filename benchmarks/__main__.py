"""``python -m benchmarks [--quick] [--store] [NAME ...]``: JSON lines on the standard output."""

from __future__ import annotations

import argparse
import importlib
import json
import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the program `cardan` has it

STORED = Path(__file__).parent / "result.json"
"""What was measured last, benchmark by benchmark; the page on performance is made of it."""

NAMES = (
    "stored_traces",
    "without_positions",
    "single_drive",
    "forces",
    "joint_kinds",
    "critical_speeds",
    "synthesis",
    "checks",
    "tolerance",
    "torsional_response",
    "transient",
    "mathieu_map",
    "speed_sweep",
    "floquet_map",
    "two_frequencies",
    "recordings",
    "sweep",
    "engines",
    "start_up",
    "app_latency",
    "refusals",
    "app_frames",
)


def main(arguments: list[str] | None = None) -> int:
    """Run the benchmarks named, all of them by default; 1 when one of them could not run."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Hot questions against their yardsticks.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"any of {', '.join(NAMES)}")
    parser.add_argument("--quick", action="store_true", help="small sizes and few rounds, to see that all runs")
    parser.add_argument("--store", action="store_true", help=f"keep the figures in {STORED.name} for the documentation")
    chosen = parser.parse_args(arguments)
    unknown = [name for name in chosen.names if name not in NAMES]
    if unknown:
        parser.error(f"unknown: {', '.join(unknown)}; there are {', '.join(NAMES)}")
    failed = False
    for name in chosen.names or NAMES:
        lines = []
        try:
            for figure in importlib.import_module(f".{name}", __package__).figures(chosen.quick):
                lines.append(figure.line())
                print(lines[-1], flush=True)
            if chosen.store:
                store(name, [json.loads(line) for line in lines])
        except Exception as error:  # the others are still worth having
            print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr)
            failed = True
    return int(failed)


def store(name: str, figures: list[dict[str, object]]) -> None:
    """Keep the figures of one benchmark in the place of those it had, all in the order of ``NAMES``."""
    kept = json.loads(STORED.read_text("utf8")) if STORED.exists() else {}
    kept[name] = figures
    text = json.dumps({one: kept[one] for one in NAMES if one in kept}, ensure_ascii=False, indent=1)
    STORED.write_text(text + "\n", "utf8")


def table() -> str:
    """Return what is stored as tables, one a benchmark, below what it says of itself; and which are not measured."""
    parts, kept = [], json.loads(STORED.read_text("utf8"))
    for name, figures in kept.items():
        (says,) = (importlib.import_module(f".{name}", __package__).__doc__ or "").strip().splitlines()[:1]
        rows = [f"### `{name}`", "", says, "", "| what | measured | held against | ratio |", "|---|---|---|---|"]
        for one in figures:
            measured = f"{one['value']:,g} {one['unit']}"
            rows.append(f"| {one['bench']} | {measured} | {one['yardstick']} | {one['ratio']:.3g} |")
        parts.append("\n".join(rows) + "\n")
    left = [f"`{name}`" for name in NAMES if name not in kept]
    return "\n".join([*parts, *([f"Not measured this time: {', '.join(left)}.\n"] if left else [])])


if __name__ == "__main__":
    sys.exit(main())
