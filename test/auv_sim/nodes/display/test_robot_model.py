"""The model of the vehicle: sizes from its file, and fins that turn the way the contract says."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_sim.nodes.display.robot_model import diameter_of, fins_of, hinge_of, urdf


def joints_of(name: str, prefix: str = "") -> dict[str, ElementTree.Element]:
    root = ElementTree.fromstring(urdf(vehicle.load(name), prefix))
    return {joint.get("name", ""): joint for joint in root.findall("joint")}


def of(joint: ElementTree.Element, tag: str, attribute: str) -> str:
    element = joint.find(tag)
    assert element is not None
    return element.get(attribute, "")


def test_a_planar_vehicle_has_a_rudder_and_a_diver_has_both() -> None:
    assert list(joints_of("remus100")) == ["rudder_joint"]
    assert list(joints_of("remus100_6dof")) == ["rudder_joint", "sternplane_joint"]


def test_sizes_and_limits_are_those_of_the_file() -> None:
    hull = vehicle.load("remus100_6dof")
    assert diameter_of(hull) == 0.19
    assert diameter_of(vehicle.load("remus100")) == pytest.approx(0.19, abs=0.005)
    radii = [float(each.get("radius", 0)) for each in ElementTree.fromstring(urdf(hull)).iter("cylinder")]
    assert radii == [0.095]
    joints = joints_of("remus100_6dof")
    assert float(of(joints["rudder_joint"], "limit", "upper")) == pytest.approx(math.radians(35), abs=1e-6)
    assert float(of(joints["sternplane_joint"], "limit", "lower")) == pytest.approx(
        -math.radians(20), abs=1e-6
    )
    assert -0.5 * hull.length < hinge_of(hull) < -0.4 * hull.length


def trailing_edge(joint: str, angle: float) -> np.ndarray:
    """Where a fin's trailing edge, behind its hinge, goes in base_link (FLU): right-handed about the axis."""
    (fin,) = (fin for fin in fins_of(vehicle.load("remus100_6dof")) if fin.joint == joint)
    axis, edge = np.array(fin.axis), np.array([-1.0, 0.0, 0.0])
    return edge * math.cos(angle) + np.cross(axis, edge) * math.sin(angle)


def test_a_positive_rudder_turns_its_trailing_edge_to_port() -> None:
    """The flow then pushes the stern to starboard and the bow to port, as the contract says."""
    assert trailing_edge("rudder_joint", 0.1)[1] > 0.0
    assert trailing_edge("rudder_joint", -0.1)[1] < 0.0


def test_a_positive_stern_plane_turns_its_trailing_edge_down() -> None:
    """The flow then lifts the stern, and the bow goes down."""
    assert trailing_edge("sternplane_joint", 0.1)[2] < 0.0
    assert trailing_edge("sternplane_joint", -0.1)[2] > 0.0


def test_a_prefix_is_in_front_of_every_link() -> None:
    root = ElementTree.fromstring(urdf(vehicle.load("remus100_6dof"), "auv1/"))
    links = {link.get("name") for link in root.findall("link")}
    assert links == {"auv1/base_link", "auv1/rudder", "auv1/sternplanes"}
    assert {of(joint, "child", "link") for joint in root.findall("joint")} < links
