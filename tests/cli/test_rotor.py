"""cardan rotor: the response of the library in words, its run-up, and two shafts beside a joint."""

import csv
import io

import pytest

from cardan import load, rotor_response
from cardan.questions.bending.line_whirl import line_whirl
from cardan.units import rpm
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import widest

CAR = EXAMPLES / "car-propshaft.toml"


@pytest.fixture
def cracked(drive_file):
    text = CAR.read_text().replace("runout_mm = 0.2", "runout_mm = 0.2\ncrack = { losses = [0.2, 0.05] }")
    return drive_file(text)


@pytest.fixture
def deep(drive_file):
    text = CAR.read_text().replace("runout_mm = 0.2", "runout_mm = 0.2\ncrack = { losses = [0.446, 0.1] }")
    return drive_file(text.replace("outer_mm = 76", "outer_mm = 46"))


def lines(done):
    return "\n".join(one for one in done.out.splitlines() if not one.startswith("    cardan"))


@pytest.mark.slow
def test_the_answer_is_that_of_the_library(cardan, cracked):
    said = cardan("rotor", cracked, "--speeds", "1000:4000:7", "--json").content
    found = rotor_response(load(cracked), speed=[k * 3.141592653589793 / 30 for k in range(1000, 4001, 500)])
    assert said["rotor"]["crack_losses"] == [0.2, 0.05]
    assert said["rotor"]["unbalance_g_mm"] == pytest.approx(1e6 * found.rotor.unbalance)
    assert said["response"]["order_2_um"] == pytest.approx(1e6 * found.steady.order_amplitude(2))
    assert said["response"]["speed_rpm"] == pytest.approx(list(range(1000, 4001, 500)))
    rows = list(csv.DictReader(io.StringIO(cardan("rotor", cracked, "--speeds", "1000:4000:7", "--csv").out)))
    assert [float(one["order_minus_1_um"]) for one in rows] == said["response"]["order_minus_1_um"]


@pytest.mark.slow
def test_it_stands_within_80_columns_and_draws(cardan, cracked, tmp_path):
    done = cardan("rotor", cracked, "--plot", "r.svg")
    assert (done.code, done.err) == (0, "")
    assert widest(lines(done)) <= 80
    assert "Its open crack takes 20.0 % of its stiffness" in done.out
    assert "order 1 backward" in (tmp_path / "r.svg").read_text()


@pytest.mark.slow
def test_whirling_that_grows_at_speeds_in_use_is_a_failure(cardan, deep):
    done = cardan("rotor", deep, "--damping", 0.002, "--json")
    assert done.code == done.content["exit_code"] == 1
    assert done.content["unstable_rpm"]


@pytest.mark.slow
def test_a_run_up_needs_one_in_the_duty(cardan, cracked, tmp_path):
    done = cardan("rotor", cracked, "--run-up")
    assert (done.code, "duty.run_up" in done.err) == (2, True)
    text = cracked.read_text().replace(
        "[duty]", "[duty]\nrun_up = { start_rpm = 2400, end_rpm = 3200, duration_s = 1 }", 1
    )
    cracked.write_text(text)
    said = cardan("rotor", cracked, "--run-up", "--json", "--plot", "run.svg").content
    third = said["rotor"]["critical_rpm"] / 3.0
    rows = said["orders"]
    at = rows["speed_rpm"][rows["order_3_um"].index(max(rows["order_3_um"]))]
    assert at == pytest.approx(third, rel=0.05)  # softer by the crack, late by the run
    assert widest(lines(cardan("rotor", cracked, "--run-up"))) <= 80
    assert (tmp_path / "run.svg").stat().st_size > 1000


@pytest.mark.slow
def test_two_shafts_beside_a_joint(cardan, tmp_path):
    done = cardan("rotor", EXAMPLES / "truck-supports.toml", "--joint", 2, "--turns", 6, "--json", "--plot", "j.svg")
    said = done.content
    assert (said["first"]["shaft"], said["second"]["shaft"]) == (2, 3)
    assert said["residual"] < 1e-6
    sommerfeld = said["orders"]["first_um"][said["orders"]["order"].index(0)]
    assert sommerfeld == pytest.approx(said["first"]["sag_um"], rel=0.05)
    assert (tmp_path / "j.svg").stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--shaft", 9), "--shaft: there is no shaft 9"),
        (("--damping", 1), "--damping: 1 is not at least 0"),
        (("--joint", 9), "--joint: there is no joint 9"),
        (("--joint", 1, "--run-up"), "choose --run-up or --joint"),
        (("--speed-rpm", 100), "--speeds says a range"),
        (("--joint", 1, "--turns", 0), "allowed is 1 to 10000"),
        (("--speeds", "0:100"), "--speeds"),
    ],
)
def test_what_is_wrong_is_said(cardan, arguments, words):
    done = cardan("rotor", CAR, *arguments)
    assert (done.code, done.out) == (2, "")
    assert words in done.err


def test_a_crack_that_contradicts_itself_is_told_with_its_key(cardan, drive_file):
    text = CAR.read_text().replace("runout_mm = 0.2", "crack = { losses = [0.2], depth_ratio = 0.2 }")
    done = cardan("rotor", drive_file(text), "--json")
    assert [one["field"] for one in done.complaint["problems"]] == [
        "shafts[1].crack",
        "shafts[1].crack.losses",
    ]


def test_the_whole_line_is_told_with_all_its_shafts_and_supports(cardan):
    rubber = EXAMPLES / "two-piece-rubber-bearing.toml"
    said = cardan("rotor", rubber, "--line", "--json").content
    found = line_whirl(load(rubber))
    size, speed, place = found.peak()
    assert (said["peak_um"], said["peak_at_rpm"], said["peak_place_mm"]) == pytest.approx(
        (1e6 * size, speed / rpm, 1e3 * place)
    )
    assert len(said["shafts"]["whirl_um"]) == 2
    assert said["supports"]["support"] == ["1 centre bearing"]
    damped = cardan("rotor", rubber, "--line", "--damping", 0.1, "--speeds", "1500:1550:10", "--json").content
    assert damped["peak_um"] < 0.6 * said["peak_um"]
    done = cardan("rotor", rubber, "--line", "--shaft", 2)
    assert (done.code, "goes without --shaft" in done.err) == (2, True)


@pytest.mark.slow
def test_a_cracked_tube_whirls_by_its_depth(cardan, drive_file):
    text = CAR.read_text()
    sound = cardan("rotor", CAR, "--line", "--json").content
    cracked = drive_file(text.replace("runout_mm = 0.2", "crack = { depth_ratio = 0.7, position_mm = 500 }"))
    assert cardan("rotor", cracked, "--line", "--json").content["peak_um"] > 2.0 * sound["peak_um"]
    assert 0.01 < cardan("rotor", cracked, "--json").content["rotor"]["crack_losses"][0] < 0.5
