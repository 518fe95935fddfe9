"""Mechanisms of links and pairs: mobility, motion and forces, which constraints to release."""

from .io.drive_file import load_mechanism as load_mechanism
from .io.examples import example_mechanism as example_mechanism
from .mechanism.load import LinkMass as LinkMass
from .mechanism.load import Load as Load
from .mechanism.mechanism import Mechanism as Mechanism
from .mechanism.mechanism import Pair as Pair
from .questions.mechanism.forces import MechanismForces as MechanismForces
from .questions.mechanism.forces import mechanism_forces as mechanism_forces
from .questions.mechanism.motion import LinkMotion as LinkMotion
from .questions.mechanism.motion import MechanismMotion as MechanismMotion
from .questions.mechanism.motion import mechanism_motion as mechanism_motion
from .questions.mobility.constraint_release import Release as Release
from .questions.mobility.constraint_release import Repair as Repair
from .questions.mobility.constraint_release import release as release
from .questions.mobility.constraint_release import repairs as repairs
from .questions.mobility.finite_mobility import FiniteMobility as FiniteMobility
from .questions.mobility.finite_mobility import MobilityTurn as MobilityTurn
from .questions.mobility.finite_mobility import finite_mobility as finite_mobility
from .questions.mobility.finite_mobility import mobility_over_turn as mobility_over_turn
