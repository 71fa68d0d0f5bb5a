# SPDX-License-Identifier: GPL-3.0-or-later
"""A triangle mesh: its arrays, its files, its pictures, and what it is to other modules."""

import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arete, _checks
from ._sizes import counted

PathLike = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]


class Mesh:
    """A triangle mesh. Arrays are read-only views of its memory, and keep it alive."""

    def __init__(self, mesh: _arete.Tin, report: Optional[Dict[str, Any]] = None, files: Sequence[str] = ()):
        self._tin = mesh
        self._files = list(files)
        self.report = report
        """What repair() or decimate() did; None of other meshes."""

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3): x, y, z in the CRS and the unit of the source."""
        return self._tin.vertices

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """(m, 3): vertices, counter-clockwise seen from above; of a surface from outside."""
        return self._tin.triangles

    @property
    def source_vertices(self) -> NDArray[np.uint32]:
        """Of a surface, (n,): the vertex of the source that each one is. Empty of terrain."""
        return self._tin.source_vertices

    @property
    def wedges(self) -> NDArray[np.uint32]:
        """Of a surface with attributes of corners, (m, 3): which row of wedge_attributes each corner has; else empty. Corners
        on two sides of a seam have one vertex and two wedges."""
        return self._tin.wedges

    @property
    def vertex_attributes(self) -> Dict[str, NDArray[Any]]:
        """Of a surface, by names as options have them ("uv", "uv2", "color", "normal", or the file's own): (n, components), with
        the numbers of the source's file. Materials and objects are not among them."""
        return self._tin.vertex_attributes

    @property
    def wedge_attributes(self) -> Dict[str, NDArray[Any]]:
        """The same of corners: a row for each wedge."""
        return self._tin.wedge_attributes

    @property
    def triangle_attributes(self) -> Dict[str, NDArray[Any]]:
        """The same of triangles, (m, components)."""
        return self._tin.triangle_attributes

    @property
    def crs(self) -> Optional[str]:
        """WKT, as pyproj, rasterio and geopandas take it; None where the source has no CRS."""
        return self._tin.crs_wkt or None

    @property
    def vertical_unit(self) -> str:
        """Of z, as the source states it; may be empty."""
        return self._tin.file_parts[0]

    def save(self, path: PathLike, progress: Progress = None, *, packed: bool = False, position_bits: Optional[int] = None,
             normals: str = "keep", crease_angle: Optional[float] = None) -> List[str]:
        """Writes a mesh in the format that the name says, with its CRS, unit and attributes.

        packed: a .glb or .gltf as small as it can be; position_bits (8 to 16, by default 14) is its grid, which moves a point
            by up to half of a step. normals: "keep", "flat" or "smooth", across edges below crease_angle degrees (by default 45).

        Returns what the format cannot hold: ["the CRS"]. A file that is the source is refused.
        """
        name = os.fspath(path)
        _checks.refuse_source(name, self._files)
        bits = _checks.packing_of(name, packed, position_bits)
        kind, angle = _checks.normals_of(normals, crease_angle)
        if bits is None and kind == "keep":
            return list(self._tin.save(name, "", False, progress))
        files = _arete.ExportFiles()
        files.output = name
        files.packed_bits = bits
        files.set_normals(kind, angle)
        return list(self._tin.save_as(files, progress))

    def slopes(self) -> NDArray[np.float64]:
        """(m,): how steep each triangle is, in degrees from the horizontal, on the ground: degrees and feet are taken as
        the metres that they are."""
        from ._slopes import slopes_of

        return slopes_of(self)

    def plot(self, by: Optional[str] = None, ax: Any = None, **options: Any) -> Any:
        """Draws it with matplotlib; returns the axes. A terrain is a map, a surface a view in space.

        by: "height" (by default), or "slope" in degrees, or, of a cut, "error".
        ax: where to draw. cmap, vmin, vmax, edges (True: with the edges of triangles), colorbar (False: without), title.
        """
        from ._plot import plot_mesh

        known = ("cmap", "vmin", "vmax", "edges", "colorbar", "title")
        for name in options:
            if name not in known:
                raise TypeError(f"plot() has no option {name}: it has {', '.join(known)}")
        return plot_mesh(self, "height" if by is None else by, ax, **options)

    def to_meshio(self) -> Any:
        """A meshio.Mesh; of a cut with the data "error" of each cell."""
        from ._export import to_meshio

        return to_meshio(self)

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh with the same vertices and faces in the same order; of a cut with the face attribute "error"."""
        from ._export import to_trimesh

        return to_trimesh(self)

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData; of a cut with the cell data "error"."""
        from ._export import to_pyvista

        return to_pyvista(self)

    def to_geopandas(self) -> Any:
        """A GeoDataFrame: one polygon with heights for each triangle, the CRS, and of a cut the column "error"."""
        from ._export import to_geopandas

        return to_geopandas(self)

    def _repr_html_(self) -> str:
        from ._html import html_of_mesh

        return html_of_mesh(self)

    def _parts(self) -> Tuple[Any, ...]:
        tin = self._tin
        return (np.array(tin.vertices), np.array(tin.triangles), np.array(tin.errors), tin.error, tin.is_complete,
                tin.pixels, tin.crs_wkt, tin.file_parts, np.array(tin.source_vertices))

    def __reduce__(self) -> Tuple[Any, ...]:
        return _mesh_of, (self.report, *self._parts()), {"_files": self._files}

    def __repr__(self) -> str:
        return f"<arete.Mesh of {counted(len(self.triangles), 'triangle', 'triangles')}>"


def _mesh_of(report: Optional[Dict[str, Any]], *parts: Any) -> Mesh:
    return Mesh(_arete.Tin(*parts), report)
