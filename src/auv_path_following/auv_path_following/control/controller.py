"""The protocol every heading controller follows: from the heading error to the rudder."""

from __future__ import annotations

from typing import NamedTuple, Protocol


class HeadingInputs(NamedTuple):
    """What a controller may look at (NED, clockwise positive, rad and s).

    psi_e = wrap(psi - psi_d); r and r_dot are the vehicle's, r_d and r_d_dot the reference's;
    thrust (N) tells a model how fast the vehicle will be.
    """

    psi_e: float
    r: float
    r_dot: float
    r_d: float
    r_d_dot: float
    thrust: float = 0.0


class ControllerOutput(NamedTuple):
    """The rudder angle delta (rad, positive turns to port) and the two surfaces a plot wants."""

    rudder: float
    sigma_1: float = 0.0
    sigma_2: float = 0.0


class HeadingController(Protocol):
    """One small stateful object per law."""

    def update(self, inputs: HeadingInputs, dt: float) -> ControllerOutput:
        """The rudder for this instant; `dt` seconds have passed since the last update."""
        ...

    def reset(self) -> None:
        """Forget all state; the rudder starts from neutral."""
        ...
