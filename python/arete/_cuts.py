# SPDX-License-Identifier: GPL-3.0-or-later
"""What a cut is asked for, and what it is."""

import dataclasses
import math
import os
from typing import Any, Callable, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arete
from ._sizes import counted

PathLike = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]


@dataclasses.dataclass(frozen=True)
class Camera:
    """Where terrain is seen from, and how."""

    position: Tuple[float, float, float]
    """x, y in the CRS of the source, and a height."""
    azimuth: float = 0
    """Degrees clockwise from the map's north."""
    pitch: float = 0
    """Degrees above the horizon; -90 looks straight down."""
    fov: float = 60
    """Vertical field of view in degrees."""
    viewport: Tuple[float, float] = (1920, 1080)
    """Width and height of the picture in pixels."""
    reference: str = "agl"
    """Of the height: "agl", above the ground; "msl" or "ell", as the source's heights are."""

    def numbers(self) -> _arete.CameraNumbers:
        return _arete.CameraNumbers(_of_camera("position", self.position, 3), self.reference, float(self.azimuth),
                                    float(self.pitch), float(self.fov), _of_camera("viewport", self.viewport, 2))


@dataclasses.dataclass(frozen=True)
class SurfaceCamera:
    """Where a surface is seen from, in its coordinates."""

    eye: Tuple[float, float, float]
    target: Tuple[float, float, float]
    """What it looks at."""
    fov: float = 60
    """Vertical field of view in degrees."""
    viewport: Tuple[float, float] = (1920, 1080)
    """Width and height of the picture in pixels."""

    def numbers(self) -> _arete.SurfaceCameraNumbers:
        return _arete.SurfaceCameraNumbers(_of_camera("eye", self.eye, 3), _of_camera("target", self.target, 3), float(self.fov),
                                           _of_camera("viewport", self.viewport, 2))


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
    def source_vertices(self) -> NDArray[np.uint32]:
        """Of a surface, (n,): the vertex of the source that each one is. Empty of terrain."""
        return self._tin.source_vertices

    @property
    def error(self) -> float:
        """The largest of them, anywhere."""
        return self._tin.error

    @property
    def pixels(self) -> Optional[float]:
        """Of a cut for a camera: the largest error in its picture."""
        return self._tin.pixels

    @property
    def is_complete(self) -> bool:
        """False where a number of triangles or a deadline ended the refinement before the error was reached."""
        return self._tin.is_complete

    @property
    def crs(self) -> Optional[str]:
        """WKT, as pyproj, rasterio and geopandas take it; None where the source has no CRS."""
        return self._tin.crs_wkt or None

    def __reduce__(self) -> Tuple[Callable[..., Any], Tuple[Any, ...]]:
        tin = self._tin
        return _tin_of, (np.array(tin.vertices), np.array(tin.triangles), np.array(tin.errors), tin.error, tin.is_complete,
                         tin.pixels, tin.crs_wkt, tin.file_parts, np.array(tin.source_vertices))

    def save(self, path: PathLike, progress: Progress = None, *, to_crs: Optional[str] = None, metric: bool = False) -> List[str]:
        """Writes a mesh in the format that the name says, with its CRS, unit, errors and, of a surface, attributes.

        Terrain is led into another CRS by to_crs ("EPSG:32632", WKT, or "utm", the zone of its middle), or by metric into
        metres to the east, north and up. Edges are split where bending adds more than a tenth of the error.

        Returns what the format cannot hold: ["the CRS"].
        """
        return list(self._tin.save(os.fspath(path), to_crs or "", bool(metric), progress))

    def to_meshio(self) -> Any:
        """A meshio.Mesh with the data "error" of each cell."""
        import meshio

        return meshio.Mesh(self.vertices, [("triangle", self.triangles)], cell_data={"error": [self.errors]})

    def __repr__(self) -> str:
        return f"<arete.Tin of {counted(len(self.triangles), 'triangle', 'triangles')}, error {self.error:g}>"


@dataclasses.dataclass(frozen=True)
class Asked:
    """What a cut is asked for, of terrain or a surface, checked as far as it does not depend on either."""

    max_error: Optional[float]
    max_triangles: Optional[int]
    has_region: bool
    outside_error: float
    has_camera: bool
    pixel_error: Optional[float]
    focus: Optional[Tuple[float, ...]] = None
    error_growth: Optional[float] = None
    deadline: Optional[float] = None
    order: Optional[str] = None
    fit: Optional[str] = None

    def check(self) -> None:
        if self.max_error is None and self.max_triangles is None and not self.has_camera and self.deadline is None:
            raise TypeError("cut() needs max_error, max_triangles, a camera or a deadline")
        if self.max_error is not None and not self.max_error >= 0:
            raise ValueError(f"max_error={self.max_error} is not at least 0")
        if self.has_camera and (self.max_error is not None or self.has_region):
            raise ValueError("a camera states its own error (pixel_error) and place: no max_error, no region")
        if self.pixel_error is not None and not self.has_camera:
            raise ValueError("pixel_error needs a camera")
        if self.pixel_error is not None and not 0 < self.pixel_error < math.inf:
            raise ValueError(f"pixel_error={self.pixel_error} is not above 0")
        if not self.has_region and not self.has_camera and self.focus is None and self.outside_error != math.inf:
            raise ValueError("outside_error needs a region, a focus or a camera")
        if math.isnan(self.outside_error) or self.outside_error < (self.max_error or 0):
            raise ValueError(f"outside_error={self.outside_error} is below the error inside")
        self._check_focus()
        if self.deadline is not None and not 0 < self.deadline < math.inf:
            raise ValueError(f"deadline={self.deadline} is not above 0")
        if self.order not in (None, "worst", "breadth", "depth", "two-queues"):
            raise ValueError(f"order={self.order!r} is not \"worst\", \"breadth\", \"depth\" or \"two-queues\"")
        if self.order is not None and self.max_triangles is None and self.deadline is None:
            raise ValueError("order needs max_triangles or a deadline")
        if self.order == "two-queues" and not self.has_camera:
            raise ValueError("order=\"two-queues\" needs a camera")
        if self.fit is not None and (self.focus is not None or self.deadline is not None):
            raise ValueError("a fit is not for a focus or a deadline")

    def _check_focus(self) -> None:
        if (self.focus is None) != (self.error_growth is None):
            raise ValueError("a focus and error_growth need each other")
        if self.focus is not None and (self.has_region or self.has_camera):
            raise ValueError("a focus is its own place: no region, no camera")
        if self.error_growth is not None and not 0 <= self.error_growth < math.inf:
            raise ValueError(f"error_growth={self.error_growth} is not at least 0")

    def request(self) -> _arete.CutRequest:
        """The same as the module takes it."""
        request = _arete.CutRequest()
        request.max_error = None if self.max_error is None else float(self.max_error)
        request.max_triangles = self.max_triangles
        request.outside_error = float(self.outside_error)
        request.pixel_error = None if self.pixel_error is None else float(self.pixel_error)
        request.deadline = None if self.deadline is None else float(self.deadline)
        if self.focus is not None and self.error_growth is not None:
            x, y, z = (*self.focus, None)[:3]
            request.set_focus(x, y, z, float(self.error_growth))
        request.set_order(self.order or "")
        request.set_fit(self.fit or "")
        return request


def focus_of(focus: Any, count: int) -> Optional[Tuple[float, ...]]:
    """The place of a focus, checked."""
    return None if focus is None else _numbers("a focus", focus, count)


class Stored:
    """A model of terrain or of a surface. It may have a file, by which it is pickled."""

    def __init__(self, model: Union[_arete.Terrain, _arete.Surface], path: Optional[str] = None):
        self._stored = model
        self._path = path

    @property
    def crs(self) -> Optional[str]:
        """WKT; None where the source has no CRS."""
        return self._stored.crs_wkt or None

    @property
    def largest_error(self) -> float:
        """Of the coarsest cut."""
        return self._stored.largest_error

    @property
    def finest_triangles(self) -> int:
        """Triangles of the cut without error."""
        return self._stored.finest_triangle_count

    def __reduce__(self) -> Tuple[Callable[[str], Any], Tuple[str]]:
        if self._path is None:
            raise TypeError("a model is pickled by its file: save() it first")
        from ._files import open as open_model

        return open_model, (self._path,)


def _tin_of(*parts: Any) -> Tin:
    return Tin(_arete.Tin(*parts))


def _of_camera(name: str, values: Any, count: int) -> Tuple[float, ...]:
    return _numbers(f"the {name} of a camera", values, count)


def _numbers(what: str, values: Any, count: int) -> Tuple[float, ...]:
    try:
        numbers = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        raise TypeError(f"{what} is {count} numbers, not {values!r}") from None
    if len(numbers) != count or not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"{what} is {count} numbers, not {values!r}")
    return numbers
