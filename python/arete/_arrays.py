# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays, regions and meshes of others as the module takes them; heights are float64, row by row, NaN for NODATA.

A form that is not understood is refused. Nothing is rounded: a number that float64 does not hold is an error.
"""

import math
import numbers
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray


def heights_of(array: Any, nodata: Optional[float]) -> NDArray[np.float64]:
    """The heights of a two-dimensional array of any order, stride, byte order and real type; masked cells and cells
    equal to `nodata` are NaN."""
    if not isinstance(array, np.ndarray):
        raise TypeError(f"the heights are of type {type(array).__name__}; pass a numpy array (np.asarray(...))")
    if array.ndim != 2:
        hint = "; of a raster of one band pass array[0]" if array.ndim == 3 and array.shape[0] == 1 else ""
        raise ValueError(f"the heights have {array.ndim} dimensions, not 2 (rows, columns){hint}")
    if array.dtype.kind not in "iuf":
        raise TypeError(f"heights of type {array.dtype} are no real numbers")
    mask = np.asarray(np.ma.getmaskarray(array), dtype=np.bool_)  # type: ignore[no-untyped-call]
    raw = np.asarray(np.ma.getdata(array))  # type: ignore[no-untyped-call]
    if raw.size == 0:
        raise ValueError(f"the heights have the shape {raw.shape}: there is none")
    with np.errstate(over="ignore"):
        heights = np.array(raw, dtype=np.float64, order="C", copy=True)
    if nodata is not None:
        mask = mask | (raw == _in_type_of(raw, nodata))
    exact = _is_exact(raw, heights) | mask
    if not exact.all():
        row, column = np.argwhere(~exact)[0]
        raise ValueError(f"the height {raw[row, column]!r} in row {row}, column {column} is no float64 number: nothing is "
                         "rounded")
    heights[mask] = np.nan
    return heights


def _is_exact(raw: NDArray[Any], heights: NDArray[np.float64]) -> NDArray[np.bool_]:
    if raw.dtype.kind == "f" and raw.dtype.itemsize <= 8:
        return np.ones(raw.shape, dtype=np.bool_)
    if raw.dtype.kind in "iu":
        if raw.dtype.itemsize < 8:
            return np.ones(raw.shape, dtype=np.bool_)
        # 2^63 and 2^64 are floats that no integer of that type is: only what is below comes back.
        below = heights < float(np.iinfo(raw.dtype).max)
        back = np.where(below, heights, 0).astype(raw.dtype.newbyteorder("="))
        return np.asarray(below & (back == raw), dtype=np.bool_)
    return np.asarray((heights.astype(raw.dtype) == raw) | np.isnan(raw), dtype=np.bool_)


def _in_type_of(raw: NDArray[Any], nodata: float) -> Any:
    """A NODATA value as the array has it: -3.4e38 of a text is that of float32."""
    if isinstance(nodata, (bool, np.bool_)) or not isinstance(nodata, numbers.Real):
        raise TypeError(f"nodata={nodata!r} is no number")
    with np.errstate(over="ignore"):
        if raw.dtype.kind == "f":
            return raw.dtype.type(nodata)
    if not math.isfinite(nodata) or nodata != int(nodata):
        return np.nan  # no whole number equals it
    limits = np.iinfo(raw.dtype)
    if int(nodata) == int(limits.max) + 1:
        return limits.max  # as a float, of 64 bits: rasterio's dataset.nodata
    return raw.dtype.type(int(nodata)) if limits.min <= int(nodata) <= limits.max else np.nan


def places_of(values: Any, name: str) -> Tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Coordinates as float64, and which of them are masked."""
    mask = np.asarray(np.ma.getmaskarray(values), dtype=np.bool_)  # type: ignore[no-untyped-call]
    raw = np.asarray(np.ma.getdata(values))  # type: ignore[no-untyped-call]
    if raw.dtype.kind not in "iufO" and raw.size:
        raise TypeError(f"{name} of type {raw.dtype} are no real numbers")
    return np.asarray(raw, dtype=np.float64), mask


def unmasked_places(values: Any, name: str) -> NDArray[np.float64]:
    """Coordinates as float64, none of them masked."""
    places, mask = places_of(values, name)
    refuse_masked(mask, name)
    return places


def refuse_masked(mask: NDArray[np.bool_], name: str) -> None:
    if mask.any():
        raise ValueError(f"{name} {int(np.argwhere(mask)[0][0])} is masked" if mask.ndim > 1 else f"the {name} is masked")


def geotransform_of(transform: Any) -> Optional[Tuple[float, float, float, float, float, float]]:
    """GDAL's order of an affine.Affine, as rasterio has it."""
    if transform is None:
        return None
    try:
        a, b, c, d, e, f = (float(getattr(transform, name)) for name in "abcdef")
        if not all(math.isfinite(number) for number in (a, b, c, d, e, f)) or a * e == b * d:
            raise OverflowError
    except OverflowError:
        raise ValueError(f"transform is not invertible: {tuple(transform)[:6]}") from None
    except (AttributeError, TypeError, ValueError):
        raise TypeError("transform is no affine.Affine (rasterio's dataset.transform); of GDAL's six numbers make "
                        "one by Affine.from_gdal(*numbers)") from None
    return (c, a, b, f, d, e)


def crs_text(crs: Any) -> str:
    """A CRS as text: WKT, "EPSG:32611", 32611, or an object of pyproj or rasterio."""
    if crs is None:
        return ""
    if isinstance(crs, str):
        return crs
    if isinstance(crs, (int, np.integer)) and not isinstance(crs, bool):
        return f"EPSG:{int(crs)}"
    if hasattr(crs, "to_wkt"):
        return str(crs.to_wkt())
    raise TypeError(f"a CRS of type {type(crs).__name__} is not understood; pass text, a number of EPSG, or an object with "
                    "to_wkt()")


def mesh_of(mesh: Any, triangles: Any) -> Tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Vertices (n, 3) and triangles (m, 3): of arrays, or of what has vertices and triangles (a Tin), points and cells
    (meshio) or vertices and faces (trimesh). Numbers that float64 does not hold are an error."""
    if triangles is None:
        mesh, triangles = _parts_of(mesh)
    for name, values in (("vertex", mesh), ("triangle", triangles)):
        refuse_masked(np.atleast_2d(np.ma.getmaskarray(values)), name)  # type: ignore[no-untyped-call]
    raw = np.asarray(mesh)
    if raw.dtype.kind not in "iuf":
        raise TypeError(f"vertices of type {raw.dtype} are no real numbers")
    vertices = np.ascontiguousarray(raw, dtype=np.float64)
    corners = np.asarray(triangles)
    for name, shape in (("vertices", vertices.shape), ("triangles", corners.shape)):
        if len(shape) != 2 or shape[1] != 3:
            raise ValueError(f"the {name} have the shape {shape}, not (n, 3)")
    if not _is_exact(raw, vertices).all():
        raise ValueError("a coordinate is no float64 number: nothing is rounded")
    if not np.isfinite(vertices).all():
        raise ValueError(f"vertex {int(np.argwhere(~np.isfinite(vertices))[0][0])} is not finite")
    if corners.dtype.kind not in "iu":
        raise ValueError(f"the triangles are no numbers of vertices: they are of type {corners.dtype}, not whole numbers")
    if corners.size and (corners.min() < 0 or corners.max() >= len(vertices)):
        wrong = int(np.argwhere(((corners < 0) | (corners >= len(vertices))).any(axis=1))[0][0])
        raise ValueError(f"the triangles are no numbers of vertices: triangle {wrong} has one that is not from 0 to "
                         f"{len(vertices) - 1}")
    return vertices, np.ascontiguousarray(corners, dtype=np.uint32)


def some_mesh_of(mesh: Any, triangles: Any) -> Tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """As mesh_of(), of a mesh that has triangles."""
    vertices, corners = mesh_of(mesh, triangles)
    if len(corners) == 0:
        raise ValueError("the mesh has no triangles: nothing is measured")
    return vertices, corners


def _parts_of(mesh: Any) -> Tuple[Any, Any]:
    if hasattr(mesh, "vertices"):
        for name in ("triangles", "faces"):
            if getattr(mesh, name, None) is not None and np.ndim(getattr(mesh, name)) == 2:
                return mesh.vertices, getattr(mesh, name)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        others = sorted(set(mesh.cells_dict) - {"triangle", "vertex", "line"})
        if others:
            raise ValueError(f"the mesh has cells that are no triangles: {', '.join(others)}")
        return mesh.points, mesh.cells_dict.get("triangle", np.empty((0, 3), dtype=np.uint32))
    raise TypeError("a mesh is vertices with triangles, or an object of meshio or trimesh")
