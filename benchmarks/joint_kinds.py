"""Joints of every kind: their laws in a batch beside that of the Hooke joint, and a report with all their pages."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from cardan import example
from cardan.io.drive_file import loads
from cardan.joints import Hooke, Joint, Rzeppa
from cardan.questions.forces.forces import forces
from cardan.questions.losses.losses import losses
from cardan.questions.motion.moving_chain import law
from tests.fixtures.joint_keys import KEYS

from .harness import Figure

HALF_SHAFT = Path(__file__).parent.parent / "examples" / "front-halfshaft.toml"

CLOSED, OPEN = 5.0, 40.0
"""Times the law of the Hooke joint that a law with a closed form and one without may take."""

PLAIN, BY_LOOPS = ("hooke", "constant_velocity"), ("weiss", "clemens", "mechanism")
"""Kinds that are not measured, and kinds whose law has no closed form."""

REPORT = 4.0
"""Seconds of processor time that the report of the half shaft may take from the prompt."""


def kinds() -> dict[str, tuple[Joint, bool]]:
    """Return joints with the sizes by which tests know them, and whether their law is a closed form."""
    text = "format = 1\n[[joints]]\njoint_angle_deg = 10\n"
    made = {kind: loads(f'{text}kind = "{kind}"\n{keys}\n').joints[0] for kind, keys in KEYS.items()}
    found = {joint.in_words(): (joint, kind not in BY_LOOPS) for kind, joint in made.items() if kind not in PLAIN}
    grooves = Rzeppa(driving_offset=0.004, driven_offset=0.0044, groove_radius=0.03)
    return {**found, "Rzeppa with grooves": (grooves, False)}


def spent(job: Callable[[], object], rounds: int) -> float:
    """Return the least processor time of a job [s]: what else runs on the machine does not count."""
    best = float("inf")
    for _round in range(rounds):
        begin = time.process_time()
        job()
        best = min(best, time.process_time() - begin)
    return best


def figures(quick: bool) -> Iterator[Figure]:
    rounds = 2 if quick else 5
    theta = np.linspace(0.0, 2.0 * np.pi, 181)
    joint_angle = np.linspace(0.05, 0.3, 100 if quick else 1000)[:, None]
    law(Hooke(), theta, joint_angle)
    base = spent(lambda: law(Hooke(), theta, joint_angle), rounds)
    for name, (joint, closed) in kinds().items():
        law(joint, theta, joint_angle)
        seconds = spent(lambda joint=joint: law(joint, theta, joint_angle), rounds)
        aim = CLOSED if closed else OPEN
        yield Figure(
            bench=f"law in a batch, {name}",
            value=1e9 * seconds / (theta.size * joint_angle.size),
            unit="ns a place",
            yardstick=f"Hooke joint, {1e9 * base / (theta.size * joint_angle.size):.3g} ns, aim ≤ {aim:g}",
            ratio=seconds / base,
        )
    drive = example("front-halfshaft")
    for name, question in (("forces", forces), ("losses", losses)):
        begin = time.process_time()
        question(drive)
        seconds = time.process_time() - begin
        yield Figure(
            bench=f"{name} of a half shaft that rubs, first time",
            value=seconds,
            unit="s",
            yardstick=f"{REPORT:g} s of a report",
            ratio=seconds / REPORT,
        )
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "report.html"
        arguments = [sys.executable, "-m", "cardan", "report", str(HALF_SHAFT), "--full", "-o", str(page)]
        best = float("inf")
        for _round in range(rounds):
            begin = os.times()
            subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)
            end = os.times()
            best = min(best, end.children_user + end.children_system - begin.children_user - begin.children_system)
    yield Figure(
        bench="report of a half shaft with all pages, processor time",
        value=best,
        unit="s",
        yardstick=f"{REPORT:g} s, aim ≤ 1",
        ratio=best / REPORT,
    )
