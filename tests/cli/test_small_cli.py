"""What small functions of cli return."""

from cardan.cli.files.calc import inputs
from cardan.cli.motion.joint import asked
from cardan.cli.motion.phasing import held_yokes
from cardan.cli.shared.asked import key_of
from cardan.cli.shared.failure import reworded
from cardan.cli.shared.progress import pace
from cardan.cli.shared.source import value_of
from cardan.cli.torsion.torsion_band import band_of, repeated
from cardan.cli.torsion.torsion_optimise import ranges_of
from cardan.cli.torsion.torsion_parts import values


def test_inputs():
    assert inputs(None, ["alpha_deg=20", "beta_deg=[1, 2]", "method=exact"]) == {
        "alpha_deg": 20,
        "beta_deg": [1, 2],
        "method": "exact",
    }


def test_asked():
    assert [one.label for one in asked(["rzeppa", "hooke"])] == ["rzeppa", "hooke"]
    assert asked(["clemens", "driving.radius_mm=75"])[0].keys == {"driving": {"radius_mm": 75}}


def test_held_yokes():
    assert held_yokes(["2=180"]) == {2: 3.141592653589793}


def test_key_of():
    assert (key_of("joints[0].cross.span"), key_of("supports"), key_of("stations[0].to_next.stiffness")) == (
        "joints[0].cross.span_mm",
        "supports",
        "stations[0].to_next.stiffness_Nm_per_rad",
    )


def test_reworded():
    assert reworded("No such option: --bogus") == "No such option: --bogus"


def test_pace():
    assert pace(0.25, 0.75, 10.0, 1_000_000) == "25\u202f000 points/s, 0:30 left"


def test_value_of():
    assert (value_of("[1, 2]"), value_of("true"), value_of(".35"), value_of("+3."), value_of("exact")) == (
        [1, 2],
        True,
        0.35,
        3.0,
        "exact",
    )


def test_repeated():
    assert repeated({"--kind": "tuned", "--mode": None}, {"--element": [1, 2]}) == (
        "--kind",
        "tuned",
        "--element",
        "1",
        "--element",
        "2",
    )


def test_band_of():
    assert [round(one, 3) for one in band_of("300:600")] == [31.416, 62.832]


def test_ranges_of():
    assert ranges_of(["shafts[1].yoke_angle_deg=-90:90:22.5"]) == {"shafts[1].yoke_angle_deg": (-90.0, 90.0, 22.5)}


def test_values():
    assert values("100:200:3", "--speeds").tolist() == [100.0, 150.0, 200.0]
