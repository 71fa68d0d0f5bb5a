# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments as the module takes them; what does not fit is an error that names the argument."""

import math
import numbers
import os
import warnings
from typing import Any, Iterable, List, Optional, Tuple

from ._warning import AreteWarning


def number(name: str, value: Any, least: float = -math.inf, most: float = math.inf) -> Optional[float]:
    """A finite number; None for None."""
    if value is None:
        return None
    if isinstance(value, bool) or not (isinstance(value, numbers.Real) or (hasattr(value, "ndim") and value.ndim == 0)):
        raise TypeError(f"{name}={value!r} is no number")
    real = float(value)
    if not math.isfinite(real) or not least <= real <= most:
        raise ValueError(f"{name}={value!r} is not {_between(least, most)}")
    return real


def whole(name: str, value: Any, least: int, most: int) -> Optional[int]:
    """A whole number; None for None. 5e4 is one."""
    real = number(name, value)
    if real is None:
        return None
    if real != int(real):
        raise ValueError(f"{name}={value!r} is no whole number")
    if not least <= int(value) <= most:
        raise ValueError(f"{name}={value!r} is not {_between(least, most)}")
    return int(value)


def word(name: str, value: Any, words: Iterable[str]) -> Any:
    """One of some words, or None."""
    known = list(words)
    if value is not None and value not in known:
        raise ValueError(f"{name}={value!r} is not one of {', '.join(known)}")
    return value


def numbers_of(what: str, values: Any, count: int) -> Tuple[float, ...]:
    """So many finite numbers."""
    try:
        found = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        raise TypeError(f"{what} is {count} numbers, not {values!r}") from None
    if len(found) != count or not all(math.isfinite(one) for one in found):
        raise ValueError(f"{what} is {count} numbers, not {values!r}")
    return found


def size_text(name: str, value: Any) -> str:
    """A length, or a percentage as text ("5%"), as the library parses it; "" for None."""
    if value is None:
        return ""
    if isinstance(value, str):
        if not value.strip().endswith("%"):
            raise TypeError(f"{name}={value!r} is no number and no percentage (\"1%\")")
        return value.strip()
    real = number(name, value, 0)
    return repr(real)


def packing_of(path: str, packed: bool, position_bits: Optional[int]) -> Optional[int]:
    """The bits of each coordinate of a packed glTF; None where it is not packed."""
    bits = whole("position_bits", position_bits, 8, 16)
    if not packed:
        if bits is not None:
            raise ValueError("position_bits is the grid of a packed file: packed=True")
        return None
    if not path.lower().endswith((".glb", ".gltf")):
        raise ValueError(f"packed is for glTF (.glb, .gltf), not for {path}")
    return 14 if bits is None else bits


def normals_of(normals: str, crease_angle: Optional[float]) -> Tuple[str, float]:
    """What becomes of normals, and the angle from which an edge is hard."""
    kind = str(word("normals", str(normals), ("keep", "flat", "smooth")))
    angle = number("crease_angle", crease_angle, 0, 180)
    if angle is not None and kind != "smooth":
        raise ValueError("crease_angle is for normals=\"smooth\"")
    return kind, 45.0 if angle is None else angle


def names_of(names: Any) -> List[str]:
    """One name, or several."""
    return [names] if isinstance(names, str) else [str(name) for name in names]


def is_path(source: Any) -> bool:
    return isinstance(source, (str, os.PathLike))


def files_of(paths: Iterable[str]) -> List[str]:
    """Those that are files now, by names that hold wherever the process goes."""
    return [os.path.abspath(path) for path in paths if path and os.path.exists(path)]


def refuse_source(path: str, sources: Iterable[str]) -> None:
    """An output that is one of the files that it is made from, by whatever name or link, would destroy it."""
    for source in sources:
        if _is_same(path, source):
            raise ValueError(f"{path}: is the source {source}; writing would destroy it")


def refuse_output(path: str, others: Iterable[str]) -> None:
    """An output that is another one of the same call would be lost."""
    if any(_is_same(path, other) for other in others):
        raise ValueError(f"{path}: is written already, as another output of this call")


def _is_same(path: str, other: str) -> bool:
    return os.path.abspath(path) == other or (os.path.exists(path) and os.path.exists(other) and os.path.samefile(path, other))


def refuse_other_than_amt(path: str) -> None:
    """A model has one format, whose name says it."""
    extension = os.path.splitext(path)[1]
    if extension.lower() != ".amt":
        stated = f", not {extension}; the save() of a cut writes other formats" if extension else f", as {path}.amt"
        raise ValueError(f"{path}: the name of a model must end in .amt{stated}")


def warn(sentence: str, code: str, stacklevel: int = 3) -> None:
    """A warning of the line that called the function that calls this."""
    warnings.warn(AreteWarning(sentence, code), stacklevel=stacklevel)


def _between(least: float, most: float) -> str:
    if math.isinf(most):
        return "finite" if math.isinf(least) else f"at least {least:g}"
    return f"between {least:g} and {most:g}"
