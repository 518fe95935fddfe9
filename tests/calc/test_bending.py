"""Keys of critical speeds: what is asked together, what contradicts itself, what is left out."""

from __future__ import annotations

import pytest

from cardan import InputError, calc

SECTION = {"length_m": 1.2, "outer_diameter_m": 0.05, "E_Pa": 2.1e11, "density_kg_m3": 7850.0}
ROW = {"length_mm": 1000.0, "d_out_mm": 50.0, "d_in_mm": 0.0, "E_GPa": 206.0, "density_kg_m3": 7850.0}
PINNED = {"end": "pinned"}
TUBE = {"length_m": 1.5, "outer_diameter_m": 0.076, "inner_diameter_m": 0.072}


@pytest.mark.parametrize(
    ("name", "inputs", "wrong"),
    [
        ("critical_speed_closed_form", {**SECTION, "inner_diameter_m": 0.05}, {"inner_diameter_m": "out_of_range"}),
        ("critical_speed_closed_form", {**SECTION, "length_m": 0.0}, {"length_m": "not_positive"}),
        ("critical_speed_closed_form", {**SECTION, "end_condition": "glued"}, {"end_condition": "out_of_range"}),
        ("critical_speed_book", {}, {"length_m": "missing"}),
        ("critical_speed_book", {"length_m": 1.0}, {"outer_diameter_m": "missing"}),
        ("critical_speed_book", {**TUBE, "E_Pa": 2e11}, {"density_kg_m3": "missing"}),
        (
            "critical_speed_book",
            {**TUBE, "lambda_": 3.9, "end_condition": "fixed-pinned"},
            {"lambda_": "inconsistent"},
        ),
        ("critical_speed_book", {**TUBE, "k_n": 1.1}, {"k_n": "out_of_range"}),
        ("critical_speed_stepped", {"segments": [SECTION], "nodes": [PINNED]}, {"nodes": "inconsistent"}),
        ("critical_speed_stepped", {"segments": [], "nodes": [PINNED, PINNED]}, {"segments": "empty"}),
        ("critical_speed_stepped", {"segments": [SECTION], "nodes": [PINNED, {"end": "free"}]}, {"nodes": "singular"}),
        (
            "critical_speed_stepped",
            {"segments": [SECTION, {**SECTION, "inner_diameter_m": 0.06}], "nodes": [PINNED, {"end": "free"}, PINNED]},
            {"segments[1].inner_diameter_m": "out_of_range", "nodes[1].end": "inconsistent"},
        ),
        (
            "critical_speed_stepped",
            {"segments": [SECTION], "nodes": [{"end": "fixed", "hinge": True}, PINNED]},
            {"nodes[0].hinge": "inconsistent"},
        ),
        ("critical_speed", {"d_out_mm": 70.0, "length_mm": 1500.0}, {"E_GPa": "missing", "density_kg_m3": "missing"}),
        (
            "critical_speed",
            {"method": "book", "d_out_mm": 70.0, "d_in_mm": 71.0},
            {"d_in_mm": "out_of_range", "length_mm": "missing"},
        ),
        ("critical_speed", {"method": "scale", "length_ratio": 2.0}, {"n_reference_rpm": "missing"}),
        (
            "critical_speed_beam",
            {"segments": [ROW], "supports": [{"x_mm": 0.0, "type": "pinned"}]},
            {"supports": "singular"},
        ),
        (
            "critical_speed_beam",
            {"segments": [ROW], "supports": [{"x_m": 1.1}], "springs": [{"x_mm": 1001.0, "k_N_per_m": 1e5}]},
            {"springs[0].x_mm": "out_of_range", "supports[0].x_m": "out_of_range"},
        ),
        ("critical_speed_margin", {"n_critical_rpm": 7000.0, "n_max_rpm": 0.0}, {"n_max_rpm": "not_positive"}),
    ],
)
def test_what_is_wrong_is_named(name, inputs, wrong):
    with pytest.raises(InputError) as caught:
        calc(name, inputs)
    assert {problem.field: problem.code for problem in caught.value.problems} == wrong


def test_the_book_formula_answers_what_it_is_asked():
    plain = calc("critical_speed_book", TUBE)
    assert set(plain) == {"n_crit_rpm", "n_crit_actual_rpm", "half_critical_rpm", "n_crit_thin_tube_rpm"}
    assert plain["n_crit_rpm"] == pytest.approx(12.1e4 * (0.076**2 + 0.072**2) ** 0.5 / 1.5**2)
    assert plain["n_crit_thin_tube_rpm"] == pytest.approx(plain["n_crit_rpm"], rel=1e-3)
    steel = calc("critical_speed_book", {**TUBE, "E_Pa": 2.1e11, "density_kg_m3": 7850.0})
    exact = calc("critical_speed_closed_form", {**TUBE, "E_Pa": 2.1e11, "density_kg_m3": 7850.0})
    assert steel["n_crit_rpm"] == pytest.approx(exact["speed_rpm"][0], rel=1e-12)
    ends = [
        calc("critical_speed_book", {**TUBE, **how}) for how in ({"end_condition": "fixed-fixed"}, {"lambda_": 4.73})
    ]
    assert ends[0]["n_crit_rpm"] == pytest.approx(2.26689 * plain["n_crit_rpm"], rel=1e-5)
    assert ends[1]["n_crit_rpm"] == pytest.approx(ends[0]["n_crit_rpm"], rel=1e-4)
    geared = calc("critical_speed_book", {**TUBE, "max_engine_speed_rpm": 3200.0, "gear_ratio": 1.25})
    assert geared["ratio_calculated_to_engine"] == pytest.approx(geared["n_crit_rpm"] / 4000.0)
    assert geared["rule_60_percent_met"] is False


def test_units_are_free():
    one = calc("critical_speed", ROW)
    other = calc(
        "critical_speed", {"length_m": 1.0, "d_out_cm": 5.0, "d_in_mm": 0.0, "E_MPa": 206e3, "density_g_cm3": 7.85}
    )
    assert one["n_critical_rpm"] == pytest.approx(other["n_critical_rpm"], rel=1e-12)
    assert one["n_critical_actual_rpm"] == one["n_critical_rpm"]


def test_motions_without_bending_and_lost_modes_are_told():
    free = calc("critical_speed_stepped", {"segments": [SECTION], "nodes": [{"end": "free"}] * 2})
    assert free["omega_rad_s"][:2] == [0.0, 0.0]
    assert (free["rigid_modes"], free["lost_modes"]) == (2, 0)
    disc = {"end": "free", "mass_kg": 5.0, "diametral_inertia_kgm2": 0.1, "polar_inertia_kgm2": 0.2}
    overhung = calc("critical_speed_stepped", {"segments": [SECTION], "nodes": [{"end": "fixed"}, disc]})
    assert overhung["lost_modes"] == 1
    standing = calc(
        "critical_speed_stepped",
        {"segments": [SECTION], "nodes": [{"end": "fixed"}, disc], "whirl": "forward_at_speed", "speed_rpm": 0.0},
    )
    assert standing["lost_modes"] == 0
    assert standing["omega_rad_s"][0] < overhung["omega_rad_s"][0]


def test_both_tables_of_a_shaft_agree():
    nodes = [PINNED, {"mass_kg": 2.0}, {"end": "free", "support_stiffness_N_per_m": 3e5}]
    half = {**SECTION, "length_m": 0.5, "E_Pa": 2.06e11}
    one = calc(
        "critical_speed_stepped",
        {"theory": "euler_bernoulli", "modes": 2, "segments": [half, half], "nodes": nodes},
    )
    other = calc(
        "critical_speed_beam",
        {
            "segments": [ROW],
            "springs": [{"x_mm": 1000.0, "k_N_per_m": 3e5}],
            "masses": [{"x_mm": 500.0, "mass_kg": 2.0}],
            "supports": [{"x_mm": 0.0, "type": "pinned"}],
        },
    )
    found = [other["n_critical_1_rpm"], other["n_critical_2_rpm"]]
    assert found == pytest.approx([speed * 30 / 3.141592653589793 for speed in one["omega_rad_s"]], rel=1e-10)


def test_the_longest_shaft_for_a_speed():
    found = calc(
        "critical_speed_margin", {"n_critical_rpm": 7000.0, "n_max_rpm": 3000.0, "d_out_mm": 76.0, "d_in_mm": 72.0}
    )
    assert found["longest_length_mm"] == pytest.approx(1e3 * (12.1e4 * (0.076**2 + 0.072**2) ** 0.5 / 4800) ** 0.5)
    assert found["half_critical_inside"] is False
    assert found["violated"] == []


@pytest.mark.parametrize("most", [500.0, 1300.0, 3700.0, 5000.0])
@pytest.mark.parametrize(("share", "rule"), [(1.6, "article_1.6"), (1 / 0.7, "catalogue"), (1.0, "supercritical")])
def test_speeds_on_the_edge_of_a_rule_are_judged_as_they_are_given(most, share, rule):
    """Only "supercritical" counts the edge itself as broken; turning rpm into rad/s must not move it."""
    broken = {
        sign: calc("critical_speed_margin", {"n_critical_rpm": share * most * (1 + sign * 1e-9), "n_max_rpm": most})
        for sign in (-1, 0, 1)
    }
    assert [rule in broken[sign]["violated"] for sign in (-1, 0, 1)] == [True, rule == "supercritical", False]
    at = {"k_n": 0.75, "outer_diameter_m": 0.03, "length_m": 1.0, "max_engine_speed_rpm": 3630.0 / 1.6}
    assert calc("critical_speed_book", at)["rule_60_percent_met"] is True
    assert calc("critical_speed_book", at | {"max_engine_speed_rpm": 2268.76})["rule_60_percent_met"] is False


@pytest.mark.parametrize("critical", [700.0, 4900.0, 6000.0, 8000.0])
def test_the_edges_of_the_half_critical_band_belong_to_it(critical):
    for edge, out in ((0.46 * critical, -1e-9), (0.54 * critical, 1e-9)):
        asked = {"n_critical_rpm": critical, "n_max_rpm": critical / 2}
        assert calc("critical_speed_margin", asked | {"operating_rpm": edge})["half_critical_inside"] is True
        assert (
            calc("critical_speed_margin", asked | {"operating_rpm": edge * (1 + out)})["half_critical_inside"] is False
        )
