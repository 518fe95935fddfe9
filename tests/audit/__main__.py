"""``python -m tests.audit [COUNT [FIRST]]``: the audit over drives at random, each by its seed; 10,000 by default."""

from __future__ import annotations

import sys
import time
from collections import Counter

from .running import audited


def main(count: int = 10_000, first: int = 0) -> int:
    """Print every contradiction with the seed of its drive, and how often each pair was compared."""
    start, pairs, bad, made = time.perf_counter(), Counter[str](), 0, 0
    for seed in range(first, first + count):
        found = audited(seed)
        if found is None:
            continue
        made += 1
        pairs.update({f"{one.pair.quantity}: {one.pair.first}, {one.pair.second}" for one in found})
        for one in found:
            if one.deviation > 1.0:
                bad += 1
                values = "{:.10g} {:.10g}".format(*one.values)
                name = f"{one.pair.quantity} {one.part}: {one.pair.first}, {one.pair.second}"
                print(f"seed {seed}: {name}: {values}, {one.deviation:.3g} of what may be", flush=True)
    for name, times in pairs.most_common():
        print(f"{times:6d}  {name}")
    spent = time.perf_counter() - start
    print(f"{made} drives of {count} seeds, {bad} contradictions, {spent:.0f} s")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
