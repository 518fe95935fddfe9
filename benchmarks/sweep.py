"""A sweep of four-joint drives with reductions and no rows, against the kernel that answers it and a fixed time."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator

from cardan import extremes
from cardan.backends import Compiled

from .harness import Figure, fastest, random_drives

AIM = 30.0
"""Seconds for a hundred million points on two cores."""

ROOM = 2.0
"""GiB that it may take."""

SCRIPT = """
import json, resource, sys, time
from cardan import Drive
from cardan.sweeps import GridAxis, sweep
side = int(sys.argv[1])
drive = Drive.from_angles([0.3, 0.2, 0.25, 0.1], yoke_angles=[0.1, 0.2, 0.3])
ends = {"joints[0].joint_angle_deg": 20, "joints[2].joint_angle_deg": 20}
ends |= {"shafts[1].yoke_angle_deg": 90, "shafts[2].yoke_angle_deg": 90}
axes = [GridAxis(field=field, start=0, stop=stop, count=side) for field, stop in ends.items()]
told = [f"{kind} speed_fluctuation_percent" for kind in ("max", "argmin", "p99")] + ["mean alpha_eq_deg"]
told.append("share speed_fluctuation_percent <= 2")
begin = time.perf_counter()
found = sweep(drive, axes, ["speed_fluctuation", "alpha_eq"], reduce=told, rows="none")
seconds = time.perf_counter() - begin
assert found.status == "done" and found.reductions["points"]["answered"] == side**4
print(json.dumps([seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20]))
"""


def figures(quick: bool) -> Iterator[Figure]:
    side = 30 if quick else 100
    count = side**4
    done = subprocess.run([sys.executable, "-c", SCRIPT, str(side)], capture_output=True, text=True, check=True)
    seconds, room = json.loads(done.stdout)
    drives = random_drives(100_000 if quick else 1_000_000)
    out = extremes(drives, method=Compiled())
    kernel = fastest({"kernel": lambda: extremes(drives, out=out, method=Compiled())}, rounds=3)["kernel"]
    each = 1e9 * kernel / drives.shape[0]
    name = f"sweep of {count:.0e} points, speed fluctuation and α_eq of four joints, five reductions"
    yield Figure(
        bench=name,
        value=seconds,
        unit="s",
        yardstick=f"{AIM:g} s a hundred million points on two cores, aim ≤ 1",
        ratio=seconds / (AIM * count / 1e8),
    )
    yield Figure(
        bench=name + ", a point",
        value=1e9 * seconds / count,
        unit="ns",
        yardstick=f"the kernel alone on drives in memory, {each:.3g} ns",
        ratio=1e9 * seconds / count / each,
    )
    yield Figure(bench=name + ", memory", value=room, unit="GiB", yardstick=f"{ROOM:g} GiB, aim ≤ 1", ratio=room / ROOM)
