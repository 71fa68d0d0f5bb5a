# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that the examples of the pages name, made small: a DEM, places, regions, pictures and scans."""
import json
import math
import pathlib
import sqlite3
import struct
import subprocess
import zipfile

COLUMNS, ROWS, PIXEL, WEST, NORTH = 240, 110, 150, 385000, 3810000  # the pages' coordinates lie in it
EPSG = 32611


def height(x, y):
    """A landscape of ridges, 300 to 2000 m."""
    u, v = x / 1000, y / 1000
    ridge = abs(math.sin(u * 0.7 + math.sin(v * 0.5))) + 0.3 * abs(math.sin(u * 1.9 - v * 1.3)) + 0.1 * math.sin(u * 5 + v * 7)
    return round(300 + 1200 * ridge, 1)


def tiff(path, columns, rows, bands, sample_format, bits, data):
    """A GeoTIFF of one strip, pixels of PIXEL metres or as many as cover the DEM's width, in EPSG."""
    pixel = PIXEL * COLUMNS / columns
    shorts = lambda *n: struct.pack(f"<{len(n)}H", *n)
    keys = (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, EPSG)
    tags = [(256, 3, 1, shorts(columns)), (257, 3, 1, shorts(rows)), (258, 3, bands, shorts(*[bits] * bands)), (259, 3, 1, shorts(1)),
            (262, 3, 1, shorts(2 if bands == 3 else 1)), (273, 4, 1, None), (277, 3, 1, shorts(bands)), (278, 3, 1, shorts(rows)),
            (279, 4, 1, struct.pack("<I", len(data))), (284, 3, 1, shorts(1)), (339, 3, bands, shorts(*[sample_format] * bands)),
            (33550, 12, 3, struct.pack("<3d", pixel, pixel, 0)), (33922, 12, 6, struct.pack("<6d", 0, 0, 0, WEST, NORTH, 0)),
            (34735, 3, len(keys), shorts(*keys))]
    at = 8 + 2 + 12 * len(tags) + 4
    directory, extra = struct.pack("<H", len(tags)), b""
    strip = at + sum(len(v) for _, _, _, v in tags if v and len(v) > 4)
    for tag, kind, count, value in tags:
        value = struct.pack("<I", strip) if value is None else value
        if len(value) > 4:
            value, extra = struct.pack("<I", at + len(extra)), extra + value
        directory += struct.pack("<HHI", tag, kind, count) + value.ljust(4, b"\0")
    path.write_bytes(b"II*\0" + struct.pack("<I", 8) + directory + b"\0\0\0\0" + extra + data)


def geopackage(path, table, kind, features):
    """A layer of points, lines or polygons, each a list of positions, in EPSG; heights of 10 m at both ends."""
    wkb = {"POINT": 1, "LINESTRING": 2, "POLYGON": 3}[kind]
    database = sqlite3.connect(path)
    database.executescript(f"""
        PRAGMA application_id = 1196444487; PRAGMA user_version = 10200;
        CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL,
          organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
        CREATE TABLE gpkg_contents (table_name TEXT PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT, description TEXT,
          last_change DATETIME NOT NULL DEFAULT '2026-01-01T00:00:00.000Z', min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER);
        CREATE TABLE gpkg_geometry_columns (table_name TEXT PRIMARY KEY, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL,
          srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL);
        CREATE TABLE {table} (fid INTEGER PRIMARY KEY, geom BLOB, h1 DOUBLE, h2 DOUBLE);
        INSERT INTO gpkg_spatial_ref_sys VALUES ('undefined', -1, 'NONE', -1, 'undefined', ''), ('undefined', 0, 'NONE', 0, 'undefined', ''),
          ('WGS 84 / UTM zone 11N', {EPSG}, 'EPSG', {EPSG}, 'PROJCS["WGS 84 / UTM zone 11N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",
          6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]],PROJECTION["Transverse_Mercator"],
          PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-117],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],
          PARAMETER["false_northing",0],UNIT["metre",1],AUTHORITY["EPSG","{EPSG}"]]', '');
        INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES ('{table}', 'features', '{table}', {EPSG});
        INSERT INTO gpkg_geometry_columns VALUES ('{table}', 'geom', '{kind}', {EPSG}, 0, 0);""")
    for positions in features:
        body = b"".join(struct.pack("<2d", *p) for p in positions)
        count = struct.pack("<I", len(positions))
        shape = {"POINT": body, "LINESTRING": count + body, "POLYGON": struct.pack("<I", 1) + count + body}[kind]
        database.execute(f"INSERT INTO {table} (geom, h1, h2) VALUES (?, 10, 10)",
                         (b"GP\0\1" + struct.pack("<i", EPSG) + struct.pack("<BI", 1, wkb) + shape,))
    database.commit()
    database.close()


def scan(path, rings=40):
    """A bumpy ball of radius 1.5 with its pole at (0, 0, 1.5)."""
    segments, vertices, faces = 2 * rings, [(0, 0, 1.5)], []
    for i in range(1, rings):
        for j in range(segments):
            a, b = math.pi * i / rings, 2 * math.pi * j / segments
            r = 1.5 + 0.05 * math.sin(6 * a) * math.sin(5 * b) * math.sin(a)
            vertices.append((r * math.sin(a) * math.cos(b), r * math.sin(a) * math.sin(b), r * math.cos(a)))
    vertices.append((0, 0, -1.5))
    at = lambda i, j: 1 + (i - 1) * segments + j % segments
    for j in range(segments):
        faces += [(0, at(1, j), at(1, j + 1)), (len(vertices) - 1, at(rings - 1, j + 1), at(rings - 1, j))]
        for i in range(1, rings - 1):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    header = (f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_text(header + "".join("%.17g %.17g %.17g\n" % v for v in vertices) + "".join("3 %d %d %d\n" % f for f in faces))


def painted(ply, obj):
    """The same mesh with a colour, a texture coordinate and a normal of each vertex."""
    lines = ply.read_text().split("end_header\n")[1].split("\n")
    vertices = [tuple(map(float, line.split())) for line in lines if len(line.split()) == 3]
    faces = [tuple(map(int, line.split()[1:])) for line in lines if len(line.split()) == 4]
    with open(obj, "w", encoding="utf-8") as file:
        for a, b, c in vertices:
            file.write(f"v {a!r} {b!r} {c!r} {0.5 + 0.3 * a:.4f} {0.5 + 0.3 * b:.4f} 0.5\n")
        for a, b, c in vertices:
            length = math.sqrt(a * a + b * b + c * c)
            file.write(f"vt {0.5 + 0.3 * a:.6f} {0.5 + 0.3 * c:.6f}\nvn {a / length:.6f} {b / length:.6f} {c / length:.6f}\n")
        for face in faces:
            file.write("f " + " ".join(f"{v + 1}/{v + 1}/{v + 1}" for v in face) + "\n")


def survey(ply, path):
    """The same mesh with a quality of each vertex, 5 in the upper half and 1 in the lower."""
    header, body = ply.read_text().split("end_header\n")
    header = header.replace("property double z\n", "property double z\nproperty double quality\n")
    lines = [line + (" 5" if float(line.split()[2]) > 0 else " 1") if len(line.split()) == 3 else line for line in body.split("\n")]
    path.write_text(header + "end_header\n" + "\n".join(lines))


def make(folder, arete):
    """Writes all inputs into a folder; `arete` is the program."""
    folder = pathlib.Path(folder)
    run = lambda *arguments: subprocess.run([arete, *arguments, "-q"], cwd=folder, check=True, capture_output=True)
    x = lambda column: WEST + PIXEL * (column + 0.5)
    y = lambda row: NORTH - PIXEL * (row + 0.5)
    heights = [height(x(c), y(r)) for r in range(ROWS) for c in range(COLUMNS)]
    tiff(folder / "dem.tif", COLUMNS, ROWS, 1, 3, 32, struct.pack(f"<{len(heights)}f", *heights))
    for name in ("ortho", "landsat"):
        data = bytes((3 * c + 7 * r + 80 * b) % 256 for r in range(55) for c in range(120) for b in range(3))
        tiff(folder / f"{name}.tif", 120, 55, 3, 1, 8, data)
    geopackage(folder / "huts.gpkg", "huts", "POINT", [[(409050, 3801450)], [(400000, 3800000)]])
    geopackage(folder / "peaks.gpkg", "peaks", "POINT", [[(404000, 3803000)]])
    geopackage(folder / "road.gpkg", "road", "LINESTRING", [[(400000, 3800000), (405000, 3802000), (409050, 3801450)]])
    geopackage(folder / "paths.gpkg", "paths", "LINESTRING", 
               [[(400000, 3800000), (409050, 3801450)], [(401000, 3799000), (411000, 3797000)]])
    park = [(398000, 3798000), (408000, 3798000), (408000, 3806000), (398000, 3806000), (398000, 3798000)]
    geopackage(folder / "park.gpkg", "park", "POLYGON", [park])
    (folder / "points.csv").write_text("x,y,z\n" + "".join(f"{x(c)},{y(r)},{heights[r * COLUMNS + c]}\n"
                                                         for r in range(0, ROWS, 2) for c in range(0, COLUMNS, 2)))
    with zipfile.ZipFile(folder / "N46E008.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        void, part = [-32768] * 1001, [int(500 + 300 * math.sin(c / 40)) for c in range(200)]
        archive.writestr("N46E008.hgt", struct.pack(">1201h", *part, *void) * 200 + struct.pack(">h", -32768) * 1201 * 1001)
    scan(folder / "scan.ply")
    painted(folder / "scan.ply", folder / "scan.obj")
    survey(folder / "scan.ply", folder / "survey.ply")
    run("convert", "scan.ply", "-o", "scan.stl")
    run("convert", "scan.ply", "-o", "scan.glb")
    run("convert", "scan.ply", "-o", "original.obj")
    run("mesh", "decimate", "scan.ply", "-o", "small.ply", "--max-triangles", "10%")
    run("build", "dem.tif", "-o", "dem.amt")
    run("convert", "dem.amt", "-o", "served.amt", "--paged")
    run("build", "scan.ply", "-o", "scan.amt")
    run("extract", "scan.amt", "-o", "small.glb", "--max-error", "2%")
    run("extract", "dem.amt", "-o", "tin.ply", "--max-error", "5")
    (folder / "scene.json").write_text(json.dumps({"objects": [
        {"file": "dem.amt"}, {"name": "mast", "file": "scan.obj", "at": [405000, 3801000], "scale": 20, "anchor": "base"}]}))
