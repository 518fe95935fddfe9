"""cardan: universal-joint (cardan, Hooke) shaft drives, analysed and designed from one description.

Python is SI and radians throughout; write ``20 * deg``. Each public name is imported on first use.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

_HOMES = {
    "CardanError": "errors",
    "InputError": "errors",
    "calc": "calc.calculations",
    "Tolerance": "drive.accuracy",
    "Drive": "drive.drive",
    "Drives": "drive.drives",
    "stack": "drive.drives",
    "Mechanism": "mechanism.mechanism",
    "Pair": "mechanism.pair",
    "TransmissionError": "questions.accuracy.accuracy",
    "transmission_error": "questions.accuracy.accuracy",
    "Articulation": "questions.motion.articulation",
    "articulation": "questions.motion.articulation",
    "AssemblyForces": "questions.forces.assembly",
    "assembly": "questions.forces.assembly",
    "CriticalSpeeds": "questions.bending.bending",
    "bending_speeds": "questions.bending.bending",
    "CriticalSpeedMap": "questions.bending.speed_map",
    "critical_speed_map": "questions.bending.speed_map",
    "LossMap": "questions.losses.losses",
    "Losses": "questions.losses.losses",
    "loss_map": "questions.losses.losses",
    "losses": "questions.losses.losses",
    "Motion": "questions.motion.motion",
    "motion": "questions.motion.motion",
    "BookComparison": "book.comparison",
    "book_comparison": "book.comparison",
    "EquivalentJoint": "questions.motion.equivalence",
    "equivalent_joint": "questions.motion.equivalence",
    "Forces": "questions.forces.drive_forces",
    "forces": "questions.forces.forces",
    "Extremes": "questions.motion.extremes",
    "extremes": "questions.motion.extremes",
    "Life": "questions.life.life",
    "life": "questions.life.life",
    "Cycles": "questions.life.rainflow",
    "Levels": "questions.life.rainflow",
    "rainflow": "questions.life.rainflow",
    "time_at_level": "questions.life.rainflow",
    "MonteCarlo": "questions.accuracy.sampling",
    "MovingForces": "questions.forces.moving_forces",
    "moving_forces": "questions.forces.moving_forces",
    "RotorResponse": "questions.bending.rotor_response",
    "rotor_response": "questions.bending.rotor_response",
    "Balance": "questions.bending.shaft_balance",
    "balance": "questions.bending.shaft_balance",
    "Strength": "checks.strength.strength",
    "strength": "checks.strength.strength",
    "Linear": "questions.accuracy.tolerance",
    "ToleranceBand": "questions.accuracy.tolerance",
    "WorstCase": "questions.accuracy.tolerance",
    "tolerance": "questions.accuracy.tolerance",
    "TorsionModes": "questions.torsion.model.torsion",
    "torsion_modes": "questions.torsion.model.torsion",
    "TorsionResponse": "questions.torsion.steady.torsion_response",
    "torsion_response": "questions.torsion.steady.torsion_response",
    "Stability": "questions.torsion.stability.torsion_stability",
    "stability": "questions.torsion.stability.torsion_stability",
    "Transient": "questions.torsion.transient.torsion_transient",
    "transient": "questions.torsion.transient.torsion_transient",
    "Traces": "questions.motion.traces",
    "traces": "questions.motion.traces",
    "HarmonicBalance": "maths.periodic.harmonics",
    "Shooting": "maths.periodic.switching_orbit",
    "Adaptive": "questions.torsion.transient.transient",
    "FixedStep": "questions.torsion.transient.fixed_steps",
    "Compiled": "maths.compiled.method",
    "Plain": "maths.compiled.method",
    "FiniteMobility": "questions.mobility.finite_mobility",
    "finite_mobility": "questions.mobility.finite_mobility",
    "Mobility": "questions.mobility.mobility",
    "mobility": "questions.mobility.mobility",
    "MobilityTurn": "questions.mobility.mobility_turn",
    "mobility_over_turn": "questions.mobility.mobility_turn",
    "Release": "questions.mobility.release",
    "release": "questions.mobility.release",
    "Repair": "questions.mobility.repair",
    "repairs": "questions.mobility.repair",
    "JointAngles": "questions.motion.joint_law",
    "JointTurn": "questions.motion.joint_law",
    "joint_angles": "questions.motion.joint_law",
    "joint_turn": "questions.motion.joint_law",
    "CHECKS": "checks.checks",
    "Verdict": "checks.verdict",
    "check": "checks.checks",
    "Channel": "questions.diagnosis.signals.signal",
    "Signal": "questions.diagnosis.signals.signal",
    "Rotation": "questions.diagnosis.signals.turning",
    "rotation": "questions.diagnosis.signals.turning",
    "OrderMap": "questions.diagnosis.signals.orders",
    "OrderSpectrum": "questions.diagnosis.signals.orders",
    "order_map": "questions.diagnosis.signals.orders",
    "order_spectrum": "questions.diagnosis.signals.orders",
    "Examination": "questions.diagnosis.examination",
    "examine": "questions.diagnosis.examination",
    "Expected": "questions.diagnosis.expected",
    "expected_orders": "questions.diagnosis.expected",
    "Finding": "questions.diagnosis.findings",
    "diagnose": "questions.diagnosis.findings",
    "Orbit": "questions.diagnosis.signals.orbit",
    "orbit": "questions.diagnosis.signals.orbit",
    "Runs": "questions.diagnosis.simulate",
    "simulate_fault": "questions.diagnosis.simulate",
    "Cepstrum": "questions.diagnosis.signals.spectra",
    "cepstrum": "questions.diagnosis.signals.spectra",
    "integrated": "questions.diagnosis.signals.spectra",
    "TorsionalVibration": "questions.diagnosis.signals.torsional",
    "torsional_vibration": "questions.diagnosis.signals.torsional",
    "TrackedOrders": "questions.diagnosis.signals.order_tracks",
    "tracked_orders": "questions.diagnosis.signals.order_tracks",
    "Remedy": "choices.change",
    "apply_remedy": "choices.change",
    "remedies": "choices.remedy",
    "most_helpful": "choices.remedy",
    "Absorber": "questions.torsion.absorber.absorber",
    "absorber": "questions.torsion.absorber.absorber",
    "Allocation": "questions.accuracy.allocation",
    "allocate": "questions.accuracy.allocation",
    "YokeAngles": "questions.phases.batch",
    "synchronous_yokes": "questions.phases.batch",
    "Calm": "questions.torsion.calm.calm",
    "calm": "questions.torsion.calm.calm",
    "Grid": "questions.torsion.calm.calm_search",
    "Evolution": "maths.curves.evolution",
    "LeastIntermediate": "questions.phases.goal",
    "NEAREST": "questions.phases.goal",
    "NearestYokes": "questions.phases.goal",
    "SYNCHRONOUS": "questions.phases.goal",
    "Layout": "questions.phases.layout",
    "layout": "questions.phases.layout",
    "Phasing": "questions.phases.phases",
    "phases": "questions.phases.phases",
    "YokeSetting": "questions.phases.setting",
    "Candidate": "choices.selection",
    "Need": "choices.selection",
    "select_joint": "choices.selection",
    "need_of": "choices.selection_reasons",
    "Sizing": "choices.sized",
    "size": "choices.sizing",
    "TradeOff": "choices.trade_off",
    "trade_off": "choices.trade_off",
    "Centring": "formulas.centring",
    "best_centring": "formulas.centring",
    "PinGeometry": "formulas.pin_geometry",
    "best_pins": "formulas.pin_geometry",
    "pin_choices": "formulas.pin_geometry",
    "Listed": "batch.points.axes",
    "Drawn": "batch.points.axes",
    "Spaced": "batch.points.axes",
    "Normal": "batch.points.distributions",
    "Triangular": "batch.points.distributions",
    "Truncated": "batch.points.distributions",
    "Uniform": "batch.points.distributions",
    "InProcess": "batch.engine.engines",
    "Processes": "batch.engine.engines",
    "Cluster": "batch.engine.cluster",
    "Sweep": "batch.table.swept",
    "read_sweep": "batch.table.swept",
    "sweep": "batch.sweep",
    "Asked": "batch.answering.asking",
    "ask_of": "batch.answering.asking",
    "Goal": "batch.search.goals",
    "Limit": "batch.search.goals",
    "Boundary": "batch.search.boundary",
    "boundary": "batch.search.boundary",
    "Global": "batch.search.optimise",
    "Local": "batch.search.optimise",
    "Optimum": "batch.search.optimise",
    "optimise": "batch.search.optimise",
    "ParetoSet": "batch.search.pareto",
    "pareto_search": "batch.search.pareto",
    "Results": "batch.table.results",
    "results": "batch.table.results",
    "Sensitivity": "batch.search.sobol",
    "sensitivity": "batch.search.sobol",
    "Swings": "batch.search.sobol",
    "swings": "batch.search.sobol",
    "example": "io.examples",
    "example_mechanism": "io.examples",
    "load": "io.drive_file",
    "load_mechanism": "io.mechanism_file",
    "save": "io.drive_file",
    "Scene": "scene.parts",
    "scene": "scene.scene",
    "signal": "io.signals",
    "report": "report.report",
}

__all__ = sorted([*_HOMES, "__version__"])

if TYPE_CHECKING:
    from .batch.answering.asking import Asked as Asked
    from .batch.answering.asking import ask_of as ask_of
    from .batch.engine.cluster import Cluster as Cluster
    from .batch.engine.engines import InProcess as InProcess
    from .batch.engine.engines import Processes as Processes
    from .batch.points.axes import Drawn as Drawn
    from .batch.points.axes import Listed as Listed
    from .batch.points.axes import Spaced as Spaced
    from .batch.points.distributions import Normal as Normal
    from .batch.points.distributions import Triangular as Triangular
    from .batch.points.distributions import Truncated as Truncated
    from .batch.points.distributions import Uniform as Uniform
    from .batch.search.boundary import Boundary as Boundary
    from .batch.search.boundary import boundary as boundary
    from .batch.search.goals import Goal as Goal
    from .batch.search.goals import Limit as Limit
    from .batch.search.optimise import Global as Global
    from .batch.search.optimise import Local as Local
    from .batch.search.optimise import Optimum as Optimum
    from .batch.search.optimise import optimise as optimise
    from .batch.search.pareto import ParetoSet as ParetoSet
    from .batch.search.pareto import pareto_search as pareto_search
    from .batch.search.sobol import Sensitivity as Sensitivity
    from .batch.search.sobol import Swings as Swings
    from .batch.search.sobol import sensitivity as sensitivity
    from .batch.search.sobol import swings as swings
    from .batch.sweep import sweep as sweep
    from .batch.table.results import Results as Results
    from .batch.table.results import results as results
    from .batch.table.swept import Sweep as Sweep
    from .batch.table.swept import read_sweep as read_sweep
    from .book.comparison import BookComparison as BookComparison
    from .book.comparison import book_comparison as book_comparison
    from .calc.calculations import calc as calc
    from .checks.checks import CHECKS as CHECKS
    from .checks.checks import check as check
    from .checks.strength.strength import Strength as Strength
    from .checks.strength.strength import strength as strength
    from .checks.verdict import Verdict as Verdict
    from .choices.change import Remedy as Remedy
    from .choices.change import apply_remedy as apply_remedy
    from .choices.remedy import most_helpful as most_helpful
    from .choices.remedy import remedies as remedies
    from .choices.selection import Candidate as Candidate
    from .choices.selection import Need as Need
    from .choices.selection import select_joint as select_joint
    from .choices.selection_reasons import need_of as need_of
    from .choices.sized import Sizing as Sizing
    from .choices.sizing import size as size
    from .choices.trade_off import TradeOff as TradeOff
    from .choices.trade_off import trade_off as trade_off
    from .drive.accuracy import Tolerance as Tolerance
    from .drive.drive import Drive as Drive
    from .drive.drives import Drives as Drives
    from .drive.drives import stack as stack
    from .errors import CardanError as CardanError
    from .errors import InputError as InputError
    from .formulas.centring import Centring as Centring
    from .formulas.centring import best_centring as best_centring
    from .formulas.pin_geometry import PinGeometry as PinGeometry
    from .formulas.pin_geometry import best_pins as best_pins
    from .formulas.pin_geometry import pin_choices as pin_choices
    from .io.drive_file import load as load
    from .io.drive_file import save as save
    from .io.examples import example as example
    from .io.examples import example_mechanism as example_mechanism
    from .io.mechanism_file import load_mechanism as load_mechanism
    from .io.signals import signal as signal
    from .maths.compiled.method import Compiled as Compiled
    from .maths.compiled.method import Plain as Plain
    from .maths.curves.evolution import Evolution as Evolution
    from .maths.periodic.harmonics import HarmonicBalance as HarmonicBalance
    from .maths.periodic.switching_orbit import Shooting as Shooting
    from .mechanism.mechanism import Mechanism as Mechanism
    from .mechanism.pair import Pair as Pair
    from .questions.accuracy.accuracy import TransmissionError as TransmissionError
    from .questions.accuracy.accuracy import transmission_error as transmission_error
    from .questions.accuracy.allocation import Allocation as Allocation
    from .questions.accuracy.allocation import allocate as allocate
    from .questions.accuracy.sampling import MonteCarlo as MonteCarlo
    from .questions.accuracy.tolerance import Linear as Linear
    from .questions.accuracy.tolerance import ToleranceBand as ToleranceBand
    from .questions.accuracy.tolerance import WorstCase as WorstCase
    from .questions.accuracy.tolerance import tolerance as tolerance
    from .questions.bending.bending import CriticalSpeeds as CriticalSpeeds
    from .questions.bending.bending import bending_speeds as bending_speeds
    from .questions.bending.rotor_response import RotorResponse as RotorResponse
    from .questions.bending.rotor_response import rotor_response as rotor_response
    from .questions.bending.shaft_balance import Balance as Balance
    from .questions.bending.shaft_balance import balance as balance
    from .questions.bending.speed_map import CriticalSpeedMap as CriticalSpeedMap
    from .questions.bending.speed_map import critical_speed_map as critical_speed_map
    from .questions.diagnosis.examination import Examination as Examination
    from .questions.diagnosis.examination import examine as examine
    from .questions.diagnosis.expected import Expected as Expected
    from .questions.diagnosis.expected import expected_orders as expected_orders
    from .questions.diagnosis.findings import Finding as Finding
    from .questions.diagnosis.findings import diagnose as diagnose
    from .questions.diagnosis.signals.orbit import Orbit as Orbit
    from .questions.diagnosis.signals.orbit import orbit as orbit
    from .questions.diagnosis.signals.order_tracks import TrackedOrders as TrackedOrders
    from .questions.diagnosis.signals.order_tracks import tracked_orders as tracked_orders
    from .questions.diagnosis.signals.orders import OrderMap as OrderMap
    from .questions.diagnosis.signals.orders import OrderSpectrum as OrderSpectrum
    from .questions.diagnosis.signals.orders import order_map as order_map
    from .questions.diagnosis.signals.orders import order_spectrum as order_spectrum
    from .questions.diagnosis.signals.signal import Channel as Channel
    from .questions.diagnosis.signals.signal import Signal as Signal
    from .questions.diagnosis.signals.spectra import Cepstrum as Cepstrum
    from .questions.diagnosis.signals.spectra import cepstrum as cepstrum
    from .questions.diagnosis.signals.spectra import integrated as integrated
    from .questions.diagnosis.signals.torsional import TorsionalVibration as TorsionalVibration
    from .questions.diagnosis.signals.torsional import torsional_vibration as torsional_vibration
    from .questions.diagnosis.signals.turning import Rotation as Rotation
    from .questions.diagnosis.signals.turning import rotation as rotation
    from .questions.diagnosis.simulate import Runs as Runs
    from .questions.diagnosis.simulate import simulate_fault as simulate_fault
    from .questions.forces.assembly import AssemblyForces as AssemblyForces
    from .questions.forces.assembly import assembly as assembly
    from .questions.forces.drive_forces import Forces as Forces
    from .questions.forces.forces import forces as forces
    from .questions.forces.moving_forces import MovingForces as MovingForces
    from .questions.forces.moving_forces import moving_forces as moving_forces
    from .questions.life.life import Life as Life
    from .questions.life.life import life as life
    from .questions.life.rainflow import Cycles as Cycles
    from .questions.life.rainflow import Levels as Levels
    from .questions.life.rainflow import rainflow as rainflow
    from .questions.life.rainflow import time_at_level as time_at_level
    from .questions.losses.losses import Losses as Losses
    from .questions.losses.losses import LossMap as LossMap
    from .questions.losses.losses import loss_map as loss_map
    from .questions.losses.losses import losses as losses
    from .questions.mobility.finite_mobility import FiniteMobility as FiniteMobility
    from .questions.mobility.finite_mobility import finite_mobility as finite_mobility
    from .questions.mobility.mobility import Mobility as Mobility
    from .questions.mobility.mobility import mobility as mobility
    from .questions.mobility.mobility_turn import MobilityTurn as MobilityTurn
    from .questions.mobility.mobility_turn import mobility_over_turn as mobility_over_turn
    from .questions.mobility.release import Release as Release
    from .questions.mobility.release import release as release
    from .questions.mobility.repair import Repair as Repair
    from .questions.mobility.repair import repairs as repairs
    from .questions.motion.articulation import Articulation as Articulation
    from .questions.motion.articulation import articulation as articulation
    from .questions.motion.equivalence import EquivalentJoint as EquivalentJoint
    from .questions.motion.equivalence import equivalent_joint as equivalent_joint
    from .questions.motion.extremes import Extremes as Extremes
    from .questions.motion.extremes import extremes as extremes
    from .questions.motion.joint_law import JointAngles as JointAngles
    from .questions.motion.joint_law import JointTurn as JointTurn
    from .questions.motion.joint_law import joint_angles as joint_angles
    from .questions.motion.joint_law import joint_turn as joint_turn
    from .questions.motion.motion import Motion as Motion
    from .questions.motion.motion import motion as motion
    from .questions.motion.traces import Traces as Traces
    from .questions.motion.traces import traces as traces
    from .questions.phases.batch import YokeAngles as YokeAngles
    from .questions.phases.batch import synchronous_yokes as synchronous_yokes
    from .questions.phases.goal import NEAREST as NEAREST
    from .questions.phases.goal import SYNCHRONOUS as SYNCHRONOUS
    from .questions.phases.goal import LeastIntermediate as LeastIntermediate
    from .questions.phases.goal import NearestYokes as NearestYokes
    from .questions.phases.layout import Layout as Layout
    from .questions.phases.layout import layout as layout
    from .questions.phases.phases import Phasing as Phasing
    from .questions.phases.phases import phases as phases
    from .questions.phases.setting import YokeSetting as YokeSetting
    from .questions.torsion.absorber.absorber import Absorber as Absorber
    from .questions.torsion.absorber.absorber import absorber as absorber
    from .questions.torsion.calm.calm import Calm as Calm
    from .questions.torsion.calm.calm import calm as calm
    from .questions.torsion.calm.calm_search import Grid as Grid
    from .questions.torsion.model.torsion import TorsionModes as TorsionModes
    from .questions.torsion.model.torsion import torsion_modes as torsion_modes
    from .questions.torsion.stability.torsion_stability import Stability as Stability
    from .questions.torsion.stability.torsion_stability import stability as stability
    from .questions.torsion.steady.torsion_response import TorsionResponse as TorsionResponse
    from .questions.torsion.steady.torsion_response import torsion_response as torsion_response
    from .questions.torsion.transient.fixed_steps import FixedStep as FixedStep
    from .questions.torsion.transient.torsion_transient import Transient as Transient
    from .questions.torsion.transient.torsion_transient import transient as transient
    from .questions.torsion.transient.transient import Adaptive as Adaptive
    from .report.report import report as report
    from .scene.parts import Scene as Scene
    from .scene.scene import scene as scene


class _Package(ModuleType):
    """Some questions share their name with the subpackage they live in; importing that must not hide them."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in _HOMES or not isinstance(value, ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'cardan' has no attribute {name!r}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)


def __dir__() -> list[str]:
    return __all__
