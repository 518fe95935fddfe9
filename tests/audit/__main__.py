"""``python -m tests.audit [COUNT [FIRST [RARE]]]``: the audit over drives at random, each by its seed.

COUNT is 10,000 by default. RARE is the probability of each part that few drives carry: ``often``, ``never``, the
default, or a number.
"""

from __future__ import annotations

import os
import sys
import time
from collections import Counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the program `cardan` has it

from tests.builders.any_drive import NEVER, OFTEN

from .running import audited

NAMED = {"often": OFTEN, "never": NEVER}


def main(count: str = "10000", first: str = "0", rare: str = "never") -> int:
    """Print every contradiction with the seed of its drive, and how often each pair was compared."""
    share = NAMED[rare] if rare in NAMED else float(rare)
    start, pairs, bad, made = time.perf_counter(), Counter[str](), 0, 0
    for seed in range(int(first), int(first) + int(count)):
        found = audited(seed, rare=share)
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
    sys.exit(main(*sys.argv[1:]))
