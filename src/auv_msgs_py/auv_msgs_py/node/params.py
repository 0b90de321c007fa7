"""Settings classes as ROS parameters: with description and range, read-only unless live, changed as one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter

from auv_msgs_py.node.private_rclpy import parameter_overrides
from auv_msgs_py.node.ros_arguments import shared_names
from auv_msgs_py.settings.params_file import BUILT_IN
from auv_msgs_py.settings.schema import SettingInfo, leaves, nested, validated
from auv_msgs_py.values.errors import ConfigurationError

T = TypeVar("T")
_SIM_TIME = "use_sim_time"


def declare(
    node: Node,
    cls: type[T],
    on_change: Callable[[T], None] | None = None,
    validate: Callable[[T], object] | None = None,
    arguments: Sequence[str] = (),
) -> T:
    """Declare every leaf of a settings class as a parameter of the node.

    Args:
        node: the node.
        cls: its settings class; every leaf has a default.
        on_change: called with the new settings after a change of parameters marked `live`.
        validate: called with new settings before they are accepted; a `ConfigurationError` refuses them.
        arguments: the node's ROS arguments. Names that only a block for several nodes (``/**``) sets and that
            this node does not have are ignored.

    Returns:
        The settings with the node's overrides applied.

    Raises:
        ConfigurationError: an override is unknown, of the wrong type or out of range.
    """
    _check_names(node, {leaf.name for leaf in leaves(cls)}, arguments)
    flat = {leaf.name: _declared(node, leaf) for leaf in leaves(cls)}
    current = validated(cls, nested(flat), f"{node.get_name()}: parameter")
    _accept_changes(node, cls, current, on_change, validate)
    return current


def _declared(node: Node, leaf: SettingInfo) -> Any:
    """Declare one parameter and return its value."""
    overrides = parameter_overrides(node)
    override = overrides.get(leaf.name)
    if isinstance(leaf.default, float) and override is not None and type(override.value) is int:
        # `-p radius:=6` means 6.0
        overrides[leaf.name] = Parameter(leaf.name, value=float(override.value))
    elif leaf.auto and override is not None and override.value == "auto":
        overrides[leaf.name] = Parameter(leaf.name, value=0.0)
    try:
        return node.declare_parameter(leaf.name, leaf.default, _descriptor(leaf)).value
    except (InvalidParameterTypeException, InvalidParameterValueException):
        found = override.value if override is not None else leaf.default
        raise ConfigurationError(
            f"{node.get_name()}: parameter {leaf.name}", repr(found), _expectation(leaf)
        ) from None


def _check_names(node: Node, known: set[str], arguments: Sequence[str]) -> None:
    given = parameter_overrides(node)
    unknown = [name for name in given if name not in known and not name.startswith(BUILT_IN)]
    ignored = shared_names(arguments, node.get_name()) if unknown else set()
    for name in unknown:
        if name not in ignored:
            raise ConfigurationError(
                f"{node.get_name()}: parameter {name}", "an unknown name", "a declared parameter"
            )
    if unknown:
        listed = ", ".join(sorted(unknown))
        node.get_logger().info(f"ignored of a block for several nodes, this one has none such: {listed}")


def _accept_changes(
    node: Node,
    cls: type[T],
    current: T,
    on_change: Callable[[T], None] | None,
    validate: Callable[[T], object] | None,
) -> None:
    names = {leaf.name for leaf in leaves(cls)}
    pending: list[T] = [current]

    def check(parameters: list[Parameter]) -> SetParametersResult:
        node.get_clock()  # in lockstep this sets the time with which rclpy stamps the event of the change
        # Registered last, hence called first: rclpy's own callback would switch the clock at once, and a node
        # whose time jumps by decades refuses every later odometry as old.
        for parameter in parameters:
            if parameter.name == _SIM_TIME and parameter.value != node.get_parameter(_SIM_TIME).value:
                found = f"{node.get_name()}: parameter {_SIM_TIME}: found {parameter.value} at run time"
                return SetParametersResult(successful=False, reason=f"{found}, expected it at the start only")
        # Always from the values set now: another callback may have refused an earlier change.
        flat = {name: node.get_parameter(name).value for name in names}
        flat |= {parameter.name: parameter.value for parameter in parameters if parameter.name in names}
        try:
            proposed = validated(cls, nested(flat), f"{node.get_name()}: parameter")
            if validate is not None:
                validate(proposed)
        except ConfigurationError as error:
            return SetParametersResult(successful=False, reason=str(error))
        pending[0] = proposed
        return SetParametersResult(successful=True)

    def apply(parameters: list[Parameter]) -> None:
        if on_change is not None and any(parameter.name in names for parameter in parameters):
            on_change(pending[0])

    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(apply)


def _descriptor(leaf: SettingInfo) -> ParameterDescriptor:
    unit = f" [{leaf.unit}]" if leaf.unit else ""
    descriptor = ParameterDescriptor(description=f"{leaf.doc}{unit}", read_only=not leaf.live)
    if isinstance(leaf.default, float) and (leaf.minimum is not None or leaf.maximum is not None):
        largest = 1.7e308
        descriptor.floating_point_range = [
            FloatingPointRange(
                from_value=-largest if leaf.minimum is None else float(leaf.minimum),
                to_value=largest if leaf.maximum is None else float(leaf.maximum),
            )
        ]
    return descriptor


def _expectation(leaf: SettingInfo) -> str:
    kind = {
        bool: "true or false",
        float: "a number",
        int: "a whole number",
        str: "a text",
        list: "a list of texts",
    }
    text = kind.get(type(leaf.default), "another type")
    if leaf.minimum is not None:
        text += f" from {leaf.minimum:g}"
    if leaf.maximum is not None:
        text += f" up to {leaf.maximum:g}"
    return text
