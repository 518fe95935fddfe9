"""Maps, histograms and ranks of a table, against NumPy and scipy on the table itself."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import spearmanr

from cardan.batch.engine.running import run
from cardan.batch.table import views
from cardan.batch.table.results import results
from cardan.batch.table.views import histogram_of, map_of, ranks_of
from cardan.errors import InputError
from tests.batch.tables import HEIGHTS, SIZE, SPEEDS, Suspension, whole

TABLE = whole()
FOUND = results(run(Suspension(), chunk=50))
HEIGHT, SPEED, JOINT_ANGLE = "joints[1].centre_mm[2]", "duty.speed_rpm", "joint_angle_deg[1]"


def test_a_grid_is_shown_as_it_is():
    found = map_of(FOUND, HEIGHT, SPEED, JOINT_ANGLE)
    np.testing.assert_array_equal(found.x, np.unique(TABLE[HEIGHT]))
    np.testing.assert_array_equal(found.values, TABLE[JOINT_ANGLE].reshape(HEIGHTS, SPEEDS).T)
    assert found.points == HEIGHTS * SPEEDS
    assert (found.across.name, found.up.unit) == (HEIGHT, "rpm")


def test_many_values_are_put_together_to_means(monkeypatch):
    monkeypatch.setattr(views, "FINEST", 12)
    monkeypatch.setattr(views, "COARSE", 5)
    found = map_of(FOUND, HEIGHT, SPEED, JOINT_ANGLE, where=f"{HEIGHT} <= 80")
    np.testing.assert_allclose(found.x, [-82.0, -46.0, -10.0, 26.0, 62.0][: len(found.x)], atol=30.0)
    edges = np.linspace(-100.0, 80.0, 6)
    height = np.unique(TABLE[HEIGHT])
    height = height[height <= 80.0]
    place = np.minimum(np.searchsorted(edges, height, side="right") - 1, 4)
    expected = [np.mean(12.0 - 0.05 * height[place == k]) for k in range(5)]
    np.testing.assert_allclose(found.values[0], expected)


def test_words_run_along_a_map_as_well():
    found = map_of(FOUND, "supplier", SPEED, JOINT_ANGLE)
    assert found.x.tolist() == ["Alpha", "Beta"]
    who, speed = TABLE["supplier"] == "Beta", TABLE[SPEED] == 750.0
    assert found.values[1, 1] == pytest.approx(np.nanmean(TABLE[JOINT_ANGLE][who & speed]))


@pytest.mark.slow
def test_a_histogram_counts_every_answer_once():
    found = histogram_of(FOUND, JOINT_ANGLE, bins=7)
    known = TABLE[JOINT_ANGLE][np.isfinite(TABLE[JOINT_ANGLE])]
    assert np.sum(found.counts) == len(known)
    assert found.unknown == 10
    assert found.mean == pytest.approx(np.mean(known))
    # Values on an edge may round to either side of it.
    assert np.max(np.abs(found.counts - np.histogram(known, 7)[0])) <= SPEEDS
    same = histogram_of(FOUND, JOINT_ANGLE, where=f"{HEIGHT} = 0", bins=3)
    assert np.sum(same.counts) == SPEEDS
    assert np.sum(histogram_of(FOUND, JOINT_ANGLE, where=f"{HEIGHT} > 90").counts) == 0


def test_a_histogram_leaves_out_what_has_no_end():
    table = Suspension().evaluate(0, SIZE)
    table[JOINT_ANGLE][:3] = np.inf, -np.inf, np.nan
    found = histogram_of(results(replace(FOUND.sweep, held=((0, table),))), JOINT_ANGLE, bins=7)
    assert np.isfinite(found.edges).all()
    assert found.mean == pytest.approx(np.mean(table[JOINT_ANGLE][np.isfinite(table[JOINT_ANGLE])]))
    assert (np.sum(found.counts), found.unknown) == (SIZE - 13, 13)


@pytest.mark.slow
def test_ranks_are_spearmans():
    found = ranks_of(FOUND, "speed_fluctuation")
    known = np.isfinite(TABLE["speed_fluctuation"])
    for column, value in zip(found.fields, found.correlation, strict=True):
        expected = spearmanr(TABLE[column.name][known], TABLE["speed_fluctuation"][known]).statistic
        assert value == pytest.approx(expected, abs=1e-12)
    assert ranks_of(FOUND, JOINT_ANGLE).correlation[0] == pytest.approx(-1.0)
    assert ranks_of(FOUND, JOINT_ANGLE).fields[0].name == HEIGHT
    assert ranks_of(FOUND, JOINT_ANGLE, fields=[SPEED]).fields[0].name == SPEED
    assert ranks_of(FOUND, JOINT_ANGLE, where=f"{HEIGHT} = 0").fields == ()


def test_words_and_unknown_names_are_refused():
    for ask in (
        lambda: map_of(FOUND, HEIGHT, SPEED, "supplier"),
        lambda: histogram_of(FOUND, "supplier"),
        lambda: ranks_of(FOUND, "supplier"),
    ):
        with pytest.raises(InputError, match="supplier holds no numbers"):
            ask()
    with pytest.raises(InputError, match="no such column"):
        map_of(FOUND, "height", SPEED, JOINT_ANGLE)
    with pytest.raises(InputError, match="no row"):
        map_of(FOUND, HEIGHT, SPEED, JOINT_ANGLE, where=f"{HEIGHT} > 1e9")
