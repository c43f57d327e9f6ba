"""Other architectures of a PC's kind, run by QEMU's user mode: where byte order or word size would show.

Needs `tools/setup --all`. There is no JSON library for them, so a scene is linked in as a table, as on a board.
"""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from . import engine
from .scene import Scene

FLAGS = ("-std=c99", "-O2")
FOLDERS = ("include", "ports/include", "examples/scene", "src", "tools/runner")
PARTS = (
    "examples/scene/scene.c", "tools/runner/runner.c", "tools/runner/target.c", "ports/host/port.c",
    "ports/common/print.c", "ports/common/no_display.c", "ports/common/no_buttons.c",
)  # fmt: skip


@dataclass(frozen=True)
class Architecture:
    """The prefix of its compiler, and its emulator."""

    prefix: str
    emulator: str


ARCHITECTURES = {"ppc": Architecture("powerpc-linux-gnu-", "qemu-ppc")}


def library(name: str, folder: Path) -> Path:
    """All but the scene, compiled afresh: it takes two seconds."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = [*sorted((engine.ROOT / "src").glob("*.c")), *(engine.ROOT / part for part in PARTS)]
    objects = [folder / f"{source.stem}-{source.parent.name}.o" for source in sources]
    for source, target in zip(sources, objects, strict=True):
        _compile(name, ["-c", str(source), "-o", str(target)])
    archive = folder / "cairn.a"
    archive.unlink(missing_ok=True)
    _call([f"{ARCHITECTURES[name].prefix}ar", "rcs", str(archive), *map(str, objects)])
    return archive


def command(name: str, archive: Path, loaded: Scene, title: str, steps: int) -> list[str]:
    """Links a scene; gives the command that runs it."""
    place = archive.parent / re.sub(r"[^A-Za-z0-9_-]", "_", title)
    table = place.with_suffix(".c")
    table.write_text(engine.table(loaded, "cairn_the_scene"), encoding="utf-8")
    _compile(name, ["-static", str(table), str(archive), "-o", str(place)])
    return [ARCHITECTURES[name].emulator, str(place), f"steps={steps}"]


def _compile(name: str, arguments: list[str]) -> None:
    folders = [f"-I{engine.ROOT / folder}" for folder in FOLDERS]
    _call([f"{ARCHITECTURES[name].prefix}gcc", *FLAGS, *folders, *arguments])


def _call(command: list[str]) -> None:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise engine.EngineError(f"{command[0]} is not installed; run tools/setup --all") from None
    if done.returncode != 0:
        raise engine.EngineError(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
