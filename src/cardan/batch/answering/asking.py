"""Questions asked of a drive wherever its fields stand: the rows of a table, whatever chose the points."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from typing import Any, Literal, TypeAlias

import numpy as np

from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.batch.points.fields import TEXT_STATUS, Maker, VaryingField, spots_of
from cardan.batch.work import STATUS, Column, Rows, Status
from cardan.catalogue import Catalogue, catalogue
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import mixed, unlike_hooke
from cardan.errors import CardanError, InputError, MissingExtraError, Problem, check
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Compiled, Method, Plain, has_numba
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _, mark

from .many import Many, many, one
from .questions import asked

# Answers by plain functions: for formulas of one's own beside the questions of a drive.


@dataclass(frozen=True, kw_only=True)
class Formula:
    """Functions of the fields, each an answer; where one is not finite there is none."""

    points: tuple[Column, ...]  # points, answers: fields and answers
    answers: tuple[Column, ...]
    functions: tuple[Callable[..., Any], ...]  # one for each answer; takes an array (n,) for each field and returns one

    @classmethod
    def of(cls, fields: Sequence[str], answers: Mapping[str, Callable[..., Any]]) -> Formula:
        """Return formulas over fields without units.

        Parameters
        ----------
        fields : sequence of str
            Their names.
        answers : mapping of str to callable
            Name and function of each answer.
        """
        return cls(
            points=tuple(Column(name=name, unit="", role="point", text=name) for name in fields),
            answers=tuple(Column(name=name, unit="", role="answer", text=name) for name in answers),
            functions=tuple(answers.values()),
        )

    def __call__(self, points: Array) -> Rows:
        """Return the answers at points (n, d)."""
        columns = np.asarray(points, dtype=float).T
        with np.errstate(all="ignore"):
            values = [np.broadcast_to(one(*columns), columns.shape[1:]).astype(float) for one in self.functions]
        rows: Rows = {column.name: value for column, value in zip(self.answers, values, strict=True)}
        known = np.all(np.isfinite(np.stack(values)), axis=0) if values else np.ones(columns.shape[1:], dtype=bool)
        rows[STATUS] = np.where(known, int(Status.ANSWERED), int(Status.NO_ANSWER)).astype(np.int8)
        return rows


gpu = later("cardan.batch.answering.asking")

Device: TypeAlias = Literal["cpu", "gpu"]
"""What computes questions about motion: NumPy and the kernels, or JAX on its default device."""

COMPILED = 20_000
"""Points of a whole sweep that are worth the kernel; of the whole, so that every part of it is computed alike."""

_FAILURES = (CardanError, ArithmeticError, np.linalg.LinAlgError)


@cache
def _named(names: tuple[str, ...], mechanism: bool) -> tuple[SweepQuestion, ...]:
    """Return questions by their names; they hold functions, which no other process could be sent."""
    return asked(names, mechanism=mechanism)


@dataclass(frozen=True, kw_only=True)
class DriveEvaluator:
    """Questions about a drive, or a mechanism, in which some fields vary.

    Attributes
    ----------
    drive : Drive or Mechanism
        A drive with grades and sizes filled in.
    spots : tuple of Spot
        What varies.
    questions : tuple of str
        Names of the questions.
    known : Catalogue
        Where names in the drive are looked up.
    device : {"cpu", "gpu"}
    many_points : bool
        Whether so many points are asked that the kernel pays.
    """

    drive: Drive | Mechanism
    spots: tuple[VaryingField, ...]
    questions: tuple[str, ...]
    known: Catalogue = field(default_factory=catalogue)
    device: Device = "cpu"
    many_points: bool = False

    @property
    def _asked(self) -> tuple[SweepQuestion, ...]:
        return _named(self.questions, isinstance(self.drive, Mechanism))

    @property
    def points(self) -> tuple[Column, ...]:
        """Columns of what varies."""
        return tuple(spot.column for spot in self.spots)

    @cached_property
    def answers(self) -> tuple[Column, ...]:
        """Columns of the answers."""
        return tuple(
            Column(name=told.name, unit=told.unit, role="answer", text=told.text)
            for question in self._asked
            for told in question.columns(self.drive)
        )

    @cached_property
    def fast(self) -> bool:
        """Whether all points are answered at once: motion is all that is asked, places and angles all that varies."""
        if isinstance(self.drive, Mechanism):
            return False
        alike = all(spot.moves for spot in self.spots) and not unlike_hooke(self.drive)
        return alike and all(question.of_many for question in self._asked)

    @cached_property
    def _maker(self) -> Maker:
        return Maker(drive=self.drive, spots=self.spots, known=self.known)

    @property
    def _method(self) -> Method:
        return Compiled(threads=1) if self.many_points and has_numba() else Plain()

    def rows(self, values: Mapping[str, Array], count: int) -> Rows:
        """Return answers and status of points.

        Parameters
        ----------
        values : mapping of str to array (count,)
            Path -> values in its unit.
        count : int

        Returns
        -------
        dict of str to array (count,)
            The columns of the answers, and the status.
        """
        return self._together(values, count) if self.fast else self._singly(values, count)

    def __call__(self, points: Array) -> Rows:
        """Return the rows of points (n, d), in the order and the units of the fields."""
        given = np.asarray(points, dtype=float)
        return self.rows({spot.path: given[:, k] for k, spot in enumerate(self.spots)}, len(given))

    def _together(self, values: Mapping[str, Array], count: int) -> Rows:
        with np.errstate(all="ignore"):
            si = {spot.bare: spot.si(np.asarray(values[spot.path], dtype=float)) for spot in self.spots}
            fits = np.ones(count, dtype=bool)
            for spot in self.spots if count else ():
                fits &= spot.fits(si[spot.bare])
            found, real = (self._on_gpu if self.device == "gpu" else self._on_cpu)(si, count)
            status = np.where(fits & real, int(Status.ANSWERED), int(Status.NO_DRIVE)).astype(np.int8)
            rows: Rows = {}
            for told, column in found:
                rows[told] = column if fits.all() and real.all() else np.where(fits & real, column, np.nan)
        rows[STATUS] = status
        return rows

    def _on_cpu(self, si: Mapping[str, Array], count: int) -> tuple[list[tuple[str, Array]], Array]:
        assert isinstance(self.drive, Drive)
        found, real = many(self.drive, si, count, method=self._method)
        return [(name, np.broadcast_to(column, (count,))) for name, column in self._told(found)], real

    def _on_gpu(self, si: Mapping[str, Array], count: int) -> tuple[list[tuple[str, Array]], Array]:
        found: tuple[list[tuple[str, Array]], Array] = gpu().answered(self.drive, self.questions, si, count)
        return found

    def _told(self, found: Many) -> Iterator[tuple[str, Array]]:
        """Yield the columns of questions about motion."""
        for question in self._asked:
            assert question.of_many is not None
            for told, column in zip(question.columns(self.drive), question.of_many(found), strict=True):
                yield told.name, column if told.factor == 1.0 else column / told.factor

    def _singly(self, values: Mapping[str, Array], count: int) -> Rows:
        rows: Rows = {column.name: np.full(count, math.nan) for column in self.answers}
        status = np.zeros(count, dtype=np.int8)
        for k in range(count):
            answers, status[k], _why = self.at({path: column[k] for path, column in values.items()})
            for name, value in answers.items():
                rows[name][k] = value
        rows[STATUS] = status
        return rows

    def at(self, values: Mapping[str, Any]) -> tuple[dict[str, float], int, tuple[Problem, ...]]:
        """Return the answers at one point, the drive made anew there, with its status and what stood in the way.

        Parameters
        ----------
        values : mapping of str to value
            Path -> value in its unit.
        """
        try:
            drive = self._maker.drive_at(values)
        except InputError as error:
            return {}, int(Status.NO_DRIVE), error.problems
        answers: dict[str, float] = {}
        problems: list[Problem] = []
        motion: Many | None = None
        for question in self._asked:
            told = question.columns(self.drive)
            try:
                if question.of_many is not None and isinstance(drive, Drive):
                    motion = motion or one(drive)
                    found: Sequence[Any] = [np.ravel(column)[0] for column in question.of_many(motion)]
                else:
                    assert question.of_one is not None
                    found = question.of_one(drive)
            except MissingExtraError:
                raise
            except InputError as error:
                problems += [Problem(f"{question.name}: {one.field}", one.message, one.code) for one in error.problems]
                continue
            except _FAILURES as error:
                problems.append(Problem(question.name, str(error)))
                continue
            answers.update({item.name: float(value) / item.factor for item, value in zip(told, found, strict=True)})
        return answers, int(Status.NO_ANSWER if problems else Status.ANSWERED), tuple(problems)


STATUS_COLUMN = Column(name=STATUS, unit="", role="status", text=TEXT_STATUS)  # the column of states


def evaluator(
    drive: Drive | Mechanism,
    paths: Sequence[str],
    ask: Sequence[str],
    *,
    known: Catalogue | None = None,
    device: Device = "cpu",
    size: int = 0,
) -> DriveEvaluator:
    """Return what answers questions about a drive, or a mechanism, at any values of some of its fields.

    Parameters
    ----------
    drive : Drive or Mechanism
    paths : sequence of str
        What varies, with units, as in the drive file.
    ask : sequence of str
        Names of questions.
    known : Catalogue, optional
        The shipped one when not given.
    device : {"cpu", "gpu"}
        What computes motion; the GPU answers nothing else.
    size : int
        How many points will be asked in all.

    Returns
    -------
    DriveEvaluator
        points (n, d) in the units of the paths -> arrays (n,) of answers and the status.

    Raises
    ------
    InputError
        Paths that lead nowhere, names that are no question, and what a question needs and the drive does not give.

    See Also
    --------
    optimise, boundary, sensitivity

    Examples
    --------
    >>> import numpy as np
    >>> from cardan import Drive
    >>> from cardan.sweeps import evaluator
    >>> asked = evaluator(Drive.from_angles([0.3, 0.3]), ["joints[1].joint_angle_deg"], ["alpha_eq"])
    >>> rows = asked(np.asarray([[10.0], [95.0]]))
    >>> rows["alpha_eq_deg"], rows["status"]
    (array([14.05239431,         nan]), array([0, 1], dtype=int8))
    """
    problems: list[Problem] = []
    spots: tuple[VaryingField, ...] = ()
    named: tuple[SweepQuestion, ...] = ()
    try:
        spots = spots_of(drive, paths)
    except InputError as error:
        problems += error.problems
    try:
        named = asked(ask, mechanism=isinstance(drive, Mechanism))
    except InputError as error:
        problems += error.problems
    check(problems)
    if device not in ("cpu", "gpu"):
        text = _("{value} is none of {choices}")
        problems.append(Problem("device", text.format(value=repr(device), choices="cpu, gpu")))
    if isinstance(drive, Drive):
        problems += _wanting(drive, {spot.bare for spot in spots}, named)
    made = DriveEvaluator(
        drive=drive,
        spots=spots,
        questions=tuple(ask),
        known=known or catalogue(),
        device=device,
        many_points=size >= COMPILED,
    )
    if device == "gpu" and not made.fast:
        text = _("the GPU answers questions about motion alone, where places and angles alone vary; ask the cpu")
        problems.append(Problem("device", text))
    check(problems)
    return made


def _wanting(drive: Drive, varied: Collection[str], named: Sequence[SweepQuestion]) -> Iterator[Problem]:
    """Yield what questions need and a drive does not give."""
    if drive.duty.speed is None and "duty.speed" not in varied:
        text = _("missing; the question {name} needs it")
        yield from (Problem("duty.speed", text.format(name=one.name)) for one in named if one.needs_speed)
    if drive.form != "points":
        text = _("only drives given by joint centres have lengths here")
        yield from (Problem(f"ask.{one.name}", text) for one in named if one.needs_centres)


# Motion of many drives by JAX: the same formulas on its arrays, compiled as one, on its default device.

jax = later("jax", mark("computing on a GPU needs JAX: pip install 'cardan[gpu]'"))
numpy = later("jax.numpy")

PIECES = (2**10, 2**15, 2**20)
"""Points that the device is given at a time: the least of these that holds them, filled up.

Each size is compiled once, which takes seconds; a piece of the largest takes about a gigabyte.
"""


def jax_numpy() -> tuple[Any, Any]:
    """Return JAX and its array library, set to 64 bits."""
    jax().config.update("jax_enable_x64", True)
    return jax(), numpy()


def answered(
    drive: Drive, questions: tuple[str, ...], si: Mapping[str, Array], count: int
) -> tuple[list[tuple[str, Array]], Array]:
    """Return answers to questions about motion, and which points are drives.

    drive: the drive in which places and angles vary; questions: names of questions about motion.
    si, mapping of str to array (count,): path without unit -> values in SI.
    Returns list of (str, array (count,)), array of bool (count,).
    """
    _jax, xp = jax_numpy()
    piece = next((size for size in PIECES if size >= count), PIECES[-1])
    run = _program(drive, questions, piece)
    parts: dict[str, list[Array]] = {}
    reals: list[Array] = []
    for start in range(0, count, piece):
        rows = slice(start, min(start + piece, count))
        held = rows.stop - start
        filled = {
            path: np.concatenate((one[rows], np.repeat(one[rows][-1:], piece - held))) for path, one in si.items()
        }
        columns, real = run({path: xp.asarray(one) for path, one in filled.items()})
        for name, column in columns.items():
            parts.setdefault(name, []).append(np.asarray(column)[:held])
        reals.append(np.asarray(real)[:held])
    if not count:
        return [(told.name, np.empty(0)) for told in _told(drive, questions)], np.empty(0, dtype=bool)
    return [(name, np.concatenate(column)) for name, column in parts.items()], np.concatenate(reals)


@lru_cache(maxsize=16)
def _program(drive: Drive, questions: tuple[str, ...], piece: int) -> Callable[[dict[str, Array]], Any]:
    """Return what answers so many points at once, compiled where it does not look at what it computes."""
    jax, xp = jax_numpy()

    def program(values: dict[str, Array]) -> tuple[dict[str, Array], Array]:
        found, real = many(drive, values, piece, xp=xp)
        answers = (column for one in asked(questions) if one.of_many for column in one.of_many(found))
        pairs = zip(_told(drive, questions), answers, strict=True)
        return {told.name: xp.broadcast_to(column / told.factor, (piece,)) for told, column in pairs}, real

    return program if mixed(drive.joints) else jax.jit(program)


def _told(drive: Drive, questions: tuple[str, ...]) -> list[OutputColumn]:
    return [told for one in asked(questions) for told in one.columns(drive)]
