"""Elementary functions for one formula on numbers (`math`, fast) and NumPy arrays (vectorised)."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np

_SCALAR: Any = SimpleNamespace(
    sin=math.sin, cos=math.cos, tan=math.tan, tanh=math.tanh, atan=math.atan, atan2=math.atan2,
    hypot=math.hypot, sqrt=math.sqrt, exp=math.exp,
)  # fmt: skip
_ARRAY: Any = SimpleNamespace(
    sin=np.sin, cos=np.cos, tan=np.tan, tanh=np.tanh, atan=np.arctan, atan2=np.arctan2,
    hypot=np.hypot, sqrt=np.sqrt, exp=np.exp,
)  # fmt: skip


def functions_of(value: Any) -> Any:
    """Return the elementary functions that fit `value`: NumPy's for an array, `math`'s for a number."""
    return _ARRAY if isinstance(value, np.ndarray) else _SCALAR
