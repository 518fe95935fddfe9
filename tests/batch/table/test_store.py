"""A folder knows what of it is whole, and belongs to one sweep and one run at a time."""

from __future__ import annotations

import json
import os
import sys
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from cardan.batch.engine.running import read_sweep, run
from cardan.batch.table.store import MANIFEST, Label, flaw, opened, rows_of, states_of, write_chunk
from cardan.batch.work import Chunks
from cardan.errors import InputError, MissingExtraError
from tests.batch.truth import same_tables, undisturbed
from tests.batch.works import Numbers

WORK = Numbers(size=250)
CHUNK = 50
LABEL = Label(work=WORK.name, columns=WORK.columns, provenance=WORK.provenance, keeps=True)
SECOND = Chunks(WORK.name, WORK.size, CHUNK)[1]


def cut_off(file):
    os.truncate(file, file.stat().st_size - 100)


def emptied(file):
    os.truncate(file, 0)


def no_parquet(file):
    file.write_text("a,b\n1,2\n")


def bit_of_the_rows(file):
    flip(file, file.read_bytes().index(WORK.evaluate(50, 100)["y"].tobytes()) + 17)


def bit_of_the_states(file):
    flip(file, file.read_bytes().rindex(b"[[50, ") + 2)


def bit_of_the_provenance(file):
    flip(file, file.read_bytes().rindex(b'"seed": 1') + 8)


def bit_of_the_twin(file):
    flip(file, file.read_bytes().index(b"ARROW:schema") + 2000)


def flip(file, place):
    content = bytearray(file.read_bytes())
    content[place] ^= 1
    file.write_bytes(content)


def of_another_place(file):
    neighbour = sorted(file.parent.glob("*.parquet"))[0]
    file.write_bytes(neighbour.read_bytes())


def of_another_sweep(file):
    write_chunk(file, SECOND, replace(LABEL, work="another"), WORK.evaluate(50, 100), [[50, 0.0], [0.0, 0]])


def with_a_row_too_few(file):
    write_chunk(file, SECOND, LABEL, WORK.evaluate(50, 99), [[50, 0.0], [0.0, 0]])


DAMAGES = [
    cut_off,
    emptied,
    no_parquet,
    bit_of_the_rows,
    bit_of_the_states,
    bit_of_the_provenance,
    bit_of_the_twin,
    of_another_place,
    of_another_sweep,
    with_a_row_too_few,
]


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_file_that_is_not_whole_is_made_again(damage, tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    file = tmp_path / f"{SECOND.name}.parquet"
    damage(file)
    sweep = run(WORK, into=tmp_path)
    assert sweep.damaged == (file.name,)
    undisturbed(sweep, WORK, CHUNK)
    assert run(WORK, into=tmp_path).damaged == ()


def test_a_chunk_that_is_made_twice_is_the_same_file(tmp_path):
    for name in ("one", "two"):
        run(WORK, chunk=CHUNK, into=tmp_path / name)
    for file in (tmp_path / "one").glob("*.parquet"):
        assert file.read_bytes() == (tmp_path / "two" / file.name).read_bytes()


def test_what_was_being_written_when_a_run_was_killed_is_cleared_away(tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    (tmp_path / f".{SECOND.name}.parquet.0a1b.part").write_bytes(b"PAR1")
    (tmp_path / "notes.txt").write_text("mine")
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)
    assert (tmp_path / "notes.txt").exists()


def test_a_chunk_that_is_lost_is_done_again(tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    (tmp_path / f"{SECOND.name}.parquet").unlink()
    found = read_sweep(tmp_path)
    assert (found.status, found.missing, found.reductions) == ("incomplete", ((50, 100, "it is not done yet"),), {})
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


def test_the_folder_of_another_sweep_is_refused(tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    before = sorted(file.name for file in tmp_path.iterdir())
    with pytest.raises(InputError, match="holds another sweep, which differs in seed: choose another folder"):
        run(replace(WORK, seed=2), into=tmp_path)
    with pytest.raises(InputError, match="holds another sweep, which differs in vary"):
        run(replace(WORK, size=251), into=tmp_path)
    with pytest.raises(InputError, match="keeps all rows: choose another folder to keep none"):
        run(WORK, into=tmp_path, rows="none")
    assert sorted(file.name for file in tmp_path.iterdir()) == before
    run(WORK, chunk=CHUNK, into=tmp_path / "none", rows="none")
    with pytest.raises(InputError, match="keeps no rows: choose another folder to keep them"):
        run(WORK, into=tmp_path / "none")


def test_tables_of_others_are_refused_and_left_alone(tmp_path):
    for name in "abcd":
        (tmp_path / f"{name}.parquet").write_text(name)
    with pytest.raises(InputError, match=r"holds 4 tables that are not of this sweep \(a.parquet, .* …\)"):
        run(WORK, into=tmp_path)
    run(WORK, chunk=CHUNK, into=tmp_path / "mine")
    (tmp_path / "mine" / "000000000050-0123456789abcdef.parquet").touch()
    with pytest.raises(InputError, match=r"holds a table that is not of this sweep \(000000000050-0123"):
        run(WORK, into=tmp_path / "mine")
    assert len(list(tmp_path.rglob("*.parquet"))) == 4 + 6


def test_two_runs_in_one_folder_are_refused(tmp_path):
    told = rf"is in use by another run \(process {os.getpid()} on "
    with opened(tmp_path, WORK, keeps=True, cut=lambda: CHUNK), pytest.raises(InputError, match=told):
        run(WORK, into=tmp_path)
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "is not the manifest of a sweep"),
        ("[]", "is not the manifest of a sweep"),
        ('{"format": 1}', "is not the manifest of a sweep"),
        ('{"format": 2}', "was written by another version of cardan"),
        (None, "holds no sweep"),
    ],
)
def test_a_manifest_that_says_nothing_is_refused(content, told, tmp_path):
    if content is not None:
        (tmp_path / MANIFEST).write_text(content)
        with pytest.raises(InputError, match=told):
            run(WORK, into=tmp_path)
    with pytest.raises(InputError, match=told):
        read_sweep(tmp_path)


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("provenance", {"seed": 2}, "has been changed"),
        ("columns", [], "has been changed"),
        ("chunk_rows", 0, "is not the manifest"),
        ("chunk_rows", "50", "is not the manifest"),
        ("chunk_rows", 25, "not of this sweep"),
        ("size", 100, "another sweep"),
        ("rows", "none", "keeps no rows"),
    ],
)
def test_a_manifest_that_was_changed_costs_no_rows(key, value, told, tmp_path):
    run(WORK, into=tmp_path, chunk=CHUNK)
    before = (tmp_path / MANIFEST).read_text(encoding="utf-8")
    (tmp_path / MANIFEST).write_text(json.dumps(json.loads(before) | {key: value}), encoding="utf-8")
    with pytest.raises(InputError, match=told):
        run(WORK, into=tmp_path)
    (tmp_path / MANIFEST).write_text(before, encoding="utf-8")
    found = run(WORK, into=tmp_path)
    assert found.damaged == ()
    undisturbed(found, WORK, CHUNK)


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot be written: "):
        run(WORK, into=tmp_path / "file" / "folder")


def test_a_missing_library_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    monkeypatch.delattr("pyarrow.parquet", raising=False)
    with pytest.raises(MissingExtraError, match=r"pip install 'cardan\[sweep\]'"):
        run(WORK, into=tmp_path)


@dataclass(frozen=True)
class Awkward(Numbers):
    """Numbers that a text would lose."""

    reductions: tuple = field(default=())

    def evaluate(self, start, stop):
        rows = super().evaluate(start, stop)
        awkward = np.array([0.1, -0.0, np.inf, -np.inf, np.nan, 5e-324, np.nextafter(1.0, 2.0)])
        k = np.arange(start, stop)
        return rows | {"y": awkward[k % 7], "word": np.asarray(["", "ö", "long " * 9])[k % 3], "y_deg": rows["y"][::-1]}


def test_every_bit_is_kept(tmp_path):
    work = Awkward(size=21)
    found = run(work, chunk=21, into=tmp_path).table()
    wanted = work.evaluate(0, 21)
    same_tables(found, wanted)
    assert found["y"].tobytes() == wanted["y"].tobytes()


def test_a_file_says_where_it_comes_from(tmp_path):
    import pyarrow.parquet as pq

    run(WORK, chunk=CHUNK, into=tmp_path)
    schema = pq.read_schema(tmp_path / f"{SECOND.name}.parquet")
    about = json.loads(schema.metadata[b"cardan"])
    assert about["provenance"] == WORK.provenance
    assert (about["work"], about["chunk"], about["start"], about["stop"]) == (WORK.name, SECOND.name, 50, 100)
    assert schema.field("y_deg").metadata[b"unit"] == b"deg"
    column = pq.read_metadata(tmp_path / f"{SECOND.name}.parquet").row_group(0).column(1)
    assert column.compression == "UNCOMPRESSED"
    assert not column.has_dictionary_page


def test_flaws_and_parts_of_one_file(tmp_path):
    file, rows = tmp_path / "a.parquet", WORK.evaluate(50, 100)
    write_chunk(file, SECOND, LABEL, rows, [[50, 1.5], [None, None]])
    assert flaw(file, SECOND, LABEL) == ""
    assert states_of(file) == [[50, 1.5], [None, None]]
    same_tables(rows_of(file, ["word", "k"]), {name: rows[name] for name in ("word", "k")})
    assert flaw(file, SECOND, replace(LABEL, keeps=False)) == "it belongs to something else"
