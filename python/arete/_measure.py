# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh measured against a DEM or another mesh, by code that no build shares."""

import math
import os
from typing import Any, Dict, Optional, Sequence

from . import _arete, _checks
from ._arrays import crs_text
from ._mesh import Mesh, Progress
from ._regions import region_of
from ._repair import source_of
from ._reports import report_of
from ._sizes import Size


def measure(mesh: Any, against: Any, *, expect: Optional[Size] = None, allow_covered_nodata: bool = False, region: Any = None,
            region_crs: Any = None, distance: Optional[float] = None, samples: int = 0, seed: int = 1,
            both_ways: bool = False, attributes: bool = False, expect_attribute: Optional[str] = None,
            band: Optional[int] = None, layer: Optional[str] = None, z_field: Optional[str] = None,
            same_place: Optional[str] = None, nodata: Optional[float] = None, vertical_unit: Optional[str] = None,
            positive: Optional[str] = None, crs: Any = None, tin_crs: Any = None, progress: Progress = None) -> Dict[str, Any]:
    """How far a mesh is from a DEM, at every sample, or from another mesh, in space, as `arete measure` finds it. The answer
    has the names of Model.measure(), or those of Surface.measure() with "from_first" and "from_second".

    mesh: a path, a Tin, or a mesh as build_surface() takes it. against: the path of a DEM, several of one mosaic, the path of
        a mesh, or a mesh.
    expect: an error, or "5%" of the relief, of the diagonal: "kept" says whether nothing is farther, "broken" why not. Between
        meshes it is asked of the points of the second, with both_ways of all.
    region, region_crs, distance: of a DEM, where its samples count, as for cut(). allow_covered_nodata: triangles over NODATA
        break no promise. samples, seed: between meshes. band and so on: how the DEM is read, as for build().
    attributes: between files of meshes, how far each attribute of the second is from the first's at the best of its points
        within expect, else within the largest distance: "attributes", by names. expect_attribute: "uv:2px,color:8,normal:10":
        "attributes_kept" says whether none changes by more, "attributes_broken" which does.
    A mesh in another CRS than the DEM, or in metres (save() with to_crs or metric), is measured where it is, as its file says;
        tin_crs says it where the file cannot (an STL).
    """
    if _is_mesh(against):
        if tin_crs is not None:
            raise TypeError("tin_crs is for a DEM: distances between meshes are in their own coordinates")
        if (attributes or expect_attribute is not None) and not (_checks.is_path(mesh) and _checks.is_path(against)):
            raise TypeError("attributes are compared between files: save() writes one of a mesh")
        return _between_meshes(report_of(_arete.measure_meshes(
            source_of(mesh, None), source_of(against, None), _checks.whole("samples", samples, 0, 2**62) or 0,
            _checks.whole("seed", seed, 0, 2**62) or 0, _checks.size_text("expect", expect), bool(both_ways),
            bool(attributes), expect_attribute or "", progress)))
    if attributes or expect_attribute is not None:
        raise TypeError("attributes are compared between meshes alone")
    request = _arete.BuildRequest()
    depth = None if positive is None else _checks.word("positive", positive, ("up", "down")) == "down"
    if not _checks.is_path(against) and not (isinstance(against, (list, tuple)) and against
                                             and all(_checks.is_path(one) for one in against)):
        raise TypeError(f"against is the path of a DEM, paths of one mosaic, or a mesh, not a {type(against).__name__}: "
                        "Model.measure() compares with an array that a model was built from")
    paths: Sequence[str] = [os.fspath(against)] if _checks.is_path(against) else [os.fspath(one) for one in against]
    request.set_reading(_checks.whole("band", band, 1, 2**31 - 1), layer or "", z_field or "", same_place or "",
                        crs_text(crs), nodata, vertical_unit or "", depth, list(paths[1:]))
    # What has no CRS of its own is in that of the DEM, which is not known here.
    asked = region_of(region, crs_text(crs), distance, region_crs)
    own = mesh.crs or "" if isinstance(mesh, Mesh) else ""
    return _against_dem(report_of(_arete.measure_dem(
        source_of(mesh, None), own, crs_text(tin_crs), paths[0], request, asked, _checks.size_text("expect", expect),
        bool(allow_covered_nodata), progress)))


def _promise_of(report: Dict[str, Any]) -> Dict[str, Any]:
    return {name: report[name] for name in ("expect", "kept", "broken") if name in report}


def _between_meshes(report: Dict[str, Any]) -> Dict[str, Any]:
    answer: Dict[str, Any] = _named_way(report["both_ways"])
    answer["from_first"], answer["from_second"] = (_named_way(report[name]) for name in ("from_first", "from_second"))
    for name in ("within", "attributes", "attributes_kept", "attributes_broken"):
        if name in report:
            answer[name] = report[name]
    return {**answer, **_promise_of(report)}


def _named_way(way: Dict[str, Any]) -> Dict[str, Any]:
    return {"max_distance": way["maximum"], "at_most": way["at_most"], "mean": way["mean"], "rms": way["rms"]}


def _against_dem(report: Dict[str, Any]) -> Dict[str, Any]:
    errors, samples = report["error"], report["samples"]
    # An error of nothing is no number.
    covers = samples["covered"] > 0
    answer: Dict[str, Any] = {name: errors[key] if covers else math.nan for name, key in (
        ("max_abs_error", "maximum"), ("rms_error", "rms"), ("mean_error", "mean"), ("mean_abs_error", "mean_absolute"))}
    answer.update({name: samples[name] for name in ("covered", "uncovered", "doubly_covered", "nodata_covered")})
    answer["worst"] = errors["worst"]
    return {**answer, **_promise_of(report)}


def _is_mesh(against: Any) -> bool:
    if _checks.is_path(against):
        return _arete.is_mesh_file(os.fspath(against))
    if isinstance(against, (list, tuple)) and against and all(_checks.is_path(one) for one in against):
        return False
    return isinstance(against, Mesh) or hasattr(against, "vertices") or hasattr(against, "points") or (
        isinstance(against, tuple) and len(against) == 2)
