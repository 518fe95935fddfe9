"""Calibrate the diagnosis on simulated recordings, and evaluate it on others.

    python -m tests.questions.diagnosis.calibrate calibrate   writes src/cardan/catalogue/calibration.json
    python -m tests.questions.diagnosis.calibrate evaluate    writes evaluation.json and docs/theory/diagnosis.md
    python -m tests.questions.diagnosis.calibrate elsewhere   the same for recordings unlike those of the calibration

Every recording follows from its number; calibration and evaluation share neither a drive nor a seed.
"""

import json
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from unittest.mock import patch

import numpy as np

from cardan.io import example
from cardan.questions.diagnosis.expected import FAULTS
from cardan.questions.diagnosis.features import NAMES
from cardan.questions.diagnosis.findings import SURE, Model, diagnose, fitted, relied_on, shipped
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.questions.diagnosis.simulate import simulate_fault
from tests.questions.diagnosis.recorded_faults import CALIBRATION, EVALUATION, case, shown

ROOT = Path(__file__).parents[3]
MODEL = ROOT / "src" / "cardan" / "catalogue" / "calibration.json"
RESULT = Path(__file__).parent / "evaluation.json"
PAGE = ROOT / "docs" / "theory" / "diagnosis.md"
LEARNT, JUDGED = 560, 500
ELSEWHERE = 84
PULL = 3.0
LATER = 1000
"""Number of the first recording that is unlike those of the calibration."""

CONDITIONS = {
    "clean": "noise 30 to 50 dB under the signal",
    "rough": "0 dB, and sizes of lines twice as uncertain",
    "poor": "tacho and one radial sensor alone",
    "no_tacho": "no tacho, no speed of the output",
    "examples": "six drives of the examples, not all within the rules",
}
KEPT = {
    "poor": ("tacho", "output radial"),
    "no_tacho": ("input radial", "output radial", "output axial", "torque"),
}
EXAMPLES = (
    "car-propshaft",
    "truck-supports",
    "two-piece-rear-drive",
    "composite-propshaft",
    "two-piece-rubber-bearing",
    "truck-rear-axle",
)
TABLE = re.compile(r"(<!-- confusion -->\n).*?(<!-- end -->)", re.S)


def named(fault):
    return FAULTS[fault] or "healthy"


def gathered(count, start):
    """Return faults, features and confidences of recordings, on every core."""
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(partial(shown, start=start), range(count), chunksize=8))
    faults = [fault for fault, _shown in found]
    return faults, np.stack([one.value for _fault, one in found]), np.array([relied_on(one) for _fault, one in found])


def write_model(faults, value):
    """Fit the model and write its file."""
    model = fitted(value, [named(one) for one in faults], NAMES, pull=PULL)
    tree = {
        "source": f"python -m {__spec__.name} calibrate: {len(faults)} recordings, seeds from {CALIBRATION}",
        "features": list(model.features),
        "causes": list(model.causes),
        "mean": np.round(model.mean, 4).tolist(),
        "spread": np.round(model.spread, 4).tolist(),
        "least": np.round(model.least, 4).tolist(),
        "most": np.round(model.most, 4).tolist(),
        "weight": np.round(model.weight, 4).tolist(),
    }
    rows = [f" {json.dumps(key)}: {json.dumps(one)}" for key, one in tree.items() if key != "weight"]
    weights = ",\n  ".join(json.dumps(row) for row in tree["weight"])
    MODEL.write_text("{\n" + ",\n".join(rows) + f',\n "weight": [\n  {weights}\n ]\n}}\n', encoding="utf-8")


def judged(faults, value, confidence, model: Model):
    """Return what the evaluation found, as it is stored."""
    sure = np.minimum(SURE, confidence)[:, None]
    score = sure * model.probability(value) + (1.0 - sure) / len(model.causes)
    order = np.argsort(-score, axis=1)
    truth = np.array([model.causes.index(named(one)) for one in faults])
    rank = np.argmax(order == truth[:, None], axis=1)
    size = len(model.causes)
    table = np.zeros((size, size), dtype=int)
    np.add.at(table, (truth, order[:, 0]), 1)
    healthy = truth == model.causes.index("healthy")
    top = score.max(axis=1)
    bands = []
    for low, high in ((0.0, 0.5), (0.5, 0.8), (0.8, 0.95), (0.95, 1.01)):
        inside = (top >= low) & (top < high)
        if inside.any():
            bands.append(
                [low, min(high, 1.0), int(inside.sum()), float(top[inside].mean()), float((rank == 0)[inside].mean())]
            )
    return {
        "recordings": len(faults),
        "seeds": [EVALUATION, EVALUATION + len(faults) - 1],
        "first": float(np.mean(rank == 0)),
        "first_three": float(np.mean(rank < 3)),
        "healthy": float(np.mean(rank[healthy] == 0)),
        "false_alarms": int(np.sum(rank[healthy] > 0)),
        "causes": list(model.causes),
        "confusion": table.tolist(),
        "scores": [[round(x, 4) for x in band] for band in bands],
    }


def _elsewhere(number, condition):
    """Return true cause and findings of a recording unlike those of the calibration; None where it cannot be."""
    drive, fault, severity, seed, snr = case(LATER + number, EVALUATION)
    if condition == "examples":
        drive = example(EXAMPLES[number % len(EXAMPLES)])
        if fault == "centre_bearing" and len(drive.joints) < 3:
            return None
    if condition == "clean":
        snr = 30.0 + 2.0 * snr
    if condition == "rough":
        with patch("cardan.questions.diagnosis.simulate.SPREAD", 0.5):
            signal = simulate_fault(drive, fault, severity=severity, seed=seed, snr=0.0)
    else:
        signal = simulate_fault(drive, fault, severity=severity, seed=seed, snr=snr)
    kept = KEPT.get(condition)
    if kept:
        channels = tuple(one for one in signal.channels if one.name in kept)
        signal = Signal(channels=channels, tacho=0 if kept[0] == "tacho" else None)
    return named(fault), diagnose(signal, drive)


def elsewhere(condition, count):
    """Return how often the diagnosis is right under a condition: count, first, first three, healthy, mean score."""
    with ProcessPoolExecutor() as pool:
        found = [one for one in pool.map(partial(_elsewhere, condition=condition), range(count), chunksize=8) if one]
    rank = np.array([[one.cause for one in findings].index(cause) for cause, findings in found])
    healthy = np.array([cause == "healthy" for cause, _findings in found])
    score = float(np.mean([findings[0].score for _cause, findings in found]))
    rates = (np.mean(rank == 0), np.mean(rank < 3), np.mean(rank[healthy] == 0), score)
    return [len(found), *(round(float(one), 4) for one in rates)]


def tables(result):
    """Return the tables of the page, from what is stored."""
    causes = result["causes"]
    lines = ["| true cause | " + " | ".join(causes) + " |", "|---" * (len(causes) + 1) + "|"]
    for name, row in zip(causes, result["confusion"], strict=True):
        lines.append(f"| {name} | " + " | ".join(str(x) if x else "" for x in row) + " |")
    lines += ["", "| score of the first cause | recordings | mean score | right |", "|---|---|---|---|"]
    for low, high, count, mean, right in result["scores"]:
        lines.append(f"| {100 * low:.0f} to {100 * high:.0f} % | {count} | {100 * mean:.1f} % | {100 * right:.1f} % |")
    lines += [
        "",
        "| recordings unlike those of the calibration | number | first | first three | healthy | mean score |",
    ]
    lines += ["|---|---|---|---|---|---|"]
    for condition, (count, *rates) in result["elsewhere"].items():
        lines.append(f"| {CONDITIONS[condition]} | {count} | " + " | ".join(f"{100 * x:.0f} %" for x in rates) + " |")
    summary = (
        f"Of {result['recordings']} recordings (seeds {result['seeds'][0]} to {result['seeds'][1]}) the true cause "
        f"came first in {100 * result['first']:.1f} %, among the first three in {100 * result['first_three']:.1f} %; "
        f"{100 * result['healthy']:.1f} % of the drives in order were called healthy."
    )
    return "\n".join([summary, "", *lines]) + "\n"


def write_page(result):
    """Put the tables onto the page."""
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(TABLE.sub(lambda found: found[1] + tables(result) + found[2], text), encoding="utf-8")


def main(task):
    if task == "calibrate":
        faults, value, _confidence = gathered(LEARNT, CALIBRATION)
        write_model(faults, value)
        return
    stored = json.loads(RESULT.read_text(encoding="utf-8"))
    if task == "elsewhere":
        result = stored | {"elsewhere": {name: elsewhere(name, ELSEWHERE) for name in CONDITIONS}}
    else:
        result = judged(*gathered(JUDGED, EVALUATION), shipped()) | {"elsewhere": stored["elsewhere"]}
    RESULT.write_text(json.dumps(result) + "\n", encoding="utf-8")
    write_page(result)


if __name__ == "__main__":
    main(sys.argv[1])
