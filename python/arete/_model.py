# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain: what a DEM becomes, and what it answers."""

import math
import os
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arete
from ._arrays import crs_text, geotransform_of, heights_of, line_of, mesh_of, region_of
from ._arrays import places_of, some_mesh_of, unmasked_places
from ._cuts import Asked, Camera, PathLike, Progress, Stored, Tin, focus_of
from ._sizes import Size, count_of, counted, size_of


class Sight(NamedTuple):
    """The answer of a line of sight, or arrays of answers."""

    verdict: Any
    """ "visible", "blocked", "unknown" (NODATA is in the way) or "undecided" (within max_error)."""
    clearance: Any
    """The least height of the line above the terrain, in the unit of heights; NaN where there is none below it."""
    distance: Any
    """Metres along the ground."""
    obstruction: Any
    """x, y where the line is first blocked; None, in arrays NaN, where it is not."""

    @property
    def visible(self) -> Any:
        return self.verdict == "visible"


class Profile(NamedTuple):
    """The terrain along a line: arrays by vertex. It is straight between vertices of one part; between parts there is
    none."""

    distance: NDArray[np.float64]
    """Metres along the ground."""
    places: NDArray[np.float64]
    """(n, 2): x, y in the CRS of the source."""
    height: NDArray[np.float64]
    part: NDArray[np.int64]
    """Counted from 1."""
    length: float
    """Of the line, in metres."""
    gap: float
    """How much of the length has no terrain."""


class Model(Stored):
    """The multitriangulation of a terrain."""

    def __init__(self, terrain: _arete.Terrain, path: Optional[str] = None):
        super().__init__(terrain, path)
        self._terrain = terrain

    def cut(self, max_error: Optional[Size] = None, max_triangles: Union[int, str, None] = None, region: Any = None,
            outside_error: Size = math.inf, camera: Optional[Camera] = None, pixel_error: Optional[float] = None,
            fit: Optional[str] = None, progress: Progress = None, focus: Optional[Sequence[float]] = None,
            error_growth: Optional[float] = None, deadline: Optional[float] = None, order: Optional[str] = None) -> Tin:
        """The fewest triangles within `max_error`, or the best of at most `max_triangles`; both: whichever ends first.

        region: a box (xmin, ymin, xmax, ymax) or polygons (shapely, geopandas) in the CRS of the source, in which
            max_error holds; elsewhere outside_error does. Polygons that overlap are united, as `arete extract --region`
            does it.
        camera: the error is at most pixel_error (1 by default) in its picture, and outside_error out of sight.
        focus: x, y of a place where max_error holds; from there the error grows by error_growth per metre.
        deadline: milliseconds after which the refinement ends as far as it is; the TIN conforms.
        order: what is refined first under max_triangles or a deadline: "worst", "breadth", "depth", or "two-queues".
        fit: moves the heights of the vertices: "triangles" for fewer triangles within max_error, "error" for a smaller
            error of as many, "unbiased" for a mean error of 0 of as many. What that comes to is certain once measure()
            has found it.

        An error may be a percentage of the relief ("1%": of the highest minus the lowest sample), a number of triangles one of
        the finest.
        """
        max_error, outside_error = self._error("max_error", max_error), self._error("outside_error", outside_error)
        max_triangles = count_of("max_triangles", max_triangles, lambda: self.finest_triangles)
        asked = Asked(max_error, max_triangles, region is not None, outside_error, camera is not None, pixel_error,
                      focus_of(focus, 2), error_growth, deadline, order, fit)
        asked.check()
        if fit not in (None, "triangles", "error", "unbiased"):
            raise ValueError(f"fit={fit!r} is not \"triangles\", \"error\" or \"unbiased\"")
        if fit is not None and camera is not None:
            raise ValueError("a fit is not for a camera")
        if fit == "triangles" and (max_error is None or max_triangles is not None):
            raise ValueError("fit=\"triangles\" needs max_error alone")
        if fit == "error" and region is not None:
            raise ValueError("fit=\"error\" is not for a region")
        numbers = None if camera is None else camera.numbers()
        return Tin(self._terrain.cut(asked.request(), region_of(region), numbers, progress))

    def _error(self, name: str, value: Any) -> Any:
        return size_of(name, value, lambda: self._terrain.relief)

    def height(self, x: ArrayLike, y: ArrayLike, max_error: Size = 0, progress: Progress = None) -> Any:
        """The height at places in the CRS of the source, NaN where there is no terrain or a place is masked; arrays or
        numbers.

        max_error: the height may be off by as much, and is found sooner.
        """
        max_error = self._error("max_error", max_error)
        if not max_error >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        (x, x_masked), (y, y_masked) = places_of(x, "x"), places_of(y, "y")
        xs, ys, masked = np.broadcast_arrays(x, y, x_masked | y_masked)
        flat = self._terrain.heights(np.ascontiguousarray(xs).ravel(), np.ascontiguousarray(ys).ravel(),
                                     float(max_error), progress)
        flat[masked.ravel()] = np.nan
        return float(flat[0]) if xs.ndim == 0 else flat.reshape(xs.shape)

    def los(self, observer: ArrayLike, target: ArrayLike, max_error: Size = 0, earth: Optional[str] = None,
            refraction: Optional[float] = None, nodata: str = "unknown", progress: Progress = None) -> "Sight":
        """Whether an observer sees a target, at full resolution: both are x, y and a height above the ground, or rows of
        them (n, 3), of which either may be one.

        earth: "ellipsoid" (with a CRS) or "plane". refraction: the coefficient k, 1/7 by default. nodata: "unknown",
        "blocked" or "clear". max_error: terrain may be off by as much; what that leaves open is "undecided".
        """
        max_error = self._error("max_error", max_error)
        if not max_error >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        ends = [unmasked_places(end, name) for end, name in ((observer, "observer"), (target, "target"))]
        for name, end in zip(("observer", "target"), ends):
            if end.ndim not in (1, 2) or end.shape[-1] != 3:
                raise ValueError(f"the {name} is no x, y, height, nor rows of them")
        is_one = ends[0].ndim == 1 and ends[1].ndim == 1
        first, second = np.broadcast_arrays(np.atleast_2d(ends[0]), np.atleast_2d(ends[1]))
        verdicts, clearances, distances, places = self._terrain.los(
            np.ascontiguousarray(first), np.ascontiguousarray(second), float(max_error), earth or "", refraction, nodata,
            progress)
        if is_one:
            place = None if np.isnan(places[0]).any() else (float(places[0][0]), float(places[0][1]))
            return Sight(verdicts[0], float(clearances[0]), float(distances[0]), place)
        return Sight(np.array(verdicts), clearances, distances, places)

    def profile(self, line: Any, max_error: Size = 0, earth: Optional[str] = None, refraction: Optional[float] = None,
                progress: Progress = None) -> "Profile":
        """The terrain along a line: rows of x, y, or a line of shapely. Between two places it is a geodesic, as for los().

        At full resolution it has a vertex at every edge that it crosses; with max_error it is within that of it.
        """
        max_error = self._error("max_error", max_error)
        if not max_error >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        return Profile(*self._terrain.profile(line_of(line), float(max_error), earth or "", refraction, progress))

    def viewshed(self, observer: ArrayLike, target_height: float = 0, radius: float = math.inf,
                 earth: Optional[str] = None, refraction: Optional[float] = None, nodata: str = "unknown",
                 progress: Progress = None) -> NDArray[np.uint8]:
        """What an observer (x, y, height above the ground) sees, on the source's grid: 255 seen, 0 hidden, 100 unknown
        because of NODATA, 1 out of range or NODATA. The radius is in metres on the ground."""
        x, y, height = (float(number) for number in unmasked_places(observer, "observer").reshape(3))
        return self._terrain.viewshed([x, y, height], float(target_height), float(radius), earth or "", refraction,
                                      nodata, progress)

    def measure(self, mesh: Any, triangles: Optional[ArrayLike] = None, progress: Progress = None) -> Dict[str, float]:
        """How far a TIN is from every sample that the model was built from, by code that the build does not share.

        mesh: a Tin, or vertices (n, 3) with triangles (m, 3). Where it covers no sample, errors are NaN.
        """
        return self._terrain.measure(*some_mesh_of(mesh, triangles), progress)

    def to_xarray(self, max_error: Size = 0, cell: Optional[float] = None, progress: Progress = None) -> Any:
        """An xarray.DataArray of heights at the middles of pixels: of the source's grid, or of square cells (the grid that
        GDAL's driver has with CELL).

        It has the dimensions y and x, the CRS in its attribute "crs", and .rio if rioxarray is imported.
        """
        import xarray

        transform, shape = self.transform, self.shape
        if cell is None and (transform is None or shape is None or transform[2] != 0 or transform[4] != 0):
            raise ValueError("the source has no grid along x and y: state a cell")
        if cell is None:
            assert transform is not None and shape is not None
            x = transform[0] + transform[1] * (np.arange(shape[1]) + 0.5)
            y = transform[3] + transform[5] * (np.arange(shape[0]) + 0.5)
        else:
            columns, rows, of_cells = self._terrain.grid_of(float(cell))
            x = of_cells[0] + of_cells[1] * (np.arange(columns) + 0.5)
            y = of_cells[3] + of_cells[5] * (np.arange(rows) + 0.5)
        heights = self.height(x[np.newaxis, :], y[:, np.newaxis], max_error, progress)
        if cell is None:
            samples, alone = self._terrain.isolated()
            heights[np.divmod(samples, self._terrain.columns)] = alone
        array = xarray.DataArray(heights, dims=("y", "x"), coords={"y": y, "x": x}, name="height")
        array.attrs.update({key: text for key, text in (("crs", self.crs), ("units", self.vertical_unit)) if text})
        if self.crs and hasattr(array, "rio"):
            array = array.rio.write_crs(self.crs)
        return array

    def save(self, path: PathLike, packed: bool = False, progress: Progress = None) -> None:
        """Writes the .amt file, whole or not at all."""
        name = os.fspath(path)
        self._terrain.save(name, packed, progress)
        self._path = os.path.abspath(name)

    @property
    def vertical_unit(self) -> str:
        """As the source states it; may be empty."""
        return self._terrain.vertical_unit

    @property
    def transform(self) -> Optional[Tuple[float, ...]]:
        """GDAL's six numbers (Affine.from_gdal(*model.transform)); None for points, or without a position."""
        numbers = self._terrain.geotransform
        return None if numbers is None else tuple(numbers)

    @property
    def shape(self) -> Optional[Tuple[int, ...]]:
        """(rows, columns) of the source; None for points."""
        shape = self._terrain.shape
        return None if shape is None else tuple(shape)

    @property
    def bounds(self) -> Tuple[float, ...]:
        """xmin, ymin, xmax, ymax of the samples."""
        return tuple(self._terrain.bounds)

    def __repr__(self) -> str:
        return f"<arete.Model of {self._terrain.source!r}, {counted(self._terrain.vertex_count, 'sample', 'samples')}>"


def build(source: Any, *, transform: Any = None, crs: Any = None, nodata: Optional[float] = None,
          shape: str = "delaunay", features: int = 64, progress: Progress = None) -> Model:
    """Builds the multitriangulation of a DEM: a file that `arete build` takes for terrain, or an array of heights.

    source: a path, or a two-dimensional numpy array (row 0 is the northernmost with the usual transform); masked cells
        are NODATA.
    transform: an affine.Affine, as rasterio has it; without it x is the column and y the row
        from the last one upwards, both and a half. crs: text, a number of EPSG, or an object with to_wkt(). nodata: a
        height that stands for none. All three are for arrays.
    shape: "delaunay", or "fidelity" for far fewer triangles at the same error.
    progress: called with a stage and a fraction from 0 to 1; what it raises ends the build and is raised here.
    """
    if isinstance(source, (str, os.PathLike)):
        for name, value in (("transform", transform), ("crs", crs), ("nodata", nodata)):
            if value is not None:
                raise TypeError(f"{name} is for arrays: a file says its own")
        return Model(_arete.build_file(os.fspath(source), shape, features, progress))
    if crs is not None and transform is None:
        raise ValueError("a crs needs a transform, which says where the heights are")
    heights = heights_of(source, nodata)
    return Model(_arete.build_array(heights, geotransform_of(transform), crs_text(crs), shape, features, progress))
