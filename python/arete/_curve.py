# SPDX-License-Identifier: GPL-3.0-or-later
"""How many triangles which error takes."""

from typing import Any, List, NamedTuple, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray


class _CurveColumns(NamedTuple):
    max_error: NDArray[np.float64]
    minimal: NDArray[np.int64]
    saturated: NDArray[np.int64]


class Curve(_CurveColumns):
    """Numbers of triangles by error: of the fewest (minimal), and of those that are found faster (saturated)."""

    unit: str = ""
    """Of the errors."""

    def plot(self, ax: Any = None) -> Any:
        """Draws it with matplotlib; returns the axes."""
        from ._plot import plot_curve

        return plot_curve(self, ax)


def curve_of(points: Sequence[Tuple[float, int, int]], unit: str) -> Curve:
    columns: List[Any] = list(zip(*points)) or [(), (), ()]
    curve = Curve(np.array(columns[0], dtype=np.float64), np.array(columns[1], dtype=np.int64),
                  np.array(columns[2], dtype=np.int64))
    curve.unit = unit
    return curve
