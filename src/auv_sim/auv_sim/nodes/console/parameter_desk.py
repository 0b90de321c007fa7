"""The parameters of a vehicle's nodes: the form of the page, and changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParametersAtomically,
)
from rclpy.parameter import parameter_value_to_python

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.params_file import BUILT_IN
from auv_msgs_py.settings.schema import leaves
from auv_msgs_py.values.errors import shortened
from auv_sim.nodes.console.vehicle_calls import CallFailed, ServiceCaller
from auv_sim.sim_parameters import SUITE
from auv_sim.views.console.web.operator_desk import RequestRefused

#: The nodes whose parameters the page shows.
NODES = (topics.GUIDANCE, topics.AUTOPILOT, topics.OBSERVER)
#: Groups of gains. All others are limits, watchdogs and modes: they are shown apart.
_GAINS = ("guidance.", "autopilot.", "pitch.", "observer.")
#: Of the mission and the process rather than of the vehicle's behaviour.
NOT_SHOWN = ("mission", "mission_text", "start_at", *BUILT_IN)
#: Not written into a parameter file: the launcher sets them.
_NOT_KEPT = ("vehicle", "lockstep", "recorded")
_SERVICES = {
    ListParameters: "list_parameters",
    DescribeParameters: "describe_parameters",
    GetParameters: "get_parameters",
    SetParametersAtomically: "set_parameters_atomically",
}
#: A bound beyond this stands for none.
_UNBOUNDED = 1e300
#: Beyond the integers of a parameter.
_LARGEST = 2**63
_TYPES = {
    ParameterType.PARAMETER_BOOL: ("bool", "bool_value"),
    ParameterType.PARAMETER_INTEGER: ("int", "integer_value"),
    ParameterType.PARAMETER_DOUBLE: ("double", "double_value"),
    ParameterType.PARAMETER_STRING: ("string", "string_value"),
    ParameterType.PARAMETER_STRING_ARRAY: ("strings", "string_array_value"),
}


class ParameterDesk:
    """Reads and sets parameters.

    Args:
        caller: of the services.
        namespace: of the vehicle.
    """

    def __init__(self, caller: ServiceCaller, namespace: str) -> None:
        self._caller, self._namespace = caller, namespace
        self._types: dict[tuple[str, str], int] = {}

    def prepare(self) -> None:
        """Make the clients early: a new client has to be discovered first."""
        for node in NODES:
            for kind, service in _SERVICES.items():
                self._caller.client(kind, self._full(node, service))

    def _full(self, node: str, service: str) -> str:
        return topics.full_name(self._namespace, f"{node}/{service}")

    async def form(self) -> list[dict[str, Any]]:
        """Return the parameters of every node that answers, live ones first.

        Raises:
            CallFailed: none answers.
        """
        found, failure = [], None
        for node in NODES:
            try:
                found.append({"node": node, "parameters": await self._rows(node)})
            except CallFailed as error:
                failure = error
        if failure is not None and not found:
            raise failure
        return found

    async def value(self, node: str, *names: str) -> list[Any]:
        """Return the values of some parameters.

        Raises:
            CallFailed: the node does not answer.
        """
        response = await self._call(node, GetParameters, names=list(names))
        return [plain_value(value) for value in response.values]

    async def set(self, node: str, values: Mapping[str, Any], may_send: Callable[[], bool]) -> str:
        """Set parameters of a node at once; return why they were refused, empty if they were not.

        Args:
            node: its name.
            values: name -> value of JSON.
            may_send: as of `ServiceCaller.call`.

        Raises:
            CallFailed: the node does not answer, or the request may not be sent.
            RequestRefused: there is no such node or parameter, or a value does not fit its type.
        """
        if node not in SUITE:
            raise RequestRefused(f"node: found {node!r}, expected one of {', '.join(NODES)}"[:300])
        if any((node, name) not in self._types for name in values):
            await self._described(node, list(values))
        parameters = [
            Parameter(name=name, value=converted(name, value, self._types.get((node, name), 0)))
            for name, value in values.items()
        ]
        service = self._full(node, _SERVICES[SetParametersAtomically])
        request = SetParametersAtomically.Request(parameters=parameters)
        response = await self._caller.call(SetParametersAtomically, service, request, may_send)
        return "" if response.result.successful else str(response.result.reason)

    async def file(self) -> str:
        """Return a parameter file of what differs from the defaults."""
        blocks = {}
        for block in await self.form():
            changed = {
                row["name"]: row["value"]
                for row in block["parameters"]
                if row["value"] != row["default"] and row["name"] not in _NOT_KEPT
                and not row["name"].startswith("frames.")
            }  # fmt: skip
            if changed:
                blocks[f"/**/{block['node']}"] = {"ros__parameters": changed}
        return yaml_file.text_of(blocks) if blocks else "# every parameter has its default\n"

    async def _rows(self, node: str) -> list[dict[str, Any]]:
        response = await self._call(node, ListParameters)
        names = [name for name in response.result.names if not name.startswith(NOT_SHOWN)]
        described = await self._described(node, names)
        values = await self.value(node, *names)
        defaults = {leaf.name: leaf.default for leaf in leaves(SUITE[node])}
        rows = [
            _row(name, one, value, defaults.get(name))
            for name, one, value in zip(names, described, values, strict=True)
        ]
        return sorted(rows, key=lambda row: (row["read_only"], row["safety"], row["name"]))

    async def _described(self, node: str, names: list[str]) -> list[ParameterDescriptor]:
        response = await self._call(node, DescribeParameters, names=names)
        for name, one in zip(names, response.descriptors, strict=False):
            self._types[node, name] = one.type
        return list(response.descriptors)

    async def _call(self, node: str, kind: Any, **fields: Any) -> Any:
        name = self._full(node, _SERVICES[kind])
        return await self._caller.call(kind, name, kind.Request(**fields))


def _row(name: str, one: ParameterDescriptor, value: Any, default: Any) -> dict[str, Any]:
    """Return a parameter as the page takes it."""
    bounds = one.floating_point_range[0] if one.floating_point_range else None
    doc, _, unit = one.description.rpartition(" [")
    if not doc or not unit.endswith("]"):
        doc, unit = one.description, ""
    return {
        "name": name,
        "type": _TYPES.get(one.type, ("other", ""))[0],
        "value": value,
        "default": list(default) if isinstance(default, (list, tuple)) else default,
        "minimum": _bound(bounds.from_value) if bounds else None,
        "maximum": _bound(bounds.to_value) if bounds else None,
        "unit": unit.removesuffix("]"),
        "doc": doc,
        "read_only": bool(one.read_only),
        "safety": not name.startswith(_GAINS),
    }


def plain_value(value: ParameterValue) -> Any:
    """Return a parameter's value as JSON has it: arrays are lists, bytes are numbers."""
    found = parameter_value_to_python(value)
    if found is None or isinstance(found, bool | int | float | str):
        return found
    return [item[0] if isinstance(item, bytes) else item for item in found]


def _bound(value: float) -> float | None:
    return float(value) if abs(value) < _UNBOUNDED else None


def converted(name: str, value: Any, kind: int) -> ParameterValue:
    """Return a value of JSON as its parameter's type: 2 is a number of JSON, and 2.0 of a float parameter.

    Raises:
        RequestRefused: it does not fit.
    """
    typed, field = _TYPES.get(kind, ("", ""))
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if typed == "double" and is_number and abs(value) < _UNBOUNDED:  # NaN fails this
        value = float(value)
    elif typed == "int" and is_number and abs(value) < _LARGEST and value == int(value):
        value = int(value)
    elif not (
        (typed == "bool" and isinstance(value, bool))
        or (typed == "string" and isinstance(value, str))
        or (typed == "strings" and isinstance(value, list) and all(isinstance(v, str) for v in value))
    ):
        expected = f"a value of type {typed}" if typed else "the name of a parameter"
        raise RequestRefused(
            f"{shortened(name, 80)}: found {shortened(repr(value), 80)}, expected {expected}"
        )
    return ParameterValue(type=kind, **{field: value})
