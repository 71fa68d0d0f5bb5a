#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods of `arete mesh decimate` beside the programs that have them: how good, and how long they take.

    compare_decimation.py --arete ARETE MESH ... [--shares 10 2 0.5] [--out FOLDER] [--modules FOLDER]

qem beside MeshLab's quadrics with its own defaults (meshlabserver, xvfb-run), half-edge beside meshoptimizer's
simplify and cluster beside its simplifySloppy (node; the npm package is fetched into --modules). Each program gets the
same mesh, without faces that are no surface, and states the time of the method alone. Distances are those of
`arete measure`, both ways. On stdout a line for each pair and the geometric means; where one has 5 % more triangles than
asked for, or Arete 10 % less than its peer, the pair is named and left out of the means.
"""
import argparse, json, math, pathlib, statistics, subprocess, sys, tempfile, time

MESHLAB = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Simplification: Quadric Edge Collapse Decimation">
  <Param type="RichInt" value="{count}" name="TargetFaceNum"/>
  <Param type="RichFloat" value="0" name="TargetPerc"/>
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
</FilterScript>
"""

# Reads vertices and triangles of an OBJ, writes what is left of them, prints the least of five times in milliseconds.
MESHOPTIMIZER = """
const fs = require('fs');
const [input, output, count, method] = process.argv.slice(2);
import('meshoptimizer').then(async ({MeshoptSimplifier: its}) => {
  await its.ready;
  its.useExperimentalFeatures = true;
  const places = [], corners = [];
  for (const line of fs.readFileSync(input, 'utf8').split('\\n')) {
    const words = line.split(/\\s+/);
    if (words[0] === 'v') places.push(+words[1], +words[2], +words[3]);
    if (words[0] === 'f') for (let i = 1; i < 4; ++i) corners.push(parseInt(words[i]) - 1);
  }
  const vertices = Float32Array.from(places), triangles = Uint32Array.from(corners);
  let left, least = Infinity;
  for (let i = 0; i < 5; ++i) {
    const begin = performance.now();
    left = method === 'sloppy' ? its.simplifySloppy(triangles, vertices, 3, null, 3 * count, 1e9)
                               : its.simplify(triangles, vertices, 3, 3 * count, 1e9, []);
    least = Math.min(least, performance.now() - begin);
  }
  const indices = left[0];
  let text = '';
  for (let i = 0; i < places.length; i += 3) text += `v ${places[i]} ${places[i + 1]} ${places[i + 2]}\\n`;
  for (let i = 0; i < indices.length; i += 3)
    text += `f ${indices[i] + 1} ${indices[i + 1] + 1} ${indices[i + 2] + 1}\\n`;
  fs.writeFileSync(output, text);
  console.log(least);
}).catch(error => { console.error(error); process.exit(1); });
"""


def run(command, **keywords):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **keywords)
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]}: {(done.stderr or done.stdout)[-600:]}")
    return done.stdout + done.stderr


def by_arete(arete, method, mesh, count, output):
    """The least of three times."""
    said = [json.loads(run([arete, "mesh", "decimate", mesh, "-o", output, "--max-triangles", count, "--operator", method,
                            "--threads", 1, "--json", "--quiet"])) for _ in range(3)]
    return min(one["seconds"] for one in said)


def by_meshlab(mesh, count, output, folder):
    """It does not state the time: what the filter takes beyond reading and writing, the least of three times."""
    script, none = folder / "decimate.mlx", folder / "none.mlx"
    script.write_text(MESHLAB.format(count=count))
    none.write_text("<!DOCTYPE FilterScript>\n<FilterScript>\n</FilterScript>\n")
    seconds = {}
    for _ in range(3):
        for path, written in ((none, folder / "whole.ply"), (script, output)):
            begin = time.perf_counter()
            run(["xvfb-run", "-a", "meshlabserver", "-i", mesh, "-o", written, "-s", path])
            seconds[path] = min(seconds.get(path, math.inf), time.perf_counter() - begin)
    return seconds[script] - seconds[none]


def by_meshoptimizer(method, mesh, count, output, modules):
    mesh = mesh.with_suffix(".obj")
    program = modules / "decimate.cjs"
    program.write_text(MESHOPTIMIZER)
    return float(run(["node", program, mesh, output, count, method], cwd=modules).split()[-1]) / 1000


def quality(arete, mesh, source):
    said = json.loads(run([arete, "measure", mesh, source, "--json"]))
    return said["first"]["triangles"], [100 * said["ofDiagonal"][name] for name in ("mean", "rms", "maximum")]


def shape_of(arete, mesh, folder):
    """The mesh as every program can hold it: an oriented surface, without attributes."""
    model, bare, shape = (folder / f"{mesh.stem}{end}" for end in (".amt", ".off", "_shape.ply"))
    run([arete, "build", mesh, "-o", model, "--quiet"])
    run([arete, "extract", model, "-o", bare, "--max-error", 0, "--quiet"])
    run([arete, "convert", bare, "-o", shape, "--quiet"])
    # MeshLab does not read every OBJ, and what is written for node is easiest read as one.
    run([arete, "convert", shape, "-o", shape.with_suffix(".obj"), "--quiet"])
    return shape


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--arete", required=True, type=pathlib.Path)
    parser.add_argument("--shares", nargs="+", type=float, default=[10, 2, 0.5], help="of the faces, in %%")
    parser.add_argument("--out", type=pathlib.Path, help="keep the meshes here")
    parser.add_argument("--modules", type=pathlib.Path, default=pathlib.Path("build/npm"))
    arguments = parser.parse_args()
    modules = arguments.modules.resolve()
    if not (modules / "node_modules" / "meshoptimizer").exists():
        modules.mkdir(parents=True, exist_ok=True)
        run(["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", modules, "meshoptimizer"])
    scratch = tempfile.TemporaryDirectory()
    folder = (arguments.out or pathlib.Path(scratch.name)).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    arete = arguments.arete.resolve()
    pairs = (("qem", "MeshLab", lambda *a: by_meshlab(*a, folder)),
             ("half-edge", "meshoptimizer", lambda *a: by_meshoptimizer("simplify", *a, modules)),
             ("cluster", "its sloppy", lambda *a: by_meshoptimizer("sloppy", *a, modules)))
    ratios = {}
    print("mesh,share,method,peer,triangles,peer_triangles,mean,rms,largest,peer_mean,peer_rms,peer_largest,seconds,peer_seconds")
    for mesh in arguments.meshes:
        source = shape_of(arete, mesh, folder)
        with open(source.with_suffix(".obj"), encoding="utf-8") as file:
            faces = sum(line.startswith("f ") for line in file)
        for share in arguments.shares:
            count = round(faces * share / 100)
            for method, peer, decimate in pairs:
                end = "ply" if peer == "MeshLab" else "obj"
                ours, theirs = folder / f"{mesh.stem}_{share}_{method}.obj", folder / f"{mesh.stem}_{share}_{method}_peer.{end}"
                try:
                    their_seconds = decimate(source, count, theirs)
                    their_count, their_quality = quality(arete, theirs, source)
                    # Beside as many triangles as the peer has come to.
                    seconds = by_arete(arete, method, source, max(count if method == "qem" else their_count, 1), ours)
                    our_count, our_quality = quality(arete, ours, source)
                except RuntimeError as error:
                    print(f"{mesh.name}, {share} %, {method}: left out: {str(error).strip()}", file=sys.stderr)
                    continue
                print(",".join([mesh.name, f"{share:g}", method, peer, str(our_count), str(their_count)]
                               + [f"{number:.5f}" for number in our_quality + their_quality]
                               + [f"{seconds:.4f}", f"{their_seconds:.4f}"]), flush=True)
                if max(their_count, our_count) > 1.05 * count or our_count < 0.9 * their_count:
                    print(f"{mesh.name}, {share} %, {method}: left out: {our_count} and {their_count} triangles for {count}",
                          file=sys.stderr)
                    continue
                ratios.setdefault((method, peer), []).append(
                    [a / b for a, b in zip(our_quality + [seconds], their_quality + [their_seconds])])
    print("\nmethod,peer,pairs,mean,rms,largest,time")
    for (method, peer), rows in ratios.items():
        # What takes MeshLab no time that can be told from reading and writing has no ratio.
        means = [statistics.geometric_mean([ratio for ratio in column if ratio > 0]) for column in zip(*rows)]
        print(",".join([method, peer, str(len(rows))] + [f"{number:.3f}" for number in means]))


if __name__ == "__main__":
    main()
