"""What small functions of answers return."""

from cardan.answers.answer import Checked, checks, closely, heads, leftover
from cardan.answers.data import simple, tree
from cardan.answers.printed import framed, printed
from cardan.answers.quantity import Joined, Quantity, Unit, listed, numbered, say
from cardan.answers.question import all_of
from cardan.answers.reader import USUAL, Reader, chosen, half_turn, raised, spreadsheet, trimmed
from cardan.answers.sweepable import each, first


def test_closely():
    assert (closely(7e-16), closely(3.2e-10), closely(0.02), closely(float("nan"))) == (
        "to rounding",
        "to 10⁻⁹",
        "to 0.1",
        "not at all",
    )


def test_leftover():
    assert (leftover(7e-16), leftover(3.2e-10), leftover(float("nan"))) == ("rounding", "< 10⁻⁹", "–")


def test_checks():
    held = Checked(what="power", how="in less out", left=3e-14, allowed=1e-9)
    assert [cell.text for cell in printed(checks([held]), USUAL).rows[0]] == [
        "power",
        "in less out",
        "rounding",
        "10⁻⁹",
        "passed",
    ]


def test_heads():
    assert [list(column.values) for column in heads("joint", ["front", ""])] == [
        ["1 front", "2"],
        [1, 2],
        ["front", ""],
    ]


def test_simple():
    assert simple({"a": (1.0, float("nan"), float("-inf"))}) == {"a": [1.0, None, "-∞"]}


def test_tree():
    assert tree({"life": Quantity(3600.0, "duration"), "cycles": {"count": 3}}, Reader()) == {
        "life_h": 1.0,
        "cycles": {"count": 3},
    }


def test_framed():
    assert (framed("0.0", "≤ "), framed("0.0", "(", ")"), framed("", "≤ ")) == ('"≤ "0.0', '"("0.0")"', "")


def test_listed():
    assert (listed([1, 4]), listed([1, 2, 3])) == ("1, 4", "1 to 3")


def test_numbered():
    assert (numbered(4, "pinion, front"), numbered(2)) == ("4 (pinion, front)", "2")


def test_joined():
    assert Joined(["a", "b", "c"], last=" and ").told(Reader()) == "a, b and c"
    assert Joined([Quantity(1.5), Quantity(2.5)]).told(Reader(decimal=",")) == "1,500; 2,500"


def test_say():
    text = say("from {low:bare} to {high}", low=Quantity(1e3, "torque"), high=Quantity(2e3, "torque"))
    assert text.told(Reader(units={"torque": "kNm"}, decimal=",")) == "from 1,000 to 2,000 kN·m"


def test_unit():
    assert (Unit("torque").told(Reader(units={"torque": "lbft"})), Unit("time", "h").told(Reader())) == ("lbft", "h")


def test_all_of():
    assert all_of(["duty.torque", "duty.torque"]) == (("duty.torque",),)


def test_chosen():
    assert chosen(["length=in"], ",").units == {"length": "in"}


def test_spreadsheet():
    assert (spreadsheet(0.125603), spreadsheet(123456.0), spreadsheet(1e-9, 2), spreadsheet(0.5, decimals=2)) == (
        "0.0000",
        "#,##0",
        "0.0E+00",
        "0.00",
    )


def test_half_turn():
    assert (half_turn(-90.0), half_turn(178.0)) == (90.0, -2.0)


def test_raised():
    assert raised(-12) == "⁻¹²"


def test_trimmed():
    assert (trimmed("1\u202f500"), trimmed("0.2500"), trimmed("3.000"), trimmed("1.500·10⁻⁹")) == (
        "1\u202f500",
        "0.25",
        "3",
        "1.500·10⁻⁹",
    )


def test_first():
    assert repr(first([2.0])) == "[2.0, nan, nan]"


def test_each():
    assert [one.name for one in each("critical_speed", "angular_speed", "rpm", "")] == [
        "critical_speed_rpm[0]",
        "critical_speed_rpm[1]",
        "critical_speed_rpm[2]",
    ]
