"""What computes: plain arrays or compiled kernels, this process, several, or a cluster."""

from .batch.engine.cluster import Cluster as Cluster
from .batch.engine.engines import InProcess as InProcess
from .batch.engine.engines import Processes as Processes
from .maths.compiled.method import Compiled as Compiled
from .maths.compiled.method import Plain as Plain
