# SPDX-License-Identifier: GPL-3.0-or-later
"""Models: what a file or an array becomes, and what it answers."""

import math
import os
from typing import Any, Callable, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arete
from ._arrays import crs_text, geotransform_of, heights_of, rings_of

PathLike = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]


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


class Tin:
    """The triangles of a cut. Arrays are read-only views of its memory, and keep it alive."""

    def __init__(self, tin: _arete.Tin):
        self._tin = tin

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3): x, y, z in the CRS and the unit of the source."""
        return self._tin.vertices

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """(m, 3): vertices, counter-clockwise seen from above; of a surface from outside."""
        return self._tin.triangles

    @property
    def errors(self) -> NDArray[np.float32]:
        """(m,): no sample that the triangle stands for is farther from it."""
        return self._tin.errors

    @property
    def error(self) -> float:
        """The largest of `errors`."""
        return self._tin.error

    @property
    def is_complete(self) -> bool:
        """False where a number of triangles ended the refinement before the error was reached."""
        return self._tin.is_complete

    @property
    def crs(self) -> Optional[str]:
        """WKT, as pyproj, rasterio and geopandas take it; None where the source has no CRS."""
        return self._tin.crs_wkt or None

    def to_meshio(self) -> Any:
        """A meshio.Mesh with the data "error" of each cell."""
        import meshio  # type: ignore[import]

        return meshio.Mesh(self.vertices, [("triangle", self.triangles)], cell_data={"error": [self.errors]})

    def __repr__(self) -> str:
        return f"<arete.Tin of {len(self.triangles)} triangles, error {self.error:g}>"


class _Stored:
    """A model that may have a file, by which it is pickled."""

    _path: Optional[str] = None

    def __reduce__(self) -> Tuple[Callable[[str], Any], Tuple[str]]:
        if self._path is None:
            raise TypeError("a model is pickled by its file: save() it first")
        return open, (self._path,)


class Model(_Stored):
    """The multitriangulation of a terrain."""

    def __init__(self, terrain: _arete.Terrain, path: Optional[str] = None):
        self._terrain = terrain
        self._path = path

    def cut(self, max_error: Optional[float] = None, max_triangles: Optional[int] = None, region: Any = None,
            outside_error: float = math.inf, progress: Progress = None) -> Tin:
        """The fewest triangles within `max_error`, or the best of at most `max_triangles`; both: whichever ends first.

        region: a box (xmin, ymin, xmax, ymax) or a polygon in the CRS of the source, in which max_error holds;
        elsewhere outside_error does.
        """
        error = _checked_error(max_error, max_triangles)
        if region is None and outside_error != math.inf:
            raise ValueError("outside_error needs a region")
        if math.isnan(outside_error) or (error is not None and outside_error < error):
            raise ValueError(f"outside_error={outside_error} is below the error inside")
        return Tin(self._terrain.cut(error, max_triangles, rings_of(region), float(outside_error), progress))

    def height(self, x: ArrayLike, y: ArrayLike, max_error: float = 0, progress: Progress = None) -> Any:
        """The height at places in the CRS of the source, NaN where there is no terrain; arrays or numbers.

        max_error: the height may be off by as much, and is found sooner.
        """
        if not max_error >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        xs, ys = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
        flat = self._terrain.heights(np.ascontiguousarray(xs).ravel(), np.ascontiguousarray(ys).ravel(),
                                     float(max_error), progress)
        return float(flat[0]) if xs.ndim == 0 else flat.reshape(xs.shape)

    def los(self, observer: ArrayLike, target: ArrayLike, max_error: float = 0, earth: Optional[str] = None,
            refraction: Optional[float] = None, nodata: str = "unknown", progress: Progress = None) -> "Sight":
        """Whether an observer sees a target, at full resolution: both are x, y and a height above the ground, or rows of
        them (n, 3), of which either may be one.

        earth: "ellipsoid" (with a CRS) or "plane". refraction: the coefficient k, 1/7 by default. nodata: "unknown",
        "blocked" or "clear". max_error: terrain may be off by as much; what that leaves open is "undecided".
        """
        if not max_error >= 0:
            raise ValueError(f"max_error={max_error} is not at least 0")
        ends = [np.asarray(end, dtype=np.float64) for end in (observer, target)]
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

    def viewshed(self, observer: ArrayLike, target_height: float = 0, radius: float = math.inf,
                 earth: Optional[str] = None, refraction: Optional[float] = None, nodata: str = "unknown",
                 progress: Progress = None) -> NDArray[np.uint8]:
        """What an observer (x, y, height above the ground) sees, on the source's grid: 255 seen, 0 hidden, 100 unknown
        because of NODATA, 1 out of range or NODATA. The radius is in metres on the ground."""
        x, y, height = (float(number) for number in np.asarray(observer, dtype=np.float64).reshape(3))
        return self._terrain.viewshed([x, y, height], float(target_height), float(radius), earth or "", refraction,
                                      nodata, progress)

    def measure(self, mesh: Any, triangles: Optional[ArrayLike] = None, progress: Progress = None) -> Dict[str, float]:
        """How far a TIN is from every sample that the model was built from, by code that the build does not share.

        mesh: a Tin, or vertices (n, 3) with triangles (m, 3).
        """
        if isinstance(mesh, Tin):
            vertices, corners = mesh.vertices, mesh.triangles
        else:
            if triangles is None:
                raise TypeError("measure() takes a Tin, or vertices and triangles")
            vertices = np.ascontiguousarray(mesh, dtype=np.float64)
            numbers = np.asarray(triangles)
            if numbers.dtype.kind not in "iu" or (numbers.size and (numbers.min() < 0 or numbers.max() >= len(vertices))):
                raise ValueError("the triangles are no numbers of vertices")
            corners = np.ascontiguousarray(numbers, dtype=np.uint32)
        for name, shape in (("vertices", vertices.shape), ("triangles", corners.shape)):
            if len(shape) != 2 or shape[1] != 3:
                raise ValueError(f"the {name} have the shape {shape}, not (n, 3)")
        return self._terrain.measure(vertices, corners, progress)

    def to_xarray(self, max_error: float = 0, cell: Optional[float] = None, progress: Progress = None) -> Any:
        """An xarray.DataArray of heights at the middles of pixels: of the source's grid, or of square cells.

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
            if not cell > 0:
                raise ValueError(f"cell={cell} is not above 0")
            left, bottom, right, top = self.bounds
            x = np.arange(left + cell / 2, right, cell)
            y = np.arange(top - cell / 2, bottom, -cell)
        heights = self.height(x[np.newaxis, :], y[:, np.newaxis], max_error, progress)
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
    def crs(self) -> Optional[str]:
        """WKT; None where the source has no CRS."""
        return self._terrain.crs_wkt or None

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

    @property
    def largest_error(self) -> float:
        """Of the coarsest cut."""
        return self._terrain.largest_error

    @property
    def finest_triangles(self) -> int:
        """Triangles of the cut without error."""
        return self._terrain.finest_triangle_count

    def __repr__(self) -> str:
        return f"<arete.Model of {self._terrain.source!r}, {self._terrain.vertex_count} samples>"


class Surface(_Stored):
    """The multitriangulation of a triangle mesh."""

    def __init__(self, surface: _arete.Surface, path: str):
        self._surface = surface
        self._path = path

    def cut(self, max_error: Optional[float] = None, max_triangles: Optional[int] = None, displaced: bool = True,
            progress: Progress = None) -> Tin:
        """The fewest triangles of which no point of the source is farther than `max_error`, or the best of at most
        `max_triangles`.

        displaced: where the model was built with displacement, draw it nearer to the source at the same error.
        """
        error = _checked_error(max_error, max_triangles)
        return Tin(self._surface.cut(error, max_triangles, displaced, progress))

    @property
    def diagonal(self) -> float:
        """Of the box of the source."""
        return self._surface.diagonal

    @property
    def crs(self) -> Optional[str]:
        return self._surface.crs_wkt or None

    @property
    def is_displaced(self) -> bool:
        return self._surface.is_displaced

    @property
    def largest_error(self) -> float:
        """Of the coarsest cut."""
        return self._surface.largest_error

    @property
    def finest_triangles(self) -> int:
        """Triangles of the cut without error."""
        return self._surface.finest_triangle_count

    def __repr__(self) -> str:
        return f"<arete.Surface of {self._surface.source!r}, {self._surface.vertex_count} vertices>"


def build(source: Any, *, transform: Any = None, crs: Any = None, nodata: Optional[float] = None,
          shape: str = "delaunay", features: int = 64, progress: Progress = None) -> Model:
    """Builds the multitriangulation of a DEM: a file that `arete build` takes, no mesh, or an array of heights.

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


def open(path: PathLike, progress: Progress = None) -> Union[Model, Surface]:  # noqa: A001
    """Opens an .amt file: a Model of terrain or a Surface."""
    name = os.path.abspath(os.fspath(path))
    if _arete.is_surface(name):
        return Surface(_arete.open_surface(name, progress), name)
    return Model(_arete.open_terrain(name, progress), name)


def _checked_error(max_error: Optional[float], max_triangles: Optional[int]) -> Optional[float]:
    if max_error is None and max_triangles is None:
        raise TypeError("cut() needs max_error, max_triangles, or both")
    if max_error is None:
        return None
    if not max_error >= 0:
        raise ValueError(f"max_error={max_error} is not at least 0")
    return float(max_error)
