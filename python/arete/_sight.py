# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers about what is seen: lines of sight, profiles, viewsheds."""

from typing import Any, Callable, Dict, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray


class _SightAnswer(NamedTuple):
    verdict: Any
    clearance: Any
    distance: Any
    obstruction: Any


class Sight(_SightAnswer):
    """The answer of a line of sight, or arrays of answers: verdict, clearance, distance, obstruction.

    verdict: "visible", "blocked", "unknown" (NODATA is in the way) or "undecided" (within max_error).
    clearance: the least height of the line above the terrain, in the unit of heights; NaN where there is none below it.
    distance: metres along the ground.
    obstruction: x, y where the line is first blocked; None, in arrays NaN, where it is not.
    """

    azimuth: Any = None
    """Degrees clockwise from north, at the observer."""
    elevation: Any = None
    """Degrees of the target above the observer's horizontal, without refraction."""
    fresnel: Any = None
    """With a frequency: the least clearance as a part of the first Fresnel zone; NaN where there is none."""
    is_clear: Any = None
    """With a frequency: whether the part of the zone that must be clear is clear."""

    @property
    def visible(self) -> Any:
        return self.verdict == "visible"


class _ProfileVertices(NamedTuple):
    distance: NDArray[np.float64]
    places: NDArray[np.float64]
    height: NDArray[np.float64]
    part: NDArray[np.int64]
    length: float
    gap: float


class Profile(_ProfileVertices):
    """The terrain along a line: arrays by vertex. It is straight between vertices of one part; between parts there is
    none.

    distance: metres along the ground. places: (n, 2): x, y in the CRS of the source. height. part: counted from 1.
    length: of the line, in metres. gap: how much of the length has no terrain.
    """

    sight: Optional[Sight] = None
    """Of a line of sight: its answer."""
    line_height: Optional[NDArray[np.float64]] = None
    """Of a line of sight: its height above each vertex."""
    fresnel_radius: Optional[NDArray[np.float64]] = None
    """With a frequency: the radius of the first Fresnel zone there, in the unit of heights."""
    vertical_unit: str = ""
    is_metric: bool = True
    """False where the source has no CRS, whose distances are in its own unit."""

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws it with matplotlib; returns the axes. color: of the terrain."""
        from ._plot import plot_profile

        return plot_profile(self, ax, **options)

    def _repr_html_(self) -> str:
        from ._html import html_of_profile

        return html_of_profile(self)


_OUTSIDE = 65535
# What is no number of observers, of modes "count" and "server".
_MARKS = {0: "hidden", 65533: "unknown", 65534: "undecided", _OUTSIDE: "outside"}


class Viewshed(np.ndarray):  # type: ignore[type-arg]
    """What is seen, as an array on a grid that knows where it lies. A part of it, and what is computed of it, is a plain
    array."""

    answers: Dict[int, str] = {255: "seen", 0: "hidden", 100: "unknown", 200: "undecided", 1: "outside"}
    """What a number means: of the class in mode "seen", of a viewshed in its own mode. Other numbers of "count" are how many
    observers see it, of "server" which one, from 1. "height" and "horizon" are numbers: NaN is unknown or outside."""
    mode: str = ""
    transform: Optional[Tuple[float, ...]] = None
    """GDAL's six numbers; None where the source has no position."""
    crs: Optional[str] = None
    observers: Sequence[Tuple[float, float]] = ()
    vertical_unit: str = ""

    @classmethod
    def of(cls, cells: NDArray[Any], mode: str, transform: Optional[Tuple[float, ...]], crs: Optional[str],
           observers: Sequence[Tuple[float, float]], vertical_unit: str) -> "Viewshed":
        """A viewshed of its cells, its mode and its place: how it is copied and pickled."""
        made = cells.view(cls)
        made.mode, made.transform, made.crs = mode, transform, crs
        made.answers = dict({"seen": cls.answers, "count": _MARKS, "server": _MARKS}.get(mode, {}))
        made.observers, made.vertical_unit = tuple(observers), vertical_unit
        return made

    @property
    def label(self) -> str:
        """What the numbers are."""
        unit = f" ({self.vertical_unit})" if self.vertical_unit else ""
        return {"seen": "seen", "height": f"least height that is seen{unit}", "horizon": "horizon (degrees)",
                "count": "observers that see it", "server": "nearest observer that sees it"}.get(self.mode, "")

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws it with matplotlib, with a colour bar that names the answers; returns the axes. cmap, colorbar."""
        from ._plot import plot_viewshed

        self._refuse_part()
        return plot_viewshed(self, ax, **options)

    def to_xarray(self) -> Any:
        """An xarray.DataArray with the middles of pixels, the CRS, and of modes "seen", "count" and "server" the
        answers as flags by their names, of the last two 65535 (outside) as _FillValue."""
        import xarray

        self._refuse_part()
        rows, columns = self.shape
        x0, dx, rx, y0, ry, dy = self.transform or (0, 1, 0, rows, 0, -1)
        if rx or ry:
            raise ValueError("the grid is not along x and y")
        array = xarray.DataArray(np.array(self), dims=("y", "x"), name=self.mode, coords={
            "y": y0 + dy * (np.arange(rows) + 0.5), "x": x0 + dx * (np.arange(columns) + 0.5)})
        if self.crs:
            array.attrs["crs"] = self.crs
        if self.answers:
            array.attrs.update(flag_values=np.array(list(self.answers), dtype=self.dtype),
                               flag_meanings=" ".join(self.answers.values()))
        if self.mode in ("count", "server"):
            array.attrs["_FillValue"] = self.dtype.type(_OUTSIDE)
        return array

    def _repr_html_(self) -> str:
        from ._html import html_of_viewshed

        return html_of_viewshed(self)

    def _refuse_part(self) -> None:
        if not self.mode or self.ndim != 2:
            raise ValueError("this is a part of a viewshed, or made of one: where it lies is not known")

    def __getitem__(self, key: Any) -> Any:
        return np.asarray(self)[key]

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        plain = np.asarray(array)
        return plain[()] if plain.ndim == 0 else plain

    def copy(self, order: Any = "C") -> "Viewshed":
        return Viewshed.of(np.array(self, order=order), self.mode, self.transform, self.crs, self.observers, self.vertical_unit)

    def __copy__(self) -> "Viewshed":
        return self.copy()

    def __deepcopy__(self, memo: Any) -> "Viewshed":
        return self.copy()

    def __reduce__(self) -> Tuple[Callable[..., Any], Tuple[Any, ...]]:
        return Viewshed.of, (np.array(self), self.mode, self.transform, self.crs, self.observers, self.vertical_unit)


def sight_of(verdicts: Sequence[str], rows: NDArray[np.float64], is_one: bool, fresnel: Optional[float]) -> Sight:
    """Of the module's rows: clearance, distance, x and y of the obstruction, azimuth, elevation, Fresnel."""
    if is_one:
        clearance, distance, x, y, *others = (float(number) for number in rows[0])
        azimuth: Any = others[0]
        elevation: Any = others[1]
        zone: Any = others[2]
        answer = Sight(verdicts[0], clearance, distance, None if np.isnan(x) else (x, y))
    else:
        answer = Sight(np.array(verdicts, dtype=str), rows[:, 0].copy(), rows[:, 1].copy(), rows[:, 2:4].copy())
        azimuth, elevation, zone = rows[:, 4].copy(), rows[:, 5].copy(), rows[:, 6].copy()
    answer.azimuth, answer.elevation = azimuth, elevation
    if fresnel is not None:
        answer.fresnel = zone
        answer.is_clear = zone >= fresnel
    return answer
