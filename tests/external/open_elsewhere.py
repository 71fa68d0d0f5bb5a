#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens what Arete writes in programs that are not Arete. README.md beside this file says which and what is checked."""

import argparse
import json
import os
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SKIPPED = 77
# Debian's own interpreter: the one that has the bindings of QGIS and GDAL.
SYSTEM_PYTHON = "/usr/bin/python3"
FORMATS = ("ply", "obj", "off", "stl", "glb", "gltf", "2dm", "gpkg", "tif")


class Missing(Exception):
    """A program is not there; the text says which package has it."""


class Broken(Exception):
    """What a program found is not what was written."""


def check(holds, sentence):
    if not holds:
        raise Broken(sentence)


def near(a, b, tolerance, what):
    pairs = list(zip(a, b)) if isinstance(a, (list, tuple)) else [(a, b)]
    check(len(pairs) > 0 and all(abs(x - y) <= tolerance for x, y in pairs),
          f"{what}: found {a}, expected {b} within {tolerance:g}")


def run(command, **options):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          errors="replace", timeout=500, **options)
    if done.returncode != 0:
        raise Broken(f"{' '.join(str(word) for word in command)} gave exit code {done.returncode}:\n"
                     f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def need_program(name, package):
    if not shutil.which(name):
        raise Missing(f"{name} is not installed (Debian package {package})")


def need_module(name, package):
    if not Path(SYSTEM_PYTHON).exists() or subprocess.run(
            [SYSTEM_PYTHON, "-c", f"import {name}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode:
        raise Missing(f"the Python module {name} is not installed (Debian package {package})")


def float32_step(value):
    """The distance to the next float32: what a program loses that reads into single precision."""
    bits = struct.unpack("<I", struct.pack("<f", abs(value)))[0]
    return struct.unpack("<f", struct.pack("<I", bits + 1))[0] - struct.unpack("<f", struct.pack("<I", bits))[0]


# --- what is opened -----------------------------------------------------------------------------------------------


class Terrain:
    """One DEM, its TIN in every format, and what is known of it without Arete's readers."""

    def __init__(self, arguments, name, dem, epsg):
        self.name, self.dem, self.epsg = name, Path(dem), epsg
        self.folder = arguments.work / name
        self.folder.mkdir(parents=True, exist_ok=True)
        about = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "dem", self.dem]))
        self.extent, self.heights = about["extent"], about["heights"]  # xmin, ymin, xmax, ymax of the samples
        self.error = round((self.heights[1] - self.heights[0]) / 60, 2)
        model = self.folder / "dem.amt"
        run([arguments.arete, "build", self.dem, "-o", model, "--quiet"])
        self.files, counts = {}, set()
        for extension in FORMATS:
            self.files[extension] = self.folder / f"tin.{extension}"
            said = json.loads(run([arguments.arete, "extract", model, "-o", self.files[extension], "--max-error",
                                   self.error, "--json"]))["exports"][0]
            counts.add((said["triangles"], said["vertices"]))
        check(len(counts) == 1, f"the formats of one TIN differ in their counts: {counts}")
        self.triangles, self.vertices = counts.pop()
        self.coarse = self.folder / "coarse.obj"
        run([arguments.arete, "extract", model, "-o", self.coarse, "--max-error", 3 * self.error, "--quiet"])

    def check_heights(self, found, rounding, what):
        """The TIN lies between the DEM's lowest and highest sample, and misses neither by more than the error."""
        low, high = self.heights
        for value, bound in ((found[0], low), (found[1], high)):
            check(low - rounding <= value <= high + rounding and abs(value - bound) <= self.error + rounding,
                  f"{what}: heights {found}, the DEM's are {self.heights}")


def stl_origin(path):
    """The header of a binary STL says what was subtracted: "arete origin X Y Z"."""
    words = path.read_bytes()[:80].split()
    check(words[:2] == [b"arete", b"origin"], f"{path}: the header does not say the origin")
    return [float(word) for word in words[2:5]]


def terrains(arguments):
    if arguments.dem:
        about = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "dem", arguments.dem]))
        return [Terrain(arguments, Path(arguments.dem).stem, arguments.dem, about["epsg"])]
    data = os.environ.get("ARETE_DATA", "")
    real = [Path(data) / "dem" / name for name in ("srtm1_bigtujunga_utm11.tif", "srtm3_zion_cc0.tif")]
    if data and all(path.exists() for path in real):
        return [Terrain(arguments, "projected", real[0], 32611), Terrain(arguments, "geographic", real[1], 4326)]
    print("-- $ARETE_DATA has no DEMs: generated ones take their place")
    arguments.work.mkdir(parents=True, exist_ok=True)
    plain = arguments.work / "generated.tif"
    run([arguments.datasets, "generate", "-o", plain, "--size", "257", "--no-lake", "--no-sea", "--quiet"])
    made = []
    for name, epsg, box in (("projected", 32611, (400000, 3810000, 407710, 3802290)),
                            ("geographic", 4326, (7.5, 46.1, 7.6, 46.03))):
        path = arguments.work / f"generated_{name}.tif"
        run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "place", plain, path, epsg, *box])
        made.append(Terrain(arguments, name, path, epsg))
    return made


# --- the steps ----------------------------------------------------------------------------------------------------


def step_gdal(arguments):
    need_program("gdalinfo", "gdal-bin")
    for t in terrains(arguments):
        for tool, file in (("gdalinfo", t.files["tif"]), ("ogrinfo", t.files["gpkg"])):
            done = subprocess.run([tool] + (["-al", "-so"] if tool == "ogrinfo" else []) + [str(file)],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            check(done.returncode == 0 and not done.stderr, f"{tool} {file}: {done.stderr or done.returncode}")
        tif = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "tif", t.files["tif"], t.dem]))
        check(tif["sameGrid"], f"{t.files['tif']} is not on the DEM's grid")
        check(tif["epsg"] == t.epsg, f"GeoTIFF: EPSG:{tif['epsg']}, expected EPSG:{t.epsg}")
        check(tif["nodata"] == 0, f"GeoTIFF: {tif['nodata']} samples have no height")
        check(tif["largestError"] <= t.error * (1 + 1e-6), f"GeoTIFF: {tif['largestError']} off, promised {t.error}")
        print(f"ok: {t.name}: GeoTIFF in GDAL: the DEM's grid, EPSG:{tif['epsg']}, nowhere more than "
              f"{tif['largestError']:g} off ({t.error} promised)")

        layer = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "gpkg", t.files["gpkg"]]))
        check(layer["features"] == t.triangles, f"GeoPackage: {layer['features']} features, {t.triangles} triangles")
        check(layer["epsg"] == t.epsg, f"GeoPackage: EPSG:{layer['epsg']}, expected EPSG:{t.epsg}")
        check(layer["geometry"] == "3D Polygon", f"GeoPackage: geometry {layer['geometry']}")
        near(layer["extent"], t.extent, 1e-9 * max(map(abs, t.extent)), "GeoPackage: extent")
        t.check_heights(layer["heights"], 0, "GeoPackage")
        box = (t.extent[2] - t.extent[0]) * (t.extent[3] - t.extent[1])
        near(layer["area"], box, 1e-9 * box, "GeoPackage: sum of the plan areas")
        check(layer["openRings"] == 0, f"GeoPackage: {layer['openRings']} rings are not four closed points")
        check(0 < layer["largestError"] <= t.error * (1 + 1e-6), f"GeoPackage: errors up to {layer['largestError']}")
        print(f"ok: {t.name}: GeoPackage in GDAL: {layer['features']} triangles, EPSG:{layer['epsg']}, extent and area "
              f"of the DEM, errors up to {layer['largestError']:g}")


def step_qgis(arguments):
    need_module("qgis.core", "python3-qgis")
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", XDG_RUNTIME_DIR=str(arguments.work),
                       HOME=str(arguments.work))
    for t in terrains(arguments):
        found = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_qgis.py", t.files["2dm"], t.files["gpkg"]],
                               env=environment).splitlines()[-1])
        mesh, layer = found["mesh"], found["vector"]
        check(mesh["valid"] and layer["valid"], f"QGIS: a layer is not valid: {found}")
        check((mesh["vertices"], mesh["faces"]) == (t.vertices, t.triangles), f"2DM in QGIS: {mesh}")
        near(mesh["extent"], t.extent, 1e-9 * max(map(abs, t.extent)), "2DM in QGIS: extent")
        t.check_heights(mesh["heights"], 1e-6, "2DM in QGIS")
        print(f"ok: {t.name}: 2DM in QGIS {found['version']}: {mesh['vertices']} vertices, {mesh['faces']} faces, extent "
              f"and heights of the DEM (the format holds no CRS that QGIS reads)")
        check(layer["features"] == t.triangles, f"GeoPackage in QGIS: {layer['features']} features")
        check(layer["crs"] == f"EPSG:{t.epsg}", f"GeoPackage in QGIS: CRS {layer['crs']}")
        near(layer["extent"], t.extent, 1e-9 * max(map(abs, t.extent)), "GeoPackage in QGIS: extent")
        check(layer["geometry"] == "PolygonZ", f"GeoPackage in QGIS: {layer['geometry']}")
        check(0 < layer["largestError"] <= t.error * (1 + 1e-6), f"GeoPackage in QGIS: {layer['largestError']}")
        check(layer["invalid"] == 0, f"GeoPackage in QGIS: {layer['invalid']} geometries are not valid")
        print(f"ok: {t.name}: GeoPackage in QGIS: {layer['features']} PolygonZ, all valid, {layer['crs']}, errors up to "
              f"{layer['largestError']:g}")


def read_with_driver(arguments, t, program, tolerances, **more):
    environment = dict(os.environ, GDAL_DRIVER_PATH=str(arguments.driver), **more)
    return json.loads(run([SYSTEM_PYTHON, HERE / "read_with_driver.py", program, t.folder / "dem.amt", t.dem,
                           *tolerances], env=environment).splitlines()[-1])


def step_driver(arguments):
    need_program("gdal_translate", "gdal-bin")
    check((arguments.driver / "gdal_AMT.so").exists(), f"there is no gdal_AMT.so in {arguments.driver}")
    for t in terrains(arguments):
        model, tolerances = t.folder / "dem.amt", [0, t.error, 3 * t.error]
        environment = dict(os.environ, GDAL_DRIVER_PATH=str(arguments.driver))
        for command in (["gdalinfo", "-stats", model], ["ogrinfo", "-al", "-so", "-oo", f"TOLERANCE={t.error}", model]):
            done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True, env=environment)
            check(done.returncode == 0 and not done.stderr, f"{command[0]} {model}: {done.stderr or done.returncode}")
        check(not Path(f"{model}.aux.xml").exists(), "GDAL wrote statistics beside the file")
        print(f"ok: {t.name}: .amt in GDAL's tools: no complaint, nothing written beside it")
        for program, package, read in (("rasterio", "python3-rasterio", driver_in_rasterio),
                                       ("geopandas", "python3-geopandas", driver_in_geopandas),
                                       ("xarray", "python3-rioxarray", driver_in_xarray),
                                       ("qgis", "python3-qgis", driver_in_qgis)):
            try:
                need_module({"xarray": "rioxarray", "qgis": "qgis.core"}.get(program, program), package)
            except Missing as missing:
                print(f"-- {missing}")
                continue
            read(arguments, t, tolerances)


def driver_in_rasterio(arguments, t, tolerances):
    found = read_with_driver(arguments, t, "rasterio", tolerances)
    for off, tolerance in zip(found["off"], tolerances):
        check(off <= tolerance * (1 + 1e-6), f"rasterio: {off} off at a tolerance of {tolerance}")
    check(found["sameInAWindow"] and found["masked"] and found["sameGrid"], f"rasterio: {found}")
    check(found["epsg"] == [t.epsg, t.epsg], f"rasterio: {found['epsg']}")
    print(f"ok: {t.name}: .amt in rasterio: the DEM's grid and CRS, {found['off']} off at {tolerances}, windows alike")


def driver_in_geopandas(arguments, t, tolerances):
    found = read_with_driver(arguments, t, "geopandas", tolerances[1:])
    check(found["features"][0] == t.triangles, f"geopandas: {found['features']} triangles, expected {t.triangles}")
    check(found["epsg"] == t.epsg and found["hasHeights"], f"geopandas: {found}")
    for error, tolerance in zip(found["largestError"], tolerances[1:]):
        check(0 < error <= tolerance * (1 + 1e-6), f"geopandas: an error of {error} at {tolerance}")
    print(f"ok: {t.name}: .amt in geopandas: {found['features']} triangles as extracted, EPSG:{found['epsg']}")


def driver_in_xarray(arguments, t, _):
    found = read_with_driver(arguments, t, "xarray", [])
    near(found["heights"], t.heights, 1e-9 * max(map(abs, t.heights)), "xarray: heights")
    check(found["epsg"] == t.epsg, f"xarray: EPSG:{found['epsg']}")
    print(f"ok: {t.name}: .amt in xarray: {found['shape']}, EPSG:{found['epsg']}, the DEM's heights")


def driver_in_qgis(arguments, t, tolerances):
    found = read_with_driver(arguments, t, "qgis", tolerances, QT_QPA_PLATFORM="offscreen",
                             XDG_RUNTIME_DIR=str(arguments.work), HOME=str(arguments.work))
    check(found["valid"] and found["crs"] == [f"EPSG:{t.epsg}"] * 2, f"QGIS: {found}")
    check(found["features"][1] == t.triangles, f"QGIS: {found['features']} triangles, expected {t.triangles}")
    for heights, tolerance in zip(found["heights"], tolerances):
        for value, bound in zip(heights, t.heights):
            check(abs(value - bound) <= tolerance + 1e-9 * abs(bound), f"QGIS: heights {heights} at {tolerance}")
    check(found["slopeSize"] == found["size"] and 0 < found["steepest"] < 90, f"QGIS: slopes {found}")
    check(found["contours"] > 0, f"QGIS: contours {found}")
    print(f"ok: {t.name}: .amt in QGIS: {found['size']} pixels, {found['features']} triangles at {tolerances}, slopes up "
          f"to {found['steepest']:.1f} degrees, {found['contours']} contours")


def step_provider(arguments):
    need_module("qgis.core", "python3-qgis")
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", XDG_RUNTIME_DIR=str(arguments.work),
                       HOME=str(arguments.work), ARETE=str(arguments.arete.resolve()))
    has_driver = (arguments.driver / "gdal_AMT.so").exists()
    if has_driver:
        environment["GDAL_DRIVER_PATH"] = str(arguments.driver)
    for t in terrains(arguments):
        middle = [(t.extent[0] + t.extent[2]) / 2, (t.extent[1] + t.extent[3]) / 2]
        found = json.loads(run([SYSTEM_PYTHON, HERE / "run_provider.py", ROOT / "gis/qgis", t.dem, t.folder, t.error,
                                *middle, t.epsg], env=environment).splitlines()[-1])
        check(found["triangles"] == [t.triangles, t.triangles] and found["crs"] == f"EPSG:{t.epsg}", f"QGIS: {found}")
        check(found["measured"] <= t.error * (1 + 1e-6) and all(found["rasters"]), f"QGIS: {found}")
        check(found["progress"] == [True, 100, False] and found["setCrs"].endswith("(EPSG:32701)") and
              abs(found["secondBand"] - found["measured"]) <= 1e-9 * found["measured"], f"QGIS: {found}")
        check(found.get("options", 0) <= t.error * 2, f"QGIS: {found}")
        check(all(found["refused"]), f"QGIS: a run without sense was not refused: {found['refused']}")
        close = 1e-6 * max(map(abs, t.heights))
        check(found["heights"][:4] == [3, 4, False, "POIN"] and found["heights"][4] <= close, f"QGIS: heights: {found['heights']}")
        check(found["profile"][:3] == [[2], True, True] and found["profile"][3] <= close, f"QGIS: profile: {found['profile']}")
        check(found["sight"][0] == found["sight"][1] and found["sight"][2], f"QGIS: lines of sight: {found['sight']}")
        check(found["pairs"][0] == 2 and found["pairs"][1] <= close, f"QGIS: pairs: {found['pairs']}")
        check(found["cuts"][0] == found["cuts"][1] and found["names"] == ["TIN of provider by region"], f"QGIS: {found}")
        # Of degrees beside metres the two measure differently, and the plugin says so.
        check(found["meshes"][0] <= 60 and (t.epsg == 4326 or found["meshes"][1] <= 1.001 * found["meshes"][2]),
              f"QGIS: meshes: {found['meshes']}")
        check(found["canceled"] == ["canceled", False], f"QGIS: Cancel: {found['canceled']}")
        check(not found["red"] and found["icons"] and (found["opened"] == [True, True] or not has_driver),
              f"QGIS: its log has {found['red']}; {found['opened']}, {found['icons']}")
        print(f"ok: {t.name}: Processing in QGIS: {', '.join(found['algorithms'])}; {t.triangles} triangles, "
              f"measured {found['measured']:g} ({t.error} promised)")


def meshlab(arguments, meshes, filters="", save=None):
    """What MeshLab says about meshes it opens and filters it applies; `save` = (path, attributes)."""
    need_program("meshlabserver", "meshlab")
    need_program("xvfb-run", "xvfb")
    script = arguments.work / "script.mlx"
    script.write_text(f"<!DOCTYPE FilterScript>\n<FilterScript>\n{filters}</FilterScript>\n")
    command = ["xvfb-run", "-a", "meshlabserver"]
    for mesh in meshes:
        command += ["-i", mesh]
    if save:
        command += ["-o", save[0]] + (["-m", *save[1]] if save[1] else [])
    return run(command + ["-s", script])


def meshlab_counts(said, path):
    found = re.search(re.escape(Path(path).name) + r" loaded has (\d+) vn (\d+) fn", said)
    check(found, f"MeshLab does not open {path}:\n{said[-500:]}")
    return int(found[1]), int(found[2])


MEASURES = ' <filter name="Compute Geometric Measures"/>\n'


def step_meshlab(arguments):
    made = terrains(arguments)
    for t in made:
        for extension, origin in (("ply", [0, 0, 0]), ("off", [0, 0, 0]), ("stl", stl_origin(t.files["stl"]))):
            said = meshlab(arguments, [t.files[extension]], MEASURES)
            counts = meshlab_counts(said, t.files[extension])
            check(counts == (t.vertices, t.triangles), f"{extension} in MeshLab: {counts}")
            corners = [[float(number) for number in re.search(rf"Bounding Box {which} +(.*)", said)[1].split()]
                       for which in ("min", "max")]
            check_box(t, corners, origin, 1e-6, f"{extension} in MeshLab")
            print(f"ok: {t.name}: {extension.upper()} in MeshLab: {counts[0]} vertices, {counts[1]} faces, box and "
                  "heights of the DEM")
    # Two TINs of the first terrain: the fine one with its vertices' distances to the coarse one.
    shown = arguments.work / "distances.ply"
    run([arguments.arete, "measure", made[0].files["ply"], made[0].coarse, "--error-mesh", shown, "--samples", 1000,
         "--quiet"])
    saved = arguments.work / "distances_saved.ply"
    said = meshlab(arguments, [shown], ' <filter name="Per Vertex Quality Stat"/>\n', (saved, ["vq", "vc"]))
    counts = meshlab_counts(said, shown)
    wrote, kept = ply_column(shown, "quality"), ply_column(saved, "quality")
    check(len(wrote) == counts[0] and wrote == kept, "MeshLab changes the quality of the vertices")
    check(ply_column(shown, "red") == ply_column(saved, "red"), "MeshLab changes the colours of the vertices")
    low, high = map(float, re.search(r"Min +(\S+) +Max +(\S+)", said).groups())
    near([low, high], [min(wrote), max(wrote)], 1e-6 * max(1, max(wrote)), "quality in MeshLab")
    print(f"ok: distances in MeshLab: {counts[0]} vertices with quality from {low:g} to {high:g} and colours")


def check_box(t, corners, origin, decimals, what):
    """A box as a program of single precision prints it; `origin` is what the file subtracted."""
    for axis, which in ((0, "x"), (1, "y"), (2, "z")):
        found = [corner[axis] + origin[axis] for corner in corners]
        rounding = max(float32_step(corner[axis]) for corner in corners) + decimals
        if axis < 2:
            near(found, [t.extent[axis], t.extent[axis + 2]], rounding, f"{what}: {which} of the box")
        else:
            t.check_heights(found, rounding, what)


def step_assimp(arguments):
    need_program("assimp", "assimp-utils")
    for t in terrains(arguments):
        for extension in ("ply", "obj", "off", "stl", "glb", "gltf"):
            said = run(["assimp", "info", t.files[extension], "--raw"])
            number = lambda what: int(re.search(what + r": +(\d+)", said)[1])
            # It splits the corners of an STL and an OBJ; the others keep their vertices.
            expected = 3 * t.triangles if extension in ("stl", "obj") else t.vertices
            check((number("Vertices"), number("Faces")) == (expected, t.triangles),
                  f"{extension} in Assimp: {number('Vertices')} vertices, {number('Faces')} faces")
            corners = [[float(number) for number in re.search(which + r" point +\((.*?)\)", said)[1].split()]
                       for which in ("Minimum", "Maximum")]
            if extension not in ("glb", "gltf"):  # have metres in a frame of its own: the step "gltf"
                origin = stl_origin(t.files["stl"]) if extension == "stl" else [0, 0, 0]
                check_box(t, corners, origin, 1e-6, f"{extension} in Assimp")
            print(f"ok: {t.name}: {extension.upper()} in Assimp: {t.triangles} faces"
                  f"{'' if extension in ('glb', 'gltf') else ', box and heights of the DEM'}")


VALIDATOR = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
  .then(report => console.log(JSON.stringify(report)));
"""


def step_gltf(arguments):
    need_program("node", "nodejs")
    modules = ROOT / "build" / "npm"
    if not (modules / "node_modules" / "gltf-validator").exists():
        need_program("npm", "npm")
        modules.mkdir(parents=True, exist_ok=True)
        try:
            run(["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", modules,
                 "gltf-validator@2.0.0-dev.3.10"])
        except Broken:
            raise Missing("the Khronos glTF validator could not be fetched (npm package gltf-validator)")
    for t in terrains(arguments):
        for extension in ("gltf", "glb"):
            report = json.loads(run(["node", "-e", VALIDATOR, t.files[extension]], cwd=modules))
            issues, info = report["issues"], report["info"]
            check(issues["numErrors"] == 0 and issues["numWarnings"] == 0, f"{t.files[extension]}: {issues['messages']}")
            check((info["totalVertexCount"], info["totalTriangleCount"]) == (t.vertices, t.triangles),
                  f"{extension}: {info['totalVertexCount']} vertices, {info['totalTriangleCount']} triangles")
        print(f"ok: {t.name}: GLB and glTF in the Khronos validator {report['validatorVersion']}: no error, no warning, "
              f"{info['totalVertexCount']} vertices, {info['totalTriangleCount']} triangles")
        place = json.loads(run([SYSTEM_PYTHON, HERE / "read_with_gdal.py", "glb", t.files["glb"], t.files["gpkg"]]))
        near(place["farthestMetres"], 0, 0.01, "GLB: metres between its vertices and where PROJ puts them")
        print(f"ok: {t.name}: GLB: every vertex within {place['farthestMetres'] * 1000:.2g} mm of where PROJ puts a "
              f"corner of the GeoPackage, in {place['frame']} metres")


DECIMATE = """ <filter name="Simplification: Quadric Edge Collapse Decimation">
  <Param type="RichInt" value="0" name="TargetFaceNum"/>
  <Param type="RichFloat" value="0.1" name="TargetPerc"/>
  <Param type="RichFloat" value="0.3" name="QualityThr"/>
  <Param type="RichBool" value="false" name="PreserveBoundary"/>
  <Param type="RichFloat" value="1" name="BoundaryWeight"/>
  <Param type="RichBool" value="false" name="PreserveNormal"/>
  <Param type="RichBool" value="false" name="PreserveTopology"/>
  <Param type="RichBool" value="true" name="OptimalPlacement"/>
  <Param type="RichBool" value="false" name="PlanarQuadric"/>
  <Param type="RichFloat" value="0.001" name="PlanarWeight"/>
  <Param type="RichBool" value="false" name="QualityWeight"/>
  <Param type="RichBool" value="true" name="AutoClean"/>
  <Param type="RichBool" value="false" name="Selected"/>
 </filter>
"""

HAUSDORFF = """ <filter name="Hausdorff Distance">
  <Param type="RichMesh" value="{0}" name="SampledMesh"/>
  <Param type="RichMesh" value="{1}" name="TargetMesh"/>
  <Param type="RichBool" value="false" name="SaveSample"/>
  <Param type="RichBool" value="false" name="SampleVert"/>
  <Param type="RichBool" value="false" name="SampleEdge"/>
  <Param type="RichBool" value="false" name="SampleFauxEdge"/>
  <Param type="RichBool" value="true" name="SampleFace"/>
  <Param type="RichInt" value="1000000" name="SampleNum"/>
  <Param type="RichAbsPerc" value="1e9" min="0" max="1e9" name="MaxDist"/>
 </filter>
"""


def ply_of_obj(obj, ply, origin=(0, 0, 0)):
    """The "v" and "f" lines of an OBJ as an ASCII PLY, polygons as fans, `origin` taken away."""
    vertices, faces = [], []
    for line in obj.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(" ".join(repr(float(words[1 + i]) - origin[i]) for i in range(3)))
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [c - 1 if c > 0 else len(vertices) + c for c in corners]
            faces += [(corners[0], corners[k - 1], corners[k]) for k in range(2, len(corners))]
    header = f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n"
    header += "".join(f"property float {axis}\n" for axis in "xyz")
    header += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    ply.write_text(header + "\n".join(vertices) + "\n" + "".join(f"3 {a} {b} {c}\n" for a, b, c in faces))


def ply_column(path, name):
    """One property of the vertices of a binary little-endian PLY."""
    content = path.read_bytes()
    begin = content.index(b"end_header\n") + len(b"end_header\n")
    sizes = {"float": "f", "double": "d", "uchar": "B"}
    layout, column, vertices = "<", None, 0
    for line in content[:begin].decode().splitlines():
        words = line.split()
        if words[:2] == ["element", "vertex"]:
            vertices = int(words[2])
        elif words[:1] == ["element"]:
            break
        elif words[:1] == ["property"]:
            if words[2] == name:
                column = len(layout) - 1
            layout += sizes[words[1]]
    check(column is not None, f"{path} has no property {name}")
    record = struct.Struct(layout)
    return [record.unpack_from(content, begin + i * record.size)[column] for i in range(vertices)]


def step_distances(arguments):
    t = terrains(arguments)[0]
    # MeshLab computes in single precision: both TINs come to it about one local origin.
    local = [arguments.work / "coarse.ply", arguments.work / "fine.ply"]
    for obj, ply in zip((t.coarse, t.files["obj"]), local):
        ply_of_obj(obj, ply, (*t.extent[:2], 0))
    pairs = [("two TINs", local[0], t.files["obj"], local[1], t.coarse)]
    models = Path(os.environ.get("ARETE_DATA", "")) / "meshes"
    for name in ("spot.obj", "pirate.obj", "fuze.obj", "self_intersectA.obj", "featuretype.STL"):
        original = models / name
        if not os.environ.get("ARETE_DATA") or not original.exists():
            print(f"-- {name} is not in $ARETE_DATA/meshes: left out")
            continue
        opened = original
        if original.suffix == ".obj":
            opened = arguments.work / (original.stem + ".ply")
            ply_of_obj(original, opened)
        small = arguments.work / (original.stem + "_small.ply")
        meshlab(arguments, [opened], DECIMATE, (small, []))
        pairs.append((name, small, original, opened, small))
    for name, small, original, opened, measured in pairs:
        said = meshlab(arguments, [small, opened], HAUSDORFF.format(0, 1) + HAUSDORFF.format(1, 0))
        ours = json.loads(run([arguments.arete, "measure", measured, original, "--samples", 1000000, "--json"]))
        counted = [meshlab_counts(said, path) for path in (small, opened)]
        check([faces for _, faces in counted] == [ours[mesh]["triangles"] for mesh in ("first", "second")],
              f"{name}: MeshLab counts {counted}")
        line = f"ok: {name} ({ours['first']['triangles']} of {ours['second']['triangles']} triangles):"
        for way, mesh in (("fromFirst", "first"), ("fromSecond", "second")):
            maximum, mean, rms = (float(number) for number in way_from(small if mesh == "first" else opened, said))
            spacing = (ours[mesh]["area"] / 1e6) ** 0.5
            # Ours is searched for, theirs is sampled: it is no larger than what we call certain, and not far below.
            check(maximum <= ours[way]["atMost"] * (1 + 1e-5) + 1e-6,
                  f"{name}, {way}: MeshLab finds {maximum}, certainly at most {ours[way]['atMost']}")
            near(ours[way]["maximum"], maximum, 4 * spacing + 1e-6, f"{name}, {way}: maximum")
            for which, value in (("mean", mean), ("rms", rms)):
                near(ours[way][which], value, 0.015 * value + 1e-6, f"{name}, {way}: {which}")
            line += (f" {way} maximum {ours[way]['maximum']:.6f} (MeshLab {maximum:.6f}), mean {ours[way]['mean']:.6f} "
                     f"({mean:.6f}), RMS {ours[way]['rms']:.6f} ({rms:.6f});")
        print(line.rstrip(";"))


def way_from(sampled, said):
    """Maximum, mean and RMS as MeshLab printed them for the way on which it sampled this mesh."""
    found = re.search(rf"on {re.escape(sampled.name)} searched closest on .*\n"
                      r" +min : \S+ +max (\S+) +mean : (\S+) +RMS : (\S+)", said)
    check(found, f"MeshLab reports no distance from {sampled}:\n{said[-1000:]}")
    return found.groups()


STEPS = {"gdal": step_gdal, "qgis": step_qgis, "driver": step_driver, "provider": step_provider, "meshlab": step_meshlab,
         "assimp": step_assimp, "gltf": step_gltf, "distances": step_distances}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"of {', '.join(STEPS)} (default: all)")
    parser.add_argument("--arete", type=Path, default=ROOT / "build/release/arete")
    parser.add_argument("--datasets", type=Path, help="the program arete-datasets (default: beside arete)")
    parser.add_argument("--driver", type=Path, help="folder of gdal_AMT.so (default: gis beside arete)")
    parser.add_argument("--dem", help="use this DEM; it has no NODATA on its border")
    parser.add_argument("--work", type=Path, default=ROOT / "build/external", help="folder for the files")
    arguments = parser.parse_args()
    for step in arguments.steps:
        if step not in STEPS:
            parser.error(f"there is no step '{step}': {', '.join(STEPS)}")
    arguments.datasets = arguments.datasets or arguments.arete.with_name("arete-datasets")
    arguments.driver = (arguments.driver or arguments.arete.with_name("gis")).resolve()
    base, failed, done = arguments.work.resolve(), 0, 0
    for step in arguments.steps or STEPS:
        arguments.work = base / step
        arguments.work.mkdir(parents=True, exist_ok=True)
        try:
            need_module("osgeo", "python3-gdal")  # says what the DEM holds
            STEPS[step](arguments)
            done += 1
        except Missing as missing:
            print(f"{Path(__file__).name}:1: Skipped\n{step}: {missing}\n")  # as GoogleTest says it: ./dev reads it
        except (Broken, subprocess.TimeoutExpired) as broken:
            print(f"FAILED: {step}: {broken}")
            failed += 1
        sys.stdout.flush()
    return 1 if failed else SKIPPED if not done else 0


if __name__ == "__main__":
    sys.exit(main())
