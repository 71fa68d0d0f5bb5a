# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings, with a code that programs can tell apart."""


class AreteWarning(UserWarning):
    """Something is not as one may believe, though the work goes on.

    code: what it is about: "position", "unit", "heights", "choice", "omitted", "completed", "geometry",
    "damaged", "bound", "library" or "display". Sentences may change, codes stay.
    """

    def __init__(self, sentence: str, code: str):
        super().__init__(sentence)
        self.code = code
