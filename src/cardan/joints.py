"""Joints by themselves: their kinds, how they turn, which to take for a duty."""

from .choices.selection import Candidate as Candidate
from .choices.selection import JointDuty as JointDuty
from .choices.selection import joint_duty as joint_duty
from .choices.selection import select_joint as select_joint
from .drive.joints import Clemens as Clemens
from .drive.joints import ConstantVelocity as ConstantVelocity
from .drive.joints import DoubleCardan as DoubleCardan
from .drive.joints import ElasticHalfCardan as ElasticHalfCardan
from .drive.joints import HalfCardan as HalfCardan
from .drive.joints import Hooke as Hooke
from .drive.joints import Joint as Joint
from .drive.joints import OffsetCross as OffsetCross
from .drive.joints import PinCoupling as PinCoupling
from .drive.joints import Rzeppa as Rzeppa
from .drive.joints import Tracta as Tracta
from .drive.joints import Tripod as Tripod
from .drive.joints import Weiss as Weiss
from .formulas.joint_geometry import Centring as Centring
from .formulas.joint_geometry import PinGeometry as PinGeometry
from .formulas.joint_geometry import best_centring as best_centring
from .formulas.joint_geometry import best_pins as best_pins
from .formulas.joint_geometry import pin_choices as pin_choices
from .questions.motion.joint_law import JointAngles as JointAngles
from .questions.motion.joint_law import JointTurn as JointTurn
from .questions.motion.joint_law import joint_over_angles as joint_over_angles
from .questions.motion.joint_law import joint_turn as joint_turn
