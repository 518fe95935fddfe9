"""How it is found: periodic motions, steps in time, tolerances, searches, goals of phasing, the books' series."""

from .book.comparison import BookComparison as BookComparison
from .book.comparison import book_comparison as book_comparison
from .maths.curves.search import Evolution as Evolution
from .maths.periodic.harmonics import HarmonicBalance as HarmonicBalance
from .maths.periodic.switching_orbit import Shooting as Shooting
from .questions.accuracy.sampling import MonteCarlo as MonteCarlo
from .questions.accuracy.tolerance import Linear as Linear
from .questions.accuracy.tolerance import WorstCase as WorstCase
from .questions.phases.setting import NEAREST as NEAREST
from .questions.phases.setting import SYNCHRONOUS as SYNCHRONOUS
from .questions.phases.setting import LeastIntermediate as LeastIntermediate
from .questions.phases.setting import NearestYokes as NearestYokes
from .questions.torsion.optimise.optimise import Grid as Grid
from .questions.torsion.transient.fixed_steps import FixedStep as FixedStep
from .questions.torsion.transient.transient import Adaptive as Adaptive
