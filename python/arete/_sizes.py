# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes as numbers or as percentages ("1%") of a whole."""

import math
import numbers
from typing import Any, Callable, Optional, Union

from ._checks import whole as whole_number

Size = Union[float, str]
"""A number, or a percentage as text: "1%"."""


def size_of(name: str, value: Any, whole: Callable[[], float]) -> Optional[float]:
    """The number; None for None. Of a percentage its part of whole(), which is called for no other value."""
    if value is None:
        return None
    if isinstance(value, str):
        try:
            if not value.strip().endswith("%"):
                raise ValueError
            share = float(value.strip()[:-1])
        except ValueError:
            raise TypeError(f"{name}={value!r} is no number and no percentage (\"1%\")") from None
        if not 0 <= share < math.inf:
            raise ValueError(f"{name}={value!r} is not at least 0")
        return share / 100 * whole()
    if isinstance(value, bool):
        raise TypeError(f"{name}={value!r} is no number and no percentage (\"1%\")")
    if not isinstance(value, numbers.Real) and not (hasattr(value, "ndim") and value.ndim == 0):
        raise TypeError(f"{name}={value!r} is no number and no percentage (\"1%\")")
    return float(value)


def count_of(name: str, value: Any, total: Callable[[], int]) -> Optional[int]:
    """The same of a whole number, at least 1; a percentage is rounded down."""
    if not isinstance(value, str):
        return whole_number(name, value, 1, 0xFFFFFFFE)
    size = size_of(name, value, total)
    assert size is not None
    if float(value.strip()[:-1]) > 100:
        raise ValueError(f"{name}={value!r} is more than all")
    if size < 1:
        raise ValueError(f"{name}={value!r} is less than one triangle")
    return int(size)


def counted(count: int, one: str, many: str) -> str:
    """A number and the word that agrees with it: "1 triangle", "2 triangles"."""
    return f"{count} {one if count == 1 else many}"
