"""The simulated vehicle that dives behind a planted driver; time comes from outside."""

from __future__ import annotations

import dataclasses
import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from auv_msgs_py.contract.frames import swap_axes
from auv_msgs_py.values.attitude import quaternion_of, turned_over
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand, SpatialCurrent
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.planted import COMMAND_TIMEOUT, PERIOD
from auv_sim.checks.vehicle_check.planted_divers import FARTHEST, PlantedDiver
from auv_sim.checks.vehicle_check.samples import OdometrySample, RangeSample, WaterSample
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.sea import Sea

CURRENT = SpatialCurrent(0.12, -0.08, 0.02)
#: The start: place, m, and heading, rad; the depth of the bottom, and the least range of the altimeter, m.
PLACE, HEADING, BOTTOM, NEAREST = (10.0, 30.0), math.radians(25.0), 30.0, 0.5


@dataclass(frozen=True)
class DiverSamples:
    """What a driver publishes at one time; None: not fitted."""

    odom: OdometrySample
    water: WaterSample
    rudder: float
    planes: float | None
    altitude: RangeSample | None


class PlantedDivingVehicle:
    """The simulated vehicle behind one of these drivers; time comes from outside, s.

    Args:
        planted: the driver.
        vehicle: the hull.
        begin: the time it begins with.
        sea, seed: of its instruments; an ideal sea by default.
    """

    def __init__(
        self, planted: PlantedDiver, vehicle: Vehicle, begin: float, sea: Sea | None = None, seed: int = 0
    ) -> None:
        assert vehicle.sternplanes is not None
        rate = planted.planes_rate * vehicle.sternplanes.max_rate_deg_s
        hull = dataclasses.replace(
            vehicle, sternplanes=dataclasses.replace(vehicle.sternplanes, max_rate_deg_s=rate)
        )
        start = BodyState(
            *PLACE, planted.depth, *quaternion_of(0.0, 0.0, HEADING), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        )
        self.planted = planted
        self.plant = SimulatedDiver(hull, start, sea, seed, CURRENT, PERIOD)
        self._now = self._next = begin
        self._count = 0
        self._under_way: deque[tuple[float, SpatialCommand]] = deque()
        self._command, self._commanded_at = SPATIAL_STOP, begin
        #: In its launching tube until the first thrust.
        self.moving = False

    def order(self, command: SpatialCommand) -> None:
        """Take a command that arrives now."""
        self._under_way.append((self._now + self.planted.dead_time, self.planted.command(command)))

    def live(self, until: float) -> list[DiverSamples]:
        """Let time pass until `until`, s, and return what is published meanwhile."""
        samples = []
        while self._next <= until + 1e-9:
            while self._under_way and self._under_way[0][0] <= self._now + 1e-9:
                self._command, self._commanded_at = self._under_way.popleft()[1], self._now
            silent = self._now - self._commanded_at > COMMAND_TIMEOUT
            self.moving = self.moving or self._command.thrust > 0.0
            if self.moving and self._next > self._now:
                self.plant.advance(SPATIAL_STOP if silent else self._command, PERIOD)
            self._now = self._next
            samples.append(self._measure())
            self._next += PERIOD
        return samples

    def _measure(self) -> DiverSamples:
        self._count += 1
        now, count, planted, plant = self._now, self._count, self.planted, self.plant
        n, motion = plant.navigation, plant.motion
        east, north = swap_axes(n.x, n.y)
        qw, qx, qy, qz = turned_over(*quaternion_of(n.phi, n.theta, n.psi))
        (u, v, w), water = plant.ground_velocity, plant.water_velocity
        if not self.moving:
            u, v, w, water = 0.0, 0.0, 0.0, water._replace(ur=0.0, vr=0.0, wr=0.0)
        odom = OdometrySample(
            now, now, "map", "base_link", east, north, (qx, qy, qz, qw), u, -v, -n.r, z=-n.z, w=-w,
            p=motion.p, q=-n.q,
        )  # fmt: skip
        through = WaterSample(now, now, "base_link", water.ur, -water.vr, w=-water.wr)
        echo = None
        if planted.altitude is not None:
            found = plant.altitude
            if math.isnan(found):  # an ideal sea has no altimeter
                found = (BOTTOM - motion.z) / (math.cos(n.phi) * math.cos(n.theta))
            given = float(np.float32(planted.altitude(found, motion.z, count)))
            echo = RangeSample(now, now, given, NEAREST, FARTHEST)
        return DiverSamples(
            planted.odom(odom, count), planted.water(through, count), plant.rudder,
            None if planted.bare else planted.state(plant.sternplanes), echo,
        )  # fmt: skip
