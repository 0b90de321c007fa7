"""The pilot without ROS and without a plant: recorded sensors in, commands out.

It includes the conversions of the wire: an angle that was sent as yaw_enu differs in its last bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.spatial_conversions import altitude_from
from auv_msgs_py.contract.stamps import StampGuard, StampVerdict
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.guide import at_the_beginning
from auv_path_following.missions import mission_file
from auv_path_following.missions import mission_state as states
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.bags.content.parameter_changes import MISSION_NAMES, Change, changed
from auv_sim.bags.content.rerun_chain import Chain, Sensed
from auv_sim.bags.content.rerun_phases import Phase, in_phase, phases_of
from auv_sim.bags.reading.beside import Beside
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag, RecordedTopic


@dataclass(frozen=True)
class Answers:
    """One row for each odometry that has an answer; every array has shape (n,).

    Attributes:
        t: the odometry's stamp, s.
        recorded, new: by topic name; NaN where nothing was recorded.
    """

    t: NDArray[np.float64]
    recorded: dict[str, NDArray[np.float64]]
    new: dict[str, NDArray[np.float64]]


class _Step(NamedTuple):
    odometry: Any
    stamp: int
    log_ns: int
    water: Any | None
    altitude: Any | None = None


def answers(
    bag: Bag,
    parameters: dict[str, Any],
    mission: Mission,
    vehicle: Vehicle,
    namespace: str | None,
    changes: Sequence[Change] = (),
) -> Answers:
    """Feed a recording's sensors to the pilot.

    Args:
        bag: the recording.
        parameters: node name -> settings.
        mission, vehicle: of the flight.
        namespace: of the vehicle.
        changes: of parameters in flight, in their order.

    Raises:
        ConfigurationError: the recording has no odometry, or several vehicles.
    """
    lockstep = parameters[topics.GUIDANCE].lockstep
    timeout = parameters[topics.GUIDANCE].water_velocity_timeout
    steps = list(_steps(bag, namespace, lockstep, timeout))
    if not steps:
        raise ConfigurationError(
            str(bag.path), "no odometry", f"messages on {topics.ODOM.name}, or --odometry"
        )
    log_ns = np.array([step.log_ns for step in steps], np.int64)
    rerun = _RerunPilot(parameters, mission, vehicle)
    names = rerun.answered
    recorded = {name: _column(bag, name, namespace, log_ns, lockstep) for name in names}
    phases = phases_of(bag, namespace, recorded[topics.DESIRED_THRUST.name])
    rows, kept = _rows(rerun, zip(steps, phases, strict=True), changes, lockstep)
    columns = np.array(rows, np.float64).reshape(-1, len(names))
    return Answers(
        np.array([steps[k].stamp for k in kept]) * 1e-9,
        {name: column[kept] for name, column in recorded.items()},
        {name: columns[:, j] for j, name in enumerate(names)},
    )


def _rows(
    rerun: _RerunPilot, steps: Iterable[tuple[_Step, Phase]], changes: Sequence[Change], lockstep: bool
) -> tuple[list[tuple[float, ...]], list[int]]:
    """Return the answers, and the indices of the odometries that have one."""
    rows, kept, left = [], [], list(reversed(changes))
    for k, (step, phase) in enumerate(steps):
        while left and left[-1].is_before(step.stamp, step.log_ns, lockstep):
            rerun.change(left.pop())
        answer = rerun.step(step, phase)
        if answer is not None:
            rows.append(answer)
            kept.append(k)
    return rows, kept


class _RerunPilot:
    """The pilot, with the recorded phases of the mission."""

    def __init__(self, parameters: dict[str, Any], mission: Mission, vehicle: Vehicle) -> None:
        self._parameters, self._mission, self._vehicle = dict(parameters), mission, vehicle
        #: Whether a mission was set that has not begun yet.
        self._is_new = False
        guidance = parameters[topics.GUIDANCE].with_mission_overrides(mission)
        self._chain = Chain(parameters, guidance, mission, vehicle)
        self._frames = FrameTable(guidance.frames)
        self._guard = StampGuard(ordered=guidance.lockstep)

    @property
    def answered(self) -> tuple[str, ...]:
        """Names of the topics of an answer."""
        return self._chain.answered

    def change(self, change: Change) -> None:
        """Take parameters that were changed in flight.

        Raises:
            ConfigurationError: a mission that was set cannot be read any more.
        """
        self._parameters[change.node] = changed(self._parameters[change.node], change.values)
        if change.node == topics.GUIDANCE:
            text, name = (change.values.get(key, "") for key in ("mission_text", "mission"))
            if text or name:
                read = mission_file.read_text if text else mission_file.load
                self._mission = read(text or name, self._vehicle)
            self._is_new = self._is_new or not set(MISSION_NAMES).isdisjoint(change.values)
        guidance = self._parameters[topics.GUIDANCE].with_mission_overrides(self._mission)
        self._chain.change(self._parameters, guidance, self._mission, self._vehicle)

    def step(self, step: _Step, phase: Phase) -> tuple[float, ...] | None:
        """Return the answer; None for an odometry that the nodes refuse, too."""
        chain = self._chain
        if self._is_new and phase.resumes:
            phase = phase._replace(begins=True, resumes=False)
        self._is_new = self._is_new and not phase.begins
        if phase.begins:
            running = states.MissionStatus(states.RUNNING)
            chain.guiding = at_the_beginning(chain.guide, running, empty_approach())
        try:
            navigation = chain.readings.navigation(step.odometry, self._frames, topics.ODOM.name)
            inputs = Sensed(navigation, self._water(step.water), self._altitude(step.altitude))
        except MessageRefused:
            return None
        verdict, dt = self._guard.judge(step.stamp)
        if verdict is StampVerdict.REFUSE:
            return None
        mission = chain.guiding.mission
        if verdict is StampVerdict.RESTART:
            chain.restart()
        chain.guiding = chain.guiding._replace(mission=in_phase(mission, phase))
        return chain.step(inputs, step.stamp * 1e-9, dt)

    def _water(self, message: Any | None) -> Any | None:
        if message is None:
            return None
        return self._chain.readings.water(message, self._frames, topics.WATER_VELOCITY.name)

    def _altitude(self, message: Any | None) -> float:
        if message is None or not self._chain.with_altitude:
            return math.nan
        return altitude_from(message, topics.ALTITUDE.name)


def _steps(bag: Bag, namespace: str | None, lockstep: bool, timeout: float) -> Iterator[_Step]:
    """Yield each odometry with its velocity through water and its range to the bottom."""
    odom = bag.find(topics.ODOM.name, namespace)
    if odom is None:
        return
    water, altitude = (
        Beside(bag.find(topic.name, namespace), lockstep, timeout)
        for topic in (topics.WATER_VELOCITY, topics.ALTITUDE)
    )
    decode_odometry = deserializer(odom)
    for topic, k in bag.in_order():
        data = topic.messages[k]
        for beside in (water, altitude):
            if topic is beside.topic:
                beside.take(data)
        if topic is not odom or data is None:
            continue
        message = decode_odometry(data)
        stamp = nanoseconds(message.header.stamp)
        yield _Step(message, stamp, topic.log_ns[k], water.at(stamp), altitude.at(stamp))


def _column(
    bag: Bag, name: str, namespace: str | None, log_ns: NDArray[np.int64], lockstep: bool
) -> NDArray[np.float64]:
    """Return a Float64 topic, a value for each odometry: row by row in lockstep, else the first after it."""
    topic: RecordedTopic | None = bag.find(name, namespace)
    column = np.full(log_ns.size, np.nan)
    if topic is None or not topic.count:
        return column
    times, values = zip(*((at, message.data) for at, message in messages_of(topic)), strict=True)
    if lockstep:
        n = min(column.size, len(values))
        column[:n] = values[:n]
        return column
    row = np.searchsorted(np.array(times), log_ns, side="left")
    there = row < len(values)
    column[there] = np.array(values)[row[there]]
    return column
