# SPDX-License-Identifier: GPL-3.0-or-later
"""A QGIS plugin that offers the commands of arete as Processing algorithms."""


def classFactory(interface):
    from .plugin import Plugin

    return Plugin()
