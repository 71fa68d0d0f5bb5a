# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain and surfaces at every level of detail.

    import arete
    model = arete.build("dem.tif")          # or a numpy array
    tin = model.cut(max_error=2)            # no sample is farther than 2 from it
    tin.vertices, tin.triangles, tin.error
    model.save("dem.amt"); model = arete.open("dem.amt")
"""

from ._model import Model, Sight, Surface, Tin, build, open

__all__ = ["Model", "Sight", "Surface", "Tin", "build", "open"]
