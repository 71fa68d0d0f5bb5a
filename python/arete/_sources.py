# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids and points of others: arrays, xarray, rasterio, geopandas."""

import dataclasses
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _checks
from ._arrays import crs_text, geotransform_of, heights_of, unmasked_places


@dataclasses.dataclass(frozen=True)
class Grid:
    """Heights with what their source says of them."""

    heights: NDArray[np.float64]
    transform: Optional[Tuple[float, ...]] = None
    """GDAL's six numbers."""
    crs: str = ""
    vertical_unit: str = ""
    name: str = "array"
    axes: Optional[Tuple[Any, Any]] = None
    """Of an xarray.DataArray: its coordinates along rows (y) and columns (x), which a transform has but for the last bits."""
    is_depth: Optional[bool] = None
    """Whether the values count downwards; None: it is not said."""


def grid_of(source: Any, transform: Any, crs: Any, nodata: Optional[float], band: Optional[int]) -> Grid:
    """The grid of an array, an xarray.DataArray or a rasterio dataset."""
    if hasattr(source, "read") and hasattr(source, "transform") and hasattr(source, "count"):
        _refuse_beside("a dataset of rasterio", transform=transform, crs=crs)
        return _of_rasterio(source, nodata, band)
    if band is not None:
        raise TypeError("band is for files and datasets: an array has one")
    if hasattr(source, "dims") and hasattr(source, "coords"):
        _refuse_beside("an xarray.DataArray", transform=transform, crs=crs)
        return _of_xarray(source, nodata)
    if crs is not None and transform is None:
        raise ValueError("a crs needs a transform, which says where the heights are")
    heights = heights_of(source, nodata)
    if transform is None and heights.shape[1] == 3 and heights.shape[0] >= 10:
        _checks.warn(f"an array of {heights.shape[0]} rows and 3 columns is taken as a grid of heights: "
                     "arete.build_points() takes rows of x, y, z", "choice", stacklevel=4)
    return Grid(heights, geotransform_of(transform), crs_text(crs))


def _refuse_beside(what: str, **options: Any) -> None:
    for name, value in options.items():
        if value is not None:
            raise TypeError(f"{name} is for arrays: {what} says its own")


def _of_rasterio(dataset: Any, nodata: Optional[float], band: Optional[int]) -> Grid:
    number = 1 if band is None else band
    if not 1 <= number <= dataset.count:
        raise ValueError(f"band={band!r} is not one of 1 to {dataset.count}")
    colours = [colour.name for colour in dataset.colorinterp]
    if len(colours) - colours.count("alpha") > 1 and band is None:
        # As a file is refused or warned of.
        if dataset.dtypes[0] == "uint8" or colours[0] == "red":
            raise ValueError(f"{dataset.name}: looks like a colour image of {dataset.count} bands, not like heights; band= reads "
                             "one of its bands as heights")
        _checks.warn(f"{dataset.name}: has {dataset.count} bands; band 1 is read", "choice", stacklevel=5)
    if colours[number - 1] == "palette":
        _checks.warn(f"{dataset.name}: the band has a colour table: its values may be classes or colours, not heights", "heights",
                     stacklevel=5)
    array = dataset.read(number, masked=True)
    heights = heights_of(array, nodata)
    scale, offset = float(dataset.scales[number - 1]), float(dataset.offsets[number - 1])
    if (scale, offset) != (1.0, 0.0):
        heights = heights * scale + offset
    transform: Optional[Tuple[float, ...]] = geotransform_of(dataset.transform)
    if transform == (0.0, 1.0, 0.0, 0.0, 0.0, 1.0) and not dataset.crs:
        if dataset.gcps[0] or getattr(dataset, "rpcs", None):
            raise ValueError(f"{dataset.name} is placed by control points or RPCs: warp it first (rasterio.vrt.WarpedVRT)")
        transform = None  # rasterio's way to say that there is none
    return Grid(heights, transform, crs_text(dataset.crs) if dataset.crs else "", dataset.units[number - 1] or "",
                str(dataset.name))


def _of_xarray(array: Any, nodata: Optional[float]) -> Grid:
    if hasattr(array, "data_vars"):
        raise TypeError(f"an xarray.Dataset has several variables; pass one: {', '.join(map(str, array.data_vars))}")
    array = array.squeeze([dim for dim in array.dims if array.sizes[dim] == 1 and dim not in _X + _Y])
    if array.ndim != 2:
        raise ValueError(f"the array has the dimensions {', '.join(map(str, array.dims))}, not two: choose one of the others")
    array = _north_east(array)
    raw = np.asarray(array.values)
    # An attribute says of raw values what is none; xarray takes it away where it has decoded them.
    fill = array.attrs.get("_FillValue", array.attrs.get("missing_value")) if nodata is None else nodata
    heights = heights_of(raw, None if fill is None else float(fill))
    scale, offset = float(array.attrs.get("scale_factor", 1)), float(array.attrs.get("add_offset", 0))
    if (scale, offset) != (1.0, 0.0):
        heights = heights * scale + offset
    unit = str(array.attrs.get("units", "") or "")
    is_depth = True if str(array.attrs.get("positive", "")).lower() == "down" else None
    place = _transform_of(array)
    axes = None if place is None else (array.coords[array.dims[0]], array.coords[array.dims[1]])
    return Grid(heights, place, _crs_of(array), unit, str(array.name or "array"), axes, is_depth)


_X = ("x", "lon", "longitude", "easting")
_Y = ("y", "lat", "latitude", "northing")


def _north_east(array: Any) -> Any:
    """With rows along y and columns along x."""
    first, second = (str(dim) for dim in array.dims)
    if first.lower() in _X and second.lower() in _Y:
        return array.transpose()
    if first.lower() in _Y + ("dim_0",) or second.lower() in _X + ("dim_1",):
        return array
    raise ValueError(f"the dimensions {first} and {second} are not known: name them y and x")


def _transform_of(array: Any) -> Optional[Tuple[float, ...]]:
    if any(dim not in array.coords for dim in array.dims):
        return None
    y, x = (np.asarray(array.coords[dim].values, dtype=np.float64) for dim in array.dims)
    stated = array.attrs.get("transform")
    if stated is not None and len(stated) >= 6:
        a, b, c, d, e, f = (float(one) for one in tuple(stated)[:6])
        # The attribute of an array that was cut out is that of the whole.
        if b == 0 and d == 0 and np.array_equal(c + a * (np.arange(len(x)) + 0.5), x) and np.array_equal(
                f + e * (np.arange(len(y)) + 0.5), y):
            return (c, a, 0.0, f, 0.0, e)
    dx, dy = _step("x", x), _step("y", y)
    return (float(x[0]) - dx / 2, dx, 0.0, float(y[0]) - dy / 2, 0.0, dy)


def _step(name: str, places: NDArray[np.float64]) -> float:
    """The distance of places that are equally far apart."""
    if len(places) < 2:
        raise ValueError(f"there is one {name} alone: how large a pixel is, is not known")
    step = float((places[-1] - places[0]) / (len(places) - 1))
    if not np.isfinite(places).all() or step == 0 or np.abs(
            places - (places[0] + step * np.arange(len(places)))).max() > 0.01 * abs(step):
        raise ValueError(f"the coordinates {name} are not equally far apart: arete.build_points() takes places")
    return step


def _crs_of(array: Any) -> str:
    own = array.attrs.get("crs")
    if own is None and hasattr(array, "rio"):
        own = array.rio.crs
    if own is None and "spatial_ref" in array.coords:
        attributes = array.coords["spatial_ref"].attrs
        own = attributes.get("crs_wkt") or attributes.get("spatial_ref")
    return crs_text(own)


def points_of(source: Any, z_field: Optional[str]) -> Tuple[NDArray[np.float64], str]:
    """Rows of x, y, z, and their CRS."""
    geometry = getattr(source, "geometry", None)
    if geometry is not None and hasattr(geometry, "x"):
        if z_field is not None and z_field not in getattr(source, "columns", ()):
            raise ValueError(f"z_field={z_field!r} is no column: there are {', '.join(map(str, getattr(source, 'columns', ())))}")
        z = geometry.z if z_field is None else source[z_field]
        return np.column_stack([np.asarray(one, dtype=np.float64) for one in (geometry.x, geometry.y, z)]), crs_text(
            getattr(geometry, "crs", None))
    if z_field is not None:
        raise TypeError("z_field is for files and frames of geopandas")
    rows = np.ascontiguousarray(unmasked_places(source, "point"))
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise ValueError(f"the points have the shape {rows.shape}, not (n, 3): rows of x, y, z")
    return rows, ""
