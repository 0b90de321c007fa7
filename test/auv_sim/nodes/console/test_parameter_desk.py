"""Values of parameters on their way to JSON and back."""

from __future__ import annotations

import json
from typing import Any

import pytest
from rclpy.parameter import Parameter, parameter_value_to_python

from auv_sim.nodes.console.parameter_desk import converted, plain_value
from auv_sim.views.console.web.operator_desk import RequestRefused


@pytest.mark.parametrize(
    "value", [True, 3, 0.5, "text", [1.5, 2.5], ["a", "b"], [1, 2], [True, False], [b"\x01", b"\xff"]]
)
def test_every_value_has_json(value: Any) -> None:
    message = Parameter("name", value=value).to_parameter_msg().value
    plain = [1, 255] if value == [b"\x01", b"\xff"] else value
    assert json.loads(json.dumps(plain_value(message))) == plain


@pytest.mark.parametrize(
    ("kind", "given", "taken"),
    [
        (Parameter.Type.DOUBLE, 2, 2.0),
        (Parameter.Type.DOUBLE, 2.5, 2.5),
        (Parameter.Type.INTEGER, 3.0, 3),
        (Parameter.Type.BOOL, True, True),
        (Parameter.Type.STRING, "nism", "nism"),
        (Parameter.Type.STRING_ARRAY, ["map"], ["map"]),
    ],
)
def test_a_number_of_json_becomes_the_parameters_type(kind: Parameter.Type, given: Any, taken: Any) -> None:
    found = parameter_value_to_python(converted("name", given, kind.value))
    assert (found, type(found)) == (taken, type(taken))


@pytest.mark.parametrize(
    ("kind", "given"),
    [
        (Parameter.Type.DOUBLE, True), (Parameter.Type.DOUBLE, "2"), (Parameter.Type.DOUBLE, None),
        (Parameter.Type.DOUBLE, float("nan")), (Parameter.Type.DOUBLE, 10**400),
        (Parameter.Type.INTEGER, 2.5), (Parameter.Type.INTEGER, 2**70), (Parameter.Type.BOOL, 1),
        (Parameter.Type.STRING, 1), (Parameter.Type.STRING_ARRAY, [1]), (Parameter.Type.NOT_SET, 1.0),
    ],
)  # fmt: skip
def test_a_value_of_another_type_is_refused(kind: Parameter.Type, given: Any) -> None:
    with pytest.raises(RequestRefused, match=r"^name: found .*, expected "):
        converted("name", given, kind.value)
