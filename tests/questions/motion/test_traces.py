"""Stored traces of batches: compiled and plain form against forty digits, `motion` and their own symmetries."""

from __future__ import annotations

import builtins
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import array_api_strict
import numpy as np
import pytest

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, stack
from cardan.drive.duty import Duty
from cardan.errors import InputError, MissingExtraError
from cardan.maths.compiled import method
from cardan.maths.compiled.method import Compiled, Plain
from cardan.questions.motion.many_drives import LARGE, Traces, traces
from cardan.questions.motion.motion import motion
from tests.builders import recurrence

METHODS = [Plain(), Compiled()]
RESULTS = ("output_angle", "ratio", "acceleration")

# An angle error of 2e-16 in each μ and the rounding of about 10 operations a joint, i_max times over; up to 2e-15 is
# seen below 40° and four joints, relative to the largest value.
CLOSE = 5e-15


def drives(count, joints, *, joint_angle=0.7, seed=1):
    rng = np.random.default_rng(seed)
    return Drives.from_angles(
        rng.uniform(0.0, joint_angle, (count, joints)),
        plane_twist=rng.uniform(-3.0, 3.0, (count, joints - 1)),
        yoke_angle=rng.uniform(-3.0, 3.0, (count, joints - 1)),
        start_phase=rng.uniform(-3.0, 3.0, count),
    )


def off(one, two):
    """Return the largest difference, relative to the largest value of each result where that is above 1."""
    pairs = [(getattr(one, name), getattr(two, name)) for name in RESULTS]
    return max(float(np.max(np.abs(x - y))) / max(1.0, float(np.max(np.abs(y)))) for x, y in pairs)


def exactly(batch, angle, speed, acceleration):
    c = batch.chain
    table = [
        [recurrence.output(*row, x, w, e) for x in angle]
        for *row, w, e in zip(
            c.joint_angle, c.plane_twist, c.yoke_angle, c.start_phase, speed, acceleration, strict=True
        )
    ]
    found = np.moveaxis(np.asarray(table), -1, 0)
    return Traces(angle=angle, output_angle=found[0], ratio=found[1], acceleration=found[2])


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("joints", [1, 2, 4, 8])
def test_forty_digits(method, joints):
    batch = drives(5, joints, joint_angle=0.5)
    angle = np.asarray([0.0, 0.3, -2.0, 6.9, 40.0])
    speed, acceleration = np.linspace(-90.0, 120.0, 5), np.linspace(-5.0, 900.0, 5)
    found = traces(batch, angle, speed=speed, acceleration=acceleration, method=method)
    assert off(found, exactly(batch, angle, speed, acceleration)) < CLOSE


@pytest.mark.parametrize("joints", range(1, 9))
def test_compiled_equals_plain_for_any_number_of_joints(joints):
    batch = drives(203, joints, joint_angle=0.6)
    angle = np.linspace(-7.0, 9.0, 53)
    one, two = (traces(batch, angle, speed=3.0, acceleration=0.5, method=m) for m in METHODS)
    assert off(one, two) < 4 * CLOSE


@pytest.mark.parametrize("count", [1, 2, 7, 8, 9, 63, 64, 65, 130])
@pytest.mark.parametrize("positions", [1, 2, 7, 8, 9, 16, 23, 64, 361])
@pytest.mark.parametrize("steep", [False, True])
def test_every_number_is_written_once_for_odd_sizes(count, positions, steep):
    batch, angle = drives(count, 3, joint_angle=0.1 if steep else 0.7), np.linspace(0.0, 6.0, positions)
    batch.chain.joint_angle[::2, 0] = 1.25 if steep else 0.3  # leads of 29°: the long arctangent, in every other row
    one, two = (traces(batch, angle, method=m) for m in METHODS)
    assert off(one, two) < (4 if steep else 1) * CLOSE  # i_max is 3.5 there


@pytest.mark.parametrize("count", [1, 3, 200])
@pytest.mark.parametrize("positions", [1, 8, 13, 40])
@pytest.mark.parametrize("skew", [(0, 0, 0), (1, 1, 1), (3, 11, 3), (1, 2, 5)])
def test_results_are_written_where_they_are_wanted_and_nowhere_else(count, positions, skew):
    batch, angle = drives(count, 2), np.linspace(0.0, 6.0, positions)
    size = count * positions
    blocks = [np.full(size + 32, -7.0) for _ in RESULTS]
    out = Traces(
        angle=angle,
        **{
            name: block[8 + k : 8 + k + size].reshape(count, positions)
            for name, block, k in zip(RESULTS, blocks, skew, strict=True)
        },
    )
    found = traces(batch, angle, out=out, method=Compiled(threads=2))
    assert off(found, traces(batch, angle, method=Plain())) < CLOSE
    for name, block, k in zip(RESULTS, blocks, skew, strict=True):
        assert np.shares_memory(getattr(found, name), block)
        assert np.all(block[: 8 + k] == -7.0)
        assert np.all(block[8 + k + size :] == -7.0)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("shape", [(0, 4), (2, 0, 3)])
def test_no_drives(method, shape):
    found = traces(Drives.from_angles(np.zeros(shape)), [0.0, 1.0], method=method)
    assert found.ratio.shape == (*shape[:-1], 2)


@pytest.mark.parametrize("method", METHODS)
def test_no_positions(method):
    assert traces(drives(3, 2), np.zeros(0), method=method).acceleration.shape == (3, 0)


@pytest.mark.parametrize("method", METHODS)
def test_more_leading_axes_and_broadcast_fields(method):
    rng = np.random.default_rng(4)
    batch = Drives.from_angles(rng.uniform(0, 0.6, (3, 5, 2)), yoke_angle=[0.4])
    angle = np.linspace(0, 4, 11)
    found = traces(batch, angle, speed=rng.uniform(1, 2, (3, 5)), method=method)
    single = motion(Drive.from_angles(batch.chain.joint_angle[2, 3], yoke_angles=[0.4]), angle)
    np.testing.assert_allclose(found.ratio[2, 3], single.ratio, rtol=CLOSE)
    np.testing.assert_allclose(found.output_angle[2, 3], single.output_angle, atol=CLOSE)


@pytest.mark.parametrize("method", METHODS)
def test_straight_padding_changes_nothing(method):
    one, two = Drive.from_angles([0.3, 0.4]), Drive.from_angles([0.2, 0.3, 0.1, 0.5])
    both = traces(stack([one, two]), method=method)
    alone = traces(one, method=method)
    np.testing.assert_allclose(both.ratio[0], alone.ratio, rtol=1e-15)


@pytest.mark.parametrize("method", METHODS)
def test_large_yoke_angles_are_reduced(method):
    """Yoke angles repeat every half turn; beyond the range of the short reduction the slow one serves."""
    batch = drives(9, 3)
    turns = np.pi * np.asarray([3.0, -1e3, 5e4, -3e6, 0, 1, 2, 7, -9])[:, None]
    far = replace(batch, chain=replace(batch.chain, yoke_angle=batch.chain.yoke_angle + turns))
    found, wanted = (traces(b, np.linspace(0, 3, 9), method=method) for b in (far, batch))
    # a yoke angle near 1e7 has a last place of 2e-9
    assert np.max(np.abs(found.ratio - wanted.ratio)[[0, 4, 5, 6, 7, 8]]) < 3 * CLOSE
    assert np.max(np.abs(found.ratio - wanted.ratio)) < 1e-8


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("joint_angle", [60.0, 80.0, 89.0, 89.9])
def test_steep_joints(method, joint_angle):
    """Rounding of the pair grows by i_max: the bound is relative to the peak, which is i_max high."""
    batch = Drives.from_angles(np.deg2rad([[joint_angle]]), start_phase=[0.3])
    angle = np.linspace(-2.0, 5.0, 40)
    peak = 1.0 / np.cos(np.deg2rad(joint_angle))
    found = traces(batch, angle, method=method)
    assert off(found, exactly(batch, angle, [1.0], [0.0])) < 4e-15 * peak


@pytest.mark.parametrize("method", METHODS)
def test_ratio_is_the_derivative_of_the_angle(method):
    """Complex steps are not at hand for a kernel: central differences, 1e-5 wide, are good to 1e-9."""
    batch, angle, step = drives(6, 4), np.linspace(0, 6, 31), 1e-5
    at, before, behind = (traces(batch, angle + shift, method=method) for shift in (0.0, -step, step))
    np.testing.assert_allclose((behind.output_angle - before.output_angle) / (2 * step), at.ratio, atol=1e-8)
    np.testing.assert_allclose((behind.ratio - before.ratio) / (2 * step), at.acceleration, atol=1e-8)


@pytest.mark.parametrize("method", METHODS)
def test_agrees_with_motion(method):
    batch = drives(20, 4)
    found, wanted = traces(batch, method=method), motion(batch, speed=1.0)
    np.testing.assert_allclose(found.output_angle, wanted.output_angle, atol=CLOSE)
    np.testing.assert_allclose(found.ratio, wanted.ratio, rtol=CLOSE)
    np.testing.assert_allclose(found.acceleration, wanted.slope, atol=4 * CLOSE)
    np.testing.assert_allclose(found.output_angle[:, -1], 2 * np.pi, atol=CLOSE)


def test_threads_do_not_change_a_bit():
    batch, angle = drives(1001, 4), np.linspace(0, 6, 361)
    one = traces(batch, angle, method=Compiled(threads=1))
    for threads in (2, 3):
        many = traces(batch, angle, method=Compiled(threads=threads))
        assert all(np.array_equal(getattr(one, name), getattr(many, name)) for name in RESULTS)


def test_a_batch_equals_its_single_drives_bit_for_bit():
    """Each position is computed by the same operations wherever it lies; only the two forms differ."""
    batch, angle = drives(70, 3), np.linspace(0, 6, 29)
    whole = traces(batch, angle, method=Compiled())
    for k in (0, 7, 8, 63, 64, 69):
        chain = batch.chain
        part = Drives.from_angles(
            chain.joint_angle[k : k + 1],
            plane_twist=chain.plane_twist[k : k + 1],
            yoke_angle=chain.yoke_angle[k : k + 1],
            start_phase=chain.start_phase[k : k + 1],
        )
        alone = traces(part, angle, method=Compiled())
        assert all(np.array_equal(getattr(alone, name)[0], getattr(whole, name)[k]) for name in RESULTS)


def test_two_python_threads_at_once():
    batch, angle = drives(300, 4), np.linspace(0, 6, 361)
    wanted = traces(batch, angle, method=Compiled(threads=1))
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _k: traces(batch, angle, method=Compiled(threads=2)), range(12)):
            assert np.array_equal(found.ratio, wanted.ratio)


@pytest.mark.slow
def test_processes_may_fork_after_a_kernel():
    """No OpenMP is loaded, so a child can run kernels too; not tested in this process, which may have threads."""
    program = (
        "import multiprocessing as m, numpy as np\n"
        "from cardan.backends import Compiled\nfrom cardan.sweeps import Drives, traces\n"
        "def run(k): return traces(Drives.from_angles(np.full((999, 2), 0.3)), method=Compiled()).ratio.sum()\n"
        "one = run(0)\n"
        "with m.get_context('fork').Pool(2) as pool: print(pool.map(run, range(4)) == [one] * 4)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300, check=False)
    assert done.stdout.strip() == "True", done.stderr


def test_a_number_of_threads_below_one_is_refused():
    with pytest.raises(InputError, match="0 given"):
        Compiled(threads=0)


def test_large_jobs_are_compiled_and_small_ones_are_not(monkeypatch):
    from cardan.questions.motion import many_drives as module

    used = []
    monkeypatch.setattr(module, "_plain", lambda *job: used.append("plain"))
    monkeypatch.setattr(module, "_compiled", lambda *job, threads: used.append("compiled"))
    angle = np.linspace(0, 6, 1000)
    traces(drives(1, 1), angle)
    traces(drives(LARGE // 1000 - 1, 1), angle)
    traces(drives(LARGE // 1000, 1), angle)
    assert used == ["plain", "plain", "compiled"]


def test_a_single_drive_does_not_import_numba(monkeypatch):
    fetch = builtins.__import__

    def without(name, *rest):
        assert not name.startswith(("numba", "llvmlite"))
        return fetch(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    assert traces(Drive.from_angles([0.3, 0.3])).ratio.shape == (361,)


def test_without_numba_everything_still_works(monkeypatch):
    from cardan.questions.motion import many_drives as module

    monkeypatch.setattr(module, "LARGE", 100)
    monkeypatch.setattr(method, "has_numba", lambda: False)
    batch = drives(10, 1)
    found = traces(batch, np.linspace(0, 6, 10))
    assert np.all(np.isfinite(found.ratio))
    with pytest.raises(MissingExtraError, match="numba"):
        traces(batch, [0.0], method=Compiled())


def test_has_numba_tells_the_truth(monkeypatch):
    method.has_numba.cache_clear()
    for name in [name for name in sys.modules if name.startswith("cardan.maths.compiled.lanes")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr("cardan.maths.compiled.lanes", raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    assert not method.has_numba()
    method.has_numba.cache_clear()
    monkeypatch.undo()
    assert method.has_numba()


def test_other_libraries_compute_it_themselves():
    xp = array_api_strict
    batch = drives(3, 2)
    chain = batch.chain
    other = Drives.from_angles(
        xp.asarray(chain.joint_angle),
        plane_twist=xp.asarray(chain.plane_twist),
        yoke_angle=xp.asarray(chain.yoke_angle),
        start_phase=xp.asarray(chain.start_phase),
    )
    found = traces(other, xp.asarray([0.0, 1.0]), method=Compiled())
    assert found.ratio.__array_namespace__() is xp
    np.testing.assert_allclose(np.asarray(found.ratio), traces(batch, [0.0, 1.0]).ratio, rtol=CLOSE)
    with pytest.raises(InputError, match="out"):
        traces(other, xp.asarray([0.0, 1.0]), out=found)


@pytest.mark.parametrize(
    "change",
    [
        {"ratio": np.zeros((3, 4))},
        {"ratio": np.zeros((3, 5), dtype=np.float32)},
        {"acceleration": np.zeros((5, 3)).T},
        {"output_angle": np.broadcast_to(np.zeros(5), (3, 5))},
        {"output_angle": [[0.0] * 5] * 3},
    ],
)
@pytest.mark.parametrize("method", METHODS)
def test_buffers_that_do_not_fit_are_refused(change, method):
    batch, angle = drives(3, 2), np.linspace(0, 1, 5)
    out = replace(traces(batch, angle), **change)
    with pytest.raises(InputError) as caught:
        traces(batch, angle, out=out, method=method)
    assert caught.value.field == f"out.{next(iter(change))}"


def test_buffers_that_overlap_are_refused():
    batch, angle = drives(3, 2), np.linspace(0, 1, 5)
    found = traces(batch, angle)
    with pytest.raises(InputError, match="overlap"):
        traces(batch, angle, out=replace(found, ratio=found.acceleration))


def test_speed_comes_from_the_duty_of_a_single_drive():
    drive = replace(Drive.from_angles([0.3]), duty=Duty(speed=10.0, acceleration=2.0))
    angle = np.linspace(0, 3, 7)
    np.testing.assert_allclose(
        traces(drive, angle).acceleration, motion(drive, angle).shaft_acceleration[-1], rtol=1e-13
    )
    np.testing.assert_allclose(
        traces(drive, angle, speed=1.0, acceleration=0.0).acceleration, motion(drive, angle).slope, atol=CLOSE
    )
