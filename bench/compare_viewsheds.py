#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Viewsheds of a DEM by Arete, gdal_viewshed and GRASS r.viewshed: where they differ, and how long they take.

    compare_viewsheds.py --arete ARETE DEM.tif --observer=X,Y[,H] ... [--out FOLDER]

Flat Earth, no refraction, target on the ground, the observer H above it (2 unless told), all cells. For each
observer a table of cells on stdout, and with --out a picture: what all three see, and who is alone with what. Needs
numpy and GDAL's Python bindings; gdal_viewshed and grass where they are on the PATH.
"""
import argparse, csv, os, shutil, subprocess, sys, tempfile, time

import numpy as np
from osgeo import gdal

gdal.UseExceptions()


def timed(command, **keywords):
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **keywords)
    return time.perf_counter() - start


def band(path):
    return gdal.Open(path).ReadAsArray()


def by_arete(arete, model, observer, folder):
    x, y, h = observer
    seen, least = os.path.join(folder, "arete.tif"), os.path.join(folder, "least.tif")
    common = [arete, "viewshed", model, "--observer", f"{x},{y},{h}", "--earth", "plane", "--quiet"]
    seconds = timed(common + ["-o", seen])
    timed(common + ["-o", least, "--mode", "height"])
    return band(seen), band(least), seconds


def by_gdal(dem, observer, folder):
    x, y, h = observer
    path = os.path.join(folder, "gdal.tif")
    seconds = timed(["gdal_viewshed", "-ox", str(x), "-oy", str(y), "-oz", str(h), "-tz", "0", "-cc", "0", "-md", "0",
                     "-vv", "255", "-iv", "0", "-q", dem, path])
    return band(path), seconds


def by_grass(dem, observer, folder):
    x, y, h = observer
    path, script = os.path.join(folder, "grass.tif"), os.path.join(folder, "grass.sh")
    with open(script, "w") as f:
        f.write(f"""set -e
r.in.gdal -o --quiet input="{dem}" output=dem
g.region raster=dem
start=$(date +%s.%N)
r.viewshed -b --quiet input=dem output=seen coordinates={x},{y} observer_elevation={h} target_elevation=0 memory=4000
end=$(date +%s.%N)
echo $start $end > "{folder}/grass.seconds"
r.out.gdal --quiet --overwrite -f input=seen output="{path}" format=GTiff type=Byte nodata=99
""")
    timed(["grass", "--tmp-location", dem, "--exec", "bash", script])
    with open(os.path.join(folder, "grass.seconds")) as f:
        start, end = (float(v) for v in f.read().split())
        return band(path) == 1, end - start


def explain(arete, model, source, observer, wrong, least, folder):
    """By how much the terrain hides what a rival sees, and how near to the observer the first of it is."""
    rows, columns = np.nonzero(wrong)
    some = np.random.default_rng(1).permutation(len(rows))[:2000]
    g = source.GetGeoTransform()
    table, answers = os.path.join(folder, "cells.csv"), os.path.join(folder, "answers.csv")
    with open(table, "w") as f:
        f.write("x,y,h\n")
        for i in some:
            f.write(f"{g[0] + g[1] * (columns[i] + 0.5)!r},{g[3] + g[5] * (rows[i] + 0.5)!r},0\n")
    x, y, h = observer
    timed([arete, "los", model, "--from", f"{x},{y},{h}", "--points", table, "--earth", "plane", "-o", answers, "-q"])
    with open(answers) as f:
        answers = list(csv.DictReader(f))
    where = np.array([float(a["obstruction_distance"]) / float(a["distance"]) for a in answers
                      if a["verdict"] == "blocked"])
    print("    hidden by (10, 50, 90 %): " + ", ".join(f"{v:.2f}" for v in np.percentile(least[wrong], [10, 50, 90])) +
          f"; first obstruction at (10, 50, 90 %) of the way: " +
          ", ".join(f"{v:.3f}" for v in np.percentile(where, [10, 50, 90])))


def picture(path, heights, ours, theirs):
    """Grey relief; white: all see it; red: only others see it; blue: only Arete sees it."""
    gy, gx = np.gradient(np.nan_to_num(heights, nan=float(np.nanmean(heights))))
    shade = np.clip(0.5 + (gx - gy) / (6 * (np.std(gx - gy) + 1e-9)), 0, 1)
    rgb = np.repeat((40 + 120 * shade)[..., None], 3, axis=2)
    everyone = ours.copy()
    anyone = np.zeros_like(ours)
    for t in theirs:
        everyone &= t
        anyone |= t
    rgb[everyone] = rgb[everyone] * 0.4 + np.array([255, 255, 255]) * 0.6
    rgb[ours & ~everyone] = np.array([40, 90, 255])
    rgb[anyone & ~ours] = np.array([230, 40, 30])
    out = gdal.GetDriverByName("MEM").Create("", heights.shape[1], heights.shape[0], 3, gdal.GDT_Byte)
    for i in range(3):
        out.GetRasterBand(i + 1).WriteArray(rgb[..., i].astype(np.uint8))
    gdal.GetDriverByName("PNG").CreateCopy(path, out)
    if os.path.exists(path + ".aux.xml"):
        os.remove(path + ".aux.xml")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dem")
    parser.add_argument("--observer", action="append", required=True, metavar="X,Y[,H]", dest="observers")
    parser.add_argument("--arete", default="arete")
    parser.add_argument("--out")
    options = parser.parse_args()
    if options.out:
        os.makedirs(options.out, exist_ok=True)
    source = gdal.Open(options.dem)
    heights = source.ReadAsArray().astype(float)
    nodata = source.GetRasterBand(1).GetNoDataValue()
    if nodata is not None:
        heights[heights == nodata] = np.nan
    valid = ~np.isnan(heights)
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "dem.amt")
        timed([options.arete, "build", options.dem, "-o", model, "--quiet"])
        for number, text in enumerate(options.observers):
            observer = [float(v) for v in text.split(",")]
            observer += [2.0] * (3 - len(observer))
            seen, least, seconds = by_arete(options.arete, model, observer, folder)
            ours = (seen == 255) & valid
            print(f"observer {observer[0]:g}, {observer[1]:g}, {observer[2]:g} above ground: "
                  f"Arete sees {ours.sum()} of {valid.sum()} cells, {seconds:.2f} s with reading and writing")
            rivals = {}
            if shutil.which("gdal_viewshed"):
                rivals["gdal_viewshed"] = by_gdal(options.dem, observer, folder)
            if shutil.which("grass"):
                rivals["r.viewshed"] = by_grass(options.dem, observer, folder)
            theirs = []
            for name, (cells, taken) in rivals.items():
                cells = ((cells != 0) & (cells != 99)) & valid
                theirs.append(cells)
                wrong, missed = cells & ~ours, ours & ~cells
                union = (cells | ours).sum()
                print(f"  {name}: sees {cells.sum()}, IoU {(cells & ours).sum() / max(1, union):.3f}, {taken:.2f} s; "
                      f"{wrong.sum()} seen that are hidden, {missed.sum()} hidden that are seen")
                if wrong.any():
                    explain(options.arete, model, source, observer, wrong, least, folder)
            if options.out and theirs:
                picture(os.path.join(options.out, f"viewsheds-{number}.png"), heights, ours, theirs)


if __name__ == "__main__":
    sys.exit(main())
