# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an error holds: boxes, files, geometries of others, and functions of boxes."""

import os
from typing import Any, Callable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arete
from ._arrays import crs_text, mesh_of, unmasked_places
from ._checks import is_path, number

Rings = Tuple[Tuple[Tuple[float, float], ...], ...]
Box = Tuple[float, float, float, float]
TextRegion = Tuple[str, str, str, float]
Asked = Union[None, Box, List[Rings], TextRegion]

Where = Callable[..., Optional[bool]]
"""A function of the sides of a box: True: all of it is meant; False: nothing of it; None: not decided."""

MOST_BOXES = 4096
"""Boxes that a function leaves undecided are divided until there are so many, or they are as small as samples."""


def region_of(region: Any, crs: str = "", distance: Any = None, region_crs: Any = None) -> Asked:
    """A region of terrain as the module takes it; None for None.

    crs: of the terrain; "" for none.
    """
    around = number("distance", distance)
    if around is not None and not around > 0:
        raise ValueError(f"distance={distance!r} is not above 0")
    if region is None:
        for name, value in (("distance", distance), ("region_crs", region_crs)):
            if value is not None:
                raise ValueError(f"{name} needs a region")
        return None
    stated = crs_text(region_crs)
    if is_path(region):
        return (os.fspath(region), "", stated, around or 0)
    if _is_geometry(region):
        return _of_geometry(region, crs, stated, around)
    box = _box_of(region)
    if around is None and not stated:
        return box
    return (",".join(repr(side) for side in box), "", stated, around or 0)


def _is_geometry(region: Any) -> bool:
    return isinstance(region, dict) or hasattr(region, "__geo_interface__")


def _box_of(region: Any) -> Box:
    try:
        left, bottom, right, top = (float(side) for side in region)
    except (TypeError, ValueError):
        raise TypeError("a region is a box (xmin, ymin, xmax, ymax), a path, a geometry of shapely, or a GeoSeries") from None
    return (left, bottom, right, top)


def _of_geometry(region: Any, crs: str, stated: str, distance: Optional[float]) -> Asked:
    geometry = region if isinstance(region, dict) else region.__geo_interface__
    own = stated or crs_text(getattr(region, "crs", None))
    parts = list(_parts_of(geometry))
    others = sorted({kind for kind, _ in parts if kind != "Polygon"})
    if others and distance is None:
        raise ValueError(f"a region is a Polygon or a MultiPolygon, not a {others[0]}: a {others[0]} needs a distance")
    if distance is None and not own:
        return [coordinates for _, coordinates in parts]
    return ("", _wkt_table_of(parts), own or crs, distance or 0)


def _parts_of(geometry: Any) -> Iterator[Tuple[str, Any]]:
    """The single geometries: each its kind and its coordinates."""
    if geometry is None:
        return
    kind = geometry.get("type")
    if kind == "Polygon":
        yield kind, tuple(tuple((float(p[0]), float(p[1])) for p in ring) for ring in geometry["coordinates"])
    elif kind in ("LineString", "LinearRing"):
        yield "LineString", tuple((float(p[0]), float(p[1])) for p in geometry["coordinates"])
    elif kind == "Point":
        yield kind, (float(geometry["coordinates"][0]), float(geometry["coordinates"][1]))
    elif kind in ("MultiPolygon", "MultiLineString", "MultiPoint"):
        for part in geometry["coordinates"]:
            yield from _parts_of({"type": kind[5:], "coordinates": part})
    elif kind == "GeometryCollection":
        for part in geometry["geometries"]:
            yield from _parts_of(part)
    elif kind == "Feature":
        yield from _parts_of(geometry.get("geometry"))
    elif kind == "FeatureCollection":
        for feature in geometry["features"]:
            yield from _parts_of(feature)
    else:
        raise ValueError(f"a region is a Polygon or a MultiPolygon, not a {kind}")


def _wkt_table_of(parts: Sequence[Tuple[str, Any]]) -> str:
    def text(coordinates: Any) -> str:
        if not coordinates:
            return ""
        if isinstance(coordinates[0], float):
            return f"{coordinates[0]!r} {coordinates[1]!r}"
        return ", ".join(text(one) if one and isinstance(one[0], float) else f"({text(one)})" for one in coordinates)

    # GDAL takes a table of one column for none.
    rows = (f'"{kind.upper()} ({text(coordinates)})",{i}\n' for i, (kind, coordinates) in enumerate(parts))
    return "WKT,number\n" + "".join(rows)


def boxes_where(where: Where, low: Sequence[float], high: Sequence[float], least: Sequence[float]) -> NDArray[np.float64]:
    """The boxes (n, 2 d) that a function means or leaves undecided, of a box of d dimensions halved again and again.

    least: sides below which a box is not divided. What stays undecided belongs to them.
    """
    if not callable(where):
        raise TypeError(f"where is a function of the sides of a box, not {type(where).__name__}")
    size = len(low)
    meant: List[Tuple[float, ...]] = []
    open_boxes: List[Tuple[int, ...]] = [(0,) * size]
    parts = 1
    while open_boxes:
        undecided = []
        for box in open_boxes:
            sides = _sides(box, parts, low, high)
            answer = where(*sides)
            if answer is None:
                undecided.append(box)
            elif not isinstance(answer, (bool, np.bool_)):
                raise TypeError(f"where answers {answer!r}, not True, False or None")
            elif answer:
                meant.append(sides)
        is_smallest = all((high[i] - low[i]) / parts <= least[i] for i in range(size))
        if is_smallest or len(undecided) * 2**size > MOST_BOXES:
            meant.extend(_sides(box, parts, low, high) for box in undecided)
            break
        parts *= 2
        open_boxes = [tuple(2 * at + (k >> i & 1) for i, at in enumerate(box)) for box in undecided for k in range(2**size)]
    return np.array(meant, dtype=np.float64).reshape(len(meant), 2 * size)


def _sides(box: Sequence[int], parts: int, low: Sequence[float], high: Sequence[float]) -> Tuple[float, ...]:
    """Boxes that touch have the same side, to the bit."""
    def at(i: int, step: int) -> float:
        return high[i] if step == parts else low[i] + (high[i] - low[i]) * (step / parts)

    return (*(at(i, step) for i, step in enumerate(box)), *(at(i, step + 1) for i, step in enumerate(box)))


def rings_of_boxes(boxes: NDArray[np.float64]) -> List[Rings]:
    """Boxes of the plan as polygons."""
    return [(((x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)),) for x0, y0, x1, y1 in boxes.tolist()]


def space_region_of(region: Any, progress: Any) -> Tuple[Optional[_arete.RegionOfSpace], str]:
    """A region of a surface as the module takes it, and as a text; None for None."""
    if region is None:
        return None, ""
    if is_path(region):
        return _arete.region_of_file(os.fspath(region), progress), os.fspath(region)
    if isinstance(region, (tuple, list)) and len(region) == 2:
        return _arete.region_of_mesh(*mesh_of(*region)), "a mesh of arrays"
    if hasattr(region, "vertices") or hasattr(region, "points"):
        return _arete.region_of_mesh(*mesh_of(region, None)), "a mesh of arrays"
    try:
        sides = [float(side) for side in region]
    except (TypeError, ValueError):
        raise TypeError("a region is a box (x0, y0, z0, x1, y1, z1), a ball (x, y, z, r) or a closed mesh") from None
    return _arete.region_of_numbers(sides), ",".join(repr(side) for side in sides)


def line_of(line: Any, most: int = 2) -> NDArray[np.float64]:
    """The places (n, 2), or with heights (n, 3), of rows or of a line with __geo_interface__ (shapely)."""
    geometry = getattr(line, "__geo_interface__", line if isinstance(line, dict) else None)
    if geometry is not None:
        if geometry.get("type") != "LineString":
            raise ValueError(f"a line is a LineString, not a {geometry.get('type')}")
        line = [place[:2] for place in geometry["coordinates"]]
    if is_path(line):
        raise TypeError("a line is rows of x, y or a line of shapely, not a path: geopandas reads files")
    if isinstance(line, (list, tuple)) and len({len(row) for row in line if hasattr(row, "__len__")}) > 1:
        raise ValueError("the rows of a line have different lengths: x, y of all, or x, y, height of both")
    places = np.ascontiguousarray(unmasked_places(line, "place"))
    if places.ndim != 2 or not 2 <= places.shape[1] <= most or len(places) < 2:
        raise ValueError("a line is two or more rows of x, y")
    if places.shape[1] == 3 and len(places) != 2:
        raise ValueError("heights are for a line of sight: two rows of x, y, height above the ground")
    if not np.isfinite(places).all():
        raise ValueError("a place of the line is not finite")
    return places
