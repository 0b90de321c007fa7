"""The parameters of the node that flies manoeuvres."""

from __future__ import annotations

from auv_msgs_py.settings.schema import setting, settings
from auv_path_following.parameters import NavigationParameters
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import DEPTH, ManoeuvreBounds


@settings
class ManoeuvresParameters(NavigationParameters):
    """manoeuvres. It steers the vehicle in place of guidance and autopilot."""

    program: str = setting("two_minutes", "program of manoeuvres, or the name of a shipped one")
    consent: bool = setting(False, "the vehicle may move; without it the node ends at once")
    depth: float = setting(
        DEPTH, "depth to go to and to hold, of a vehicle with stern planes", unit="m", ge=0.0
    )
    look_around: float = setting(
        5.0, "time of looking for other publishers, after the first odometry and before anything is sent",
        unit="s", ge=0.0, le=60.0,
    )  # fmt: skip
    bounds: ManoeuvreBounds = setting(factory=ManoeuvreBounds, doc="bounds that end the program")
