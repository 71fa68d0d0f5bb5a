# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of the library, which are JSON with names in camel case, as dictionaries with Python's names."""

import json
import re
from typing import Any, Dict


def report_of(text: str) -> Dict[str, Any]:
    """The report, with keys like max_error."""
    report = _renamed(json.loads(text))
    assert isinstance(report, dict)
    return report


def _renamed(value: Any) -> Any:
    if isinstance(value, dict):
        return {re.sub(r"(?<=[a-z0-9])([A-Z])", lambda found: "_" + str(found[1]).lower(), key): _renamed(one)
                for key, one in value.items()}
    return [_renamed(one) for one in value] if isinstance(value, list) else value
