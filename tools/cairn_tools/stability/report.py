"""Results as a table for people and as records for programs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import groupby
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .cases import CASES
from .model import Figure, Result

OTHER_SOLVERS = {"slides": "the slides' scheme", "small": "the small solver"}
# From metres and kin to what reads well; the least figure that is shown in a unit.
_SMALLER = {"m": ("mm", 1e3), "m/s": ("mm/s", 1e3)}


def shown(value: float, unit: str) -> str:
    if unit in _SMALLER and abs(value) < 0.1:
        unit, factor = _SMALLER[unit]
        value *= factor
    if unit == "%":
        value *= 100
    return f"{value:.4g}{'' if unit == '%' else ' ' if unit else ''}{unit}"


def _text(figure: Figure) -> str:
    """The figure and its target; what falls short in red, and with a sign for those who see no colour."""
    text = f"{figure.what} {shown(figure.value, figure.unit)} {'>=' if figure.least else '<='} "
    text += shown(figure.limit, figure.unit)
    if figure.stretch:
        return f"({text})" if figure.ok else f"[yellow](! {text})[/]"
    return text if figure.ok else f"[red]! {text}[/]"


def verdict(result: Result) -> str:
    if result.error:
        return "[red]breaks"
    if result.ok and all(figure.stretch and not figure.ok for figure in result.figures):
        return "[yellow]stretch: open"
    if result.ok:
        return "[green]holds"
    return "[red]falls short" if result.decides else "[yellow]falls"


def table(results: list[Result]) -> Table:
    grid = Table(
        title="Stiff and extreme cases",
        caption="! short of its target; in brackets: a stretch target, which does not decide",
        box=SIMPLE_HEAD,
    )
    grid.add_column("case", no_wrap=True)
    grid.add_column("engine", no_wrap=True)
    grid.add_column("verdict", no_wrap=True)
    grid.add_column("figures and targets")
    grid.add_column("other engines")
    grid.add_column("s", justify="right", no_wrap=True)
    for result in results:
        engine = result.engine if result.decides else f"{result.engine} {result.solver}"
        figures = "; ".join(
            [*map(_text, result.figures), *([f"[red]{escape(result.error)}[/]"] if result.error else [])]
        )
        grid.add_row(result.case, engine, verdict(result), figures, CASES[result.case].peers, f"{result.seconds:.1f}")
    return grid


def record(result: Result) -> dict[str, Any]:
    entry = CASES[result.case]
    figures = [{**asdict(figure), "value": _json(figure.value), "ok": figure.ok} for figure in result.figures]
    return {
        "case": result.case,
        "row": entry.row,
        "engine": result.engine,
        "solver": result.solver,
        "ok": result.ok,
        "decides": result.decides,
        "figures": figures,
        "error": result.error,
        "other_engines": entry.peers,
        "seconds": round(result.seconds, 3),
    }


def _json(value: float) -> float | str:
    """JSON has no infinity and no NaN."""
    return value if abs(value) < float("inf") else str(value)


def _is_stretch(result: Result) -> bool:
    """A row of stretch targets alone neither holds nor falls short."""
    return not result.error and all(figure.stretch for figure in result.figures)


def counts(results: list[Result]) -> tuple[int, int]:
    """How many of the deciding rows hold, and how many there are."""
    deciding = [result for result in results if result.decides and not _is_stretch(result)]
    return sum(result.ok for result in deciding), len(deciding)


def closing(results: list[Result]) -> str:
    """One line: how many of the deciding rows hold."""
    held, deciding = counts(results)
    line = f"{held} of {deciding} rows hold"
    for solver, name in OTHER_SOLVERS.items():
        own = [result for result in results if result.solver == solver]
        line += f"; under {name} {sum(not result.ok for result in own)} of {len(own)} fall" if own else ""
    return line


def show(results: list[Result], console: Console) -> None:
    # Into a file there is no width to keep to.
    wide = console if console.is_terminal else Console(width=180)
    wide.print(table(results))
    wide.print(closing(results))


# The headings of the page, by the file that holds the cases.
HEADINGS = {
    "scenes": "Scenes of the slides and of examples/scenes",
    "stands": "Standing",
    "heavy": "Masses and impacts",
    "springs": "Springs",
    "motion": "Motion",
    "fast": "Fast bodies",
    "mess": "Disorder and extreme settings",
}


@dataclass(frozen=True)
class Line:
    """A case, its verdict in fixed point and in double, and the figures of both."""

    heading: str
    case: str
    q16: str
    f64: str
    figures: str  # what falls short is between **
    peers: str


def lines(results: list[Result]) -> Iterator[Line]:
    """One line a case, under the headings in turn; of the engine's own solver."""
    soft = [result for result in results if result.decides]
    for file, heading in HEADINGS.items():
        names = dict.fromkeys(r.case for r in soft if CASES[r.case].check.__module__.endswith(f".{file}"))
        for name in names:
            by_engine = {result.engine: result for result in soft if result.case == name}
            verdicts = [_plain(by_engine[engine]) if engine in by_engine else "" for engine in ("q16", "f64")]
            yield Line(heading, name, *verdicts, _figures(by_engine), CASES[name].peers)


def markdown(results: list[Result]) -> str:
    """The results as docs/STABILITY.md has them."""
    text: list[str] = []
    for heading, own in groupby(lines(results), key=lambda line: line.heading):
        text += [f"### {heading}", "", "| case | q16 | f64 | figures in q16 (f64) |", "| --- | --- | --- | --- |"]
        text += [f"| `{line.case}` | {_bold(line.q16)} | {_bold(line.f64)} | {line.figures} |" for line in own]
        text.append("")
    return "\n".join([*text, closing(results)])


def _bold(verdict: str) -> str:
    return f"**{verdict}**" if verdict == "short" else verdict


def _plain(result: Result) -> str:
    if _is_stretch(result) and not all(figure.ok for figure in result.figures):
        return "stretch: open"
    return "holds" if result.ok else "short"


def _figures(by_engine: dict[str, Result]) -> str:
    first = by_engine.get("q16") or next(iter(by_engine.values()))
    if first.error:
        return first.error
    others = {figure.what: figure for figure in by_engine["f64"].figures} if "f64" in by_engine else {}
    texts = []
    for figure in first.figures:
        other = others.get(figure.what)
        beside = f" ({shown(other.value, other.unit)})" if other and first.engine == "q16" else ""
        limit = f"{'≥' if figure.least else '≤'} {shown(figure.limit, figure.unit)}"
        text = f"{figure.what} {shown(figure.value, figure.unit)}{beside} {limit}"
        text = text if figure.ok else f"**{text}**"
        texts.append(f"[{text}]" if figure.stretch else text)
    return "; ".join(texts)
