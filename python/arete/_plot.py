# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by matplotlib. The ramps of colours grow lighter, or darker, from one end to the other."""

from typing import Any, Dict, Optional, Sequence, Tuple

import numpy as np

from ._slopes import aspect_of, slopes_of

RAMPS = {"height": "viridis", "error": "magma_r", "slope": "cividis"}
_MOST_IN_SPACE = 50_000
"""Triangles that matplotlib still draws in space."""


def new_axes(ax: Any, in_space: bool = False) -> Any:
    if ax is not None:
        if not hasattr(ax, "add_patch"):
            raise TypeError(f"ax={ax!r} is no axes of matplotlib")
        return ax
    from matplotlib import pyplot

    return pyplot.figure().add_subplot(projection="3d" if in_space else None)


def is_geographic(crs: Optional[str]) -> bool:
    text = (crs or "").lstrip().upper()
    if text.startswith("COMPOUND") or text.startswith("COMPD_CS"):
        text = text[text.find("[", text.find("[") + 1) - 12:]
        return "GEOG" in text[:12] or "GEODCRS" in text[:12]
    return text.startswith("GEOG") or text.startswith("GEODCRS")


def values_of(mesh: Any, by: str) -> Tuple[Any, str]:
    """By triangle, or of heights by vertex, and what they are."""
    unit = f" ({mesh.vertical_unit})" if mesh.vertical_unit else ""
    if by == "height":
        return np.array(mesh.vertices[:, 2]), f"height{unit}"
    if by == "slope":
        return slopes_of(mesh), "slope (degrees)"
    if by == "error":
        if not hasattr(mesh, "errors"):
            raise ValueError("by=\"error\": the mesh has no errors")
        return np.array(mesh.errors, dtype=np.float64), f"error{unit}"
    raise ValueError(f"by={by!r} is not one of {', '.join(RAMPS)}")


def plot_mesh(mesh: Any, by: str, ax: Any = None, cmap: Any = None, vmin: Optional[float] = None, vmax: Optional[float] = None,
              edges: Optional[bool] = None, colorbar: bool = True, title: Optional[str] = None) -> Any:
    values, label = values_of(mesh, by)
    if len(mesh.triangles) == 0:
        raise ValueError("there is no triangle to draw")
    draw = _draw_in_space if len(mesh.source_vertices) else _draw_map
    ax = new_axes(ax, in_space=draw is _draw_in_space)
    finite = values[np.isfinite(values)]
    least, most = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if by != "height":
        least = min(least, 0.0)
    drawn = draw(mesh, by, values, ax, cmap or RAMPS[by], least if vmin is None else vmin, most if vmax is None else vmax, edges)
    if colorbar:
        room = {"pad": 0.14, "shrink": 0.7} if draw is _draw_in_space else {}
        ax.figure.colorbar(drawn, ax=ax, label=label, **room)
    if title is not None:
        ax.set_title(title)
    return ax


def _draw_map(mesh: Any, by: str, values: Any, ax: Any, cmap: Any, vmin: float, vmax: float, edges: Optional[bool]) -> Any:
    x, y = np.array(mesh.vertices[:, 0]), np.array(mesh.vertices[:, 1])
    triangles = mesh.triangles.astype(np.int64)
    if by == "height":
        drawn = ax.tripcolor(x, y, triangles, values, shading="gouraud", cmap=cmap, vmin=vmin, vmax=vmax)
    else:
        drawn = ax.tripcolor(x, y, triangles, facecolors=values, cmap=cmap, vmin=vmin, vmax=vmax)
    if edges or (edges is None and len(triangles) <= 3000):
        ax.triplot(x, y, triangles, color="black", linewidth=0.2, alpha=0.5)
    label_map(ax, mesh.crs, (float(x.min() + x.max()) / 2, float(y.min() + y.max()) / 2))
    return drawn


def _draw_in_space(mesh: Any, by: str, values: Any, ax: Any, cmap: Any, vmin: float, vmax: float, edges: Optional[bool]) -> Any:
    from matplotlib import cm, colors, ticker
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    if len(mesh.triangles) > _MOST_IN_SPACE:
        raise ValueError(f"{len(mesh.triangles)} triangles are more than the {_MOST_IN_SPACE} that are drawn in space: plot a "
                         "coarser cut, or to_pyvista()")
    if not hasattr(ax, "set_zlim"):
        raise ValueError("a surface needs axes with projection=\"3d\"")
    corners = np.array(mesh.vertices)[mesh.triangles]
    by_triangle = values[mesh.triangles].mean(axis=1) if by == "height" else values
    ramp = cm.ScalarMappable(colors.Normalize(vmin, vmax), cmap)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    # Light from above, beside and in front, so that the shape is seen too.
    light = np.abs((normals / np.where(lengths > 0, lengths, 1)) @ (np.array([2.0, -3.0, 6.0]) / 7))
    shaded = ramp.to_rgba(by_triangle)
    shaded[:, :3] *= (0.45 + 0.55 * light)[:, np.newaxis]
    ax.add_collection3d(Poly3DCollection(corners, facecolors=shaded, edgecolors=(0, 0, 0, 0.4) if edges else shaded,
                                         linewidths=0.2))
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    size = np.where(high > low, high - low, 1e-9)
    ax.set(xlim=(low[0], low[0] + size[0]), ylim=(low[1], low[1] + size[1]), zlim=(low[2], low[2] + size[2]),
           xlabel="x", ylabel="y", zlabel="z")
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_major_locator(ticker.MaxNLocator(4 if axis is not ax.zaxis else 2))
    ax.set_box_aspect(size)
    return ramp


def label_map(ax: Any, crs: Optional[str], middle: Tuple[float, float]) -> None:
    """The names of the axes, and lengths on the ground in the middle alike along both."""
    names = ("longitude", "latitude") if is_geographic(crs) else ("x", "y")
    ax.set(xlabel=names[0], ylabel=names[1])
    ax.set_aspect(aspect_of(crs or "", middle))
    ax.ticklabel_format(useOffset=False, style="plain")
    ax.locator_params(axis="x", nbins=4)


def plot_profile(profile: Any, ax: Any = None, color: Any = "saddlebrown") -> Any:
    ax = new_axes(ax)
    for part in np.unique(profile.part):
        of_part = profile.part == part
        ax.plot(profile.distance[of_part], profile.height[of_part], color=color, linewidth=1)
        ax.fill_between(profile.distance[of_part], profile.height[of_part], profile.height.min(), color=color, alpha=0.25)
    if profile.line_height is not None:
        ax.plot(profile.distance, profile.line_height, color="tab:blue", linewidth=1, label="line of sight")
        radius = profile.fresnel_radius
        if radius is not None:
            ax.fill_between(profile.distance, profile.line_height - radius, profile.line_height + radius, color="tab:blue",
                            alpha=0.2, label="first Fresnel zone")
        ax.legend()
        ax.set_title(profile.sight.verdict)
    unit = f" ({profile.vertical_unit})" if profile.vertical_unit else ""
    ax.set(xlabel="distance (m)" if profile.is_metric else "distance", ylabel=f"height{unit}", xlim=(0, profile.length))
    return ax


def plot_viewshed(viewshed: Any, ax: Any = None, cmap: Any = None, colorbar: bool = True) -> Any:
    from matplotlib import colors, ticker

    ax = new_axes(ax)
    cells = np.asarray(viewshed)
    if viewshed.mode == "seen":
        values = [value for value in viewshed.answers if (cells == value).any()]
        shown = np.searchsorted(sorted(values), cells)
        ramp = colors.ListedColormap([_CELLS[value] for value in sorted(values)])
        drawn = _draw_grid(shown, viewshed, ax, cmap=ramp, vmin=-0.5, vmax=len(values) - 0.5)
        if colorbar:
            bar = ax.figure.colorbar(drawn, ax=ax, ticks=range(len(values)))
            bar.ax.set_yticklabels([viewshed.answers[value] for value in sorted(values)])
            bar.ax.tick_params(length=0)
    else:
        numbers = cells.astype(np.float64)
        if cells.dtype.kind == "u":
            numbers[cells >= 65533] = np.nan
        numbers[~np.isfinite(numbers)] = np.nan
        whole = cells.dtype.kind == "u" and bool(np.isfinite(numbers).any())
        drawn = _draw_grid(numbers, viewshed, ax, **_whole_colours(numbers, cmap) if whole else {"cmap": cmap or "viridis"})
        if colorbar:
            bar = ax.figure.colorbar(drawn, ax=ax, label=viewshed.label)
            if whole:
                bar.locator = ticker.MaxNLocator(nbins=10, integer=True)
                bar.minorticks_off()
                bar.update_ticks()
    for x, y in viewshed.observers:
        ax.plot(x, y, marker="^", color="red", markeredgecolor="white", markersize=7, linestyle="none")
    return ax


def _whole_colours(numbers: Any, cmap: Any) -> Dict[str, Any]:
    """A colour for each whole number from 0, as many as a reader tells apart."""
    from matplotlib import cm, colors

    most = int(np.nanmax(numbers))
    if most > 30:
        return {"cmap": cmap or "viridis", "vmin": 0, "vmax": most}
    ramp = cm.ScalarMappable(colors.Normalize(0, max(most, 1)), cmap or "viridis").to_rgba(np.arange(most + 1))
    return {"cmap": colors.ListedColormap(ramp), "vmin": -0.5, "vmax": most + 0.5}


_CELLS = {255: "#fde725", 0: "#3b3b6d", 100: "#b0b0b0", 200: "#e08214", 1: "#ffffff"}


def _draw_grid(values: Any, grid: Any, ax: Any, **options: Any) -> Any:
    rows, columns = values.shape
    x0, dx, rx, y0, ry, dy = grid.transform or (0, 1, 0, rows, 0, -1)
    if rx or ry:
        column, row = np.meshgrid(np.arange(columns + 1), np.arange(rows + 1))
        drawn = ax.pcolormesh(x0 + dx * column + rx * row, y0 + ry * column + dy * row, values, **options)
    else:
        drawn = ax.imshow(values, origin="upper", extent=(x0, x0 + columns * dx, y0 + rows * dy, y0), interpolation="nearest",
                          **options)
        ax.set(xlim=sorted((x0, x0 + columns * dx)), ylim=sorted((y0, y0 + rows * dy)))
    corners = [(x0 + dx * c + rx * r, y0 + ry * c + dy * r) for c, r in ((0, 0), (columns, rows))]
    label_map(ax, grid.crs, _middle(corners))
    return drawn


def _middle(corners: Sequence[Tuple[float, float]]) -> Tuple[float, float]:
    return ((corners[0][0] + corners[1][0]) / 2, (corners[0][1] + corners[1][1]) / 2)


def plot_curve(curve: Any, ax: Any = None) -> Any:
    ax = new_axes(ax)
    ax.plot(curve.max_error, curve.minimal, marker="o", markersize=3, label="minimal")
    ax.plot(curve.max_error, curve.saturated, marker="o", markersize=3, linestyle="--", label="saturated")
    ax.set(xscale="log", yscale="log", ylabel="triangles",
           xlabel=f"error ({curve.unit})" if curve.unit else "error")
    ax.legend()
    return ax
