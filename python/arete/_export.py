# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as other modules have it, where they are installed. Vertices and triangles keep their order."""

from typing import Any, Dict

import numpy as np


def _errors_of(mesh: Any) -> Any:
    return getattr(mesh, "errors", None)


def to_meshio(mesh: Any) -> Any:
    import meshio

    errors = _errors_of(mesh)
    return meshio.Mesh(mesh.vertices, [("triangle", mesh.triangles)], cell_data=None if errors is None else {"error": [errors]})


def to_trimesh(mesh: Any) -> Any:
    import trimesh

    errors = _errors_of(mesh)
    said: Dict[str, Any] = {"crs": mesh.crs, "vertical_unit": mesh.vertical_unit}
    # It would merge and reorder vertices otherwise.
    return trimesh.Trimesh(vertices=np.array(mesh.vertices), faces=mesh.triangles.astype(np.int64), process=False,
                           face_attributes={} if errors is None else {"error": np.array(errors)}, metadata=said)


def to_pyvista(mesh: Any) -> Any:
    import pyvista

    triangles = mesh.triangles.astype(np.int64)
    faces = np.column_stack([np.full(len(triangles), 3, dtype=np.int64), triangles]).ravel()
    made = pyvista.PolyData(np.array(mesh.vertices), faces)
    errors = _errors_of(mesh)
    if errors is not None:
        made.cell_data["error"] = np.array(errors)
    return made


def to_geopandas(mesh: Any) -> Any:
    import geopandas
    import shapely

    corners = mesh.vertices[mesh.triangles]
    if hasattr(shapely, "polygons"):
        polygons = shapely.polygons(corners)
    else:
        from shapely.geometry import Polygon

        polygons = [Polygon(corner) for corner in corners]
    errors = _errors_of(mesh)
    columns = {} if errors is None else {"error": np.array(errors)}
    return geopandas.GeoDataFrame(columns, geometry=list(polygons), crs=mesh.crs)
