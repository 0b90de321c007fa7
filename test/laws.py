"""A registered law flown alone: its configuration for a vehicle, and its state from step to step."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import Step
from auv_path_following.registry import Law


class Stepped:
    """A step with its configuration and its state."""

    def __init__(self, step: Step, config: Any, initial: Any) -> None:
        self.step, self.config, self.initial = step, config, initial
        self.reset()

    def reset(self) -> None:
        self.state = self.initial

    def update(self, inputs: Any, dt: float) -> Any:
        self.state, output = self.step(self.config, self.state, inputs, dt)
        return output


def flown(law: Law, gains: Any = None, vehicle: Any = None) -> Stepped:
    """A law with its gains, on a vehicle where it needs one."""
    return Stepped(law.step, law.prepare(gains or law.Settings(), vehicle), law.initial)
