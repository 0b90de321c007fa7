"""The laws that compiled code calls as they stand in their own files: one implementation for both."""

from __future__ import annotations

from typing import Any

from auv_path_following.control import nism
from auv_path_following.control.hull_model import HullModel
from auv_path_following.control.reference_model import ReferenceModel
from auv_path_following.guidance import acceptance, adaptive_lookahead, ailos, virtual_point
from auv_path_following.guidance import approach as guidance_approach
from auv_path_following.guidance.ailos import Ailos
from auv_path_following.guidance.los import Los
from auv_sim.batch.compiled import part, take_over_pure
from auv_sim.plant import remus
from auv_sim.plant.remus import RemusDynamics

is_at = part(guidance_approach.is_at)
path_errors = part(virtual_point.path_errors)
saturated = part(virtual_point.saturated)
tangential_speed = part(virtual_point.tangential_speed)
crab_angle = part(acceptance.crab_angle)
acceptance_radius = part(acceptance.acceptance_radius)
adaptive_delta = part(adaptive_lookahead.adaptive_lookahead)
adaptive_offset = part(ailos.adaptive_offset)
rudder_rate: Any = part(nism.rudder_rate)
moved = part(remus.moved)

# Methods that only read their object: `numbers` has what stands in its place.
ailos_update: Any = part(Ailos.update)
los_update: Any = part(Los.update)
approach: Any = part(ReferenceModel.approach)
derivative: Any = part(RemusDynamics.derivative)
accelerations: Any = part(HullModel.accelerations)
rudder_gain: Any = part(HullModel.rudder_gain)

take_over_pure()
