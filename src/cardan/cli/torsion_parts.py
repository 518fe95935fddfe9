"""What the commands of ``cardan torsion`` share: options, names of elements, how to stop long work and keep it."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.questions.torsion.model.torsional_train import TorsionalTrain

    from .answer import Remark

Speeds: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--speeds",
        metavar="LOW:HIGH[:COUNT]",
        help=_("Input speeds [rpm] from the lowest to the highest, instead of one."),
        show_default=False,
    ),
]
Pieces: TypeAlias = Annotated[
    int,
    typer.Option(
        "--pieces",
        metavar="N",
        min=1,
        max=1000,
        help=_("Stretches into which the body of a shaft is divided between two stations."),
    ),
]

COUNT = 121
"""Values of a list where no number is given."""

MOST = 1_000_000
"""Values of a list at most."""


def values(text: str, option: str, *, count: int = COUNT, low: float | None = None) -> Any:
    """Return the values of LOW:HIGH[:COUNT].

    Parameters
    ----------
    text : str
        What the user wrote.
    option : str
        As what.
    count : int
        How many, where the text does not say.
    low : float, optional
        The values are above this.

    Raises
    ------
    InputError
        The text is no such range, or holds too many values.

    Examples
    --------
    >>> values("100:200:3", "--speeds").tolist()
    [100.0, 150.0, 200.0]
    """
    import numpy as np

    from cardan.errors import refuse

    parts = text.split(":")
    try:
        first, last = (float(part) for part in parts[:2])
        many = int(parts[2]) if len(parts) > 2 else count
    except ValueError:
        first = last = float("nan")
        many = 0
    if len(parts) > 3 or not (np.isfinite(first) and np.isfinite(last)):
        raise refuse(option, _("{text} is no range; write LOW:HIGH or LOW:HIGH:COUNT").format(text=text))
    if not first < last or many < 2:
        raise refuse(option, _("{text} is empty; the second value is above the first, two at least").format(text=text))
    if low is not None and first <= low:
        raise refuse(option, _("{first:g} is not allowed; allowed is more than {low:g}").format(first=first, low=low))
    if many > MOST:
        from cardan.questions.torsion.stability.torsion_stability import PACE

        said = _("{count:,} values would take about {hours:,.0f} h; at most {most:,} are done")
        said = said.format(count=many, hours=many * PACE / 3600.0, most=MOST)
        raise refuse(option, said.replace(",", "\u202f"))
    return np.linspace(first, last, many)


@contextmanager
def keeping(what: str, *, count: int = 0) -> Iterator[Callable[[float], object]]:
    """Give the function that long work tells its share done; ctrl-C makes it answer "stop", so that its part is kept.

    A second ctrl-C ends the command at once. The function has an attribute ``stopped``.

    Parameters
    ----------
    what : str
        What is being done, beside the bar.
    count : int
        Points of the whole work, where points a second and the time left are to be told.
    """
    from .progress import watching

    class Telling:
        stopped = False

        def __call__(self, share: float) -> object:
            tell(share)
            return "stop" if self.stopped else None

    telling = Telling()

    def interrupt(_number: int, _frame: object) -> None:
        if telling.stopped:
            raise KeyboardInterrupt
        telling.stopped = True

    with watching(what, count=count) as tell:
        try:
            before = signal.signal(signal.SIGINT, interrupt)
        except ValueError:  # not in the main thread: nobody interrupts there
            yield telling
            return
        try:
            yield telling
        finally:
            signal.signal(signal.SIGINT, before)


def ended(code: int, telling: Any) -> int:
    """Return the exit code of a command; one that was stopped ends with 130 and what it has said."""
    if telling.stopped:
        raise SystemExit(130)
    return code


def short(name: str, most: int = 44) -> str:
    """Return a name that fits a column.

    Examples
    --------
    >>> short("joint 1, driven yoke – joint 2, driving yoke", 30)
    'joint 1, driven yoke – joint …'
    """
    return name if len(name) <= most else name[: most - 1] + "…"


def assumptions(train: TorsionalTrain) -> Iterator[Remark]:
    """Yield what the model assumes, in one line a sort."""
    import re

    from .answer import Remark
    from .asked import listed

    said = {
        "stiffness": _("rigid, for want of a stiffness or a body of known length: {shafts}"),
        "inertia": _("without inertia: {shafts}"),
        "material": _("of steel: {shafts}"),
        "damping": _("without damping: {shafts}"),
    }
    found: dict[str, list[int]] = {}
    for path in train.assumed:
        match = re.match(r"shafts\[(\d+)\]\.(\w+)$", path)
        if match:
            found.setdefault(match[2], []).append(int(match[1]))
    texts = []
    for name, numbers in found.items():
        word = _("shaft") if len(numbers) == 1 else _("shafts")
        texts.append(said[name].format(shafts=f"{word} {listed(numbers)}"))
    if "duty.motor" in train.assumed:
        texts.append(_("driven by a constant torque that equals what resists at the start"))
    if texts:
        yield Remark(text=_("Assumed: {what}.").format(what="; ".join(texts)))
