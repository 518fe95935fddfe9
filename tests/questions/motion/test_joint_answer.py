"""What is said of kinds of joints by themselves, for any reader."""

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.joints import JOINTS, Hooke
from cardan.joints import DoubleCardan, Tripod
from cardan.questions.motion.joint_answer import Named, answer, answer_of_kinds, ask
from cardan.texts import speaking
from cardan.units import deg, rpm

RADIANS = Reader(units={"angle": "rad"}, decimal=",")


def of(*joints, joint_angle=30 * deg, speed=None):
    return answer(ask([Named(joint=one, name=one.kind, sizes={}) for one in joints], joint_angle, speed=speed))


@pytest.mark.parametrize(
    ("joints", "text"),
    [
        ((Hooke(),), "hooke at 30.0°: output angle error ±4.117°, speed fluctuation δ = 28.87 %."),
        ((Tripod(),), "tripod at 30.0°: the output turns exactly uniformly."),
        ((Tripod(), Tripod()), "All 2 joints turn exactly uniformly at 30.0°."),
        (
            (Hooke(), Tripod()),
            "At 30.0° hooke has the largest output angle error, ±4.12°; 1 of 2 turns exactly uniformly.",
        ),
    ],
)
def test_the_sentence_says_how_uniformly_joints_turn(joints, text):
    assert told(of(*joints).sentence, USUAL) == text


def test_numbers_are_those_of_the_law_in_the_units_of_the_reader():
    said = of(Hooke(), DoubleCardan(centring_ratio=0.5), speed=600 * rpm)
    found = ask([Named(joint=Hooke(), name="hooke", sizes={})], 30 * deg).turns[0]
    first = data(said, RADIANS)["joints"][0]
    assert first["angle_error_rad"] == pytest.approx(found.error)
    assert first["acceleration_rad_s2"] == pytest.approx(found.acceleration * (600 * rpm) ** 2)
    assert "hooke has the largest output angle error, ±0,0719 rad" in told(said.sentence, RADIANS)
    with speaking("ru"):
        assert told(of(Hooke()).remarks[-1].text, USUAL) != "Beside others:"


def test_all_kinds_are_listed():
    said = answer_of_kinds()
    assert [one["kind"] for one in data(said, USUAL)["kinds"]] == list(JOINTS)
    assert list(said.full().columns[0].values) == list(JOINTS)


def test_a_joint_beyond_its_kind_is_warned_of():
    said = of(Tripod(), joint_angle=40 * deg)
    assert said.tone == "warning"
    assert "real joints of this kind work to 26.0° only" in told(said.remarks[0].text, USUAL)
