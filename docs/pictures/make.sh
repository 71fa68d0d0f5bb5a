#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws the pictures of README.md, of docs/start and of docs/topics/scenes.md again: docs/pictures/make.sh, after ./dev build, from generated mountains.
# Needs python3-pil and python3-matplotlib; those of QGIS and Blender also python3-qgis and blender, and are left out without.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
out="$root/docs/pictures" build="$root/build/release" work="$root/out/pictures"
export PATH="$build:$PATH" PYTHONPATH="$build/python" GDAL_DRIVER_PATH="$build/gis" QT_QPA_PLATFORM=offscreen
mkdir -p "$work"
cd "$work"
python() { /usr/bin/python3 "$@"; }

# One ridge in 200, 2 000 and 20 000 triangles, and in all of them.
arete-datasets generate -o ridge.tif --size 513 --no-lake --no-sea --seed 3 -q
arete build ridge.tif -o ridge.amt --features 8 -q
panel=(--headless --size 1200x520 --camera 409300,5171500,9200msl,353,-24.5,23 --sun 300,30 --pixel-error 0.01 --no-geomorph --no-decorations -q)
for n in 200 2000 20000; do
  arete view ridge.amt "${panel[@]}" --max-triangles $n --wireframe --screenshot "ridge$n.png"
done
arete view ridge.amt "${panel[@]}" --screenshot ridge.png
python "$out/panels.py" "$out/levels.png" 480x208 \
  ridge200.png "200 triangles" ridge2000.png "2 000" ridge20000.png "20 000" ridge.png "full resolution: 524 288"

# Rocks on hills, docs/topics/scenes.md.
arete-datasets generate -o hills.tif --size 513 -q
arete-datasets asteroid -o rock.ply -q
arete build hills.tif -o hills.amt -q
arete build rock.ply -o rock.amt -q
cp "$out/scene.json" .
arete view scene.json --screenshot rocks.png --camera 407700,5187000,2500msl,0,-10 --size 760x380 --sea-level 0 -q
python "$out/panels.py" "$out/scene.png" 760x380 rocks.png ""

# The tutorial, docs/start/tutorial.md.
arete-datasets generate -o dem.tif -q
arete build dem.tif -o dem.amt -q
arete extract dem.amt -o dem.glb --max-error 20 -q
arete view dem.amt --headless --size 1280x720 --haze 60 --screenshot flight.png --camera 423055,5182625,3300msl,215,-12 -q
python "$out/panels.py" "$out/tutorial-view.png" 640x360 flight.png ""
xvfb-run -a -s "-screen 0 1280x800x24" arete view dem.amt --contours 100 --haze 60 --camera 423055,5182625,3300msl,215,-12 \
  --size 1200x675 --window-frames 12 --window-screenshot window.png -q
python "$out/panels.py" "$out/window.png" 912x513 window.png ""
python "$out/tutorial_python.py" dem.amt python.png
python "$out/panels.py" "$out/tutorial-python.png" 512x400 python.png ""
if python -c "import qgis.core" 2>/dev/null; then
  python "$out/tutorial_qgis.py" dem.amt qgis.png
  python "$out/panels.py" "$out/tutorial-qgis.png" 512x320 qgis.png ""
fi
if command -v blender >/dev/null; then
  blender -b --python-exit-code 1 -P "$out/tutorial_blender.py" -- dem.glb blender.png >blender.log
  python "$out/panels.py" "$out/tutorial-blender.png" 480x300 blender.png ""
fi
