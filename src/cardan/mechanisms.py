"""Mechanisms of links and pairs: their mobility, how they turn, which constraints to release."""

from .io.drive_file import load_mechanism as load_mechanism
from .io.examples import example_mechanism as example_mechanism
from .mechanism.mechanism import Mechanism as Mechanism
from .mechanism.mechanism import Pair as Pair
from .questions.mobility.constraint_release import Release as Release
from .questions.mobility.constraint_release import Repair as Repair
from .questions.mobility.constraint_release import release as release
from .questions.mobility.constraint_release import repairs as repairs
from .questions.mobility.finite_mobility import FiniteMobility as FiniteMobility
from .questions.mobility.finite_mobility import MobilityTurn as MobilityTurn
from .questions.mobility.finite_mobility import finite_mobility as finite_mobility
from .questions.mobility.finite_mobility import mobility_over_turn as mobility_over_turn
