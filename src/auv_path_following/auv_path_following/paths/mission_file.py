"""The mission file: where to go, and with how much thrust. How to get there well is not its business."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Annotated, Any, Literal

import pydantic
from pydantic_core import PydanticCustomError

from auv_msgs_py import yaml_file
from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.settings import Pair, setting, settings
from auv_path_following import config_files
from auv_path_following.paths.arc import Arc
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.paths.line import Line
from auv_path_following.paths.segment import Segment


@dataclasses.dataclass(frozen=True)
class Mission:
    """A mission that can be flown.

    Attributes:
        name, description: for people.
        path: what to follow, NED.
        thrust: constant thrust on the way, N, greater than 0.
        source: the file it came from.
    """

    name: str
    path: CompositePath
    thrust: float
    source: Path
    description: str


def _no_boolean(value: Any) -> Any:
    if isinstance(value, bool):  # Python takes True for 1
        raise PydanticCustomError("int_type", "a whole number")
    return value


_Version = Annotated[Literal[1], pydantic.BeforeValidator(_no_boolean)]
_Turn = Annotated[Literal[1, -1], pydantic.BeforeValidator(_no_boolean)]


@settings
class LineSpec:
    """`line`: Eq. (10)."""

    start: Pair = setting(doc="north, east", unit="m")
    length: float = setting(doc="length", unit="m", gt=0.0)
    course_deg: float = setting(doc="course, clockwise from north", unit="deg")

    def build(self) -> Segment:
        """The segment it describes."""
        return Line(*self.start, self.length, math.radians(self.course_deg))


@settings
class ArcSpec:
    """`arc`: Eq. (11); to starboard when to_deg is the larger."""

    centre: Pair = setting(doc="north, east", unit="m")
    radius: float = setting(doc="radius", unit="m", gt=0.0)
    from_deg: float = setting(doc="bearing of the start, seen from the centre", unit="deg")
    to_deg: float = setting(doc="bearing of the end, seen from the centre", unit="deg")

    @pydantic.model_validator(mode="after")
    def _has_length(self) -> ArcSpec:
        if self.from_deg == self.to_deg:
            found = f"from_deg and to_deg both {self.to_deg:g}"
            raise PydanticCustomError(
                "unfit", "no arc", {"found": found, "expected": "two bearings that differ"}
            )
        return self

    def build(self) -> Segment:
        """The segment it describes."""
        return Arc(*self.centre, self.radius, math.radians(self.from_deg), math.radians(self.to_deg))


@settings
class FermatSpec:
    """`fermat`: Eq. (12)."""

    start: Pair = setting(doc="north, east", unit="m")
    course_deg: float = setting(doc="course at the start, clockwise from north", unit="deg")
    scale: float = setting(doc="k", unit="m", gt=0.0)
    theta_end: float = setting(doc="polar angle of the end", unit="rad", gt=0.0, le=100.0)
    turn: _Turn = setting(doc="rho: 1 to starboard, -1 to port")

    def build(self) -> Segment:
        """The segment it describes."""
        return FermatSpiral(*self.start, self.scale, self.theta_end, math.radians(self.course_deg), self.turn)


@settings
class FermatMirroredSpec:
    """`fermat_mirrored`: Eq. (13)."""

    end: Pair = setting(doc="north, east", unit="m")
    course_deg: float = setting(doc="course at the end, clockwise from north", unit="deg")
    scale: float = setting(doc="k", unit="m", gt=0.0)
    theta_end: float = setting(
        doc="polar angle of the start, seen from the end", unit="rad", gt=0.0, le=100.0
    )
    turn: _Turn = setting(doc="rho: 1 to starboard, -1 to port")

    def build(self) -> Segment:
        """The segment it describes."""
        chi_end = math.radians(self.course_deg)
        return MirroredFermatSpiral(*self.end, self.scale, self.theta_end, chi_end, self.turn)


@settings
class SegmentSpec:
    """One item of `segments`: a mapping with one key, the kind of the segment."""

    line: LineSpec | None = setting(None, "straight line")
    arc: ArcSpec | None = setting(None, "circular arc")
    fermat: FermatSpec | None = setting(None, "Fermat's spiral")
    fermat_mirrored: FermatMirroredSpec | None = setting(None, "Fermat's spiral, mirrored")

    @pydantic.model_validator(mode="after")
    def _is_one(self) -> SegmentSpec:
        if len(self._given()) != 1:
            found = f"{len(self._given())} kinds of segment"
            kinds = ", ".join(field.name for field in dataclasses.fields(self))
            expected = f"exactly one of {kinds}"
            raise PydanticCustomError("unfit", "not one segment", {"found": found, "expected": expected})
        return self

    def _given(self) -> list[LineSpec | ArcSpec | FermatSpec | FermatMirroredSpec]:
        values = (getattr(self, field.name) for field in dataclasses.fields(self))
        return [value for value in values if value is not None]

    def build(self) -> Segment:
        """The segment it describes."""
        return self._given()[0].build()


@settings
class MissionSpec:
    """A whole mission file."""

    version: _Version = setting(doc="version of this format")
    name: str = setting(doc="what people call it")
    description: str = setting("", "more for people")
    frame: Literal["ned"] = setting(doc="axes of all points and courses: x north, y east")
    thrust: float = setting(doc="constant thrust on the way", unit="N", gt=0.0)
    segments: tuple[SegmentSpec, ...] = setting(doc="the subpaths, in order")


def load(name_or_path: str) -> Mission:
    """Read a mission file.

    Args:
        name_or_path: a path, or a shipped name such as ``paper_composite``.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    source = config_files.find("missions", name_or_path)
    spec = yaml_file.load(source, MissionSpec)
    try:
        path = CompositePath(segment.build() for segment in spec.segments)
    except ConfigurationError as error:
        raise ConfigurationError(f"{source}: {error.where}", error.found, error.expected) from None
    return Mission(spec.name, path, spec.thrust, source, spec.description)
