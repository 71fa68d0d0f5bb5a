# SPDX-License-Identifier: GPL-3.0-or-later
"""What Jupyter shows: a picture, where matplotlib is installed, and figures."""

import base64
import html
import io
from typing import Any, Callable, Dict


def html_of_mesh(mesh: Any) -> str:
    facts = {"triangles": f"{len(mesh.triangles):,}", "vertices": f"{len(mesh.vertices):,}"}
    if hasattr(mesh, "error"):
        facts["error"] = f"{mesh.error:g} {mesh.vertical_unit}".strip()
    return _html_of(type(mesh).__name__, facts, lambda ax: mesh.plot(ax=ax, edges=False), len(mesh.source_vertices) > 0)


def html_of_model(model: Any) -> str:
    info = model.info()
    facts = {"source": info["source"], "CRS": info["crs"], "triangles": f"{info['finest_triangles']:,} at the finest"}
    if "relief" in info:
        facts["samples"] = f"{info['samples']:,}"
        facts["relief"] = f"{info['relief']:g} {info['vertical_unit']}".strip()
    return _html_of(type(model).__name__, facts, lambda ax: model.plot(ax=ax, edges=False, max_triangles=5000),
                    info["kind"] == "surface")


def html_of_profile(profile: Any) -> str:
    facts = {"length": f"{profile.length:,.6g}", "without terrain": f"{profile.gap:,.6g}" if profile.gap else "",
             "line of sight": profile.sight.verdict if profile.sight else ""}
    return _html_of("Profile", facts, lambda ax: profile.plot(ax=ax), False)


def html_of_viewshed(viewshed: Any) -> str:
    if not viewshed.mode:
        return f"<pre>{html.escape(repr(viewshed))}</pre>"
    counts = {name: int((viewshed == value).sum()) for value, name in viewshed.answers.items()} if viewshed.mode == "seen" else {}
    facts = {name: f"{count:,}" for name, count in counts.items() if count}
    return _html_of("Viewshed", facts, lambda ax: viewshed.plot(ax=ax), False)


def _html_of(kind: str, facts: Dict[str, str], draw: Callable[[Any], Any], in_space: bool) -> str:
    rows = "".join(f"<tr><th style='text-align:left'>{html.escape(key)}</th><td style='text-align:left'>"
                   f"{html.escape(str(value))}</td></tr>" for key, value in facts.items() if value)
    return f"<div><b>arete.{kind}</b><table>{rows}</table>{_picture_of(draw, in_space)}</div>"


def _picture_of(draw: Callable[[Any], Any], in_space: bool) -> str:
    """Without pyplot, whose figures notebooks show by themselves."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(5, 3.6), dpi=100)
    FigureCanvasAgg(figure)
    try:
        draw(figure.add_subplot(projection="3d" if in_space else None))
    except (ValueError, RuntimeError):
        return ""  # there is nothing to draw
    out = io.BytesIO()
    figure.savefig(out, format="png", bbox_inches="tight")
    return f"<img alt='picture' src='data:image/png;base64,{base64.b64encode(out.getvalue()).decode()}'>"
