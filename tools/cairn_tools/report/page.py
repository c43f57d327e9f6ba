"""The page: sections in, one HTML file out that needs no other file."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup, escape

from .model import BAD, GOOD, OPEN, Cell, Section

# For those who see no colour.
SIGNS = {GOOD: "✓", BAD: "✗", OPEN: "○", "": ""}


@dataclass(frozen=True)
class About:
    """What was measured, and where it stands."""

    version: str
    commit: str
    build: str  # digest of the engine's sources
    quick: bool
    peers: bool


def html(sections: list[Section], about: About) -> str:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=select_autoescape(default=True, default_for_string=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["prose"] = prose
    environment.globals["cell_class"] = cell_class
    template = environment.get_template("page.html.j2")
    return template.render(sections=sections, about=about, signs=SIGNS)


def markdown(sections: list[Section]) -> str:
    """The tables alone, for documents."""
    lines: list[str] = []
    for section in sections:
        lines += [f"## {section.title}", "", f"    {section.command}", "", section.finding, ""]
        for grid in section.grids:
            rules = ["---:" if right else "---" for right in grid.right]
            rows = [grid.columns, rules, *([cell.text for cell in row] for row in grid.rows)]
            lines += [f"**{grid.title}**", ""] if grid.title else []
            lines += [f"| {' | '.join(row)} |" for row in rows]
            lines += ["", grid.caption, ""] if grid.caption else [""]
    return "\n".join(lines)


def prose(text: str) -> Markup:
    """Between two **: strong. Between two `: code."""
    safe = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", str(escape(text)))
    return Markup(re.sub(r"`(.+?)`", r"<code>\1</code>", safe))


def cell_class(cell: Cell, right: bool, wide: bool) -> str:
    return " ".join(name for name, on in (("n", right), ("w", wide), (cell.tone, bool(cell.tone))) if on)
