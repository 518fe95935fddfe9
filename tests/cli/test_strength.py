"""cardan strength, select, balance, catalogue: what they say, what they write, what they refuse."""

import csv
import io
import tomllib

import numpy as np
import pytest

from cardan import io as files
from cardan.catalogue import TABLES, catalogue
from cardan.checks.strength.strength import strength
from cardan.choices.selection import JointDuty, select_joint
from cardan.choices.sizing import size
from cardan.drive.fields.parts import known_lengths
from cardan.questions.bending.balance import balance
from cardan.units import deg, rpm
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import widest

DRIVE = """format = 1
name = "winch"

[[joints]]
joint_angle_deg = 14  # as built
size = "example-90"

[[joints]]
joint_angle_deg = 14
size = "example-90"

[[shafts]]
number = 2
outer_mm = 70  # a stock tube
wall_mm = 3
length_mm = 1100
material = "C45"
unbalance = [{ position_mm = 200, amount_g_mm = 90 }]

[duty]
torque_Nm = 500
speed_rpm = 1500
shock_factor = 1.2
life_h = 1000
"""

MAKER = """[[joint_sizes]]
id = "mine-60"
source = "my maker, catalogue of 2024"
type = "medium"
cross = { span_mm = 60, journal_mm = 19, bending_arm_mm = 9, material = "20Kh" }
needles = { capacity_N = 60000, static_capacity_N = 40000 }
rating = { max_torque_Nm = 2500, max_joint_angle_deg = 30, max_speed_rpm = 5000, outer_mm = 60 }
"""


@pytest.fixture
def winch(drive_file):
    return drive_file(DRIVE, "winch.toml")


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    [
        ("strength", "{}"),
        ("strength", str(EXAMPLES / "truck-supports.toml")),
        ("strength", "{}", "--size", "tube"),
        ("strength", "{}", "--size", "joint"),
        ("strength", "{}", "--size", "needles:1"),
        ("select", "{}"),
        ("balance", "{}"),
        ("catalogue",),
        ("catalogue", "joint_sizes"),
        ("catalogue", "joint_types", "heavy"),
        ("catalogue", "materials", "--keys"),
    ],
)
def test_the_answer_stands_within_80_columns_and_as_json_and_csv(cardan, winch, command):
    command = [word.format(winch) for word in command]
    done = cardan(*command)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert cardan(*command, "--json").content["exit_code"] == 0
    rows = list(csv.reader(io.StringIO(cardan(*command, "--csv").out)))
    assert len(rows) > 1
    assert {len(row) for row in rows} == {len(rows[0])}


def test_json_is_the_strength(cardan, winch):
    said = cardan("strength", winch, "--json").content
    found = strength(files.load(winch))
    assert said["rated_torque_Nm"] == found.rated_torque
    assert said["utilisation"] == found.utilisation
    assert [row["utilisation"] for row in said["limits"]] == [u.utilisation if u.run else None for u in found.verdicts]


def test_a_drive_that_is_too_weak_fails_and_says_what_to_size(cardan, winch):
    done = cardan("strength", winch, "--torque-Nm", 9000)
    assert done.code == 1
    assert "too weak" in done.out
    assert "--size" in done.out


def test_a_size_is_written_with_the_comments(cardan, winch, tmp_path):
    done = cardan("strength", winch, "--size", "tube:2", "-o", "better.toml")
    assert done.code == 0
    text = (tmp_path / "better.toml").read_text("utf-8")
    assert "# a stock tube" in text
    found = size(files.load(winch), None, "tube:2")
    new = files.load(tmp_path / "better.toml").shafts[1]
    assert 1e3 * new.outer == pytest.approx(found.values["shafts[1].outer_mm"])
    assert 1e3 * new.wall == pytest.approx(found.values["shafts[1].wall_mm"])
    assert cardan("strength", "better.toml").code == 0


@pytest.mark.slow
def test_a_row_of_a_maker_is_taken(cardan, winch, drive_file, tmp_path):
    maker = drive_file(MAKER, "maker.toml")
    said = cardan("strength", winch, "--size", "joint", "--catalogue", maker, "--json").content
    assert said["as_made"] == {"joints[0].size": "mine-60", "joints[1].size": "mine-60"}
    assert said["tried"][0]["size"] == "example-58"
    made = cardan("strength", winch, "--size", "joint", "--catalogue", maker, "-o", "own.toml")
    again = cardan("strength", "own.toml", "--size", "tube:2", "--catalogue", maker, "-o", "own.toml")
    assert (made.code, again.code) == (0, 0)
    own = cardan("select", winch, "--catalogue", maker, "--json").content
    assert [row["fits"] for row in own["sizes"] if row["size"] == "mine-60"] == [True]
    shown = cardan("catalogue", "joint_sizes", "mine-60", "--catalogue", maker)
    assert "my maker, catalogue of 2024" in shown.out
    done = cardan("catalogue", "--check", maker)
    assert (done.code, "mine-60" in done.out) == (0, True)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--size", "tubes"), "--size: 'tubes' is none of tube"),
        (("--size", "journal"), "--size: say which: journal:1, journal:2"),
        (("--size", "tube", "--series", "R7"), "--series: 'R7' is none of"),
        (("-o", "x.toml"), "--out: there is nothing to write"),
        (("--size", "tube", "--hold", "colour"), "colour"),
    ],
)
def test_what_cannot_be_sized_is_refused(cardan, winch, arguments, words):
    done = cardan("strength", winch, *arguments)
    assert done.code == 2
    assert words in " ".join(done.err.split())


def test_no_torque_is_named_with_its_option(cardan, drive_file):
    bare = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 10\n")
    assert "--torque-Nm" in cardan("strength", bare).err
    done = cardan("strength", bare, "--torque-Nm", 10)
    assert done.code == 0
    assert "nothing could be judged" in " ".join(done.out.split())


def test_options_and_file_ask_for_the_same(cardan, winch):
    """Two joints of 14°, yokes in one plane: the middle shaft carries 500/cos 14°."""
    said = cardan("select", winch, "--json").content
    same = [
        "--torque-Nm",
        said["need"]["torque_Nm"],
        "--joint-angle-deg",
        14,
        "--speed-rpm",
        1500,
        "--service-factor",
        1.2,
    ]
    own = cardan("select", *same, "--outer-mm", 90, "--json").content
    assert own["types"] == said["types"]
    assert own["need"] == pytest.approx(said["need"])


def test_options_count_in_the_lives_of_sizes_too(cardan, winch):
    """By hand: the life falls with the 10/3rd power of the torque, and with the joint angle."""

    def life(*options):
        rows = cardan("select", winch, *options, "--json").content["sizes"]
        return next(row["life_h"] for row in rows if row["size"] == "gwb-687.25")

    twice = ("--joint-angle-deg", 10, "--service-factor", 2.4)
    once = ("--joint-angle-deg", 10, "--service-factor", 1.2)
    assert life(*once) / life(*twice) == pytest.approx(2.0 ** (10.0 / 3.0))
    assert life(*once) / life("--joint-angle-deg", 20, "--service-factor", 1.2) == pytest.approx(2.0)
    assert life("--service-factor", 2.4) < 0.2 * life()


def test_every_reason_says_its_limit_and_source(cardan):
    said = cardan(
        "select", "--torque-Nm", 700, "--joint-angle-deg", 30, "--speed-rpm", 2000, "--synchronous", "--json"
    ).content
    found = select_joint(JointDuty(torque=700.0, joint_angle=30 * deg, speed=2000 * rpm, synchronous=True))
    assert [row["type"] for row in said["types"]] == [one.row.id for one in found]
    for row, one in zip(said["types"], found, strict=True):
        assert [reason["code"] for reason in row["reasons"]] == [*one.causes, *one.flags]
        for reason in row["reasons"]:
            assert reason["message"]
            assert reason["source"]
            if reason["code"] in ("torque", "angle", "n_alpha"):
                assert reason["value"] > reason["limit"]


def test_a_need_that_cannot_be_names_its_options(cardan):
    done = cardan("select", "--torque-Nm", -1, "--joint-angle-deg", 95, "--speed-rpm", 10)
    assert done.code == 2
    assert "--torque-Nm: -1 given" in done.err
    assert "--joint-angle-deg: 95 given" in done.err
    assert cardan("select", "--torque-Nm", 5).code == 2
    assert (
        "--joint-angle-deg: nan" in cardan("select", "--torque-Nm", 5, "--speed-rpm", 2, "--joint-angle-deg", "nan").err
    )


def test_the_need_of_one_joint(cardan, winch):
    assert cardan("select", winch, "--joint", 3).code == 2
    assert cardan("select", winch, "--joint", 1, "--json").content["need"]["joint_angle_deg"] == pytest.approx(14)


def test_json_is_the_balance(cardan, winch):
    said = cardan("balance", winch, "--grade", "G40", "--json").content
    found = balance(files.load(winch), grade="G40").shafts[0]
    assert said["shafts"][0]["allowed_g_mm"] == pytest.approx(1e6 * found.allowed)
    assert len(said["shafts"][0]["corrections"]) == 2
    assert cardan("balance", winch, "--grade", "G41").code == 2


@pytest.mark.parametrize("table", TABLES)
def test_every_row_is_shown_as_a_file_may_give_it(cardan, drive_file, table):
    """Rows printed as JSON, written as a file, read back: the same rows."""
    from cardan.catalogue.rows import row_tree
    from cardan.io.drive_file import toml_text

    rows = cardan("catalogue", table, "--json").content["rows"]
    own = catalogue().tables[table]
    assert [row["id"] for row in rows] == list(own)
    text = "".join(toml_text({table: [row_tree(row)]}) + "\n" for row in own.values())
    assert len(tomllib.loads(text)[table]) == len(own)
    done = cardan("catalogue", "--check", drive_file(text, "own.toml"))
    assert (done.code, done.err) == (0, "")


def test_every_problem_of_a_file_of_rows_is_told(cardan, drive_file):
    bad = drive_file(
        '[[joint_sizes]]\nid = "A"\nratng = {}\ncross = { span_mm = -3 }\n[[materals]]\nid = "X"\n', "bad.toml"
    )
    done = cardan("catalogue", "--check", bad)
    assert done.code == 2
    for words in (
        "ratng: unknown key; the nearest known one is rating",
        "cross.span_mm: -3",
        "source: missing",
        "nearest is materials",
    ):
        assert words in done.err
    assert "is not a table" in cardan("catalogue", "materail").err
    assert "the nearest is C45" in cardan("catalogue", "materials", "C46").err
    assert cardan("catalogue", "--check", "nowhere.toml").code == 2


def test_other_tubes_are_compared_with_the_one_of_the_file(cardan, winch, tmp_path):
    cardan("strength", winch, "--size", "tube:2", "--plot", "tubes.svg")
    now = files.load(winch).shafts[1]
    mass = (
        7850.0 * 0.25 * np.pi * (now.outer**2 - (now.outer - 2.0 * now.wall) ** 2) * known_lengths(files.load(winch))[2]
    )
    assert f"now it is {mass:.2f} kg" in (tmp_path / "tubes.svg").read_text("utf-8")


def test_keys_that_miss_have_their_units(cardan):
    done = cardan("strength", EXAMPLES / "propshaft-with-rzeppa.toml", "--size", "journal:1")
    assert done.code == 2
    assert "joints[0].cross.material.yield_strength_MPa: missing" in done.err
