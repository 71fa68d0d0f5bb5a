# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain and surfaces at every level of detail.

    import arete
    model = arete.build("dem.tif")          # or a numpy array
    tin = model.cut(max_error=2)            # no sample is farther than 2 from it
    tin.vertices, tin.triangles, tin.error
    model.save("dem.amt"); model = arete.open("dem.amt")
    surface = arete.build_surface("scan.ply")
"""

from ._cuts import Camera, SurfaceCamera, Tin
from ._files import open
from ._model import Model, Profile, Sight, build
from ._surface import Surface, build_surface
from ._warning import AreteWarning

__all__ = ["AreteWarning", "Camera", "Model", "Profile", "Sight", "Surface", "SurfaceCamera", "Tin", "build", "build_surface", "open"]
