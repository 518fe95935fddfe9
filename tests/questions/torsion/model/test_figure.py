"""Figures of torsional vibration show what the results say, and both renderers draw them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cardan import Drive, stability, torsion_modes, torsion_response, transient
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.shaft import Shaft
from cardan.drive.station import Absorber, Pendulum, Station
from cardan.figures import for_result, save
from cardan.figures.figure import Band, Bars, Curve, Figure, Note, Rule, Shape
from cardan.figures.for_reader import for_reader
from cardan.questions.torsion.model.figure import campbell_figure, shapes_figure
from cardan.questions.torsion.stability.figure import growth_figure, map_figure
from cardan.questions.torsion.steady.figure import response_figure, sweep_figure, waterfall_figure
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import deg, rpm

DRIVE = replace(
    Drive.from_angles([25 * deg]),
    shafts=(Shaft(number=1, stiffness=1000.0, damping=0.3),),
    stations=(Station(shaft=2, name="mill", inertia=0.4),),
    duty=Duty(speed=40.0, torque=50.0, speed_range=(10.0, 60.0)),
)
SPEEDS = np.linspace(32.0, 60.0, 29)


HUNG = Absorber(inertia=0.1, stiffness=90.0)


def drawn(figure: Figure, kind: type, panel: int = 0) -> list:
    return [one for one in figure.panels[panel].series if isinstance(one, kind)]


def test_the_campbell_chart_meets_where_the_crossings_are() -> None:
    found = torsion_modes(DRIVE)
    figure = campbell_figure(found)
    dots = [one for one in drawn(figure, Curve) if one.width == 0.0]
    assert [float(one.x[0]) * rpm for one in dots] == pytest.approx([one.speed for one in found.crossings])
    assert {one.role for one in dots} == {"failed"}  # both in use
    zone = next(one for one in drawn(figure, Band) if one.role == "failed")
    assert (zone.low * rpm, zone.high * rpm) == pytest.approx(tuple(found.zone[0]))
    assert "order 4 at" in told(figure.sentence, USUAL)


def test_pendulums_bend_the_natural_frequencies() -> None:
    pendulum = Pendulum(mass=0.4, radius=0.4, length=0.1)
    found = torsion_modes(replace(DRIVE, stations=(replace(DRIVE.stations[0], pendulum=pendulum),)))
    modes = [one for one in drawn(campbell_figure(found), Curve) if one.label]
    assert len(modes) == 2
    assert modes[0].y[-1] > modes[0].y[0]


def test_shapes_stand_along_the_line_with_their_nodes() -> None:
    free = replace(
        DRIVE,
        duty=Duty(input="free", speed=40.0),
        stations=(
            *DRIVE.stations,
            Station(shaft=1, end="start", inertia=1.0, absorber=Absorber(inertia=0.1, stiffness=90.0)),
        ),
    )
    found = torsion_modes(free)
    figure = shapes_figure(found)
    lines = [one for one in drawn(figure, Curve) if one.label]
    np.testing.assert_allclose(lines[0].y, found.shape[0, list(found.train.line)])
    nodes = [one for one in drawn(figure, Curve) if one.marker == 7.0]
    assert len(nodes) == sum(len(one) for one in found.nodes)
    assert [one.text for one in drawn(figure, Rule) if one.upright] == ["1"]


def test_the_response_shows_torques_and_orders() -> None:
    found = torsion_response(DRIVE)
    figure = response_figure(found)
    over = drawn(figure, Curve)[0]
    assert np.max(over.y) == pytest.approx(float(found.torque_highest[0]), rel=1e-4)
    bars = drawn(figure, Bars, 1)[0]
    assert bars.size[0] == pytest.approx(float(found.steady.torque.amplitude[0, 0]))


def test_orders_that_do_not_repeat_with_the_turn_have_their_bar() -> None:
    """The swing counts them: the chart must not drop them."""
    found = torsion_response(replace(DRIVE, duty=replace(DRIVE.duty, harmonics=(Harmonic(order=1.3, torque=20.0),))))
    figure = response_figure(found)
    bars, words = drawn(figure, Bars, 1)[0], figure.panels[1].x.texts
    assert bars.size[words.index("1.3")] == pytest.approx(abs(found.apart[0].torque[0]))
    assert "order 1.3, at most ±" in told(figure.source, USUAL)


def test_no_place_is_told_in_millimetres_where_the_lengths_are_not_known() -> None:
    free = replace(
        DRIVE, duty=Duty(input="free", speed=40.0), stations=(Station(shaft=1, inertia=1.0), *DRIVE.stations)
    )
    figure = shapes_figure(torsion_modes(free))
    assert not torsion_modes(free).train.to_scale
    assert (figure.panels[0].x.unit, figure.panels[0].x.dimension) == ("", "")
    (joint,) = (one.value for one in drawn(figure, Rule) if one.upright)
    assert joint == 1.0  # by shafts
    known = replace(free, shafts=(replace(free.shafts[0], length=0.4), Shaft(number=2, length=0.2)))
    assert shapes_figure(torsion_modes(known)).panels[0].x.unit == "mm"


def test_a_sweep_shades_what_is_unstable() -> None:
    found = torsion_response(DRIVE, speed=SPEEDS)
    figure = sweep_figure(found)
    bands = drawn(figure, Band)
    assert len(bands) == 1
    unstable = SPEEDS[found.floquet.spectral_radius > 1.0]
    assert bands[0].low * rpm < unstable[0] < unstable[-1] < bands[0].high * rpm
    falls = waterfall_figure(found).panels[0].series
    assert len(falls) == 24
    assert max(float(np.max(one.y)) for one in falls) <= waterfall_figure(found).panels[0].y.high


@pytest.mark.slow
def test_maps_cover_the_unstable_points() -> None:
    joint_angles = np.linspace(5.0, 30.0, 6)
    for axes in (("duty.speed_rad_s", "joint_angle_deg"), ("joint_angle_deg", "duty.speed_rad_s")):
        values = {"duty.speed_rad_s": np.linspace(44.0, 56.0, 7), "joint_angle_deg": joint_angles}
        found = stability(DRIVE, over={path: values[path] for path in axes})
        figure = map_figure(found)
        area = sum(float((one.x[1] - one.x[0]) * (one.y[2] - one.y[0])) for one in drawn(figure, Shape))
        assert 0.0 < area < (56.0 - 44.0) * 25.0
    growth = growth_figure(stability(DRIVE, over={"duty.speed_rad_s": SPEEDS}))
    assert len(drawn(growth, Band)) == 1


def test_a_map_tells_what_else_may_be_red() -> None:
    """With play the torque may change its sign and steady running ends there, far from any zone."""
    tight = stability(
        DRIVE, over={"duty.speed_rpm": np.linspace(44.0, 56.0, 4) / rpm, "joint_angle_deg": np.asarray([25.0, 30])}
    )
    assert "backlash" not in told(map_figure(tight).source, USUAL)
    backlash = np.full_like(tight.train.model.backlash, 0.01)
    loose = replace(tight, train=replace(tight.train, model=replace(tight.train.model, backlash=backlash)))
    figure = map_figure(loose)
    assert "red there is rattling" in told(figure.source, USUAL)
    assert all(one.text.startswith("nearest: ") for one in drawn(figure, Note))


@pytest.mark.slow
def test_zones_are_named_beside_their_tongues() -> None:
    for axes in (("duty.speed_rpm", "joint_angle_deg"), ("joint_angle_deg", "duty.speed_rpm")):
        values = {"duty.speed_rpm": np.linspace(20.0, 60.0, 41) / rpm, "joint_angle_deg": np.linspace(5.0, 30.0, 6)}
        found = stability(DRIVE, over={path: values[path] for path in axes})
        figure = map_figure(found)
        notes = drawn(figure, Note)
        left = min(float(one.x[0]) for one in drawn(figure, Shape))
        named = {one.text: one.x for one in notes}
        assert "principal zone of mode 1" in named
        assert left <= min(named.values())
        assert 44.0 < named["principal zone of mode 1"] * rpm < 56.0  # edge of the tongue about ω = 50 rad/s


@pytest.mark.slow
def test_words_stand_off_the_lines_where_the_drive_runs() -> None:
    running = replace(DRIVE, duty=replace(DRIVE.duty, speed=60.0))
    over = {"duty.speed_rpm": np.linspace(20.0, 90.0, 41) / rpm, "joint_angle_deg": np.linspace(5.0, 30.0, 6)}
    (name,) = [one for one in drawn(map_figure(stability(running, over=over)), Note) if "principal" in one.text]
    assert name.side == "right"
    assert name.x * rpm < 60.0  # it ends before the line of the drive
    found = torsion_modes(running)
    figure = campbell_figure(found)
    (word,) = [one for one in drawn(figure, Note) if "parametric" in one.text]
    width = 0.17 * figure.panels[0].x.high
    assert not word.x < 60.0 / rpm < word.x + width


def test_a_shaft_keeps_its_colour_in_every_figure() -> None:
    three = replace(
        Drive.from_angles([0.2, 0.2]),
        shafts=(
            Shaft(number=1, stiffness=9000.0),
            Shaft(number=2, stiffness=1000.0),
            Shaft(number=3, stiffness=4000.0),
        ),
        stations=(Station(shaft=1, inertia=0.5), Station(shaft=3, inertia=2.0)),
        duty=Duty(speed=40.0, torque=50.0, input="free"),
    )
    for figure in (response_figure(torsion_response(three)), sweep_figure(torsion_response(three, speed=SPEEDS[:3]))):
        roles = {one.label: one.role for one in drawn(figure, Curve)}
        assert roles == {f"shaft {k}": f"shaft {k}" for k in (1, 2, 3)}
        assert len({one.dash for one in drawn(figure, Curve)}) == 3


def test_every_result_is_drawn_by_both_renderers(tmp_path: Path) -> None:
    results = [
        torsion_modes(DRIVE),
        torsion_response(DRIVE),
        torsion_response(DRIVE, speed=SPEEDS[:5]),
        stability(DRIVE),
        stability(DRIVE, over={"duty.speed_rad_s": SPEEDS[:4], "joint_angle_deg": [10.0, 25.0]}),
        transient(DRIVE, span=0.2, method=Adaptive(rtol=1e-6, atol=1e-6)),
    ]
    figures = [figure for result in results for figure in for_result(result)]
    assert len({figure.name for figure in figures}) == len(figures)
    for suffix in ("svg", "html"):
        assert save(figures, tmp_path / f"all.{suffix}").stat().st_size > 10000
    for figure in figures:
        assert told(figure.sentence, USUAL).endswith(".") or not figure.sentence


def test_a_reader_sees_axes_and_words_in_own_units() -> None:
    who = Reader(units={"torque": "lbft", "angular_speed": "rad_s"}, decimal=",")
    found = torsion_response(DRIVE, speed=SPEEDS)
    usual, seen = sweep_figure(found), for_reader(sweep_figure(found), who)
    assert [panel.heading for panel in seen.panels] == [
        "Alternating torque, ± [lbf·ft]",
        "Orders of shaft 1, ± [lbf·ft]",
    ]
    assert seen.panels[1].x.title == "input speed [rad/s]"
    (own,), (other,) = (drawn(one, Curve) for one in (usual, seen))
    np.testing.assert_allclose(other.x, SPEEDS)
    np.testing.assert_allclose(other.y * 1.3558179483314, own.y)
    assert "rad/s, ±" in for_reader(waterfall_figure(found), who).sentence
