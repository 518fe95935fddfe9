"""Stations put into drive files: the file then holds the drive, and every line of it stays."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cardan import example
from cardan.drive.station import Absorber, Pendulum
from cardan.io import example_text, loads
from cardan.io.edit import put_station, station_text
from cardan.questions.torsion.absorber.absorber_search import hosts, hung
from cardan.questions.torsion.model.torsional_train import torsional_train

THINGS = (
    Absorber(inertia=0.12002, stiffness=880.16, damping=2.2954),
    Pendulum(mass=0.31234567, radius=0.12, length=0.030123, count=2),
)


@pytest.mark.parametrize("name", ["pto-flywheel", "truck-power-unit", "unstable-drive"])
@pytest.mark.parametrize("thing", THINGS)
def test_every_station_of_an_example_takes_it(name: str, thing: Absorber | Pendulum) -> None:
    drive, text = example(name), example_text(name)
    for host in hosts(drive, torsional_train(drive)):
        better, table = hung(drive, host, thing)
        written = put_station(text, better, table)
        assert loads(written) == better
        assert [line for line in text.splitlines() if line not in written.splitlines()] == []
        if table == len(drive.stations):  # what is shown can be pasted
            assert loads(text + "\n" + station_text(better, table)) == better


def test_tables_in_one_line_take_it_too() -> None:
    text = "format = 1\nstations = [{ shaft = 2, inertia_kg_m2 = 0.5 }]  # one\n[[joints]]\njoint_angle_deg = 10\n"
    drive = loads(text)
    one = replace(drive, stations=(replace(drive.stations[0], absorber=THINGS[0]),))
    assert loads(put_station(text, one, 0)) == one
    two = replace(drive, stations=(*drive.stations, replace(drive.stations[0], inertia=0.0, absorber=THINGS[0])))
    written = put_station(text, two, 1)
    assert loads(written) == two
    assert "# one" in written
