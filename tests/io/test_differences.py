"""In what drives differ."""

from dataclasses import replace

import pytest

from cardan.errors import InputError
from cardan.io import dumps, example, example_names, example_text, loads
from cardan.io.amend import amend
from cardan.io.differences import differences


def told(*texts):
    return [(one.path, one.values) for one in differences([loads(text) for text in texts])]


@pytest.mark.parametrize("name", example_names()[::4])
def test_a_drive_does_not_differ_from_what_was_saved_of_it(name):
    drive = example(name)
    assert differences([drive, loads(dumps(drive)), drive]) == ()


def test_keys_are_told_in_the_order_of_the_file_with_their_units():
    text = example_text("z-arrangement")
    other = amend(text, {"duty.speed_rpm": 1200, "shafts[1].yoke_angle_deg": 90, "joints[0].centre_mm": [0, 0, 1]})
    assert told(text, text, other) == [
        ("joints[0].centre", ("0, 0, 0 mm", "0, 0, 0 mm", "0, 0, 1 mm")),
        ("shafts[1].yoke_angle", ("0°", "0°", "90°")),
        ("duty.speed", ("1450 rpm", "1450 rpm", "1200 rpm")),
    ]


def test_another_unit_of_the_same_value_is_no_difference():
    text = example_text("truck-supports")
    assert "speed_rpm" in text
    drive = loads(text)
    same = replace(drive, duty=replace(drive.duty, speed=drive.duty.speed * (1.0 + 1e-15)))
    assert differences([drive, same]) == ()


def test_a_table_that_is_missing_is_told_once():
    few, many = example("truck-exact-yokes"), example("truck-supports")
    paths = [one.path for one in differences([few, many])]
    assert len(paths) == len(set(paths))
    gone = [one for one in differences([many, replace(many, supports=())]) if one.path.startswith("supports")]
    assert [one.path for one in gone] == [f"supports[{k}]" for k in range(len(many.supports))]
    assert all(one.values[1] == "" for one in gone)


def test_long_numbers_look_for_a_shorter_unit():
    life = next(one for one in differences([example("car-propshaft"), example("z-arrangement")]) if "life" in one.path)
    assert life.values[0] == "4000 h"


def test_no_drive_is_refused():
    with pytest.raises(InputError, match="at least one"):
        differences([])
