# SPDX-License-Identifier: GPL-3.0-or-later
"""blender -b -P tutorial_blender.py -- TERRAIN.glb OUT.png: a GLB of a terrain in Blender, with a sun and a camera."""
import math
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian's Blender 3.4 reads this name, which Debian's numpy 1.24 has no more
terrain, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=terrain)
ground = next(o for o in bpy.context.scene.objects if o.type == "MESH")
corners = [ground.matrix_world @ Vector(c) for c in ground.bound_box]
middle = sum(corners, Vector()) / 8
size = max((a - b).length for a in corners for b in corners)
print(f"{len(ground.data.polygons)} triangles, {size:.0f} m across")

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = 2
sun.rotation_euler = (math.radians(62), 0, math.radians(60))
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.clip_end = 10 * size  # the default hides everything beyond 1 km
camera.data.lens = 45
camera.location = middle + size * Vector((-0.25, -0.62, 0.42))
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
for thing in (sun, camera):
    bpy.context.scene.collection.objects.link(thing)

scene = bpy.context.scene
scene.camera = camera
scene.world = bpy.data.worlds.new("sky")
scene.world.color = (0.12, 0.15, 0.2)
scene.view_settings.view_transform = "Standard"
scene.render.engine = "CYCLES"
scene.cycles.samples = 32
scene.cycles.use_denoising = False  # Debian builds Blender without it
scene.render.resolution_x, scene.render.resolution_y = 640, 400
scene.render.filepath = out if out.startswith("/") else f"{__import__('os').getcwd()}/{out}"
bpy.ops.render.render(write_still=True)
