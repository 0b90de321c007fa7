"""remus_plant: the simulated vehicle, in lockstep with the suite or free running."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from rclpy import clock as ros_clock
from std_msgs.msg import String
from std_srvs.srv import Trigger

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim, of_simulator
from auv_msgs_py.contract.conversions import finite, stamp_of
from auv_msgs_py.contract.mission_word import MissionState, MissionWord
from auv_msgs_py.contract.wire import Clock, Float64
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import vehicle
from auv_sim.nodes.held_commands import HeldCommands, orders_of
from auv_sim.nodes.lockstep import Lockstep
from auv_sim.nodes.pacing import PATIENCE, Pacer
from auv_sim.nodes.vehicle_outputs import outputs_of
from auv_sim.sim_parameters import PlantParameters
from auv_sim.vehicle import sea
from auv_sim.vehicle.diving.simulated_diver import simulated_vehicle

#: States of a mission in which the free-running vehicle obeys no command: one may arrive late.
_OVER = (MissionState.HOLDING, MissionState.COMPLETE, MissionState.ABORTED)


class RemusPlantNode(SuiteNode):
    """Publishes the contract's vehicle topics and obeys its commands."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.PLANT, PlantParameters, **arguments)
        p: PlantParameters = self.parameters
        self.vehicle = vehicle.load(p.vehicle)
        at_sea = sea.load(p.sea) if p.sea else None
        self.step_ns = round(p.step * 1e9)
        self._dt = self.step_ns * 1e-9
        dives = self.vehicle.dives
        initial = p.initial.spatial_state if dives else p.initial.state
        self.simulated: Any = simulated_vehicle(
            self.vehicle, initial, at_sea, p.seed, p.current.of(dives), self._dt
        )
        self.steps = 0
        self.mission_running = False
        self._mission = MissionWord()
        orders = orders_of(self.vehicle)
        self.command = self._stop = orders.stop
        self._released = not p.hold_until_running
        self._commands = HeldCommands(orders)
        self._reset_requested = False
        self._begun = False
        p.check_frames(self.get_name())
        self._outputs = outputs_of(self, self.simulated, at_sea)
        self.close_gate()
        self._lockstep = Lockstep(self, orders) if p.lockstep else None
        self.pacer = None if p.lockstep or p.shared_clock else Pacer(p.step / p.speed)
        for topic in (topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD):
            if topic.name in orders.limits:
                self.listen(topic, self._on_command(topic.name))
        self.listen(topics.MISSION_STATE, self._on_mission_state)
        self.create_service(Trigger, topics.RESET_SERVICE, self._on_reset)
        if p.shared_clock and not p.lockstep:
            self.listen(topics.CLOCK, self._on_clock)
        if self.pacer is not None:
            steady = ros_clock.Clock(clock_type=ros_clock.ClockType.STEADY_TIME)
            self.create_timer(self.pacer.ask_every, self._tick, clock=steady)

    def claim(self) -> Claim:
        return of_simulator(self.get_namespace(), self.get_name())

    def waiting_for(self) -> str:
        return self.gate_waits_for() or (self._lockstep.waiting_for() if self._lockstep else "")

    def report(self) -> dict[str, Any]:
        values = {"steps": self.steps, "stamp [s]": f"{self.stamp * 1e-9:.3f}"}
        if self.pacer is not None:
            values["behind [s]"] = f"{self.pacer.behind:.3f}"
        return values

    @property
    def stamp(self) -> int:
        """Time of the present step, ns."""
        return topics.FIRST_STAMP_NS + self.steps * self.step_ns

    def configure(self) -> None:
        self.simulated.constant_current = self.parameters.current.of(self.vehicle.dives)

    def publish_step(self) -> None:
        """Publish the present state, once its subscribers are matched."""
        self._outputs.fill(self.simulated, self._at_rest, self.stamp)
        self.time_is(self.stamp)
        # In lockstep every step has its message: a log without water lock repeats its last measurement.
        in_lockstep = self._lockstep is not None
        self.answer(lambda: self._outputs.publish(in_lockstep or self.simulated.water_lock))

    def advance(self, command: Any) -> None:
        """Advance the vehicle by one step, or reset it if that was requested."""
        if self._reset_requested:
            self._reset_requested = False
            self.simulated.reset()
            self.steps = 0
            self._commands.clear()
            return
        self.simulated.advance(command, self._dt)
        self.steps += 1

    def _on_command(self, topic: str) -> Callable[[Float64], None]:
        return lambda message: self.take_command(topic, message.data)

    def take_command(self, topic: str, value: float) -> None:
        """Keep a command; in lockstep the last one of a step ends it."""
        self._commands.put(topic, finite(value, topic), self.stamp)
        if self._lockstep is not None:
            self._lockstep.on_command(topic, value)

    def _on_mission_state(self, message: String) -> None:
        refused = self._mission.hear(message.data, time.monotonic())
        self.mission_running = message.data == MissionState.RUNNING
        self._released = self._released or self.mission_running
        if self._lockstep is not None:
            self._lockstep.on_mission_state()
        if refused is not None:
            raise refused

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        # It waits for the next step: in lockstep, the answer to the present one must not meet the new first.
        self._reset_requested = True
        response.success, response.message = True, "back at the initial state with the next step"
        return response

    def _tick(self) -> None:
        """Take the next step of a free run when the wall clock demands it."""
        assert self.pacer is not None
        if self._silent:
            self.pacer.restart(time.monotonic())
        elif self.pacer.due(time.monotonic()):
            self._take_free_step()

    def _on_clock(self, message: Clock) -> None:
        """Take the steps that are due by the fleet's /clock; time that a slow machine loses is caught up."""
        now = stamp_of(message.clock, topics.CLOCK.name)
        if self._silent:
            self.steps = max(0, now - topics.FIRST_STAMP_NS) // self.step_ns
            return
        for _ in range(PATIENCE):
            if self._begun and self.stamp + self.step_ns > now:
                break
            self._take_free_step()

    def _take_free_step(self) -> None:
        self.command = self._held_command()
        if self._begun and self._at_rest and not self._reset_requested:
            self.steps += 1
        elif self._begun:
            self.advance(self.command)
        self._begun = True
        self.publish_step()

    @property
    def _silent(self) -> bool:
        """Whether nothing is published before the mission, and the vehicle waits for it."""
        return self._at_rest and not self.parameters.publish_at_rest

    @property
    def _at_rest(self) -> bool:
        """Whether a free run has not begun: time passes, and the vehicle is held at its initial state."""
        return self._lockstep is None and not self._released

    def _held_command(self) -> Any:
        """Return the newest commands; a stop when one is overdue, as every vehicle has to do on its own."""
        bound = self.parameters.command_timeout
        command, silent = self._commands.at(self.stamp, bound)
        self.health.warn("commands", f"no {', '.join(silent)} for {bound:g} s: stopped" if silent else "")
        over = self._mission.at(time.monotonic()) in _OVER
        return self._stop if silent or over else command


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `remus_plant`."""
    return run_nodes([RemusPlantNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
