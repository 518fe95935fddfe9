"""Figures of forces: the numbers of the analysis, vectors at their places, both renderers."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader, significant
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import geometry
from cardan.figures.axes import support_dashes
from cardan.figures.figure import Curve, Note
from cardan.figures.for_reader import for_reader
from cardan.figures.page import onto
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.maths.kernel import frames
from cardan.questions.forces.figures.forces import (
    forces_figures,
    loads_figures,
    reactions_figure,
    torques_figure,
    worst,
)
from cardan.questions.forces.forces import forces
from cardan.units import deg, mm

TRUCK = example("truck-supports")
FORCES = forces(TRUCK)


def curves(panel):
    return [item for item in panel.series if isinstance(item, Curve)]


def drawn(figure):
    figure = for_reader(figure, USUAL)
    assert not figure.sentence or figure.sentence.endswith(".")
    tree = ElementTree.fromstring(inline_svg(figure))
    assert figure.title in tree.get("aria-label")
    assert described(figure)["data"]


@pytest.mark.parametrize("name", ["truck-supports", "pto-spline-thrust", "instrument-joint"])
def test_both_renderers_draw_them(name):
    drive = example(name)
    found = forces(drive)
    made = figures.for_result(found)
    assert [figure.name for figure in made] == ["torques", "reactions"]
    drawings = forces_figures(found, drive)
    assert [figure.name for figure in drawings] == ["torques", "loads", "loads-space", "reactions"]
    for figure in (*made, *drawings):
        drawn(figure)


@pytest.mark.parametrize("joint_angles", [[0.0], [0.3], [0.2] * 7])
def test_drives_without_supports_have_torques_alone(joint_angles):
    found = forces(Drive.from_angles(joint_angles), Duty(torque=10.0))
    (figure,) = forces_figures(found)
    drawn(figure)
    assert ("joints are straight" in told(figure.sentence, USUAL)) == (joint_angles == [0.0])


def test_one_position_is_drawn_too():
    for figure in forces_figures(forces(TRUCK, angle=[0.1])):
        drawn(figure)


def test_torques_and_couples_are_those_of_the_analysis():
    torque, couple, *_paths = torques_figure(FORCES).panels
    for k in range(4):
        np.testing.assert_array_equal(curves(torque)[k].y, FORCES.shaft_torque[k])
        np.testing.assert_array_equal(curves(couple)[k].y, FORCES.bending_couple[k])


def test_the_path_of_a_couple_has_its_size_and_is_seen_along_the_power_flow():
    drive = Drive.from_angles([20 * deg])
    found = forces(drive, Duty(torque=100.0))
    figure = torques_figure(found)
    path = curves(figure.panels[3])[-2]  # the last one is the dot at the start
    np.testing.assert_allclose(np.hypot(path.x, path.y), found.bending_couple[1], atol=1e-12)
    along = found.axis[1, 0]
    up = np.asarray([0.0, 0.0, 1.0]) - along[2] * along
    up /= np.linalg.norm(up)
    np.testing.assert_allclose(path.y, found.secondary_couple[1] @ up, atol=1e-12)
    np.testing.assert_allclose(path.x, found.secondary_couple[1] @ np.cross(along, up), atol=1e-12)


def test_reactions_are_those_of_the_analysis_both_ways_of_sliding():
    radial, axial, *_paths = reactions_figure(FORCES).panels
    for k in range(5):
        np.testing.assert_array_equal(curves(radial)[k].y, FORCES.radial[k])
        np.testing.assert_array_equal(curves(radial)[5 + k].y, FORCES.reverse.radial[k])
    # Only supports 1 and 4 hold lengthwise.
    for shown, back, k in zip(curves(axial)[:2], curves(axial)[2:], (0, 3), strict=True):
        np.testing.assert_array_equal(shown.y, FORCES.axial[k])
        np.testing.assert_array_equal(back.y, FORCES.reverse.axial[k])


def test_paths_of_the_supports_are_the_radial_forces_both_ways_of_sliding():
    paths = reactions_figure(FORCES).panels[2:]
    assert len(paths) == 5
    for k, panel in enumerate(paths):
        back, path, _start = curves(panel)[-3:]
        np.testing.assert_allclose(np.hypot(path.x, path.y), FORCES.radial[k], atol=1e-9)
        np.testing.assert_allclose(np.hypot(back.x, back.y), FORCES.reverse.radial[k], atol=1e-9)
        # z runs up: what holds the shaft up stands above the middle.
        shaft = FORCES.axis[FORCES.support_shaft[k] - 1]
        upward = np.asarray([0.0, 0.0, 1.0]) - shaft[:, 2:] * shaft
        np.testing.assert_allclose(np.sign(path.y), np.sign(np.sum(FORCES.reaction[k] * upward, axis=-1)), atol=1e-9)


def test_supports_are_called_by_their_names():
    names = [one.name for one in TRUCK.supports]
    labels = [item.label for item in reactions_figure(FORCES, names).panels[0].series]
    assert labels[:5] == [f"{k} {name}" for k, name in enumerate(names, start=1)]


def test_the_worst_is_that_of_both_ways_of_sliding():
    top = max(float(np.max(frames.norm(one.reaction))) for one in (FORCES, FORCES.reverse))
    assert worst(FORCES).size == top
    sentences = [told(figure.sentence, USUAL) for figure in forces_figures(FORCES, TRUCK)]
    assert sentences[1] == "All forces on the shafts at 156°, where support 4 (pinion, front) carries most."
    assert sentences[2:] == ["", ""]  # said once


def test_what_a_reader_sees_in_other_units_is_the_same():
    pounds = Reader(units={"force": "lbf", "torque": "lbft"}, decimal=",")
    plain, seen = (for_reader(reactions_figure(FORCES), one) for one in (USUAL, pounds))
    assert (seen.panels[0].y.unit, plain.panels[0].y.unit) == ("lbf", "N")
    ring = [[item.text for item in one.panels[2].series if isinstance(item, Note)] for one in (plain, seen)]
    assert ring == [["3\u202f000 N"], ["674,4 lbf"]]


def test_arrows_start_at_the_supports_and_point_as_the_forces_do():
    drive = example("pto-spline-thrust")
    found = forces(drive)
    place = geometry(drive)
    size = frames.norm(found.reaction)
    when = int(np.unravel_index(np.argmax(size), size.shape)[1])
    for panel in (*loads_figures(found, drive)[0].panels, *loads_figures(found, drive)[1].panels):
        arrows = [item for item in curves(panel) if item.arrow and item.z is not None]
        assert len(arrows) == 4
        for arrow, support, force in zip(arrows, drive.supports, found.reaction[:, when], strict=True):
            foot = np.asarray([arrow.x[0], arrow.y[0], arrow.z[0]])
            way = np.asarray([arrow.x[1], arrow.y[1], arrow.z[1]]) - foot
            joint = place.points[1 if support.shaft == 1 else support.shaft - 1]
            np.testing.assert_allclose(foot * mm, joint + support.position * place.axis[support.shaft - 1])
            np.testing.assert_allclose(way / np.linalg.norm(way), force / np.linalg.norm(force), atol=1e-12)
        lengths = [np.hypot(np.hypot(a.x[1] - a.x[0], a.y[1] - a.y[0]), a.z[1] - a.z[0]) for a in arrows]
        np.testing.assert_allclose(lengths / lengths[0], size[:, when] / size[0, when])


def test_arrows_stay_on_the_page():
    for figure in loads_figures(FORCES, TRUCK):
        for panel in figure.panels:
            for item in curves(panel):
                if item.z is not None:
                    x, y, _toward = onto(panel.view, np.stack((item.x, item.y, item.z), axis=-1)).T
                    assert np.all((x >= panel.x.low) & (x <= panel.x.high))
                    assert np.all((y >= panel.y.low) & (y <= panel.y.high))


def test_arrows_in_a_scene_have_heads_at_their_tips_and_tell_the_force():
    figure = loads_figures(FORCES, TRUCK)[1]
    data = described(for_reader(figure, USUAL))["data"]
    arrows = [item for item in curves(figure.panels[0]) if item.arrow and item.z is not None]
    shafts = [one for one in data if one["type"] == "scatter3d" and one["mode"] == "lines"]
    heads = [one for one in data if one["type"] == "mesh3d" and one["hoverinfo"] == "skip"]
    assert len(arrows) == len(shafts) == len(heads) == 5
    for arrow, shaft, head in zip(arrows, shafts, heads, strict=True):
        tip = np.asarray([arrow.x[-1], arrow.y[-1], arrow.z[-1]])
        corners = np.stack([head[way] for way in "xyz"], axis=-1)
        assert np.min(np.linalg.norm(corners - tip, axis=-1)) == 0.0
        back = np.asarray([arrow.x[0], arrow.y[0], arrow.z[0]]) - tip
        assert np.all((corners - tip) @ back >= 0.0)  # the head does not reach beyond the tip
        assert "N" in shaft["text"]
    assert f"support 4 (pinion, front): {significant(worst(FORCES).size)} N" in [one["text"] for one in shafts]
    bodies = [one for one in data if one["type"] == "mesh3d" and one["hoverinfo"] == "text"]
    assert all(one["opacity"] < 1.0 for one in bodies)


def test_supports_of_one_shaft_are_told_apart():
    shafts = FORCES.support_shaft
    assert len(set(zip(shafts, support_dashes(shafts), strict=True))) == len(shafts)


def test_supports_that_carry_nothing_are_drawn():
    free = replace(TRUCK, duty=replace(TRUCK.duty, torque=0.0))
    found = forces(free)
    for figure in forces_figures(found, free):
        drawn(figure)
