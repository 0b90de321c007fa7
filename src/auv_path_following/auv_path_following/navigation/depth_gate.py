"""Gate for the odometry of a vehicle that dives: place and heading, then depth. ROS-free."""

from __future__ import annotations

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.attitude import level_of
from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following.navigation.navigation_gate import (
    Judgement,
    NavigationGate,
    NavigationGateConfig,
    Passed,
)
from auv_path_following.vehicle import Vehicle


@settings
class DepthGateConfig:
    """Bounds of a plausible depth, for vehicles with stern planes; `gate.enabled` switches them, too."""

    depth_margin: float = setting(
        2.0, "largest jump of the depth beyond what the vehicle's top speed explains", unit="m", ge=0.0,
        live=True,
    )  # fmt: skip
    above_surface: float = setting(
        3.0, "largest height above the surface: waves, tide, offset of the sensor; more is never accepted",
        unit="m", ge=0.0, live=True,
    )  # fmt: skip
    flat_after: float = setting(
        3.0,
        "depth, roll and pitch of exactly 0 for this long under way are refused: the odometry is planar",
        unit="s", ge=0.1, live=True,
    )  # fmt: skip


_ACCEPTED = Judgement(Passed.ACCEPTED)


class DepthGate:
    """Compare each depth with the accepted ones before it, as `NavigationGate` does with positions.

    Args:
        config: bounds.
        speed: largest vertical speed, m/s.
        accept_after: depths at a new place that agree for this long are accepted, s.
    """

    def __init__(self, config: DepthGateConfig, speed: float, accept_after: float) -> None:
        self.config, self.speed, self.accept_after = config, speed, accept_after
        self.reset()

    def reset(self) -> None:
        """Forget all depths; the next one is the first."""
        self._last: float | None = None
        self._other: float | None = None
        self._since = self._since_other = self._agreed = self._flat = 0.0

    def wait(self, dt: float) -> None:
        """Let `dt` s pass without an accepted depth."""
        self._since += dt
        self._since_other += dt

    def judge(self, navigation: SpatialNavigation, dt: float, under_way: bool) -> Judgement:
        """Judge a depth; arguments as those of `NavigationGate.judge`."""
        c, z = self.config, navigation.z
        self.wait(dt)
        if z < -c.above_surface:
            expected = f"at most {c.above_surface:g} m above the surface: z is up in ENU, and down in NED"
            return Judgement(Passed.REFUSED, f"a depth of {z:.1f} m", expected)
        is_flat = z == 0.0 and navigation.phi == 0.0 and navigation.theta == 0.0
        # What began under way counts until a value changes, even if the vehicle stops.
        self._flat = self._flat + dt if is_flat and (under_way or self._flat > 0.0) else 0.0
        if self._flat >= c.flat_after:
            found = f"depth, roll and pitch of exactly 0 for {self._flat:.1f} s under way"
            return Judgement(Passed.REFUSED, found, "the odometry of a vehicle with stern planes")
        last, since = self._last, self._since
        if last is None or abs(z - last) <= c.depth_margin + self.speed * since:
            self._accept(z)
            return _ACCEPTED
        found = f"a depth {abs(z - last):.1f} m from the last accepted one"
        expected = f"at most {c.depth_margin + self.speed * since:.1f} m after {since:.2f} s"
        other = self._other
        if other is None or abs(z - other) > c.depth_margin + self.speed * self._since_other:
            self._agreed = 0.0
        else:
            self._agreed += dt
        self._other, self._since_other = z, 0.0
        if self._agreed < self.accept_after:
            return Judgement(Passed.REFUSED, found, expected)
        self._accept(z)
        return Judgement(Passed.MOVED, found, expected)

    def _accept(self, z: float) -> None:
        self._last, self._other = z, None
        self._since = self._since_other = self._agreed = 0.0


class SpatialGate:
    """The gate of a vehicle that dives: place and heading, then depth.

    Args:
        config, depth: bounds.
        top_speed: of the vehicle through the water, m/s.
    """

    def __init__(self, config: NavigationGateConfig, depth: DepthGateConfig, top_speed: float) -> None:
        self._level = NavigationGate(config, top_speed)
        self._depth = DepthGate(depth, top_speed, config.accept_after)
        self._moved: Judgement | None = None

    def configure(self, config: NavigationGateConfig, depth: DepthGateConfig) -> None:
        """Take new bounds."""
        self._level.config, self._depth.config = config, depth
        self._depth.accept_after = config.accept_after

    def reset(self) -> None:
        """Forget all measurements; the next one is the first."""
        self._level.reset()
        self._depth.reset()
        self._moved = None

    def judge(self, navigation: SpatialNavigation, dt: float, under_way: bool) -> Judgement:
        """Judge a measurement; arguments as those of `NavigationGate.judge`."""
        level = self._level.judge(level_of(navigation), dt, under_way)
        if not self._level.config.enabled:
            self._depth.reset()
            return level
        if level.passed is Passed.REFUSED:
            self._depth.wait(dt)
            return level
        depth = self._depth.judge(navigation, dt, under_way)
        if level.passed is Passed.MOVED:
            self._moved = level  # reported with the next depth that is accepted
        if depth.passed is Passed.REFUSED:
            return depth
        moved, self._moved = self._moved, None
        return depth if moved is None or depth.passed is Passed.MOVED else moved


class PlanarGate(NavigationGate):
    """The gate of a vehicle in the plane."""

    def configure(self, config: NavigationGateConfig, depth: DepthGateConfig) -> None:
        """Take new bounds; those of the depth do not matter."""
        self.config = config


def gate_of(
    config: NavigationGateConfig, depth: DepthGateConfig, vehicle: Vehicle
) -> PlanarGate | SpatialGate:
    """Return the gate for a vehicle's odometry."""
    if vehicle.dives:
        return SpatialGate(config, depth, vehicle.top_speed)
    return PlanarGate(config, vehicle.top_speed)
