# SPDX-License-Identifier: GPL-3.0-or-later
"""What a cut is asked for, and what it is."""

import dataclasses
import math
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arete, _checks
from ._arrays import crs_text
from ._mesh import Mesh
from ._mesh import PathLike as PathLike
from ._mesh import Progress as Progress
from ._reports import report_of
from ._sizes import counted


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


class Tin(Mesh):
    """The triangles of a cut. Arrays are read-only views of its memory, and keep it alive."""

    def __init__(self, tin: _arete.Tin, export: Optional["Export"] = None):
        super().__init__(tin, None, () if export is None else export.files)
        self._export = export

    @property
    def errors(self) -> NDArray[np.float32]:
        """(m,): no sample that the triangle stands for is farther from it."""
        return self._tin.errors

    @property
    def error(self) -> float:
        """The largest of them, anywhere."""
        return self._tin.error

    @property
    def attribute_errors(self) -> Dict[str, float]:
        """Of a surface built with attributes: what each is off by at most, within `error`; infinite: not bounded."""
        return self._tin.attribute_errors

    @property
    def pixels(self) -> Optional[float]:
        """Of a cut for a camera: the largest error in its picture."""
        return self._tin.pixels

    @property
    def is_complete(self) -> bool:
        """False where a number of triangles or a deadline ended the refinement before the error was reached."""
        return self._tin.is_complete

    def save(self, path: PathLike, progress: Progress = None, *, certificate: Union[bool, PathLike, None] = None,
             error_raster: Optional[PathLike] = None, map: Optional[PathLike] = None,
             drop_attributes: Union[str, Sequence[str]] = (), both_ways: bool = False, to_crs: Any = None,
             metric: bool = False, packed: bool = False, position_bits: Optional[int] = None, normals: str = "keep",
             crease_angle: Optional[float] = None) -> List[str]:
        """Writes a mesh in the format that the name says, with its CRS, unit, errors and, of a surface, attributes; of a
        raster also .tif, the TIN sampled on the source's grid.

        Formats of 32-bit floats round heights by a little, which the error of the cut does not include; with a certificate the
        cut is taken so that the promise holds all the same.

        certificate: True, or a path: also measures what was written, and writes what was promised and found; an error that
            breaks the promise is raised, behind the files.
        error_raster: of terrain, a GeoTIFF of the TIN minus the DEM. map: of a surface, a CSV of the vertices and faces of
            the source. drop_attributes: of a surface, names to leave out. both_ways: measures a surface that way too.

        packed: a .glb or .gltf as small as it can be, on a grid of position_bits (8 to 16, by default 14); what that moves is
            counted in the error, and a max_error is kept where it leaves room. normals: of a surface "keep", "flat" or "smooth",
            across edges below crease_angle degrees (by default 45), made of the faces of the cut.

        Terrain is led into another CRS by to_crs (a CRS as build() takes it, or "utm", the zone of its middle), or by metric into
        metres to the east, north and up. Edges are split where bending adds more than a tenth of the error.

        Returns what the format cannot hold: ["the CRS"]. A file that is the source is refused.
        """
        name = os.fspath(path)
        written: List[str] = []
        stated = os.path.splitext(name)[0] + ".certificate.json" if certificate is True else certificate or None
        for one in (os.fspath(other) for other in (path, error_raster, map, stated) if other is not None):
            _checks.refuse_source(one, self._files)
            _checks.refuse_output(one, written)
            written.append(os.path.abspath(one))
        to_crs = crs_text(to_crs)
        names = _checks.names_of(drop_attributes)
        bits = _checks.packing_of(name, packed, position_bits)
        kind, angle = _checks.normals_of(normals, crease_angle)
        is_raster = name.lower().endswith((".tif", ".tiff"))
        if not (certificate or error_raster or map or names or both_ways or is_raster or bits or kind != "keep"):
            return list(self._tin.save(name, to_crs, bool(metric), progress))
        is_surface = len(self.source_vertices) > 0
        for option, value in (("map", map), ("drop_attributes", names), ("both_ways", both_ways),
                              ("normals", kind != "keep")):
            if value and not is_surface:
                raise TypeError(f"{option} is for surfaces")
        for option, value in (("error_raster", error_raster), ("to_crs", to_crs), ("metric", metric)):
            if value and is_surface:
                raise TypeError(f"{option} is for terrain")
        if self._export is None:
            raise ValueError("a Tin that was pickled, or made in another process, has no model to be measured against")
        files = _arete.ExportFiles()
        files.output = name
        if certificate:
            files.certificate = os.fspath(stated or "")
        files.error_raster = "" if error_raster is None else os.fspath(error_raster)
        files.map = "" if map is None else os.fspath(map)
        files.drop_attributes = names
        files.both_ways = both_ways
        files.packed_bits = bits
        files.set_normals(kind, angle)
        files.to_crs = to_crs
        files.metric = metric
        return self._export.write(files, progress)

    def __reduce__(self) -> Tuple[Any, ...]:
        return _tin_of, self._parts(), {"_files": self._files}

    def __repr__(self) -> str:
        return f"<arete.Tin of {counted(len(self.triangles), 'triangle', 'triangles')}, error {self.error:g}>"


@dataclasses.dataclass(frozen=True)
class Export:
    """How a cut is taken again, to be written and measured as `arete extract` does it."""

    extract: Callable[[_arete.ExportFiles, Progress], str]
    sources: Sequence[str]
    """The files that the model was built from, if there are any."""
    model: str
    has_deadline: bool
    check_options: Callable[[], str] = str
    """Further arguments of measure(), by which the export is checked."""
    files: Sequence[str] = ()
    """What must not be written over: the files of the source, and that of the model."""

    def write(self, files: _arete.ExportFiles, progress: Progress) -> List[str]:
        if self.has_deadline:
            raise ValueError("a cut by a deadline is another one the next time: save it without certificate, map and rasters")
        files.model = self.model
        if files.certificate and all(os.path.exists(source) or "://" in source for source in self.sources):
            against = repr(self.sources[0]) if len(self.sources) == 1 else repr(list(self.sources))
            place = ""
            files.check_before = f"arete.measure({files.output!r}, {against}, expect="
            # An STL has no place for a CRS, and which zone "utm" was is not known to measure().
            if files.to_crs and not _arete.holds_crs(files.output):
                place = f", tin_crs={files.to_crs!r}"
                if files.to_crs.lower() == "utm":
                    files.check_before = ""
            files.check_behind = self.check_options() + place + ")"
        report = report_of(self.extract(files, progress))
        if report.get("kept") is False:
            raise RuntimeError(f"{files.output}: the measurement contradicts the promised error; the files are written")
        lost = report.get("lost")
        return list(lost) if isinstance(lost, list) else []


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
    method: str = "minimal"

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
        if self.method not in ("minimal", "saturated"):
            raise ValueError(f"method={self.method!r} is neither \"minimal\" nor \"saturated\"")
        if self.method == "saturated" and (self.deadline is not None or self.order is not None):
            raise ValueError("method=\"saturated\" is not for a deadline or an order")
        if self.method == "saturated" and self.fit == "triangles":
            raise ValueError("fit=\"triangles\" is not for method=\"saturated\"")
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
            z = self.focus[2] if len(self.focus) > 2 else None
            request.set_focus(self.focus[0], self.focus[1], z, float(self.error_growth))
        request.set_method(self.method)
        request.set_order(self.order or "")
        request.set_fit(self.fit or "")
        return request


def focus_of(focus: Any, count: int) -> Optional[Tuple[float, ...]]:
    """The place of a focus, checked."""
    return None if focus is None else _checks.numbers_of("a focus", focus, count)


class Stored:
    """A model of terrain or of a surface. It may have a file, by which it is pickled."""

    _path: Optional[str]

    def __init__(self, model: Union[_arete.Terrain, _arete.Surface], path: Optional[str] = None,
                 files: Sequence[str] = ()):
        if not isinstance(model, (_arete.Terrain, _arete.Surface)):
            raise TypeError("a model is made by arete.build(), build_points(), build_surface() and open()")
        self._stored = model
        self._path = path
        # A surface knows the name of its source without the folder.
        known = [model.source, *model.other_files()] if isinstance(model, _arete.Terrain) else []
        self._sources = _checks.files_of([*files, *known])

    def _name_to_save(self, path: PathLike) -> str:
        """Of an .amt file that is not what the model was built from."""
        name = os.fspath(path)
        _checks.refuse_other_than_amt(name)
        _checks.refuse_source(name, self._sources)
        return name

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
        """Triangles of the source, of which nothing is left out. cut(max_error=0) has fewer where flat parts need none."""
        return self._stored.finest_triangle_count

    def info(self) -> Dict[str, Any]:
        """What is in it: source, CRS, numbers of triangles, how it was built."""
        return report_of(self._stored.facts())

    def _repr_html_(self) -> str:
        from ._html import html_of_model

        return html_of_model(self)

    def __reduce__(self) -> Tuple[Callable[..., Any], Tuple[Any, ...]]:
        if self._path is None:
            raise TypeError("a model is pickled by its file: save() it first")
        return _reopened, (self._path, self._content())

    def _content(self) -> Tuple[Any, ...]:
        """What another model in the same file differs in."""
        facts = self.info()
        return tuple(facts.get(name) for name in ("kind", "source_checksum", "source_faces", "vertices", "triangles"))


def plot_cut(model: Any, by: Optional[str], ax: Any, max_triangles: Union[int, str], options: Dict[str, Any]) -> Any:
    """Draws a cut of a model of either kind, and says how far it is off."""
    drawn = {name: options.pop(name) for name in ("cmap", "vmin", "vmax", "edges", "colorbar", "title") if name in options}
    if not {"max_error", "camera", "deadline"} & set(options):
        options["max_triangles"] = max_triangles
        if isinstance(max_triangles, int):
            options["max_triangles"] = max(min(max_triangles, model.finest_triangles), model._stored.root_triangle_count)
    tin = model.cut(**options)
    drawn.setdefault("title", f"{counted(len(tin.triangles), 'triangle', 'triangles')}, error {tin.error:.3g} "
                              f"{tin.vertical_unit}".rstrip())
    return tin.plot(by, ax, **drawn)


def _reopened(path: str, content: Tuple[Any, ...]) -> Any:
    from ._files import open as open_model

    model = open_model(path)
    if model._content() != content:
        raise RuntimeError(f"{path}: holds another model than the one that was pickled")
    return model


def _tin_of(*parts: Any) -> Tin:
    return Tin(_arete.Tin(*parts))


def _of_camera(name: str, values: Any, count: int) -> Tuple[float, ...]:
    return _checks.numbers_of(f"the {name} of a camera", values, count)
