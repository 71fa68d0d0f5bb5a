# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain: what a DEM becomes, and what it answers."""

import dataclasses
import math
import os
from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arete
from ._arrays import crs_text, places_of, some_mesh_of, unmasked_places
from ._checks import is_path, number, numbers_of, whole, word
from ._curve import Curve, curve_of
from ._cuts import Asked, Camera, Export, PathLike, Progress, Stored, Tin, focus_of, plot_cut
from ._regions import Asked as AskedRegion
from ._regions import Where, boxes_where, line_of, region_of, rings_of_boxes
from ._reports import report_of
from ._sight import Profile, Sight, Viewshed, sight_of
from ._sizes import Size, count_of, counted, size_of


class Model(Stored):
    """The multitriangulation of a terrain. One in pages reads what each question needs (open()); several threads may ask it."""

    def __init__(self, terrain: _arete.Terrain, path: Optional[str] = None, files: Sequence[str] = ()):
        super().__init__(terrain, path, files)
        self._terrain = terrain
        self._axes: Any = None
        """Of what was built from an xarray.DataArray: its own coordinates."""

    def cut(self, max_error: Optional[Size] = None, max_triangles: Union[int, str, None] = None, region: Any = None,
            outside_error: Size = math.inf, camera: Optional[Camera] = None, pixel_error: Optional[float] = None,
            fit: Optional[str] = None, progress: Progress = None, focus: Optional[Sequence[float]] = None,
            error_growth: Optional[float] = None, deadline: Optional[float] = None, order: Optional[str] = None,
            method: str = "minimal", distance: Optional[float] = None, region_crs: Any = None, where: Optional[Where] = None,
            lonlat: bool = False) -> Tin:
        """The fewest triangles within `max_error`, or the best of at most `max_triangles`; both: whichever ends first.

        region: where max_error holds, elsewhere outside_error does: a box (xmin, ymin, xmax, ymax), a path, or polygons of
            shapely or geopandas; with distance, metres on the ground around it, lines and points too. What has a CRS is
            brought into that of the source; region_crs states one. Polygons that overlap are united, as
            `arete extract --region` does it.
        where: the same by a function of xmin, ymin, xmax, ymax: True: all of that box is meant, False: nothing, None: it
            is asked again of quarters, down to samples.
        camera: the error is at most pixel_error (1 by default) in its picture, and outside_error out of sight.
        focus: x, y of a place where max_error holds; from there the error grows by error_growth per metre.
        lonlat: the places of the focus and the camera are longitude and latitude.
        deadline: milliseconds after which the refinement ends as far as it is; the TIN conforms.
        order: what is refined first under max_triangles or a deadline: "worst", "breadth", "depth", or "two-queues".
        method: "saturated" takes a few more triangles, sooner.
        fit: moves the heights of the vertices: "triangles" for fewer triangles within max_error, "error" for a smaller
            error of as many, "unbiased" for a mean error near 0 of as many. What that comes to is certain once measure()
            has found it.

        An error may be a percentage of the relief ("1%": of the highest minus the lowest sample), a number of triangles one of
        the finest.
        """
        if camera is not None and not isinstance(camera, Camera):
            raise TypeError(f"camera={camera!r} is no arete.Camera")
        inside, outside = self._error("max_error", max_error), self._error("outside_error", outside_error)
        budget = count_of("max_triangles", max_triangles, lambda: self.finest_triangles)
        if where is not None and region is not None:
            raise ValueError("where is a region: not with another one")
        has_region = region is not None or where is not None
        asked = Asked(inside, budget, has_region, outside, camera is not None, pixel_error,
                      focus_of(focus, 2), error_growth, deadline, order, fit, method)
        asked.check()
        if fit not in (None, "triangles", "error", "unbiased"):
            raise ValueError(f"fit={fit!r} is not \"triangles\", \"error\" or \"unbiased\"")
        if fit is not None and camera is not None:
            raise ValueError("a fit is not for a camera")
        if fit == "triangles" and (max_error is None or max_triangles is not None):
            raise ValueError("fit=\"triangles\" needs max_error alone")
        if fit == "error" and has_region:
            raise ValueError("fit=\"error\" is not for a region")
        if lonlat and focus is None and camera is None:
            raise ValueError("lonlat is for a focus or a camera")
        if lonlat and asked.focus is not None:
            asked = dataclasses.replace(asked, focus=tuple(self._places([asked.focus])[0].tolist()))
        if lonlat and camera is not None:
            x, y = self._places([camera.position[:2]])[0].tolist()
            camera = dataclasses.replace(camera, position=(x, y, camera.position[2]))
        numbers = None if camera is None else camera.numbers()
        where_it_holds = self._region(region, distance, region_crs, where)
        request = asked.request()
        tin = self._terrain.cut(request, where_it_holds, numbers, progress)

        def extract(files: _arete.ExportFiles, export_progress: Progress) -> str:
            return self._terrain.extract(request, where_it_holds, numbers, files, export_progress)

        def check_options() -> str:
            stated: Dict[str, Any] = dict(report_of(self._terrain.reading()))
            stated["region"] = os.fspath(region) if is_path(region) else tuple(region) if isinstance(region, (list, tuple)) else None
            stated["distance"] = distance
            stated["region_crs"] = region_crs if isinstance(region_crs, (str, int)) else None
            return "".join(f", {name}={value!r}" for name, value in stated.items() if value is not None)

        sources = [self._terrain.source, *self._terrain.other_files()]
        kept = [*self._sources, *([] if self._path is None else [self._path])]
        return Tin(tin, Export(extract, sources, self._path or "", deadline is not None, check_options, kept))

    def _region(self, region: Any, distance: Any, region_crs: Any, where: Optional[Where]) -> AskedRegion:
        if where is None:
            return region_of(region, self.crs or "", distance, region_crs)
        for name, value in (("distance", distance), ("region_crs", region_crs)):
            if value is not None:
                raise ValueError(f"{name} is not for where")
        left, bottom, right, top = self.bounds
        transform = self.transform or (0, 1, 0, 0, 0, -1)
        side = ([abs(transform[1]) + abs(transform[2]), abs(transform[4]) + abs(transform[5])] if self.shape is not None
                else [math.sqrt((right - left) * (top - bottom) / max(1, self._terrain.vertex_count))] * 2)
        boxes = boxes_where(where, (left, bottom), (right, top), side)
        if len(boxes) == 0:
            raise ValueError("where means nothing of the terrain")
        return rings_of_boxes(boxes)

    def _places(self, places: Any) -> NDArray[np.float64]:
        """Longitudes and latitudes in the CRS of the source."""
        return self._terrain.from_lonlat(np.ascontiguousarray(places, dtype=np.float64).reshape(-1, 2))

    def _error(self, name: str, value: Any) -> Any:
        return size_of(name, value, lambda: self._terrain.relief)

    def _tolerance(self, max_error: Size) -> float:
        tolerance = float(self._error("max_error", max_error))
        if not tolerance >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        return tolerance

    def height(self, x: ArrayLike, y: ArrayLike, max_error: Size = 0, progress: Progress = None, lonlat: bool = False) -> Any:
        """The height at places in the CRS of the source, NaN where there is no terrain or a place is masked; arrays or
        numbers.

        max_error: the height may be off by as much, and is found sooner. lonlat: x, y are longitude and latitude.
        """
        tolerance = self._tolerance(max_error)
        (x, x_masked), (y, y_masked) = places_of(x, "x"), places_of(y, "y")
        xs, ys, masked = np.broadcast_arrays(x, y, x_masked | y_masked)
        flat_x, flat_y = np.ascontiguousarray(xs).ravel(), np.ascontiguousarray(ys).ravel()
        if lonlat:
            flat_x, flat_y = (np.ascontiguousarray(one) for one in self._places(np.column_stack([flat_x, flat_y])).T)
        flat = self._terrain.heights(flat_x, flat_y, tolerance, progress)
        flat[masked.ravel()] = np.nan
        return float(flat[0]) if xs.ndim == 0 else flat.reshape(xs.shape)

    def los(self, observer: ArrayLike, target: ArrayLike, max_error: Size = 0, earth: Optional[str] = None,
            refraction: Optional[float] = None, nodata: str = "unknown", progress: Progress = None, lonlat: bool = False,
            method: str = "auto", frequency: Optional[float] = None, fresnel: Optional[float] = None,
            clutter: Union[float, PathLike, None] = None, clutter_free: Optional[float] = None) -> Sight:
        """Whether an observer sees a target, at full resolution: both are x, y and a height above the ground, or rows of
        them (n, 3), of which either may be one.

        earth: "ellipsoid" (with a CRS) or "plane". refraction: the coefficient k, 1/7 by default. nodata: "unknown",
        "blocked" or "clear". max_error: terrain may be off by as much; what that leaves open is "undecided".
        lonlat: x, y are longitude and latitude. method: "auto", or one of those of `arete los`, with the same answers.
        frequency: in MHz, of which the part `fresnel` (0.6) of the first Fresnel zone must be clear. clutter: a height on the
        terrain, or the path of a raster of them, but within clutter_free (100) metres of the ends.
        """
        tolerance = self._tolerance(max_error)
        if fresnel is not None and frequency is None:
            raise ValueError("fresnel needs a frequency")
        if clutter_free is not None and clutter is None:
            raise ValueError("clutter_free needs clutter")
        ends = [self._ends(name, end, lonlat) for name, end in (("observer", observer), ("target", target))]
        is_one = ends[0].ndim == 1 and ends[1].ndim == 1
        if len({len(end) for end in ends if end.ndim == 2} - {1}) > 1:
            raise ValueError(f"there are {len(ends[0])} rows of observer and {len(ends[1])} of target: as many, or one of either")
        first, second = np.broadcast_arrays(np.atleast_2d(ends[0]), np.atleast_2d(ends[1]))
        heights = os.fspath(clutter) if isinstance(clutter, (str, os.PathLike)) else repr(number("clutter", clutter, 0))
        if clutter is None:
            heights = ""
        megahertz = number("frequency", frequency)
        if megahertz is not None and not megahertz > 0:
            raise ValueError(f"frequency={frequency!r} is not above 0")
        verdicts, rows = self._terrain.los(
            np.ascontiguousarray(first), np.ascontiguousarray(second), tolerance, earth or "", refraction, nodata,
            method, megahertz or 0, heights, 100 if clutter_free is None else number("clutter_free", clutter_free, 0) or 0,
            progress)
        part = None if frequency is None else 0.6 if fresnel is None else number("fresnel", fresnel, 0)
        return sight_of(verdicts, rows, is_one, part)

    def _ends(self, name: str, end: ArrayLike, lonlat: bool) -> NDArray[np.float64]:
        rows = unmasked_places(end, name)
        if rows.ndim not in (1, 2) or rows.shape[-1] != 3:
            raise ValueError(f"the {name} is no x, y, height, nor rows of them")
        if lonlat:
            rows = rows.copy()
            rows[..., :2] = self._places(rows[..., :2]).reshape(rows[..., :2].shape)
        return rows

    def profile(self, line: Any, max_error: Size = 0, earth: Optional[str] = None, refraction: Optional[float] = None,
                progress: Progress = None, lonlat: bool = False, nodata: str = "unknown", frequency: Optional[float] = None,
                fresnel: Optional[float] = None) -> Profile:
        """The terrain along a line: rows of x, y, or a line of shapely. Between two places it is a geodesic, as for los().

        At full resolution it has a vertex at every edge that it crosses; with max_error it is within that of it.
        Two rows of x, y and a height above the ground are a line of sight: `sight` is its answer, line_height it above the
        vertices; nodata, frequency and fresnel are those of los(). lonlat: x, y are longitude and latitude.
        """
        tolerance = self._tolerance(max_error)
        places = line_of(line, most=3)
        if places.shape[1] == 2 and (frequency is not None or nodata != "unknown" or fresnel is not None):
            raise ValueError("frequency, fresnel and nodata are for a line of sight: two rows of x, y, height")
        if lonlat:
            places[:, :2] = self._places(places[:, :2])
        along = np.ascontiguousarray(places[:, :2])
        profile = Profile(*self._terrain.profile(along, tolerance, earth or "", refraction, progress))
        profile.vertical_unit, profile.is_metric = self.vertical_unit, bool(self.crs)
        if places.shape[1] == 3:
            profile.sight = self.los(places[0], places[1], 0, earth, refraction, nodata, progress, frequency=frequency,
                                     fresnel=fresnel)
            height, radius = self._terrain.sight_over(places, profile.distance, earth or "", refraction, frequency or 0)
            profile.line_height = height
            profile.fresnel_radius = None if frequency is None else radius
        return profile

    def viewshed(self, observer: ArrayLike, target_height: float = 0, radius: float = math.inf,
                 earth: Optional[str] = None, refraction: Optional[float] = None, nodata: str = "unknown",
                 progress: Progress = None, min_distance: float = 0, azimuth: Optional[Sequence[float]] = None,
                 elevation: Optional[Sequence[float]] = None, mode: str = "seen", like: Optional[PathLike] = None,
                 max_error: Size = 0, method: str = "auto", lonlat: bool = False) -> Viewshed:
        """What an observer (x, y, height above the ground) sees, on the source's grid: an array of 255 seen, 0 hidden, 100
        unknown because of NODATA, 200 undecided within max_error, 1 out of range or NODATA. Rows of several observers: what
        any of them sees.

        radius, min_distance: metres on the ground. azimuth: from, to, clockwise. elevation: from, to. like: the path of a
        raster whose grid the answer has.
        mode: "height": the least height that is seen; "horizon": its elevation in degrees; of several "count": how many see
        it; "server": the nearest of them, from 1; of both 0 is hidden, 65533 unknown, 65534 undecided, 65535 outside. The
        `answers` of a viewshed name them.
        """
        ends = np.atleast_2d(self._ends("observer", observer, lonlat))
        if not radius > 0:
            raise ValueError(f"radius={radius!r} is not above 0")
        ranges = [None if one is None else numbers_of(name, one, 2)
                  for name, one in (("azimuth", azimuth), ("elevation", elevation))]
        if ranges[0] is not None and abs(ranges[0][1] - ranges[0][0]) > 360:
            raise ValueError(f"azimuth={azimuth!r} is more than a turn")
        cells, transform, crs = self._terrain.viewshed(
            ends.tolist(), float(target_height), float(radius), number("min_distance", min_distance, 0) or 0, ranges[0],
            ranges[1], mode, "" if like is None else os.fspath(like), self._tolerance(max_error), method,
            earth or "", refraction, nodata, progress)
        # A grid of another CRS does not know these places.
        places = [(float(x), float(y)) for x, y, _ in ends] if (crs or None) == self.crs else []
        return Viewshed.of(cells, mode, None if transform is None else tuple(transform), crs or None, places,
                           self.vertical_unit)

    def measure(self, mesh: Any, triangles: Optional[ArrayLike] = None, progress: Progress = None, region: Any = None,
                region_crs: Any = None, distance: Optional[float] = None) -> Dict[str, float]:
        """How far a TIN is from every sample that the model was built from, by code that the build does not share.

        mesh: a Tin, or vertices (n, 3) with triangles (m, 3). Where it covers no sample, errors are NaN.
        region, region_crs, distance: where samples count, as for cut().
        """
        return self._terrain.measure(*some_mesh_of(mesh, triangles), self._region(region, distance, region_crs, None), progress)

    def curve(self, curve: int = 12, at: Optional[Sequence[Size]] = None, progress: Progress = None) -> Curve:
        """How many triangles which error takes: at the largest errors of 1, 2, 5, 10 ... as many as `curve` says, or at those
        stated."""
        errors = [] if at is None else [self._error("at", one) for one in ([at] if isinstance(at, (str, float, int)) else at)]
        if at is not None and not errors:
            raise ValueError("at names no error")
        if any(not one >= 0 for one in errors):
            raise ValueError(f"at={at!r} is not at least 0")
        return curve_of(self._terrain.curve(errors, whole("curve", curve, 1, 1000) or 12, progress), self.vertical_unit)

    def validate(self, fronts: int = 8, seed: int = 1, full: bool = False, against: Optional[PathLike] = None,
                 progress: Progress = None, band: Optional[int] = None, layer: Optional[str] = None,
                 z_field: Optional[str] = None, same_place: Optional[str] = None, nodata: Optional[float] = None,
                 vertical_unit: Optional[str] = None, positive: Optional[str] = None, crs: Any = None) -> Dict[str, Any]:
        """Checks every law of a multitriangulation. "holds" says whether all do, "laws" which they are, "violation" what
        breaks one.

        fronts, seed: random cuts that are checked beside the uniform ones. full: the error of every triangle.
        against: the path of the DEM, of which every height is compared; read as for build(), or as the model was.
        """
        request = _arete.BuildRequest()
        depth = None if positive is None else word("positive", positive, ("up", "down")) == "down"
        request.set_reading(whole("band", band, 1, 2**31 - 1), layer or "", z_field or "", same_place or "", crs_text(crs),
                            nodata, vertical_unit or "", depth, [])
        return report_of(self._terrain.validate(whole("fronts", fronts, 0, 1_000_000) or 0, whole("seed", seed, 0, 2**62) or 0,
                                                full, "" if against is None else os.fspath(against), request, progress))

    def plot(self, by: Optional[str] = None, ax: Any = None, max_triangles: Union[int, str] = 20000, **options: Any) -> Any:
        """Draws a cut with matplotlib, of as many triangles; returns the axes.

        by: "height" (by default), "error", or "slope" in degrees. The other options are those of Tin.plot(), and of cut().
        """
        return plot_cut(self, by, ax, max_triangles, options)

    def to_xarray(self, max_error: Size = 0, cell: Optional[float] = None, progress: Progress = None) -> Any:
        """An xarray.DataArray of heights at the middles of pixels: of the source's grid, or of square cells (the grid that
        GDAL's driver has with CELL).

        It has the dimensions y and x, the CRS in its attribute "crs", and .rio if rioxarray is imported. Of a model that was
        built from an xarray.DataArray it has the coordinates of that, to the bit, and its names of the dimensions. Heights are
        float64, whatever the source had, and NaN where there are none.
        """
        import xarray

        transform, shape = self.transform, self.shape
        if transform is None and shape is not None:
            transform = (0, 1, 0, shape[0], 0, -1)  # where height() has an array without a place
        if cell is None and (transform is None or shape is None or transform[2] != 0 or transform[4] != 0):
            raise ValueError("the source has no grid along x and y: state a cell")
        if cell is None:
            assert transform is not None and shape is not None
            left, step_x, top, step_y = transform[0], transform[1], transform[3], transform[5]
            columns, rows = shape[1], shape[0]
        else:
            if not (number("cell", cell) or 0) > 0:
                raise ValueError(f"cell={cell!r} is not above 0")
            columns, rows, of_cells = self._terrain.grid_of(float(cell))
            if columns * rows > 2**40:
                raise MemoryError(f"cell={cell!r} makes {rows} x {columns} cells, more than memory holds")
            left, step_x, top, step_y = of_cells[0], of_cells[1], of_cells[3], of_cells[5]
        x = left + step_x * (np.arange(columns) + 0.5)
        y = top + step_y * (np.arange(rows) + 0.5)
        is_source = cell is None and self._tolerance(max_error) == 0
        heights = self._terrain.samples() if is_source else self.height(x[np.newaxis, :], y[:, np.newaxis], max_error, progress)
        if cell is None and not is_source:
            samples, alone = self._terrain.isolated()
            heights[np.divmod(samples, self._terrain.columns)] = alone
        names: Tuple[Any, Any] = ("y", "x")
        coordinates: Dict[Any, Any] = {"y": y, "x": x}
        if cell is None and self._axes is not None:
            names = (self._axes[0].dims[0], self._axes[1].dims[0])
            coordinates = dict(zip(names, self._axes))
        array = xarray.DataArray(heights, dims=names, coords=coordinates, name="height")
        array.attrs.update({key: text for key, text in (("crs", self.crs), ("units", self.vertical_unit)) if text})
        array.attrs["transform"] = (step_x, 0.0, left, 0.0, step_y, top)
        if self.crs and hasattr(array, "rio"):
            if names != ("y", "x"):
                array = array.rio.set_spatial_dims(y_dim=names[0], x_dim=names[1])
            array = array.rio.write_crs(self.crs)
        return array

    def save(self, path: PathLike, packed: bool = False, progress: Progress = None, *, paged: bool = False) -> None:
        """Writes the .amt file, whole or not at all. Another ending, or the file of the source, is refused.

        packed: compressed. paged: compressed, in pages, of which a query reads what it needs.
        """
        name = self._name_to_save(path)
        self._terrain.save(name, packed, paged, progress)
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
