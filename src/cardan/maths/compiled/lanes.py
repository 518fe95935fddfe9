"""Eight drives or eight positions in one register, as an array of the array-API standard.

numba leaves it to its optimiser whether a loop becomes vector instructions, and gives no way to write past the caches.
`Lanes` says both outright: a formula written on ``xp = namespace(x)`` is emitted for eight numbers at a time. Machines
with narrower registers split them. Importing this module imports numba.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]
from numba import njit, types
from numba.extending import intrinsic

LANES = 8
BYTES = 8 * LANES

INPUT = {dimensions: types.Array(types.float64, dimensions, "A", readonly=True) for dimensions in (1, 2)}
"""Types of the arrays a kernel reads: any strides, so that broadcast arrays need no copy."""

OUTPUT = types.float64[::1]
"""Type of the arrays a kernel writes."""

SOURCES = zlib.crc32(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))))
"""Stands in the key of the kernels on disk; numba looks only at the file of the kernel itself."""

_DOUBLE = ir.DoubleType()
_VECTOR = ir.VectorType(_DOUBLE, LANES)
_PAIRS = ir.VectorType(_DOUBLE, 2 * LANES)
_INDEX = ir.IntType(32)
_FLAGS = ("contract", "nsz")


class Lanes:
    """Eight 64-bit numbers (or truth values) of a kernel under construction."""

    __slots__ = ("builder", "value")

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder = builder
        self.value = value

    def __array_namespace__(self, api_version: str | None = None) -> type[_Functions]:
        """Return the functions of the standard that the kernels use."""
        return _Functions

    def _number(self, other: Any) -> Any:
        return other.value if isinstance(other, Lanes) else ir.Constant(_VECTOR, [float(other)] * LANES)

    def _of(self, operation: Callable[..., Any], left: Any, right: Any) -> Lanes:
        return Lanes(self.builder, operation(self._number(left), self._number(right), flags=_FLAGS))

    def __add__(self, other: Any) -> Lanes:
        return self._of(self.builder.fadd, self, other)

    def __radd__(self, other: Any) -> Lanes:
        return self._of(self.builder.fadd, other, self)

    def __sub__(self, other: Any) -> Lanes:
        return self._of(self.builder.fsub, self, other)

    def __rsub__(self, other: Any) -> Lanes:
        return self._of(self.builder.fsub, other, self)

    def __mul__(self, other: Any) -> Lanes:
        return self._of(self.builder.fmul, self, other)

    def __rmul__(self, other: Any) -> Lanes:
        return self._of(self.builder.fmul, other, self)

    def __truediv__(self, other: Any) -> Lanes:
        return self._of(self.builder.fdiv, self, other)

    def __rtruediv__(self, other: Any) -> Lanes:
        return self._of(self.builder.fdiv, other, self)

    def __neg__(self) -> Lanes:
        return Lanes(self.builder, self.builder.fneg(self.value, flags=_FLAGS))

    def __lt__(self, other: Any) -> Lanes:
        return Lanes(self.builder, self.builder.fcmp_ordered("<", self.value, self._number(other)))

    def __gt__(self, other: Any) -> Lanes:
        return Lanes(self.builder, self.builder.fcmp_ordered(">", self.value, self._number(other)))


class _Functions:
    """The functions of the array-API standard that the kernels use."""

    @staticmethod
    def sqrt(x: Lanes) -> Lanes:
        return _called("sqrt", x)

    @staticmethod
    def abs(x: Lanes) -> Lanes:
        return _called("fabs", x)

    @staticmethod
    def maximum(x: Lanes, y: Lanes) -> Lanes:
        return _called("maxnum", x, y)

    @staticmethod
    def minimum(x: Lanes, y: Lanes) -> Lanes:
        return _called("minnum", x, y)

    @staticmethod
    def where(condition: Lanes, yes: Any, no: Any) -> Lanes:
        chosen = condition.builder.select(condition.value, condition._number(yes), condition._number(no))
        return Lanes(condition.builder, chosen)


def _called(name: str, x: Lanes, *more: Lanes) -> Lanes:
    given = [x.value, *(one.value for one in more)]
    kind = ir.FunctionType(_VECTOR, [_VECTOR] * len(given))
    function = x.builder.module.declare_intrinsic(f"llvm.{name}.v{LANES}f64", (), kind)
    return Lanes(x.builder, x.builder.call(function, given))


def _splat(builder: Any, number: Any) -> Lanes:
    empty = ir.Constant(_VECTOR, ir.Undefined)
    first = builder.insert_element(empty, number, ir.Constant(_INDEX, 0))
    everywhere = ir.Constant(ir.VectorType(_INDEX, LANES), [0] * LANES)
    return Lanes(builder, builder.shuffle_vector(first, empty, everywhere))


def _load(builder: Any, address: Any) -> Lanes:
    return Lanes(builder, builder.load(builder.inttoptr(address, _VECTOR.as_pointer()), align=8))


def _store(builder: Any, lanes: Lanes | tuple[Lanes, Lanes], address: Any, past_caches: bool) -> None:
    if isinstance(lanes, tuple):
        real, imaginary = lanes
        in_turns = [part * LANES + k for k in range(LANES) for part in (0, 1)]
        pairs = builder.shuffle_vector(
            real.value, imaginary.value, ir.Constant(ir.VectorType(_INDEX, 2 * LANES), in_turns)
        )
        builder.store(pairs, builder.inttoptr(address, _PAIRS.as_pointer()), align=8)
        return
    pointer = builder.inttoptr(address, _VECTOR.as_pointer())
    written = builder.store(lanes.value, pointer, align=BYTES if past_caches else 8)
    if past_caches:
        written.set_metadata("nontemporal", builder.module.add_metadata([ir.Constant(_INDEX, 1)]))


def step(formula: Callable[..., tuple[Any, ...]], *, past_caches: bool = False) -> Any:
    """Return a kernel function that applies a formula to eight lanes.

    formula: takes the loaded lanes, then the numbers; returns a tuple of lanes, or of pairs of lanes: real and
    imaginary parts, which are written in turns as complex numbers.
    past_caches: write to memory without reading the line first; the addresses must then be multiples of 64.
    Returns function (loaded, numbers, written) -> None: tuples of addresses to load eight numbers from, of numbers
    shared by the lanes, of addresses to write to.
    """

    def types_and_code(context: Any, loaded: Any, numbers: Any, written: Any) -> Any:
        def code(_context: Any, builder: Any, signature: Any, given: Any) -> Any:
            load_from, shared, write_to = (
                [builder.extract_value(pack, k) for k in range(len(kinds))]
                for pack, kinds in zip(given, signature.args, strict=True)
            )
            results = formula(
                *(_load(builder, address) for address in load_from), *(_splat(builder, number) for number in shared)
            )
            for result, address in zip(results, write_to, strict=True):
                _store(builder, result, address, past_caches)
            return _context.get_dummy_value()

        return types.void(loaded, numbers, written), code

    return intrinsic(types_and_code)


def _fence(context: Any) -> Any:
    def code(_context: Any, builder: Any, _signature: Any, _given: Any) -> Any:
        builder.fence("seq_cst")
        return _context.get_dummy_value()

    return types.void(), code


fence: Any = intrinsic(_fence)
"""Kernel function: what was written past the caches is in place before anything that follows."""


@njit(nogil=True)
def address(array: Any) -> Any:
    """Return where an array begins, as a signed number: unsigned and signed ones together would become floats."""
    return np.intp(array.ctypes.data)


def compiled(*signature: Any) -> Callable[[Callable[..., None]], Any]:
    """Return a decorator that compiles a kernel without the interpreter lock, kept on disk where that is possible.

    The kernel runs in one thread; `cardan.maths.compiled.method` calls it from several. So no OpenMP is loaded: a
    process may fork after it, and two Python threads may run kernels at once.
    """

    def decorate(function: Callable[..., None]) -> Any:
        kind = types.void(*signature)
        try:
            return njit(kind, cache=True, nogil=True, error_model="numpy")(function)
        except RuntimeError:  # no folder to write to
            return njit(kind, nogil=True, error_model="numpy")(function)

    return decorate
