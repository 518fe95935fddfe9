"""What small functions of catalogue return."""

from cardan.catalogue import catalogue, completed
from cardan.catalogue.provenance import rows_behind, unconfirmed
from cardan.catalogue.rows import JointSize, row_keys, sureness, told
from cardan.drive.drive import Drive
from cardan.drive.joint_parts import Rating
from cardan.drive.joints import Hooke


def test_unconfirmed():
    assert unconfirmed((catalogue().rows(JointSize)["example-75"],)) == ("example-75 (made up for examples)",)


def test_rows_behind():
    drive = completed(Drive(joints=(Hooke(joint_angle=0.1, size="example-75", rating=Rating(max_speed=400.0)),)))
    assert [
        row.id for row in rows_behind(drive, catalogue(), "joints[0].rating.torque", "joints[0].rating.max_speed")
    ] == ["example-75"]
    assert rows_behind(drive, catalogue(), "joints[0].rating.max_speed") == ()


def test_told():
    assert told(catalogue().tables["faults"]["F37"]).repair == "replace the shaft"


def test_row_keys():
    assert [one.key for one in row_keys("balance_grades")] == ["id", "source", "confidence", "note", "speed_m_s"]


def test_sureness():
    assert sorted(("recalled", "confirmed", "made_up"), key=sureness) == ["made_up", "recalled", "confirmed"]
