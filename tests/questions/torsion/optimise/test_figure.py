"""Figures of absorbers on drives and of calm designs: what is drawn is what was found, and the sentence tells it."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import Drive, figures
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.figures.figure import Curve, Figure, Rule
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.questions.torsion.absorber.absorber import absorber
from cardan.questions.torsion.absorber.figure import logarithmic
from cardan.questions.torsion.optimise.optimise import Grid, optimise_torsion
from cardan.units import deg, factor, rpm

DRIVE = replace(
    Drive.from_angles([14 * deg, 14 * deg], plane_twists=[25 * deg]),
    shafts=(Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02),),
    stations=(Station(shaft=3, name="pump", inertia=0.8),),
    duty=Duty(torque=60.0, speed_range=(30.0, 60.0)),
)
YOKE = {"shafts[1].yoke_angle_deg": (-60.0, 20.0)}


def drawn(found: object) -> Figure:
    (made,) = figures.for_result(found)
    figure = for_reader(made, USUAL)
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label", "")
    assert described(figure)["layout"]
    return figure


def curves(figure: Figure) -> list[Curve]:
    return [item for panel in figure.panels for item in panel.series if isinstance(item, Curve)]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["viscous", "tuned", "pendulum"])
def test_before_and_after_of_an_absorber(kind: str) -> None:
    found = absorber(DRIVE, kind=kind, radius=0.2 if kind == "pendulum" else None, progress=lambda _share: "stop")
    figure = drawn(found)
    before, closed, after, twist = curves(figure)
    for curve, swing in ((before, found.before), (closed, found.closed), (after, found.after)):
        np.testing.assert_array_equal(curve.y, np.max(swing, axis=-1))
    np.testing.assert_allclose(twist.y * deg, found.twist)
    pounds = for_reader(figures.for_result(found)[0], Reader(units={"torque": "lbft"})).panels[0]
    assert pounds.heading == "Largest alternating torque ± [lbf·ft]"
    assert pounds.y.high == pytest.approx(figure.panels[0].y.high / factor("torque", "lbft"))
    panel = figure.panels[0]
    assert panel.y.low < found.best.peak < found.bare.peak < panel.y.high
    (rule,) = [item for item in panel.series if isinstance(item, Rule)]
    meant = found.omega / found.order if found.tuned_speed is None else found.tuned_speed
    assert rule.value * rpm == pytest.approx(meant)
    assert ("pendulums" in figure.title) == (kind == "pendulum")


@pytest.mark.slow
def test_what_is_judged_is_drawn() -> None:
    tube = Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02)
    line = replace(DRIVE, shafts=(tube, Shaft(number=3, stiffness=9000.0, damping=1.0)))
    found = absorber(line, kind="viscous", elements=[1], progress=lambda _share: "stop")
    before, *_others = curves(drawn(found))
    np.testing.assert_array_equal(before.y, found.before[:, 1])
    assert np.max(before.y) == found.bare.peak < np.max(found.before)


@pytest.mark.slow
def test_a_design_shows_how_its_joints_excite() -> None:
    found = optimise_torsion(DRIVE, free=YOKE, method=Grid(points=3))
    figure = drawn(found)
    assert len(figure.panels) == 3  # a search of one round has no course
    assert [panel.heading for panel in figure.panels][1:3] == [
        "Excitation of order 2, mode 1, as built",
        "Excitation of order 2, mode 1, best values",
    ]
    for panel, rule in zip(figure.panels[1:3], (found.rules_before[0], found.rules_after[0]), strict=True):
        *arrows, total = [item for item in panel.series if isinstance(item, Curve)]
        assert len(arrows) == 2
        assert all(arrow.arrow for arrow in arrows)
        moved = np.asarray([np.diff(arrow.x) + 1j * np.diff(arrow.y) for arrow in arrows])[:, 0]
        ratio = moved / rule.forced
        np.testing.assert_allclose(ratio, ratio[0])  # one scale for all
        np.testing.assert_allclose(np.diff(total.x) + 1j * np.diff(total.y), np.sum(moved), atol=1e-12)
    assert "head to tail" in figure.sentence


def test_one_speed_is_a_dot_and_what_grows_is_marked() -> None:
    single = replace(
        Drive.from_angles([25 * deg]),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=0.2),),
        stations=(Station(shaft=2, inertia=0.4),),
        duty=Duty(speed=50.0),
    )
    found = optimise_torsion(single, free={"shafts[0].stiffness_Nm_per_rad": (1000.0, 1400.0)}, method=Grid(points=2))
    figure = drawn(found)
    marks = [item for item in curves(figure) if item.role == "failed"]
    assert found.unstable_before.size == 1
    assert len(marks) == 1
    assert all(item.marker for item in figure.panels[0].series if isinstance(item, Curve))


def test_axes_of_torques_hold_three_decades() -> None:
    found = logarithmic("a", [np.asarray([np.nan, 0.0, 1e-9, 50.0])])
    assert (found.low, found.high) == pytest.approx((0.04, 67.5))
    assert found.texts == ("0.1", "1", "10")
    assert logarithmic("a", [np.asarray([0.0, 0.0])]).high > 0.0
