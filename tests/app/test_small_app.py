"""What small functions of app return."""

from cardan.app.parts.blocks import changed, words_html
from cardan.app.server import cookies_of
from cardan.app.state.form import tables
from cardan.report.block import Words


def test_changed():
    line = {"mode": "lines", "x": [0, 1], "y": [2, 3]}
    assert changed({"data": [line], "layout": {}}, {"data": [line | {"y": [2, 4]}], "layout": {}}) == {
        "heights": {0: "AAAAAAAAAEAAAAAAAAAQQA=="}
    }


def test_words_html():
    assert words_html(Words(text="a < b")) == "<p>a &lt; b</p>"


def test_cookies_of():
    assert cookies_of({"cookie": 'odd:name={"a": 1}; cardan_token=abc'})["cardan_token"] == "abc"


def test_tables():
    assert (tables({"joints": [{"joint_angle_deg": 20}, 5]}, "joints"), tables({"joints": 5}, "joints")) == (
        [{"joint_angle_deg": 20}, {}],
        [],
    )
