"""Joints by themselves: their kinds, how they turn, which to take for a duty."""

from .choices.selection import Candidate as Candidate
from .choices.selection import JointDuty as JointDuty
from .choices.selection import joint_duty as joint_duty
from .choices.selection import select_joint as select_joint
from .drive.joints import Hooke as Hooke
from .drive.joints import Joint as Joint
from .drive.joints.clemens import Clemens as Clemens
from .drive.joints.constant_velocity import ConstantVelocity as ConstantVelocity
from .drive.joints.double_cardan import DoubleCardan as DoubleCardan
from .drive.joints.half_cardan import ElasticHalfCardan as ElasticHalfCardan
from .drive.joints.half_cardan import HalfCardan as HalfCardan
from .drive.joints.offset_cross import OffsetCross as OffsetCross
from .drive.joints.pin_coupling import PinCoupling as PinCoupling
from .drive.joints.rzeppa import Rzeppa as Rzeppa
from .drive.joints.tracta import Tracta as Tracta
from .drive.joints.tripod import Tripod as Tripod
from .drive.joints.weiss import Weiss as Weiss
from .formulas.joint_geometry import Centring as Centring
from .formulas.joint_geometry import PinGeometry as PinGeometry
from .formulas.joint_geometry import best_centring as best_centring
from .formulas.joint_geometry import best_pins as best_pins
from .formulas.joint_geometry import pin_choices as pin_choices
from .questions.motion.joint_law import JointAngles as JointAngles
from .questions.motion.joint_law import JointTurn as JointTurn
from .questions.motion.joint_law import joint_over_angles as joint_over_angles
from .questions.motion.joint_law import joint_turn as joint_turn
