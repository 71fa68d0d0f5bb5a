# SPDX-License-Identifier: GPL-3.0-or-later
"""How steep triangles are on the ground."""

from typing import Any, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arete


def slopes_of(mesh: Any) -> NDArray[np.float64]:
    """Degrees from the horizontal, by triangle; NaN of one without area."""
    corners = _on_the_ground(mesh)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat = np.hypot(normals[:, 0], normals[:, 1])
    slopes = np.degrees(np.arctan2(flat, np.abs(normals[:, 2])))
    slopes[~normals.any(axis=1)] = np.nan
    return np.asarray(slopes, dtype=np.float64)


def _on_the_ground(mesh: Any) -> NDArray[np.float64]:
    """The corners of each triangle (m, 3, 3) in metres around its middle, by the scale of the map there: one meridian for
    all would shear what lies far from it. Without a CRS, and of a surface, in the units of the source."""
    corners = np.array(mesh.vertices, dtype=np.float64)[mesh.triangles]
    middles = corners.mean(axis=1, keepdims=True)
    local = corners - middles
    if len(mesh.source_vertices) > 0 or not mesh.crs or len(corners) == 0:
        return np.asarray(local, dtype=np.float64)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    middle = (float(low[0] + high[0]) / 2, float(low[1] + high[1]) / 2)
    units = _arete.ground_units(mesh.crs, middle, np.ascontiguousarray(middles[:, 0, 1]))
    local[:, :, :2] *= units[:, np.newaxis, :]
    metres = mesh._tin.file_parts[1]
    local[:, :, 2] *= metres if metres > 0 else 1
    return np.asarray(local, dtype=np.float64)


def aspect_of(mesh_crs: str, middle: Tuple[float, float]) -> float:
    """How much longer on the ground a unit of y is than one of x."""
    if not mesh_crs:
        return 1.0
    units = _arete.ground_units(mesh_crs, middle, np.array([middle[1]], dtype=np.float64))
    x, y = (float(one) for one in units[0])
    return y / x if x > 0 and y > 0 else 1.0
