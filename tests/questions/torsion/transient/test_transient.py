"""Motion in time against another formulation, closed forms, limits, and its own account of energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.maths.compiled.method import Compiled, Plain
from cardan.questions.torsion.model.inputs import (
    Asynchronous,
    Constant,
    Falling,
    History,
    SpeedCourse,
    SpeedTable,
    Swinging,
)
from cardan.questions.torsion.model.torsional_balance import energy
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.simulation import Simulation, Status
from cardan.questions.torsion.transient.transient import Adaptive, Method, simulate
from tests.builders.multipliers import Chain

BALANCED = 1e-6
"""Share of the energy that its account may miss in any of these simulations."""

ROUGH = Adaptive(rtol=1e-7, atol=1e-8)


def followed(model: TorsionalModel, span: float, **options: object) -> Simulation:
    """Return a simulation that ended well and balances."""
    found = simulate(model, span=span, **options)  # type: ignore[arg-type]
    assert np.all(found.status == Status.DONE)
    assert np.all(found.imbalance < BALANCED)
    return found


def chain(**changes: object) -> Chain:
    """Return two joints with a heavy shaft between them; damping everywhere."""
    parts = {
        "inertia": [[1.2, 0.05], [0.03, 0.3, 0.04], [0.02, 0.8]],
        "stiffness": [[4000.0], [6000.0, 8000.0], [5000.0]],
        "damping": [[1.0], [0.5, 0.2], [0.3]],
        "ground": [[0.0, 0.1], [0.2, 0.0, 0.1], [0.3, 0.0]],
        "joint_angle": [0.6, 0.45],
        "phase": [0.2, 1.1],
    }
    return Chain(**(parts | changes))  # type: ignore[arg-type]


def model_of(one: Chain, torques: tuple[Torque, ...] = ()) -> TorsionalModel:
    """Return the same drive as a model."""
    return torsional_line(
        one.inertia,
        stiffness=one.stiffness,
        damping=one.damping,
        backlash=one.gap,
        ground_damping=one.ground,
        joint_angle=one.joint_angle,
        phase=one.phase,
        torques=torques,
        input_speed=one.input_speed,
    )


METHODS: list[Method] = [Adaptive(stiff=False), Adaptive(stiff=True), FixedStep(per_period=14, compute=Plain())]


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS, ids=["explicit", "implicit", "fixed"])
def test_motion_is_that_of_constraints_and_multipliers(method: Method) -> None:
    """Free, twisted at the start, under torques by angle, speed and time."""
    loads = [
        (0, lambda _t, angle, speed: 90.0 - 0.8 * speed + 30.0 * np.sin(1.5 * angle + 0.4)),
        (6, lambda t, _angle, speed: -np.interp(t, [0.0, 0.02, 0.03], [0.0, 10.0, 60.0]) - 0.2 * speed),
    ]
    one = chain(torques=loads)
    torques = (
        Torque(station=0, law=Falling(standstill=90.0, slope=0.8)),
        Torque(station=0, law=Swinging(amplitude=30.0, frequency=1.5, phase=0.4)),
        Torque(station=6, law=History(times=np.asarray([0.0, 0.02, 0.03]), torques=np.asarray([0.0, -10.0, -60.0]))),
        Torque(station=6, law=Falling(standstill=0.0, slope=0.2)),
    )
    start = {0: 0.0, 1: 0.01, 3: -0.02, 4: 0.0, 6: 0.015}
    angle, speed, torque = one.follow(0.08, angle=start, speed=70.0)
    found = followed(model_of(one, torques), 0.08, times=3, angle=list(start.values()), speed=70.0, method=method)
    # The other one steps over the corners of the history with its own tolerance of 1e-11: 1e-8 is what that leaves.
    np.testing.assert_allclose(found.angle[-1], angle, atol=1e-8)
    np.testing.assert_allclose(found.speed[-1], speed, rtol=1e-6, atol=1e-5)
    np.testing.assert_allclose(found.torque[-1], torque, rtol=1e-6, atol=1e-4)


def test_a_forced_input_and_the_torque_it_takes() -> None:
    one = chain(input_speed=60.0)
    angle, speed, torque = one.follow(0.05)
    found = followed(model_of(one), 0.05, times=2)
    np.testing.assert_allclose(found.angle[-1], angle, atol=1e-9)
    np.testing.assert_allclose(found.torque[-1], torque, rtol=1e-8, atol=1e-6)
    assert found.input_torque is not None
    assert found.input_torque[-1] == pytest.approx(torque[0], rel=1e-8)  # the first station keeps its speed
    np.testing.assert_allclose(found.speed[-1], speed, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("method", [Adaptive(), FixedStep(step=2e-5, compute=Compiled())], ids=["events", "fixed"])
def test_contacts_in_the_play_of_an_element(method: Method) -> None:
    """The other formulation walks over the contacts in steps of a 200th of their period."""
    one = Chain(
        inertia=[[1.2, 0.05], [0.03, 0.2]],
        stiffness=[[4000.0], [5000.0]],
        damping=[[1.0], [0.0]],
        gap=[[0.0], [0.01]],
        joint_angle=[0.4363],
        phase=[0.0],
        input_speed=45.0,
    )
    angle, _speed, torque = one.follow(0.12, step=1.5e-4)
    found = followed(model_of(one), 0.12, times=2, method=method)
    np.testing.assert_allclose(found.angle[-1], angle, atol=2e-7)
    np.testing.assert_allclose(found.torque[-1], torque, rtol=1e-5, atol=1e-2)
    free = followed(model_of(replace(one, gap=None)), 0.12, times=2)
    assert np.max(np.abs(free.angle[-1] - angle)) > 1e-3, "the play must matter"


def test_a_damper_in_a_play_acts_in_contact_only() -> None:
    """Two masses part at 2 rad/s in a play of 0.2 rad: nothing happens for 0.05 s, then the contact is a half swing."""
    line = torsional_line([[1.0, 1.0]], stiffness=[[800.0]], damping=[[5.0]], backlash=[[0.2]])
    found = followed(line, 0.2, times=np.asarray([0.0, 0.04, 0.06, 0.2]), speed=np.asarray([1.0, -1.0]))
    assert found.torque[1, 0] == 0.0
    # Relative motion: ẍ + 10 ẋ + 1600 x = 0 from x = 0, ẋ = 2 (reduced mass ½), until x is 0 again.
    omega = np.sqrt(1600.0 - 25.0)
    t = 0.01
    x = 2.0 / omega * np.exp(-5.0 * t) * np.sin(omega * t)
    v = 2.0 / omega * np.exp(-5.0 * t) * (omega * np.cos(omega * t) - 5.0 * np.sin(omega * t))
    assert found.torque[2, 0] == pytest.approx(800.0 * x + 5.0 * v, rel=1e-9)
    parted = 2.0 * np.exp(-5.0 * np.pi / omega)
    assert found.speed[3, 1] - found.speed[3, 0] == pytest.approx(parted, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("play", [0.2, 1e-5])
@pytest.mark.parametrize("stiff", [False, True])
def test_it_rattles_from_side_to_side_for_good(play: float, stiff: bool) -> None:
    """Half a swing in contact, a straight way through the play, and back; the narrow play is crossed in a moment."""
    line = torsional_line([[1.0, 1.0]], stiffness=[[800.0]], backlash=[[play]])
    half = np.pi / 40.0 + play / 2.0
    times = np.asarray([0.0, 7.0, 10.0]) * half + 0.5 * play / 2.0
    way = Adaptive(stiff=stiff)
    found = followed(line, 11.0 * half, times=times, speed=np.asarray([11.0, 9.0]), method=way)
    twist, turning = -np.diff(found.angle)[:, 0], -np.diff(found.speed)[:, 0]
    np.testing.assert_allclose(turning, [2.0, -2.0, 2.0], rtol=1e-8)
    np.testing.assert_allclose(twist, [0.5 * play, -0.5 * play, 0.5 * play], atol=1e-8)
    np.testing.assert_allclose(found.extremes.torque_high, 800.0 * 2.0 / 40.0, rtol=1e-8)
    np.testing.assert_allclose(found.extremes.torque_low, -800.0 * 2.0 / 40.0, rtol=1e-8)


def test_a_straight_drive_swings_as_the_closed_form_says() -> None:
    line = torsional_line([[0.5, 0.3]], stiffness=[[700.0]], torques=[Torque(station=0, law=Constant(value=6.0))])
    times = np.linspace(0.0, 0.5, 41)
    found = followed(line, 0.5, times=times, angle=[0.02, 0.0], speed=[30.0, 30.0])
    omega, level = np.sqrt(700.0 * (1 / 0.5 + 1 / 0.3)), 6.0 / 0.5 / (700.0 * (1 / 0.5 + 1 / 0.3))
    twist = level + (0.02 - level) * np.cos(omega * times)
    np.testing.assert_allclose(found.torque[:, 0], 700.0 * twist, atol=1e-6)
    middle = (0.5 * found.angle[:, 0] + 0.3 * found.angle[:, 1]) / 0.8
    np.testing.assert_allclose(middle, 0.0125 + 30.0 * times + 0.5 * 7.5 * times**2, rtol=1e-11)
    assert found.extremes.torque_high[0] == pytest.approx(14.0, rel=1e-8)
    assert found.extremes.torque_low[0] == pytest.approx(700.0 * (2 * level - 0.02), rel=1e-7)


def test_without_torque_and_damping_energy_stays() -> None:
    one = chain(damping=[[0.0], [0.0, 0.0], [0.0]], ground=None)
    line = model_of(one)
    found = followed(line, 0.1, times=21, angle=[0.0, 0.01, 0.02, 0.03, 0.03], speed=40.0)
    np.testing.assert_allclose(found.energy, found.energy[0], rtol=1e-9)
    np.testing.assert_allclose(found.work, 0.0, atol=1e-9)
    np.testing.assert_allclose(energy(line, found.coordinate, found.rate), found.energy)


class TestWithoutInertia:
    """Joints whose yokes weigh nothing: their balance is static, or of first order in time with dampers."""

    def line(self, yoke: float, damping: float) -> TorsionalModel:
        return torsional_line(
            [[1.0, yoke], [0.0, 0.5]],
            stiffness=[[4000.0], [5000.0]],
            damping=[[damping], [0.5 * damping]],
            joint_angle=[0.4],
            input_speed=40.0,
        )

    @pytest.mark.slow
    @pytest.mark.parametrize("damping", [1.0, 4.0])
    def test_is_the_limit_of_small_inertia(self, damping: float) -> None:
        """Explicit steps with a little inertia: the difference shrinks with it, once its own swings are damped away."""
        light = followed(self.line(0.0, damping), 0.1, times=2)
        assert light.method == "implicit"
        heavy = [
            followed(self.line(yoke, damping), 0.1, times=2, method=replace(ROUGH, stiff=False))
            for yoke in (4e-4, 1e-4)
        ]
        miss = [np.max(np.abs(one.angle[-1] - light.angle[-1])[2:]) for one in heavy]
        assert miss[1] < 0.4 * miss[0] < 2e-4

    def test_the_static_balance_holds_all_the_way(self) -> None:
        found = followed(self.line(0.0, 0.0), 0.1, times=31)
        lever = np.cos(0.4) / (1.0 - np.sin(0.4) ** 2 * np.cos(found.angle[:, 1]) ** 2)
        np.testing.assert_allclose(found.torque[:, 0], lever * found.torque[:, 1], atol=1e-5)

    def test_a_damper_between_two_of_them_is_in_series_with_the_springs(self) -> None:
        """Maxwell's element: its torque fades by c/b once the twist is held."""
        line = torsional_line(
            [[1.0, 0.0, 0.0, 1e9]], stiffness=[[3000.0, 1e-9, 6000.0]], damping=[[0.0, 20.0, 0.0]], input_speed=0.0
        )
        found = followed(line, 0.02, times=np.asarray([0.0, 0.01, 0.02]), angle=[0.0, 0.05, 0.05, 0.1])
        series = 1.0 / (1 / 3000.0 + 1 / 6000.0)
        fading = -0.1 * series * np.exp(-series / 20.0 * found.times)
        np.testing.assert_allclose(found.torque, fading[:, None] * np.ones(3), rtol=1e-6)

    @pytest.mark.slow
    @pytest.mark.parametrize("damping", [0.0, 3.0])
    def test_between_two_plays_it_hangs_loose_and_makes_them_one(self, damping: float) -> None:
        """Springs and dampers in series of the same ratio are a spring and a damper, their plays add up."""
        drag = [damping, 0.5 * damping]
        two = torsional_line([[1.0, 0.0, 0.5]], stiffness=[[3000.0, 1500.0]], damping=[drag], backlash=[[0.01, 0.006]])
        one = torsional_line([[1.0, 0.5]], stiffness=[[1000.0]], damping=[[damping / 3.0]], backlash=[[0.016]])
        wanted = followed(one, 0.3, times=7, speed=np.asarray([12.0, 10.0]))
        found = followed(two, 0.3, times=7, angle=[0.0, 0.001, 0.0], speed=np.asarray([12.0, 0.0, 10.0]))
        # While both hang loose the yoke is kept amid its plays by a hundred-millionth of the stiffness; with dampers
        # the two contacts do not open at one moment.
        near = 1e-6 if damping == 0.0 else 1e-3
        np.testing.assert_allclose(found.angle[:, ::2], wanted.angle, atol=near)

    @pytest.mark.slow
    def test_a_torque_that_snaps_the_joint_through_ends_it(self) -> None:
        """c_1 + c_2 T'² + t_2 T'' reaches 0: quasi-static, the load grows slowly on a light mass."""
        load = Torque(station=3, law=History(times=np.asarray([0.0, 40.0]), torques=np.asarray([0.0, -4000.0])))
        line = torsional_line(
            [[1.0, 0.0], [0.0, 1e-3]],
            stiffness=[[300.0], [300.0]],
            damping=[[0.0], [0.0]],
            ground_damping=[[0.0, 0.0], [0.0, 3.0]],
            joint_angle=[1.3],
            phase=[0.8],
            torques=[load],
            input_speed=0.0,
        )
        found = simulate(line, span=40.0, times=4001, method=ROUGH)
        assert found.status == Status.SNAPPED
        done = found.times < found.ended
        assert 0.0 < found.ended < 40.0
        assert np.all(np.isnan(found.angle[~done]))
        angle, torque = found.angle[done][-1], found.torque[done][-1]
        below = 1.0 - np.sin(1.3) ** 2 * np.cos(angle[1] + 0.8) ** 2
        first = np.cos(1.3) / below
        second = -np.cos(1.3) * np.sin(1.3) ** 2 * np.sin(2.0 * (angle[1] + 0.8)) / below**2
        assert 300.0 + 300.0 * first**2 + torque[1] * second < 0.15 * 300.0, "hardly any stiffness is left"


class TestStiffDrives:
    """A yoke of 10⁻⁶ kg m² on 10⁵ N m/rad turns a thousand times as fast as the drive."""

    def line(self, damping: float) -> TorsionalModel:
        return torsional_line(
            [[1.0, 1e-6], [0.4]], stiffness=[[1e5], []], damping=[[damping], []], joint_angle=[0.3], input_speed=50.0
        )

    @pytest.mark.slow
    def test_what_dies_out_fast_is_integrated_implicitly(self) -> None:
        stiff = torsional_line([[1.0, 1e-6, 0.4]], stiffness=[[1e5, 2e3]], damping=[[4.0, 0.0]], input_speed=50.0)
        found = followed(stiff, 0.005, times=2, angle=[0.0, 0.0, 0.01])
        assert found.method == "implicit"
        plain = followed(stiff, 0.005, times=2, angle=[0.0, 0.0, 0.01], method=replace(ROUGH, stiff=False))
        assert plain.method == "explicit"
        assert plain.steps > 10 * found.steps
        np.testing.assert_allclose(found.angle[-1], plain.angle[-1], atol=1e-7)

    def test_what_keeps_swinging_fast_is_not(self) -> None:
        """Undamped, the fast swing has to be followed either way: explicit steps are cheaper."""
        found = followed(self.line(0.0), 0.02, times=2, method=ROUGH)
        assert found.method == "explicit"


class TestHowItEnds:
    @pytest.mark.slow
    def test_a_motor_that_pushes_ever_harder_diverges_and_says_when(self) -> None:
        push = Torque(station=0, law=Falling(standstill=10.0, slope=-60.0))
        line = torsional_line([[1.0, 0.01], [0.4]], stiffness=[[1000.0], []], joint_angle=[0.43], torques=[push])
        for method in (ROUGH, FixedStep(step=8e-3, compute=Plain()), FixedStep(step=2e-3, compute=Compiled())):
            found = simulate(line, span=1.0, times=101, method=method)
            assert found.status == Status.DIVERGED
            assert 0.1 < found.ended < 1.0
            before = found.times <= found.ended
            assert np.all(np.isfinite(found.angle[before]))
            assert np.all(np.isnan(found.angle[~before]))
            assert np.isfinite(found.imbalance)

    @pytest.mark.slow
    @pytest.mark.parametrize("method", [ROUGH, FixedStep(step=5e-3, compute=Plain())])
    def test_stopping_keeps_what_is_done(self, method: Method) -> None:
        told: list[float] = []

        def progress(share: float) -> str:
            told.append(share)
            return "stop" if share > 0.5 else ""

        found = simulate(chain_model(), span=2.0, times=41, method=method, progress=progress)
        assert found.status == Status.CANCELLED
        assert told == sorted(told)
        assert 0.5 <= found.ended / 2.0 < 1.0
        before = found.times <= found.ended
        assert np.all(np.isfinite(found.torque[before]))
        assert np.all(np.isnan(found.torque[~before]))

    def test_progress_of_many_is_that_of_all(self) -> None:
        told: list[float] = []
        many = replace(chain_model(), joint_angle=np.asarray([[0.1, 0.2], [0.3, 0.4]]))
        simulate(many, span=0.05, times=2, method=ROUGH, progress=told.append)
        assert told == sorted(told)
        assert told[-1] == pytest.approx(1.0)
        assert any(abs(share - 0.5) < 1e-9 for share in told)


def chain_model() -> TorsionalModel:
    """Return the chain under a motor and a load."""
    torques = (
        Torque(station=0, law=Asynchronous(synchronous_speed=60.0, pullout_torque=200.0, pullout_slip=0.15)),
        Torque(station=6, law=Constant(value=-40.0)),
    )
    return model_of(chain(), torques)


class TestManyDrives:
    joint_angles = np.linspace(0.2, 0.6, 11)[:, None] * np.asarray([1.0, 0.8])

    @pytest.mark.slow
    @pytest.mark.parametrize("compute", [Plain(), Compiled(threads=1)])
    def test_in_fixed_steps_are_each_alone(self, compute: Plain | Compiled) -> None:
        table = SpeedTable(speeds=np.asarray([0.0, 50.0, 70.0]), torques=np.asarray([5.0, -5.0, -30.0]))
        model = replace(chain_model(), torques=(*chain_model().torques, Torque(station=2, law=table)))
        many = replace(model, joint_angle=self.joint_angles)
        way = FixedStep(step=1.5e-3, compute=compute)
        found = followed(many, 0.06, times=3, speed=55.0, method=way)
        assert found.angle.shape == (11, 3, 7)
        for k in (0, 7, 10):
            one = followed(replace(model, joint_angle=self.joint_angles[k]), 0.06, times=3, speed=55.0, method=way)
            np.testing.assert_array_equal(found.angle[k], one.angle)
            np.testing.assert_array_equal(found.extremes.torque_high[k], one.extremes.torque_high)
            assert found.work[k, -1] == one.work[-1]

    def test_adaptively_are_each_alone(self) -> None:
        torques = (Torque(station=6, law=Constant(value=np.asarray([-10.0, -40.0]))),)
        many = replace(chain_model(), torques=torques, input_speed=np.asarray([40.0, 50.0]))
        found = followed(many, 0.05, times=2, method=ROUGH)
        alone = replace(many, torques=(Torque(station=6, law=Constant(value=-40.0)),), input_speed=np.asarray(50.0))
        one = followed(alone, 0.05, times=2, method=ROUGH)
        np.testing.assert_array_equal(found.angle[1], one.angle)
        assert found.status.shape == found.ended.shape == (2,)

    def test_fixed_steps_reach_what_steps_by_their_error_reach(self) -> None:
        wanted = followed(chain_model(), 0.2, times=5, speed=55.0)
        way = FixedStep(per_period=14, compute=Compiled())
        found = followed(chain_model(), 0.2, times=5, speed=55.0, method=way)
        np.testing.assert_allclose(found.angle, wanted.angle, atol=1e-8)
        size = np.max(np.abs(wanted.extremes.torque_high))
        # Extremes in fixed steps are those of cubics through values and slopes: right to a ten-thousandth here.
        np.testing.assert_allclose(found.extremes.torque_high, wanted.extremes.torque_high, atol=1e-4 * size)
        np.testing.assert_allclose(found.extremes.speed_low, wanted.extremes.speed_low, rtol=1e-4)


@pytest.mark.parametrize("method", [Adaptive(), FixedStep(per_period=14, compute=Plain())])
def test_a_changing_input_speed_is_followed_over_its_corners(method: Method) -> None:
    """Straight and undamped: the twist behind a ramp is that of a mass pulled along, in closed form."""
    ramp = SpeedCourse(times=(0.1, 0.3), speeds=(0.0, 8.0), angle=0.5)
    line = replace(torsional_line([[1.0, 0.2]], stiffness=[[500.0]]), input_motion=ramp)
    found = followed(line, 0.5, times=np.asarray([0.0, 0.1, 0.25, 0.5]), angle=[0.0, 0.5], method=method)
    omega, pull = np.sqrt(500.0 / 0.2), 40.0 * 0.2
    np.testing.assert_allclose(found.angle[:, 0], [0.5, 0.5, 0.5 + 20.0 * 0.15**2, 0.5 + 0.8 + 1.6], atol=1e-12)
    after = pull * (1.0 - np.cos(omega * 0.15)), pull * (np.cos(omega * 0.2) - np.cos(omega * 0.4))
    np.testing.assert_allclose(found.torque[:, 0], [0.0, 0.0, *after], atol=1e-6)


class TestBadInput:
    @pytest.mark.parametrize(
        ("options", "fields"),
        [
            ({"span": 0.0}, ["span"]),
            ({"span": (1.0, np.nan)}, ["span"]),
            ({"span": 1.0, "times": [0.5, 0.2]}, ["times"]),
            ({"span": 1.0, "times": [0.5, 1.2]}, ["times"]),
            ({"span": 1.0, "angle": [1.0, 2.0], "speed": np.inf}, ["angle", "speed"]),
        ],
    )
    def test_is_named(self, options: dict[str, object], fields: list[str]) -> None:
        with pytest.raises(InputError) as caught:
            simulate(chain_model(), **options)  # type: ignore[arg-type]
        assert [problem.field for problem in caught.value.problems] == fields

    def test_methods_refuse_what_is_not_positive(self) -> None:
        with pytest.raises(InputError) as caught:
            Adaptive(rtol=0.0, atol=np.nan)
        assert [problem.field for problem in caught.value.problems] == ["rtol", "atol"]
        with pytest.raises(InputError) as caught:
            FixedStep(step=-1.0, per_period=0.0)
        assert {problem.field for problem in caught.value.problems} == {"step", "per_period"}

    def test_fixed_steps_refuse_what_they_cannot_do(self) -> None:
        with pytest.raises(InputError, match="at most"):
            simulate(chain_model(), span=1.0, method=FixedStep(step=0.05))
        line = torsional_line([[1.0, 0.0], [0.0, 0.5]], stiffness=[[4e3], [5e3]], joint_angle=[0.4], input_speed=40.0)
        with pytest.raises(InputError, match="without inertia"):
            simulate(line, span=1.0, method=FixedStep())
