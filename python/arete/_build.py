# SPDX-License-Identifier: GPL-3.0-or-later
"""Building terrain: of files, grids and points."""

import os
from typing import Any, Optional, Sequence

import numpy as np

from . import _arete, _checks
from ._arrays import crs_text
from ._cuts import Progress
from ._model import Model
from ._sizes import Size
from ._sources import grid_of, points_of

_RULES = ("min", "max", "mean", "first")


def build(source: Any, *, transform: Any = None, crs: Any = None, nodata: Optional[float] = None,
          shape: str = "delaunay", features: Optional[int] = None, progress: Progress = None, band: Optional[int] = None,
          layer: Optional[str] = None, z_field: Optional[str] = None, same_place: Optional[str] = None,
          vertical_unit: Optional[str] = None, positive: Optional[str] = None, ratio: Optional[float] = None,
          max_degree: int = 14, min_aspect: Optional[float] = None, rim_tolerance: float = 0,
          feature_persistence: Optional[Size] = None, fixed: Any = None, crease_angle: Optional[float] = None) -> Model:
    """Builds the multitriangulation of a DEM.

    source: a path that `arete build` takes for terrain, or several of one mosaic; a two-dimensional numpy array (row 0 is
        the northernmost with the usual transform; masked cells are NODATA); an xarray.DataArray; a rasterio dataset.
    transform: of an array, an affine.Affine, as rasterio has it; without it x is the column and y the row from the last
        one upwards, both and a half. crs: of an array or of a file that has none; text, a number of EPSG, or an object
        with to_wkt(). nodata: a height that stands for none.
    band, layer, z_field, same_place: which of a file's; same_place is "min", "max", "mean" or "first" where points of one
        place have different heights. vertical_unit, positive ("up", "down"): where the source is wrong or says none.
    shape: "delaunay", or "fidelity" for far fewer triangles at the same error, none thinner than min_aspect (0.02).
    features: how many peaks, pits and passes every cut keeps (64); or those of at least feature_persistence ("5%" of the
        relief). fixed: places whose samples are kept: rows of x, y, points of geopandas, or a path. crease_angle: vertices
        on sharper creases are kept, in degrees. rim_tolerance: how many samples a rim of NODATA may move.
    ratio, max_degree: how levels grow, and the most neighbours of a vertex that is removed.
    progress: called with a stage and a fraction from 0 to 1; what it raises ends the build and is raised here.
    """
    request = _request(shape, features, ratio, max_degree, min_aspect, rim_tolerance, feature_persistence, fixed,
                       crease_angle)
    _checks.word("same_place", same_place, _RULES)
    depth = _depth(positive)
    paths = _paths_of(source)
    if paths is not None:
        if transform is not None:
            raise TypeError("transform is for arrays: a file says its own")
        stated = _checks.number("nodata", nodata) if nodata is None or nodata == nodata else nodata
        request.set_reading(_checks.whole("band", band, 1, 2**31 - 1), layer or "", z_field or "", same_place or "",
                            crs_text(crs), stated, vertical_unit or "", depth, paths[1:])
        return Model(_arete.build_file(paths[0], request, progress), files=[*paths, request.fixed_file])
    for name, value in (("layer", layer), ("z_field", z_field), ("same_place", same_place)):
        if value is not None:
            raise TypeError(f"{name} is for files of points; arete.build_points() takes points")
    grid = grid_of(source, transform, crs, nodata, band)
    request.source = grid.name
    request.has_place = grid.transform is not None
    if depth is None and grid.is_depth:
        _checks.warn("the array counts downwards (positive: down): its depths are negated", "heights")
    request.set_reading(None, "", "", "", "", None, vertical_unit or "", grid.is_depth if depth is None else depth,
                        [])
    model = Model(_arete.build_array(grid.heights, grid.transform, grid.crs, grid.vertical_unit, request, progress),
                  files=[grid.name, request.fixed_file])
    model._axes = grid.axes
    return model


def build_points(source: Any, *, crs: Any = None, same_place: Optional[str] = None, nodata: Optional[float] = None,
                 vertical_unit: Optional[str] = None, positive: Optional[str] = None, layer: Optional[str] = None,
                 z_field: Optional[str] = None, shape: str = "delaunay", features: Optional[int] = None,
                 ratio: Optional[float] = None, max_degree: int = 14, min_aspect: Optional[float] = None,
                 feature_persistence: Optional[Size] = None, fixed: Any = None, crease_angle: Optional[float] = None,
                 progress: Progress = None) -> Model:
    """Builds the multitriangulation of scattered points.

    source: rows of x, y, z (n, 3); points of geopandas, with their z or the column z_field; a path of points, or of a mesh,
        whose vertices are taken. The other arguments are those of build().
    """
    request = _request(shape, features, ratio, max_degree, min_aspect, 0, feature_persistence, fixed, crease_angle)
    _checks.word("same_place", same_place, _RULES)
    stated = None if nodata is None else float(nodata)

    def read_as(own: str) -> None:
        request.set_reading(None, layer or "", z_field or "", same_place or "", crs_text(crs) or own, stated,
                            vertical_unit or "", _depth(positive), [])

    if _checks.is_path(source):
        read_as("")
        return Model(_arete.build_point_file(os.fspath(source), request, progress), files=[os.fspath(source)])
    if layer is not None:
        raise TypeError("layer is for files")
    rows, own = points_of(source, z_field)
    without = np.isnan(rows[:, 2])
    if without.any():
        _checks.warn(f"{int(without.sum())} of {len(rows)} points have no height and are left out", "omitted")
        rows = np.ascontiguousarray(rows[~without])
    if not np.isfinite(rows).all():
        raise ValueError(f"point {int(np.argwhere(~np.isfinite(rows))[0][0])} is not finite")
    if len(rows) == 0:
        raise ValueError("there is no point")
    read_as(own)
    return Model(_arete.build_points(rows, request, progress))


def _request(shape: str, features: Optional[int], ratio: Optional[float], max_degree: int, min_aspect: Optional[float],
             rim_tolerance: float, feature_persistence: Optional[Size], fixed: Any,
             crease_angle: Optional[float]) -> _arete.BuildRequest:
    if features is not None and feature_persistence is not None:
        raise ValueError("features and feature_persistence exclude each other")
    request = _arete.BuildRequest()
    request.shape = str(shape)
    request.features = _checks.whole("features", features, 0, 100_000_000)
    request.ratio = _checks.number("ratio", ratio)
    request.max_degree = _checks.whole("max_degree", max_degree, 6, 32) or 14
    request.min_aspect = _checks.number("min_aspect", min_aspect, 0)
    request.rim_tolerance = _checks.number("rim_tolerance", rim_tolerance, 0) or 0
    request.feature_persistence = _checks.size_text("feature_persistence", feature_persistence)
    request.crease_angle = _checks.number("crease_angle", crease_angle, 0, 180)
    if _checks.is_path(fixed):
        request.fixed_file = os.fspath(fixed)
    elif fixed is not None:
        request.set_fixed(_places_of(fixed))
    return request


def _places_of(fixed: Any) -> Any:
    geometry = getattr(fixed, "geometry", None)
    if geometry is not None and hasattr(geometry, "x"):
        return np.ascontiguousarray(np.column_stack([np.asarray(geometry.x), np.asarray(geometry.y)]), dtype=np.float64)
    rows = np.ascontiguousarray(np.asarray(fixed, dtype=np.float64))
    if rows.ndim != 2 or rows.shape[1] not in (2, 3) or not np.isfinite(rows).all():
        raise ValueError("fixed is rows of x, y, finite numbers")
    return np.ascontiguousarray(rows[:, :2])


def _depth(positive: Optional[str]) -> Optional[bool]:
    _checks.word("positive", positive, ("up", "down"))
    return None if positive is None else positive == "down"


def _paths_of(source: Any) -> Optional[Sequence[str]]:
    if _checks.is_path(source):
        return [os.fspath(source)]
    if isinstance(source, (list, tuple)) and source and all(_checks.is_path(one) for one in source):
        return [os.fspath(one) for one in source]
    return None
