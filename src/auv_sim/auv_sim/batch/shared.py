"""The laws that compiled code calls as they stand in their own files: one implementation for both."""

from __future__ import annotations

from auv_path_following.control import autopilot  # noqa: F401 - its pure functions
from auv_path_following.guidance import acceptance, virtual_point
from auv_path_following.guidance import approach as guidance_approach
from auv_sim.batch.compiled import part, take_over_pure
from auv_sim.plant import remus  # noqa: F401 - its pure functions

is_at = part(guidance_approach.is_at)
path_errors = part(virtual_point.path_errors)
saturated = part(virtual_point.saturated)
tangential_speed = part(virtual_point.tangential_speed)
crab_angle = part(acceptance.crab_angle)
acceptance_radius = part(acceptance.acceptance_radius)

take_over_pure()
