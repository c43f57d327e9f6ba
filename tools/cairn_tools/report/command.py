"""The verb: runs all parts, writes the page and the record."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import engine
from ..sweep.measure import build
from . import page, runner, single, standing, wrong
from .model import Options, Part, Section, plain

PARTS: list[Part] = [
    single.PARTS["arithmetic"],
    single.PARTS["smooth"],
    wrong.ERRORS,
    wrong.ERROR_TIME,
    single.PARTS["integrators"],
    standing.STABILITY,
    standing.BENCH,
    standing.MEMORY,
    standing.SCENES,
]


@dataclass(frozen=True)
class Written:
    """Where the report is, and whether all of its parts could be measured."""

    page: Path
    record: Path
    tables: Path
    broke: list[str]


def write(folder: Path, options: Options, workers: int, tell: runner.Tell) -> Written:
    """Measures everything first: a report that was stopped leaves an earlier one as it was."""
    for preset in engine.ARITHMETICS.values():
        engine.host_library(preset)
    done = runner.run(PARTS, options, workers, tell)
    about = page.About(_version(), _commit(), build(), options.quick, options.peers)
    sections = [entry.section for entry in done]
    seconds = {entry.section.key: round(entry.seconds, 1) for entry in done}
    names = ("index.html", "report.json", "tables.md")
    got = Written(*(folder / name for name in names), [entry.section.finding for entry in done if entry.broke])
    got.page.write_text(page.html(sections, about), encoding="utf-8")
    got.tables.write_text(page.markdown(sections), encoding="utf-8")
    got.record.write_text(json.dumps(record(sections, about, seconds), indent=1) + "\n", encoding="utf-8")
    return got


def record(sections: list[Section], about: page.About, seconds: dict[str, float]) -> dict[str, Any]:
    """Every number of the page. What depends on the host's speed comes last, in a part of its own."""
    numbers = {
        section.key: {
            "title": section.title,
            "command": section.command,
            "finding": section.finding,
            "data": plain(section.data),
        }
        for section in sections
    }
    return {"about": plain(about), "sections": numbers, "host_times": {"seconds_of_processes": seconds}}


def _version() -> str:
    text = (engine.ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"project\(\s*cairn\s+VERSION\s+([\d.]+)", text, re.IGNORECASE)
    return found[1] if found else "of no version"


def _commit() -> str:
    """That of the clone; a + where files differ from it."""

    def git(*words: str) -> str:
        return subprocess.run(["git", "-C", engine.ROOT, *words], capture_output=True, text=True, check=False).stdout

    commit = git("rev-parse", "--short=12", "HEAD").strip()
    return (commit or "unknown") + ("+" if git("status", "--porcelain", "--untracked-files=no").strip() else "")
