"""The URDF of a torpedo with its fins as joints. ROS-free.

Frame base_link is FLU (REP-103). A positive rudder turns about FRD z (down), a positive stern plane about FRD
y (starboard), both right-handed: hence the axes -z and -y here.
"""

from __future__ import annotations

from typing import NamedTuple
from xml.etree import ElementTree

from auv_path_following.vehicle import Rudder, Vehicle

#: Length over diameter of a hull whose file has no diameter: that of the REMUS 100.
_SLENDERNESS = 8.4
#: Shares of the length: of the parallel middle body, and of the chord of a fin; the fins stand at the stern.
_BODY, _CHORD = 0.8, 0.06
RUDDER, STERNPLANE = "rudder_joint", "sternplane_joint"


class Fin(NamedTuple):
    """One pair of fins.

    Attributes:
        joint, link: names.
        axis: of rotation in base_link.
        limit: of the angle, rad.
    """

    joint: str
    link: str
    axis: tuple[float, float, float]
    limit: float


def diameter_of(vehicle: Vehicle) -> float:
    """Return the hull's diameter, m: from its file, else from its length."""
    vertical = vehicle.hull.vertical if vehicle.hull is not None else None
    return vertical.diameter if vertical is not None else vehicle.length / _SLENDERNESS


def hinge_of(vehicle: Vehicle) -> float:
    """Return where the fins' hinge stands along base_link x, m; base_link is amidships."""
    return -0.5 * vehicle.length * (1.0 - 2.0 * _CHORD)


def fins_of(vehicle: Vehicle) -> tuple[Fin, ...]:
    """Return the fins that a vehicle has."""

    def limit(rudder: Rudder) -> float:
        return rudder.max_angle

    rudder = Fin(RUDDER, "rudder", (0.0, 0.0, -1.0), limit(vehicle.rudder))
    if vehicle.sternplanes is None:
        return (rudder,)
    return rudder, Fin(STERNPLANE, "sternplanes", (0.0, -1.0, 0.0), limit(vehicle.sternplanes))


def urdf(vehicle: Vehicle, prefix: str = "") -> str:
    """Return the URDF.

    Args:
        vehicle: with length, diameter and the limits of its fins.
        prefix: of the frames, such as ``auv1/``.
    """
    length, diameter = vehicle.length, diameter_of(vehicle)
    robot = ElementTree.Element("robot", name="auv")
    body = ElementTree.SubElement(robot, "link", name=f"{prefix}base_link")
    along = f"0 {0.5 * 3.141592653589793:.6f} 0"
    _visual(body, "0 0 0", along, "cylinder", "0.95 0.75 0.1 1", length=_BODY * length, radius=0.5 * diameter)
    for end in (0.5, -0.5):
        _visual(
            body, f"{end * _BODY * length:g} 0 0", "0 0 0", "sphere", "0.95 0.75 0.1 1", radius=0.5 * diameter
        )
    for fin in fins_of(vehicle):
        link = ElementTree.SubElement(robot, "link", name=prefix + fin.link)
        chord, span, thickness = _CHORD * length, 2.0 * diameter, 0.05 * diameter
        size = (chord, thickness, span) if fin.joint == RUDDER else (chord, span, thickness)
        _visual(
            link, f"{-0.5 * chord:g} 0 0", "0 0 0", "box", "0.85 0.2 0.1 1",
            size=" ".join(f"{value:g}" for value in size),
        )  # fmt: skip
        joint = ElementTree.SubElement(robot, "joint", name=fin.joint, type="revolute")
        ElementTree.SubElement(joint, "parent", link=f"{prefix}base_link")
        ElementTree.SubElement(joint, "child", link=prefix + fin.link)
        ElementTree.SubElement(joint, "origin", xyz=f"{hinge_of(vehicle):g} 0 0", rpy="0 0 0")
        ElementTree.SubElement(joint, "axis", xyz=" ".join(f"{value:g}" for value in fin.axis))
        limits = {"lower": -fin.limit, "upper": fin.limit, "effort": 1.0, "velocity": 1.0}
        ElementTree.SubElement(joint, "limit", {name: f"{value:.6f}" for name, value in limits.items()})
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode")


def _visual(
    link: ElementTree.Element, xyz: str, rpy: str, shape: str, rgba: str, **sizes: float | str
) -> None:
    visual = ElementTree.SubElement(link, "visual")
    ElementTree.SubElement(visual, "origin", xyz=xyz, rpy=rpy)
    geometry = ElementTree.SubElement(visual, "geometry")
    ElementTree.SubElement(
        geometry, shape, {k: v if isinstance(v, str) else f"{v:g}" for k, v in sizes.items()}
    )
    material = ElementTree.SubElement(visual, "material", name=rgba)
    ElementTree.SubElement(material, "color", rgba=rgba)
