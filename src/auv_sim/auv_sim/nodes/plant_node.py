"""remus_plant: the simulated vehicle, in lockstep with the suite or free running."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from std_msgs.msg import String
from std_srvs.srv import Trigger

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim, of_simulator
from auv_msgs_py.contract.conversions import finite
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.contract.wire import Float64
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import vehicle
from auv_sim.nodes.held_commands import HeldCommands, orders_of
from auv_sim.nodes.stepping.free_run import FreeRun
from auv_sim.nodes.stepping.lockstep import Lockstep
from auv_sim.nodes.vehicle_outputs import outputs_of
from auv_sim.sim_parameters import PlantParameters
from auv_sim.vehicle import sea
from auv_sim.vehicle.diving.simulated_diver import simulated_vehicle


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
        orders = orders_of(self.vehicle)
        self.command = orders.stop
        self._commands = HeldCommands(orders)
        self.reset_requested = False
        p.check_frames(self.get_name())
        self._outputs = outputs_of(self, self.simulated, at_sea)
        self.close_gate()
        self._lockstep = Lockstep(self, orders) if p.lockstep else None
        for topic in (topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD):
            if topic.name in orders.limits:
                self.listen(topic, self._on_command(topic.name))
        self.listen(topics.MISSION_STATE, self._on_mission_state)
        self.create_service(Trigger, topics.RESET_SERVICE, self._on_reset)
        self.free_run = None if p.lockstep else FreeRun(self)

    def claim(self) -> Claim:
        return of_simulator(self.get_namespace(), self.get_name())

    def waiting_for(self) -> str:
        return self.gate_waits_for() or (self._lockstep.waiting_for() if self._lockstep else "")

    def report(self) -> dict[str, Any]:
        values = {"steps": self.steps, "stamp [s]": f"{self.stamp * 1e-9:.3f}"}
        if self.free_run is not None and self.free_run.pacer is not None:
            values["behind [s]"] = f"{self.free_run.pacer.behind:.3f}"
        return values

    @property
    def stamp(self) -> int:
        """Time of the present step, ns."""
        return topics.FIRST_STAMP_NS + self.steps * self.step_ns

    def configure(self) -> None:
        self.simulated.constant_current = self.parameters.current.of(self.vehicle.dives)

    def publish_step(self) -> None:
        """Publish the present state, once its subscribers are matched."""
        at_rest = self.free_run is not None and self.free_run.at_rest
        self._outputs.fill(self.simulated, at_rest, self.stamp)
        self.time_is(self.stamp)
        # In lockstep every step has its message: a log without water lock repeats its last measurement.
        in_lockstep = self._lockstep is not None
        self.answer(lambda: self._outputs.publish(in_lockstep or self.simulated.water_lock))

    def advance(self, command: Any) -> None:
        """Advance the vehicle by one step, or reset it if that was requested."""
        if self.reset_requested:
            self.reset_requested = False
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
        refused = self._commands.mission.hear(message.data, time.monotonic())
        self.mission_running = message.data == MissionState.RUNNING
        if self.mission_running:
            self.mission_runs()
        if self._lockstep is not None:
            self._lockstep.on_mission_state()
        if refused is not None:
            raise refused

    def mission_runs(self) -> None:
        """Let the vehicle move: the mission runs, by its latest message."""
        if self.free_run is not None:
            self.free_run.at_rest = False

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        # It waits for the next step: in lockstep, the answer to the present one must not meet the new first.
        self.reset_requested = True
        response.success, response.message = True, "back at the initial state with the next step"
        return response

    def held_command(self) -> Any:
        """Return the command in force while running free; see `HeldCommands.in_force`."""
        timeout = self.parameters.command_timeout
        self.health.warn("commands", self._commands.complaint(self.stamp, timeout))
        return self._commands.in_force(self.stamp, timeout, time.monotonic())


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `remus_plant`."""
    return run_nodes([RemusPlantNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
