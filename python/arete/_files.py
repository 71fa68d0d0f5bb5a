# SPDX-License-Identifier: GPL-3.0-or-later
"""Opening .amt files."""

import os
from typing import Union

from . import _arete
from ._cuts import PathLike, Progress
from ._model import Model
from ._surface import Surface


def open(path: PathLike, progress: Progress = None) -> Union[Model, Surface]:  # noqa: A001
    """Opens an .amt file, also by its address ("https://..."): a Model of terrain or a Surface.

    Of a file in pages (save(paged=True)) the root is read, and each question reads the pages that it needs, with the answers of
    the whole: cuts, and of terrain height(), profile(), los() and viewshed(). Fits, measure(), validate(), certificates, maps
    and rasters, curve(at=), save() and the source's grid need everything: the first of them reads the whole, which is kept.
    """
    name = os.fspath(path)
    # An address, also within a path of GDAL, is no path of this machine.
    if "://" not in name and not name.startswith("/vsi"):
        name = os.path.abspath(name)
    model = _arete.open_model(name, progress)
    return Surface(model, name) if isinstance(model, _arete.Surface) else Model(model, name)


def open_model(path: PathLike, progress: Progress = None) -> Model:
    """Opens an .amt file of terrain; one of a surface is a TypeError."""
    model = open(path, progress)
    if not isinstance(model, Model):
        raise TypeError(f"{os.fspath(path)}: holds a surface: arete.open_surface() opens it")
    return model


def open_surface(path: PathLike, progress: Progress = None) -> Surface:
    """Opens an .amt file of a surface; one of terrain is a TypeError."""
    model = open(path, progress)
    if not isinstance(model, Surface):
        raise TypeError(f"{os.fspath(path)}: holds terrain: arete.open_model() opens it")
    return model
