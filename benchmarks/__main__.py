"""``python -m benchmarks [--quick] [NAME ...]``: JSON lines on the standard output."""

from __future__ import annotations

import argparse
import importlib
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the program `cardan` has it

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
    "app_frames",
)


def main(arguments: list[str] | None = None) -> int:
    """Run the benchmarks named, all of them by default; 1 when one of them could not run."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Hot questions against their yardsticks.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"any of {', '.join(NAMES)}")
    parser.add_argument("--quick", action="store_true", help="small sizes and few rounds, to see that all runs")
    chosen = parser.parse_args(arguments)
    unknown = [name for name in chosen.names if name not in NAMES]
    if unknown:
        parser.error(f"unknown: {', '.join(unknown)}; there are {', '.join(NAMES)}")
    failed = False
    for name in chosen.names or NAMES:
        try:
            for figure in importlib.import_module(f".{name}", __package__).figures(chosen.quick):
                print(figure.line(), flush=True)
        except Exception as error:  # the others are still worth having
            print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr)
            failed = True
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
