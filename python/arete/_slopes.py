# SPDX-License-Identifier: GPL-3.0-or-later
"""How steep triangles are on the ground."""

from typing import Any, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _arete


def slopes_of(mesh: Any) -> NDArray[np.float64]:
    """Degrees from the horizontal, by triangle; NaN of one without area."""
    corners = ground_of(mesh)[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat = np.hypot(normals[:, 0], normals[:, 1])
    with np.errstate(invalid="ignore"):
        slopes = np.degrees(np.arctan2(flat, np.abs(normals[:, 2])))
    slopes[~normals.any(axis=1)] = np.nan
    return np.asarray(slopes, dtype=np.float64)


def ground_of(mesh: Any) -> NDArray[np.float64]:
    """The vertices in metres from the middle, each where the map has the scale of its latitude. Without a CRS in the
    units of the source."""
    places = np.array(mesh.vertices, dtype=np.float64)
    if len(places) == 0:
        return places
    low, high = places.min(axis=0), places.max(axis=0)
    middle = (low + high) / 2
    unit = mesh._tin.file_parts[1]
    if _is_surface(mesh) or not mesh.crs:
        return np.asarray(places - middle, dtype=np.float64)
    units = _arete.ground_units(mesh.crs, (float(middle[0]), float(middle[1])), np.ascontiguousarray(places[:, 1]))
    metres = places - middle
    metres[:, :2] *= units
    metres[:, 2] *= unit if unit > 0 else 1
    return np.asarray(metres, dtype=np.float64)


def aspect_of(mesh_crs: str, middle: Tuple[float, float]) -> float:
    """How much longer on the ground a unit of y is than one of x."""
    if not mesh_crs:
        return 1.0
    units = _arete.ground_units(mesh_crs, middle, np.array([middle[1]], dtype=np.float64))
    x, y = (float(one) for one in units[0])
    return y / x if x > 0 and y > 0 else 1.0


def _is_surface(mesh: Any) -> bool:
    return len(mesh.source_vertices) > 0
