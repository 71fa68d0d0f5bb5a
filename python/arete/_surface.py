# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces: what a triangle mesh becomes, and what it answers."""

import math
import os
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from . import _arete
from ._arrays import mesh_of, some_mesh_of
from ._checks import names_of, number, whole
from ._curve import Curve, curve_of
from ._cuts import Asked, Export, PathLike, Progress, Stored, SurfaceCamera, Tin, focus_of, plot_cut
from ._regions import Where, boxes_where, space_region_of
from ._reports import report_of
from ._sizes import Size, count_of, counted, size_of


class Surface(Stored):
    """The multitriangulation of a triangle mesh. One in pages reads what each cut needs (open()); several threads may ask it."""

    def __init__(self, surface: _arete.Surface, path: Optional[str] = None, files: Sequence[str] = ()):
        super().__init__(surface, path, files)
        self._surface = surface

    def cut(self, max_error: Optional[Size] = None, max_triangles: Union[int, str, None] = None, region: Any = None,
            outside_error: Size = math.inf, camera: Optional[SurfaceCamera] = None, pixel_error: Optional[float] = None,
            displaced: bool = True, fit: Optional[str] = None, progress: Progress = None,
            focus: Optional[Sequence[float]] = None, error_growth: Optional[float] = None, deadline: Optional[float] = None,
            order: Optional[str] = None, drop_parts: Size = 0, method: str = "minimal",
            where: Optional[Where] = None, attribute_error: Union[str, Mapping[str, Union[float, str]]] = "",
            importance: str = "") -> Tin:
        """The fewest triangles of which no point of the source is farther than `max_error`, or the best of at most
        `max_triangles`.

        region: where max_error holds: a box (x0, y0, z0, x1, y1, z1), a ball (x, y, z, r), or a closed mesh, as a file
            or as build_surface() takes it; elsewhere outside_error does.
        where: the same by a function of x0, y0, z0, x1, y1, z1: True: all of that box is meant, False: nothing, None: it is
            asked again of eighths.
        camera: the error is at most pixel_error (1 by default) in its picture.
        method: "saturated" takes a few more triangles, sooner.
        focus: x, y, z of a place where max_error holds; from there the error grows by error_growth per unit.
        deadline: milliseconds after which the refinement ends as far as it is; the mesh conforms.
        order: what is refined first under max_triangles or a deadline: "worst", "breadth", "depth", or "two-queues"; by
            default, without a place, where the mean square distance is large.
        drop_parts: leaves out the components whose box has a smaller diagonal; the error is that of the rest.
        attribute_error: what attributes may be off by, each within max_error: {"uv": "2px", "normal": 10, "color": 8}; of a
            model built with attributes.
        importance: the name of a number of vertices by which the error is divided from place to place; it is above 0.
        displaced: where the model was built with displacement, draw it nearer to the source at the same error.
        fit: "rms" moves vertices to where the mean square distance is small; within max_error, if it is stated.

        An error may be a percentage of the diagonal ("1%"), a number of triangles one of the finest.
        """
        if camera is not None and not isinstance(camera, SurfaceCamera):
            raise TypeError(f"camera={camera!r} is no arete.SurfaceCamera")
        inside = size_of("max_error", max_error, lambda: self.diagonal)
        outside: Any = size_of("outside_error", outside_error, lambda: self.diagonal)
        budget = count_of("max_triangles", max_triangles, lambda: self.finest_triangles)
        dropped = size_of("drop_parts", drop_parts, lambda: self.diagonal)
        if where is not None and region is not None:
            raise ValueError("where is a region: not with another one")
        has_region = region is not None or where is not None
        asked = Asked(inside, budget, has_region, outside, camera is not None, pixel_error,
                      focus_of(focus, 3), error_growth, deadline, order, fit, method)
        asked.check()
        if fit not in (None, "rms"):
            raise ValueError(f"fit={fit!r} is not \"rms\"")
        if fit is not None and (has_region or camera is not None):
            raise ValueError("a fit is for a cut by max_error or max_triangles everywhere")
        numbers = None if camera is None else camera.numbers()
        request = asked.request()
        request.displaced = displaced
        request.drop_parts = dropped or 0
        request.importance = importance
        errors = attribute_error if isinstance(attribute_error, str) else ",".join(
            f"{name}:{most}" for name, most in attribute_error.items())
        if errors:
            request.set_attribute_errors(errors)
        where_it_holds, text = self._region(region, where, progress)
        tin = self._surface.cut(request, where_it_holds, numbers, progress)

        def extract(files: _arete.ExportFiles, export_progress: Progress) -> str:
            return self._surface.extract(request, where_it_holds, text, numbers, files, export_progress)

        kept = [*self._sources, *([] if self._path is None else [self._path])]
        return Tin(tin, Export(extract, [self._surface.source], self._path or "", deadline is not None, files=kept))

    def _region(self, region: Any, where: Optional[Where], progress: Progress) -> Tuple[Optional[_arete.RegionOfSpace], str]:
        if where is None:
            return space_region_of(region, progress)
        sides = self._surface.box
        low, high = sides[:3], sides[3:]
        boxes = boxes_where(where, low, high, [self.diagonal / 4096] * 3)
        if len(boxes) == 0:
            raise ValueError("where means nothing of the surface")
        return _arete.region_of_boxes(boxes), "a function of boxes"

    def curve(self, curve: int = 12, at: Optional[Sequence[Size]] = None, progress: Progress = None) -> Curve:
        """How many triangles which error takes: at round shares of the diagonal, the smallest as many as `curve` says, or at
        the errors stated."""
        most = whole("curve", curve, 1, 1000) or 12
        if at is None:
            shares = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
            errors = [share / 100 * self.diagonal for share in shares if share / 100 * self.diagonal < self.largest_error][:most]
        else:
            stated = [at] if isinstance(at, (str, float, int)) else at
            errors = [size_of("at", one, lambda: self.diagonal) or 0.0 for one in stated]
        return curve_of(self._surface.curve(errors, progress), "")

    def validate(self, full: bool = False, progress: Progress = None) -> Dict[str, Any]:
        """Checks every law of a multitriangulation of a surface. "holds" says whether all do, "laws" which they are,
        "violation" what breaks one. full: the error at more samples."""
        return report_of(self._surface.validate(full, progress))

    def plot(self, by: Optional[str] = None, ax: Any = None, max_triangles: Union[int, str] = 10000, **options: Any) -> Any:
        """Draws a cut in space with matplotlib, of as many triangles; returns the axes.

        by: "height" (by default), "error", or "slope" in degrees. The other options are those of Tin.plot(), and of cut().
        """
        return plot_cut(self, by, ax, max_triangles, options)

    def measure(self, mesh: Any, triangles: Optional[ArrayLike] = None, samples: int = 0,
                progress: Progress = None, seed: int = 1) -> Dict[str, Any]:
        """The distances between the source and a mesh, both ways, by code that the build does not share.

        mesh: as build_surface() takes it, or a Tin. samples: on each, as many as `arete measure` takes by default.
        Each way has the largest distance found, what no point exceeds, the mean and the root mean square. Where position
        bits rounded the model, every distance is raised by "position_error": the source itself is no farther.
        """
        return self._surface.measure(*some_mesh_of(mesh, triangles), int(samples), int(seed), progress)

    def save(self, path: PathLike, packed: bool = False, position_bits: int = 0, progress: Progress = None,
             *, paged: bool = False) -> None:
        """Writes the .amt file, whole or not at all. position_bits: of a packed file, the bits of each coordinate; 0: all.
        Another ending, or the file of the source, is refused. paged: packed, in pages."""
        if position_bits and not (packed or paged):
            raise ValueError("position_bits is for packed files")
        name = self._name_to_save(path)
        self._surface.save(name, packed, paged, int(position_bits), progress)
        self._path = os.path.abspath(name)

    @property
    def diagonal(self) -> float:
        """Of the box of the source."""
        return self._surface.diagonal

    @property
    def position_error(self) -> float:
        """How far rounding (position_bits) has moved a vertex of the source at most."""
        return self._surface.position_error

    @property
    def is_displaced(self) -> bool:
        return self._surface.is_displaced

    def __repr__(self) -> str:
        return f"<arete.Surface of {self._surface.source!r}, {counted(self._surface.vertex_count, 'vertex', 'vertices')}>"


def build_surface(source: Any, triangles: Optional[ArrayLike] = None, *, displacement: bool = False,
                  keep_borders: bool = False, drop_attributes: Union[str, Sequence[str]] = (),
                  progress: Progress = None, ratio: Optional[float] = None, max_degree: Optional[int] = None,
                  attributes: bool = False, crease_angle: Optional[float] = None) -> Surface:
    """Builds the multitriangulation of a triangle mesh.

    source: a file that `arete build` takes for a surface; vertices (n, 3) with triangles (m, 3); or a mesh of meshio
        (points, cells) or trimesh (vertices, faces), of which the shape is taken.
    displacement: find where the vertices of coarse cuts are nearest to the source. It takes as long again.
    keep_borders: vertices of borders stay in every cut.
    drop_attributes: names of attributes of a file to leave out, and "objects", "groups", "materials": seams and edges
        between parts keep vertices in every cut.
    attributes: bound what attributes of vertices and corners are off by, and let them count (Surface.cut(attribute_error=)).
    ratio, max_degree: how levels grow, and the most neighbours of a vertex that is removed.
    crease_angle: edges whose faces are turned by more degrees are lines of every cut.
    """
    names = names_of(drop_attributes)
    growth, degree = number("ratio", ratio), whole("max_degree", max_degree, 6, 32)
    angle = number("crease_angle", crease_angle, 0, 180)
    if isinstance(source, (str, os.PathLike)):
        if triangles is not None:
            raise TypeError("triangles are for arrays: a file says its own")
        path = os.fspath(source)
        return Surface(_arete.build_surface_file(path, displacement, keep_borders, growth, degree, angle, names,
                                                 attributes, progress), files=[path])
    if names:
        raise ValueError("drop_attributes is for files: arrays have no attributes")
    if attributes:
        raise ValueError("attributes is for files: arrays have no attributes")
    return Surface(_arete.build_surface_arrays(*mesh_of(source, triangles), displacement, keep_borders, growth, degree, angle,
                                               progress))
