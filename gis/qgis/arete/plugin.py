# SPDX-License-Identifier: GPL-3.0-or-later
from qgis.core import QgsApplication

from .provider import Provider


class Plugin:
    """Adds the provider while the plugin is on."""

    def __init__(self):
        self.provider = None

    def initProcessing(self):
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        QgsApplication.processingRegistry().removeProvider(self.provider)
