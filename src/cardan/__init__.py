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
    "TransmissionError": "analysis.accuracy",
    "transmission_error": "analysis.accuracy",
    "Articulation": "analysis.articulation",
    "articulation": "analysis.articulation",
    "AssemblyForces": "analysis.assembly",
    "assembly": "analysis.assembly",
    "CriticalSpeeds": "analysis.bending",
    "bending_speeds": "analysis.bending",
    "CriticalSpeedMap": "analysis.speed_map",
    "critical_speed_map": "analysis.speed_map",
    "LossMap": "analysis.losses",
    "Losses": "analysis.losses",
    "loss_map": "analysis.losses",
    "losses": "analysis.losses",
    "Motion": "analysis.motion",
    "motion": "analysis.motion",
    "BookComparison": "analysis.book",
    "book_comparison": "analysis.book",
    "EquivalentJoint": "analysis.equivalence",
    "equivalent_joint": "analysis.equivalence",
    "Forces": "analysis.drive_forces",
    "forces": "analysis.forces",
    "Extremes": "analysis.extremes",
    "extremes": "analysis.extremes",
    "Life": "analysis.life",
    "life": "analysis.life",
    "Cycles": "analysis.rainflow",
    "Levels": "analysis.rainflow",
    "rainflow": "analysis.rainflow",
    "time_at_level": "analysis.rainflow",
    "MonteCarlo": "analysis.sampling",
    "MovingForces": "analysis.moving_forces",
    "moving_forces": "analysis.moving_forces",
    "RotorResponse": "analysis.rotor_response",
    "rotor_response": "analysis.rotor_response",
    "Balance": "analysis.shaft_balance",
    "balance": "analysis.shaft_balance",
    "Strength": "analysis.strength",
    "strength": "analysis.strength",
    "Linear": "analysis.tolerance",
    "ToleranceBand": "analysis.tolerance",
    "WorstCase": "analysis.tolerance",
    "tolerance": "analysis.tolerance",
    "TorsionModes": "analysis.torsion",
    "torsion_modes": "analysis.torsion",
    "TorsionResponse": "analysis.torsion_response",
    "torsion_response": "analysis.torsion_response",
    "Stability": "analysis.torsion_stability",
    "stability": "analysis.torsion_stability",
    "Transient": "analysis.torsion_transient",
    "transient": "analysis.torsion_transient",
    "Traces": "analysis.traces",
    "traces": "analysis.traces",
    "HarmonicBalance": "maths.periodic",
    "Shooting": "maths.pieces",
    "Adaptive": "analysis.transient",
    "FixedStep": "analysis.fixed_steps",
    "Compiled": "maths.compiled.method",
    "Plain": "maths.compiled.method",
    "FiniteMobility": "analysis.finite_mobility",
    "finite_mobility": "analysis.finite_mobility",
    "Mobility": "analysis.mobility",
    "mobility": "analysis.mobility",
    "MobilityTurn": "analysis.mobility_turn",
    "mobility_over_turn": "analysis.mobility_turn",
    "Release": "analysis.release",
    "release": "analysis.release",
    "Repair": "analysis.repair",
    "repairs": "analysis.repair",
    "JointBends": "analysis.joint_law",
    "JointTurn": "analysis.joint_law",
    "joint_bends": "analysis.joint_law",
    "joint_turn": "analysis.joint_law",
    "CHECKS": "checks.checks",
    "Verdict": "checks.verdict",
    "check": "checks.checks",
    "Channel": "diagnosis.signal",
    "Signal": "diagnosis.signal",
    "Rotation": "diagnosis.turning",
    "rotation": "diagnosis.turning",
    "OrderMap": "diagnosis.orders",
    "OrderSpectrum": "diagnosis.orders",
    "order_map": "diagnosis.orders",
    "order_spectrum": "diagnosis.orders",
    "Examination": "diagnosis.examination",
    "examine": "diagnosis.examination",
    "Expected": "diagnosis.expected",
    "expected_orders": "diagnosis.expected",
    "Finding": "diagnosis.findings",
    "diagnose": "diagnosis.findings",
    "Orbit": "diagnosis.orbit",
    "orbit": "diagnosis.orbit",
    "Runs": "diagnosis.simulate",
    "simulate_fault": "diagnosis.simulate",
    "Cepstrum": "diagnosis.spectra",
    "cepstrum": "diagnosis.spectra",
    "integrated": "diagnosis.spectra",
    "TorsionalVibration": "diagnosis.torsional",
    "torsional_vibration": "diagnosis.torsional",
    "TrackedOrders": "diagnosis.order_tracks",
    "tracked_orders": "diagnosis.order_tracks",
    "Cure": "synthesis.change",
    "cured": "synthesis.change",
    "cures": "synthesis.cure",
    "most_helpful": "synthesis.cure",
    "Absorber": "synthesis.absorber",
    "absorber": "synthesis.absorber",
    "Allocation": "synthesis.allocation",
    "allocate": "synthesis.allocation",
    "YokeAngles": "synthesis.batch",
    "synchronous_yokes": "synthesis.batch",
    "Calm": "synthesis.calm",
    "calm": "synthesis.calm",
    "Grid": "synthesis.calm_search",
    "Evolution": "synthesis.evolution",
    "LeastIntermediate": "synthesis.goal",
    "NEAREST": "synthesis.goal",
    "NearestYokes": "synthesis.goal",
    "SYNCHRONOUS": "synthesis.goal",
    "Layout": "synthesis.layout",
    "layout": "synthesis.layout",
    "Phasing": "synthesis.phases",
    "phases": "synthesis.phases",
    "YokeSetting": "synthesis.setting",
    "Candidate": "synthesis.selection",
    "Need": "synthesis.selection",
    "select_joint": "synthesis.selection",
    "need_of": "synthesis.selection_reasons",
    "Sizing": "synthesis.sized",
    "size": "synthesis.sizing",
    "TradeOff": "synthesis.trade_off",
    "trade_off": "synthesis.trade_off",
    "Centring": "synthesis.centring",
    "best_centring": "synthesis.centring",
    "PinGeometry": "synthesis.pin_geometry",
    "best_pins": "synthesis.pin_geometry",
    "pin_choices": "synthesis.pin_geometry",
    "Listed": "batch.axes",
    "Drawn": "batch.axes",
    "Spaced": "batch.axes",
    "Normal": "batch.distributions",
    "Triangular": "batch.distributions",
    "Truncated": "batch.distributions",
    "Uniform": "batch.distributions",
    "InProcess": "batch.engines",
    "Processes": "batch.engines",
    "Cluster": "batch.cluster",
    "Sweep": "batch.swept",
    "read_sweep": "batch.swept",
    "sweep": "batch.sweep",
    "Asked": "batch.asking",
    "ask_of": "batch.asking",
    "Goal": "batch.goals",
    "Limit": "batch.goals",
    "Boundary": "batch.boundary",
    "boundary": "batch.boundary",
    "Global": "batch.optimise",
    "Local": "batch.optimise",
    "Optimum": "batch.optimise",
    "optimise": "batch.optimise",
    "ParetoSet": "batch.pareto",
    "pareto_search": "batch.pareto",
    "Results": "batch.results",
    "results": "batch.results",
    "Sensitivity": "batch.sobol",
    "sensitivity": "batch.sobol",
    "Swings": "batch.sobol",
    "swings": "batch.sobol",
    "example": "io.examples",
    "example_mechanism": "io.examples",
    "load": "io.drive_file",
    "load_mechanism": "io.mechanism_file",
    "save": "io.drive_file",
    "Scene": "figures.scene_parts",
    "scene": "figures.scene",
    "signal": "io.signals",
    "report": "report.report",
}

__all__ = sorted([*_HOMES, "__version__"])

if TYPE_CHECKING:
    from .analysis.accuracy import TransmissionError as TransmissionError
    from .analysis.accuracy import transmission_error as transmission_error
    from .analysis.articulation import Articulation as Articulation
    from .analysis.articulation import articulation as articulation
    from .analysis.assembly import AssemblyForces as AssemblyForces
    from .analysis.assembly import assembly as assembly
    from .analysis.bending import CriticalSpeeds as CriticalSpeeds
    from .analysis.bending import bending_speeds as bending_speeds
    from .analysis.book import BookComparison as BookComparison
    from .analysis.book import book_comparison as book_comparison
    from .analysis.drive_forces import Forces as Forces
    from .analysis.equivalence import EquivalentJoint as EquivalentJoint
    from .analysis.equivalence import equivalent_joint as equivalent_joint
    from .analysis.extremes import Extremes as Extremes
    from .analysis.extremes import extremes as extremes
    from .analysis.finite_mobility import FiniteMobility as FiniteMobility
    from .analysis.finite_mobility import finite_mobility as finite_mobility
    from .analysis.fixed_steps import FixedStep as FixedStep
    from .analysis.forces import forces as forces
    from .analysis.joint_law import JointBends as JointBends
    from .analysis.joint_law import JointTurn as JointTurn
    from .analysis.joint_law import joint_bends as joint_bends
    from .analysis.joint_law import joint_turn as joint_turn
    from .analysis.life import Life as Life
    from .analysis.life import life as life
    from .analysis.losses import Losses as Losses
    from .analysis.losses import LossMap as LossMap
    from .analysis.losses import loss_map as loss_map
    from .analysis.losses import losses as losses
    from .analysis.mobility import Mobility as Mobility
    from .analysis.mobility import mobility as mobility
    from .analysis.mobility_turn import MobilityTurn as MobilityTurn
    from .analysis.mobility_turn import mobility_over_turn as mobility_over_turn
    from .analysis.motion import Motion as Motion
    from .analysis.motion import motion as motion
    from .analysis.moving_forces import MovingForces as MovingForces
    from .analysis.moving_forces import moving_forces as moving_forces
    from .analysis.rainflow import Cycles as Cycles
    from .analysis.rainflow import Levels as Levels
    from .analysis.rainflow import rainflow as rainflow
    from .analysis.rainflow import time_at_level as time_at_level
    from .analysis.release import Release as Release
    from .analysis.release import release as release
    from .analysis.repair import Repair as Repair
    from .analysis.repair import repairs as repairs
    from .analysis.rotor_response import RotorResponse as RotorResponse
    from .analysis.rotor_response import rotor_response as rotor_response
    from .analysis.sampling import MonteCarlo as MonteCarlo
    from .analysis.shaft_balance import Balance as Balance
    from .analysis.shaft_balance import balance as balance
    from .analysis.speed_map import CriticalSpeedMap as CriticalSpeedMap
    from .analysis.speed_map import critical_speed_map as critical_speed_map
    from .analysis.strength import Strength as Strength
    from .analysis.strength import strength as strength
    from .analysis.tolerance import Linear as Linear
    from .analysis.tolerance import ToleranceBand as ToleranceBand
    from .analysis.tolerance import WorstCase as WorstCase
    from .analysis.tolerance import tolerance as tolerance
    from .analysis.torsion import TorsionModes as TorsionModes
    from .analysis.torsion import torsion_modes as torsion_modes
    from .analysis.torsion_response import TorsionResponse as TorsionResponse
    from .analysis.torsion_response import torsion_response as torsion_response
    from .analysis.torsion_stability import Stability as Stability
    from .analysis.torsion_stability import stability as stability
    from .analysis.torsion_transient import Transient as Transient
    from .analysis.torsion_transient import transient as transient
    from .analysis.traces import Traces as Traces
    from .analysis.traces import traces as traces
    from .analysis.transient import Adaptive as Adaptive
    from .batch.asking import Asked as Asked
    from .batch.asking import ask_of as ask_of
    from .batch.axes import Drawn as Drawn
    from .batch.axes import Listed as Listed
    from .batch.axes import Spaced as Spaced
    from .batch.boundary import Boundary as Boundary
    from .batch.boundary import boundary as boundary
    from .batch.cluster import Cluster as Cluster
    from .batch.distributions import Normal as Normal
    from .batch.distributions import Triangular as Triangular
    from .batch.distributions import Truncated as Truncated
    from .batch.distributions import Uniform as Uniform
    from .batch.engines import InProcess as InProcess
    from .batch.engines import Processes as Processes
    from .batch.goals import Goal as Goal
    from .batch.goals import Limit as Limit
    from .batch.optimise import Global as Global
    from .batch.optimise import Local as Local
    from .batch.optimise import Optimum as Optimum
    from .batch.optimise import optimise as optimise
    from .batch.pareto import ParetoSet as ParetoSet
    from .batch.pareto import pareto_search as pareto_search
    from .batch.results import Results as Results
    from .batch.results import results as results
    from .batch.sobol import Sensitivity as Sensitivity
    from .batch.sobol import Swings as Swings
    from .batch.sobol import sensitivity as sensitivity
    from .batch.sobol import swings as swings
    from .batch.sweep import sweep as sweep
    from .batch.swept import Sweep as Sweep
    from .batch.swept import read_sweep as read_sweep
    from .calc.calculations import calc as calc
    from .checks.checks import CHECKS as CHECKS
    from .checks.checks import check as check
    from .checks.verdict import Verdict as Verdict
    from .diagnosis.examination import Examination as Examination
    from .diagnosis.examination import examine as examine
    from .diagnosis.expected import Expected as Expected
    from .diagnosis.expected import expected_orders as expected_orders
    from .diagnosis.findings import Finding as Finding
    from .diagnosis.findings import diagnose as diagnose
    from .diagnosis.orbit import Orbit as Orbit
    from .diagnosis.orbit import orbit as orbit
    from .diagnosis.order_tracks import TrackedOrders as TrackedOrders
    from .diagnosis.order_tracks import tracked_orders as tracked_orders
    from .diagnosis.orders import OrderMap as OrderMap
    from .diagnosis.orders import OrderSpectrum as OrderSpectrum
    from .diagnosis.orders import order_map as order_map
    from .diagnosis.orders import order_spectrum as order_spectrum
    from .diagnosis.signal import Channel as Channel
    from .diagnosis.signal import Signal as Signal
    from .diagnosis.simulate import Runs as Runs
    from .diagnosis.simulate import simulate_fault as simulate_fault
    from .diagnosis.spectra import Cepstrum as Cepstrum
    from .diagnosis.spectra import cepstrum as cepstrum
    from .diagnosis.spectra import integrated as integrated
    from .diagnosis.torsional import TorsionalVibration as TorsionalVibration
    from .diagnosis.torsional import torsional_vibration as torsional_vibration
    from .diagnosis.turning import Rotation as Rotation
    from .diagnosis.turning import rotation as rotation
    from .drive.accuracy import Tolerance as Tolerance
    from .drive.drive import Drive as Drive
    from .drive.drives import Drives as Drives
    from .drive.drives import stack as stack
    from .errors import CardanError as CardanError
    from .errors import InputError as InputError
    from .figures.scene import scene as scene
    from .figures.scene_parts import Scene as Scene
    from .io.drive_file import load as load
    from .io.drive_file import save as save
    from .io.examples import example as example
    from .io.examples import example_mechanism as example_mechanism
    from .io.mechanism_file import load_mechanism as load_mechanism
    from .io.signals import signal as signal
    from .maths.compiled.method import Compiled as Compiled
    from .maths.compiled.method import Plain as Plain
    from .maths.periodic import HarmonicBalance as HarmonicBalance
    from .maths.pieces import Shooting as Shooting
    from .mechanism.mechanism import Mechanism as Mechanism
    from .mechanism.pair import Pair as Pair
    from .report.report import report as report
    from .synthesis.absorber import Absorber as Absorber
    from .synthesis.absorber import absorber as absorber
    from .synthesis.allocation import Allocation as Allocation
    from .synthesis.allocation import allocate as allocate
    from .synthesis.batch import YokeAngles as YokeAngles
    from .synthesis.batch import synchronous_yokes as synchronous_yokes
    from .synthesis.calm import Calm as Calm
    from .synthesis.calm import calm as calm
    from .synthesis.calm_search import Grid as Grid
    from .synthesis.centring import Centring as Centring
    from .synthesis.centring import best_centring as best_centring
    from .synthesis.change import Cure as Cure
    from .synthesis.change import cured as cured
    from .synthesis.cure import cures as cures
    from .synthesis.cure import most_helpful as most_helpful
    from .synthesis.evolution import Evolution as Evolution
    from .synthesis.goal import NEAREST as NEAREST
    from .synthesis.goal import SYNCHRONOUS as SYNCHRONOUS
    from .synthesis.goal import LeastIntermediate as LeastIntermediate
    from .synthesis.goal import NearestYokes as NearestYokes
    from .synthesis.layout import Layout as Layout
    from .synthesis.layout import layout as layout
    from .synthesis.phases import Phasing as Phasing
    from .synthesis.phases import phases as phases
    from .synthesis.pin_geometry import PinGeometry as PinGeometry
    from .synthesis.pin_geometry import best_pins as best_pins
    from .synthesis.pin_geometry import pin_choices as pin_choices
    from .synthesis.selection import Candidate as Candidate
    from .synthesis.selection import Need as Need
    from .synthesis.selection import select_joint as select_joint
    from .synthesis.selection_reasons import need_of as need_of
    from .synthesis.setting import YokeSetting as YokeSetting
    from .synthesis.sized import Sizing as Sizing
    from .synthesis.sizing import size as size
    from .synthesis.trade_off import TradeOff as TradeOff
    from .synthesis.trade_off import trade_off as trade_off


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
