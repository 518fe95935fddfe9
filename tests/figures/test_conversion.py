"""Numbers and sentences in other units."""

import re

import pytest

from cardan.errors import InputError
from cardan.figures.conversion import Conversion, names_of
from cardan.texts import speaking
from cardan.units import DIMENSIONS, label

AMERICAN = {
    "length": "in",
    "angle": "rad",
    "angular_speed": "rad_s",
    "torque": "lbft",
    "force": "lbf",
    "mass": "lb",
    "stress": "psi",
    "power": "kW",
}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("The joints move by up to 15.8 mm.", "The joints move by up to 0.622 in."),
        ("It takes 0.03802 to 0.04308 N·m;", "It takes 0.028042 to 0.031774 lbf·ft;"),
        ("Between 3.5 and 12.0 mm it slides.", "Between 0.138 and 0.472 in it slides."),
        ("yokes of shafts 2, 3 to 90.00°, −1.70°", "yokes of shafts 2, 3 to 1.5708 rad, −0.0297 rad"),
        ("joint 2 and 15.0° more", "joint 2 and 0.262 rad more"),
        ("shaft 1 [N·m]", "shaft 1 [lbf·ft]"),
        ("75.0 %, ±10.6 µm", "75.0 %, ±0.000417 in"),
        ("1\u202f234.5 rpm at 1.5·10⁻⁷°", "129.28 rad/s at 2.62·10⁻⁹ rad"),
        ("5.0° ± 1.0°", "0.0873 rad ± 0.0175 rad"),
        ("stiff by 12.5 N·m/rad and 3.0 N/mm", "stiff by 12.5 N·m/rad and 3.0 N/mm"),
        ("sliding at 12.5 mm/s", "sliding at 0.492 in/s"),
        ("at 22.3 Hz, for 5000 h", "at 22.3 Hz, for 5000 h"),
        ("joint 2 in the plane of joint 3", "joint 2 in the plane of joint 3"),
        ("tube 60 × 3 mm", "tube 2.362 × 0.1181 in"),
        ("set joints[1].centre_mm or shafts[2].length_mm", "set joints[1].centre_mm or shafts[2].length_mm"),
        ("at 600 / 900 / 1\u202f500 rpm", "at 62.83 / 94.25 / 157.1 rad/s"),
        ("nothing, 0.00°, is left", "nothing, 0.00 rad, is left"),
    ],
)
def test_a_number_goes_with_its_unit(text, said):
    assert Conversion(units=AMERICAN).sentence(text) == said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Calculated by cardan 0.1.0 in 2.5 s.", "Calculated by cardan 0.1.0 in 2,5 s."),
        ("truck-2.5.toml at 1\u202f234.5 rpm", "truck-2.5.toml at 1\u202f234,5 rpm"),
        ("here 0.0009, 0.0012", "here 0,0009; 0,0012"),
        ("on shaft 2, 0.016 N·m", "on shaft 2, 0,016 N·m"),
        ("Book (80), 1.5·10⁻⁷", "Book (80), 1,5·10⁻⁷"),
    ],
)
def test_the_decimal_sign_stands_in_numbers_only(text, said):
    assert Conversion(decimal=",").sentence(text) == said


def test_names_that_a_user_wrote_stay():
    how = Conversion(units=AMERICAN, names=names_of(["pump 300 mm", "gearbox"]))
    assert how.sentence("pump 300 mm: the shaft is 300 mm long") == "pump 300 mm: the shaft is 11.81 in long"


def test_the_usual_units_change_nothing():
    usual = Conversion(units={name: next(iter(units)) for name, units in DIMENSIONS.items()})
    assert usual.idle
    assert usual.sentence("15.8 mm, 25 µm") == "15.8 mm, 25 µm"


@pytest.mark.parametrize("language", ["en", "ru"])
@pytest.mark.parametrize("dimension", sorted(AMERICAN))
@pytest.mark.parametrize("text", ["12.5", "3", "0.00402", "1\u202f234.5", "−7.25·10⁻⁹"])
def test_there_and_back_is_the_same_to_the_last_digit_said(dimension, text, language):
    usual, chosen = (DIMENSIONS[dimension][one] for one in (next(iter(DIMENSIONS[dimension])), AMERICAN[dimension]))
    with speaking(language):
        how = Conversion(units={dimension: AMERICAN[dimension]})
        before = label(next(iter(DIMENSIONS[dimension])))
        said = how.sentence(f"it is {text}{'' if before == '°' else ' '}{before}.")
        number = re.fullmatch(r"it is ([^ ]+) " + re.escape(label(AMERICAN[dimension])) + r"\.", said)
        assert number, said
    # Half a step of the last digit that was written: what was said cannot be meant more sharply.
    digits = re.sub(r"·.*|[^\d.]", "", text)
    step = 10.0 ** -len(digits.partition(".")[2]) * (1e-9 if "·" in text else 1.0)
    assert read(number[1]) * chosen / usual == pytest.approx(read(text), abs=0.5 * step)


def read(text):
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
    mantissa, _times, power = text.replace("\u202f", "").replace("−", "-").partition("·10")
    return float(mantissa) * 10.0 ** int(power.translate(raised) or 0)


def test_a_number_in_full_is_converted_from_all_its_digits():
    how = Conversion(units={"length": "in"})
    assert how.number("0.3", 1.0 / 25.4, 0.254) == "0.0100"
    assert how.number("2\u202f969 … 3\u202f485", 0.1) == "296.9 … 348.5"
    assert how.number("≤ 90", 0.01) == "≤ 0.9000"


@pytest.mark.parametrize(
    ("choice", "field"),
    [
        ({"units": {"colour": "mm"}}, "units"),
        ({"units": {"length": "N"}}, "units.length"),
        ({"decimal": ";"}, "decimal"),
    ],
)
def test_what_is_no_unit_is_refused(choice, field):
    with pytest.raises(InputError) as caught:
        Conversion(**choice)
    assert [one.field for one in caught.value.problems] == [field]
