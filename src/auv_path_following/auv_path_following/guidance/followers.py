"""The steps of guidance for either kind of follower, planar or spatial, chosen by its configuration."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import dispatched, pure
from auv_path_following.guidance import follow as planar
from auv_path_following.guidance.follow import FollowerConfig, GuidanceOutput
from auv_path_following.guidance.measured import Measured, SpatialMeasured
from auv_path_following.guidance.spatial import spatial_follow as spatial
from auv_path_following.guidance.spatial.spatial_follow import SpatialOutput
from auv_path_following.guidance.spatial.spatial_follower import SpatialFollower
from auv_path_following.missions.limits import LimitsInputs


@pure
def planar_state(
    config: FollowerConfig, measured: Measured, output: GuidanceOutput, holds: bool, rests: bool
) -> LimitsInputs:
    """Return what the limits judge of a planar vehicle."""
    navigation, off = measured.navigation, math.hypot(output.xe, output.ye)
    return LimitsInputs(navigation.x, navigation.y, 0.0, off, 0.0, math.inf, measured.to_go, holds, rests)


@pure
def spatial_state(
    config: SpatialFollower, measured: SpatialMeasured, output: SpatialOutput, holds: bool, rests: bool
) -> LimitsInputs:
    """Return what the limits judge of a vehicle that dives."""
    (x, y, z, phi, theta, _, _, _), altitude = measured.navigation, measured.altitude
    off = math.sqrt(output.xe * output.xe + output.ye * output.ye + output.ze * output.ze)
    if altitude <= 0.0:  # too close to be measured
        altitude = 0.0
    elif not altitude > 0.0:  # NaN: no altimeter
        altitude = math.inf
    altitude *= math.cos(phi) * math.cos(theta)
    return LimitsInputs(x, y, z, off, z - output.depth, altitude, measured.to_go, holds, rests)


follower_begins = dispatched({FollowerConfig: planar.first_state, SpatialFollower: spatial.first_state})
follow_step = dispatched({FollowerConfig: planar.follow, SpatialFollower: spatial.follow_spatial})
look_step = dispatched({FollowerConfig: planar.look, SpatialFollower: spatial.look_spatial})
rejoin_step = dispatched({FollowerConfig: planar.rejoin, SpatialFollower: spatial.rejoin_spatial})
#: What the limits judge: (configuration, measurement, output, holds, rests) -> `LimitsInputs`.
limits_inputs = dispatched({FollowerConfig: planar_state, SpatialFollower: spatial_state})
