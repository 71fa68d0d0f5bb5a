# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes examined, mended and made smaller, of files and of arrays."""

import os
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from . import _arete, _checks
from ._arrays import mesh_of
from ._mesh import Mesh, Progress
from ._reports import report_of
from ._sizes import Size

Source = Union[str, Tuple[Any, Any]]


def source_of(mesh: Any, triangles: Optional[ArrayLike]) -> Any:
    """A path, or vertices and triangles, as the module takes them."""
    if _checks.is_path(mesh):
        if triangles is not None:
            raise TypeError("triangles are for arrays: a file says its own")
        return os.fspath(mesh)
    if triangles is None and isinstance(mesh, tuple) and len(mesh) == 2:
        mesh, triangles = mesh
    return mesh_of(mesh, triangles)


_OPERATORS = ("measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster")


def _files_of(mesh: Any) -> List[str]:
    """The files that a mesh is made from."""
    if _checks.is_path(mesh):
        return _checks.files_of([os.fspath(mesh)])
    return mesh._files if isinstance(mesh, Mesh) else []


def mesh_info(mesh: Any, triangles: Optional[ArrayLike] = None, *, self_intersections: bool = True,
              progress: Progress = None) -> Dict[str, Any]:
    """What is in a mesh, and what is the matter with it, as `arete mesh info` says it: "verdict", "is_manifold",
    "is_closed", "components", "borders", "findings" with their places, "area", "volume" of a solid.

    mesh: a path; vertices (n, 3) with triangles (m, 3); or what build_surface() takes.
    self_intersections: False leaves out the search for triangles that cross, which takes most of the time.
    """
    return report_of(_arete.mesh_info(source_of(mesh, triangles), self_intersections, progress))


def repair(mesh: Any, triangles: Optional[ArrayLike] = None, *, weld: Optional[Size] = None, fill_holes: int = 0,
           split_sheets: bool = False, progress: Progress = None) -> Mesh:
    """Mends a mesh without guessing, as `arete mesh repair` does: no vertex moves but by welding. Attributes of a file are
    kept. Its `report` says what was done.

    weld: joins border vertices within this distance, or a percentage of the diagonal ("0.001%").
    fill_holes: fills borders of at most so many edges. split_sheets: splits edges of more than two triangles.
    """
    mended, report = _arete.repair(source_of(mesh, triangles), _checks.size_text("weld", weld),
                                   _checks.whole("fill_holes", fill_holes, 0, 1_000_000_000) or 0, bool(split_sheets), progress)
    return Mesh(mended, report_of(report), _files_of(mesh))


def decimate(mesh: Any, triangles: Optional[ArrayLike] = None, *, max_triangles: Union[int, str, None] = None,
             max_error: Optional[Size] = None, operator: str = "measured", queue: str = "lazy", quadric_weight: str = "area",
             cluster_vertices: str = "quadric", keep_borders: bool = False, no_crossings: bool = False,
             drop_parts: Optional[Size] = None, drop_attributes: Union[str, Sequence[str]] = (),
             attribute_weight: str = "", progress: Progress = None) -> Mesh:
    """Makes a mesh smaller, once, as `arete mesh decimate` does. Its `report` says what that came to. "error" of "measured" is
    how far a point of the source is from the result, and not the other way: measure() says both. "is_complete" is False
    where max_triangles ended "measured" before max_error was reached, which is 0 unless it is stated.

    max_triangles: how many at most, or "10%" of them. max_error: how far a point of the mesh may be from the result, or
        "0.5%" of the diagonal; of the operator "measured".
    operator: "measured", the closest: of a file with attributes it keeps their seams, which others may leave
        out; "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face" or "cluster".
    queue, quadric_weight, cluster_vertices, no_crossings: of some operators (docs/topics/decimation.md).
    attribute_weight: what a change of attributes counts beside a distance, "uv:1,color:0.5", of all operators but
        "lindstrom-turk"; "" for the usual weights, which "measured" has with max_triangles.
    """
    request = _arete.DecimationRequest()
    request.attribute_weight = str(attribute_weight)
    request.operator = _checks.word("operator", str(operator), _OPERATORS)
    request.queue = str(queue)
    request.quadric_weight = str(quadric_weight)
    request.cluster_vertices = str(cluster_vertices)
    request.keep_borders = bool(keep_borders)
    request.no_crossings = bool(no_crossings)
    share = 0.0
    if isinstance(max_triangles, str):
        share = _share_of("max_triangles", max_triangles)
        request.max_triangles = 1
    else:
        request.max_triangles = _checks.whole("max_triangles", max_triangles, 1, 4_000_000_000)
    smaller, report = _arete.decimate(source_of(mesh, triangles), request, _checks.size_text("max_error", max_error),
                                      _checks.size_text("drop_parts", drop_parts), _checks.names_of(drop_attributes), share,
                                      progress)
    return Mesh(smaller, report_of(report), _files_of(mesh))


def _share_of(name: str, text: str) -> float:
    size = _checks.size_text(name, text)
    try:
        share = float(size[:-1]) / 100
    except ValueError:
        raise TypeError(f"{name}={text!r} is no number and no percentage (\"10%\")") from None
    if not 0 < share <= 1:
        raise ValueError(f"{name}={text!r} is not above 0 and at most 100%")
    return share
