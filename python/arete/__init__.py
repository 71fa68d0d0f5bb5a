# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain and surfaces at every level of detail, each with its error.

    import arete
    model = arete.build("dem.tif")          # or an array, what to_xarray() gives, a dataset of rasterio
    tin = model.cut(max_error=2)            # no sample is farther than 2 from it
    tin.vertices, tin.triangles, tin.error
    tin.plot(); tin.save("tin.glb", certificate=True)
    model.save("dem.amt"); model = arete.open_model("dem.amt")

Functions

    build, build_points        a Model of a DEM; of points
    build_surface              a Surface of a triangle mesh
    open_model, open_surface   of an .amt file; open() takes either
    measure                    a mesh against a DEM or a mesh
    mesh_info, repair, decimate   meshes of files and arrays

Classes; help(arete.Model) and so on say the rest

    Model     cut, height, los, profile, viewshed, measure, curve, info, validate, plot, to_xarray, save
    Surface   cut, measure, curve, info, validate, plot, save
    Tin       vertices, triangles, errors, error, plot, slopes, save, to_geopandas, to_trimesh, to_pyvista, to_meshio
    Mesh      of repair() and decimate(): the same without errors, and report
    Camera, SurfaceCamera, Sight, Profile, Viewshed, Curve, AreteWarning

docs/topics/python.md has examples.
"""

# Without __all__, so that help(arete) is this page, and not all classes behind it.
from ._build import build as build
from ._build import build_points as build_points
from ._curve import Curve as Curve
from ._cuts import Camera as Camera
from ._cuts import SurfaceCamera as SurfaceCamera
from ._cuts import Tin as Tin
from ._files import open as open
from ._files import open_model as open_model
from ._files import open_surface as open_surface
from ._measure import measure as measure
from ._mesh import Mesh as Mesh
from ._model import Model as Model
from ._repair import decimate as decimate
from ._repair import mesh_info as mesh_info
from ._repair import repair as repair
from ._sight import Profile as Profile
from ._sight import Sight as Sight
from ._sight import Viewshed as Viewshed
from ._surface import Surface as Surface
from ._surface import build_surface as build_surface
from ._warning import AreteWarning as AreteWarning
