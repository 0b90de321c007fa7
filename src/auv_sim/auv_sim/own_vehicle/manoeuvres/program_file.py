"""A program of manoeuvres: its YAML file."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, Literal

import pydantic

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import exactly_one, no_boolean, unfit
from auv_path_following import config_files

#: Longest program, s.
LONGEST = 3600.0


@settings
class Straight:
    """`straight`: ahead on a course, held by the rudder; after another thrust it is a thrust step."""

    seconds: float = setting(doc="duration", unit="s", gt=0.0, le=600.0)
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)
    course_deg: float | None = setting(
        None, "course from the one at the start, clockwise; by default as before", unit="deg"
    )
    towards_start: bool = setting(False, "take the course towards the place of the start instead")
    depth_step: float | None = setting(
        None, "change of the held depth, for a vehicle that dives; positive down", unit="m", ge=-20.0, le=20.0
    )

    @pydantic.model_validator(mode="after")
    def _has_one_course(self) -> Straight:
        if self.towards_start and self.course_deg is not None:
            raise unfit("towards_start and course_deg", "one of the two")
        return self


@settings
class Zigzag:
    """`zigzag`: the rudder to one side until the heading has deviated, then to the other side."""

    seconds: float = setting(doc="duration", unit="s", gt=0.0, le=600.0)
    rudder_deg: float = setting(doc="rudder, first to port; negative: first to starboard", unit="deg")
    heading_deg: float = setting(
        doc="deviation from the course at which the rudder is reversed", unit="deg", gt=0.0, le=60.0
    )
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)


@settings
class Circle:
    """`circle`: one rudder angle, until the time is over or the heading has turned."""

    seconds: float = setting(doc="longest duration", unit="s", gt=0.0, le=600.0)
    rudder_deg: float = setting(doc="rudder, positive to port", unit="deg")
    turn_deg: float = setting(3600.0, "turn after which it ends", unit="deg", gt=0.0)
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)


@settings
class PitchZigzag:
    """`pitch_zigzag`: the planes down until the pitch has deviated, then up; round the held depth."""

    seconds: float = setting(doc="duration", unit="s", gt=0.0, le=600.0)
    planes_deg: float = setting(doc="planes, first bow down; negative: first bow up", unit="deg")
    pitch_deg: float = setting(doc="deviation at which they are reversed", unit="deg", gt=0.0, le=25.0)
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)


@settings
class DepthZigzag:
    """`depth_zigzag`: one held pitch down until the depth has deviated, then up."""

    seconds: float = setting(doc="duration", unit="s", gt=0.0, le=600.0)
    pitch_deg: float = setting(doc="held pitch, first bow down", unit="deg", gt=0.0, le=25.0)
    depth: float = setting(doc="deviation from the held depth at which it is reversed", unit="m", gt=0.0)
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)


@settings
class PlaneStep:
    """`plane_step`: one angle of the planes, until the time is over or the pitch has deviated."""

    seconds: float = setting(doc="longest duration", unit="s", gt=0.0, le=60.0)
    planes_deg: float = setting(doc="planes, positive bow down", unit="deg")
    pitch_deg: float = setting(doc="deviation of the pitch at which it ends", unit="deg", gt=0.0, le=25.0)
    thrust: float = setting(1.0, "share of the largest thrust", gt=0.0, le=1.0)


Manoeuvre = Straight | Zigzag | Circle | PitchZigzag | DepthZigzag | PlaneStep


@settings
class LegSpec:
    """One item of `legs`: a mapping with one key, the manoeuvre."""

    straight: Straight | None = setting(None, "ahead on a course")
    zigzag: Zigzag | None = setting(None, "rudder reversed by the heading")
    circle: Circle | None = setting(None, "one rudder angle: a circle, or with a short time a step")
    pitch_zigzag: PitchZigzag | None = setting(None, "planes reversed by the pitch")
    depth_zigzag: DepthZigzag | None = setting(None, "pitch reversed by the depth")
    plane_step: PlaneStep | None = setting(None, "one angle of the planes")

    @pydantic.model_validator(mode="after")
    def _is_one(self) -> LegSpec:
        exactly_one(self, tuple(field.name for field in dataclasses.fields(self)), "manoeuvres")
        return self

    @property
    def manoeuvre(self) -> Manoeuvre:
        """The manoeuvre."""
        fields = (getattr(self, field.name) for field in dataclasses.fields(self))
        return next(spec for spec in fields if spec is not None)  # type: ignore[no-any-return]

    @property
    def needs_planes(self) -> bool:
        """Whether only a vehicle with stern planes can fly it."""
        spec: Any = self.manoeuvre
        return isinstance(spec, PitchZigzag | DepthZigzag | PlaneStep) or (
            isinstance(spec, Straight) and spec.depth_step is not None
        )


@settings
class Program:
    """A whole file of manoeuvres."""

    version: Annotated[Literal[1], pydantic.BeforeValidator(no_boolean)] = setting(
        doc="version of this format"
    )
    name: str = setting(doc="name of the program")
    description: str = setting("", "description")
    fits_fins: bool = setting(
        False, "all angles of a fin are reduced in one proportion where its largest one exceeds the vehicle's"
    )
    legs: tuple[LegSpec, ...] = setting(doc="the manoeuvres, one after the other")

    @pydantic.model_validator(mode="after")
    def _has_an_end(self) -> Program:
        if not self.legs:
            raise unfit("no legs", "a manoeuvre")
        if self.duration > LONGEST:
            raise unfit(f"{self.duration:g} s of manoeuvres", f"at most {LONGEST:g} s")
        return self

    @property
    def duration(self) -> float:
        """Longest duration, s, without the way to the depth."""
        return sum(leg.manoeuvre.seconds for leg in self.legs)

    @property
    def needs_planes(self) -> bool:
        """Whether only a vehicle with stern planes can fly it."""
        return any(leg.needs_planes for leg in self.legs)


def load(name_or_path: str) -> Program:
    """Read a program.

    Args:
        name_or_path: a path, or a shipped name such as ``two_minutes``.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    return yaml_file.load(config_files.find("manoeuvres", name_or_path), Program)
