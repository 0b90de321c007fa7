"""Arithmetic rounded as in Python, where compilers and C libraries round differently.

In still water a last bit is irrelevant. At sea a dead band and a saturated controller amplify it to
centimetres.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from auv_msgs_py.values.pure import modulus, squared
from auv_sim.flight.batch.compiled import numba, overloads

#: Splits a number into two halves of its bits.
_SPLITTER = 134217729.0


def hypot(x: float, y: float) -> float:
    """Return sqrt(x^2 + y^2) as `math.hypot` has it: corrected by what is left of x^2 + y^2 - h^2."""
    h = math.sqrt(x * x + y * y)
    if not 1e-120 < h < 1e120:
        large, small = max(abs(x), abs(y)), min(abs(x), abs(y))
        if not 0.0 < large < math.inf:
            return x * x + y * y
        return large * math.sqrt(1.0 + (small / large) * (small / large))
    total, rest = 0.0, 0.0
    for value, sign in ((x, 1.0), (y, 1.0), (h, -1.0)):
        split = value * _SPLITTER
        high = split - (split - value)
        low = value - high
        for term in (sign * high * high, sign * 2.0 * high * low):
            before = total
            total += term
            # The rounding error of this sum, whichever of both is larger.
            part = total - before
            rest += (before - (total - part)) + (term - part)
        rest += sign * low * low
    return h + (total + rest) / (2.0 * h)


@overloads(squared)
def _squared(x: Any) -> Callable[..., Any]:
    # A compiler that cannot see that the exponent is 2 calls the same power as Python.
    return lambda x: math.pow(x, 2.0 + 0.0 * x)


if numba is not None:
    from numba import types
    from numba.extending import lower_builtin

    _libm_hypot = types.ExternalFunction("hypot", types.float64(types.float64, types.float64))

    @overloads(modulus)
    def _modulus(z: Any) -> Callable[..., Any]:
        return lambda z: _libm_hypot(z.real, z.imag)

    def _lowered_hypot(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return context.compile_internal(builder, hypot, signature, arguments)

    _lower: Any = lower_builtin
    _lower(math.hypot, types.float64, types.float64)(_lowered_hypot)
