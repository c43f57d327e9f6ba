"""The verb `fuzz`: worlds in which anything is called, in any order, under the sanitizers.

The worlds are those of tests/unit/test_any_calls_fixed_host.c, which plays 200 of them in every run of the tests.
"""

from __future__ import annotations

import json
import os
import re
import select
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from . import engine
from .terminal import JsonOption, bar

PROGRAM = "test_any_calls_fixed_host"
PRESETS = {"undefined": "host-clang", "memory": "host-memory"}
PATIENCE = 120.0  # seconds: a world takes a second at most
SAID = 12  # lines of what a failure says
TELLING = re.compile(r"runtime error:|ERROR: |WARNING: MemorySanitizer|:FAIL")

Sanitizer = Enum("Sanitizer", {name: name for name in PRESETS}, type=str)


@dataclass(frozen=True)
class Result:
    """So many worlds were sound, from the first seed on; failed is the seed of the one that was not."""

    first: int
    sound: int
    failed: int | None = None
    said: tuple[str, ...] = ()


def fuzz(
    worlds: Annotated[int, typer.Option(min=1, max=100_000_000, help="How many.")] = 2000,
    seed: Annotated[int, typer.Option(min=0, max=4_000_000_000, help="The first; the others follow it.")] = 100_000,
    sanitizer: Annotated[
        Sanitizer, typer.Option(help="Addresses and undefined behaviour, or memory that was never set.")
    ] = "undefined",
    as_json: JsonOption = False,
) -> None:
    """Call anything in any order in worlds at random, under the sanitizers; exit code 1 if one is unsound."""
    with bar("worlds") as tell:
        tell(0, worlds)
        result = play(program(sanitizer.value), seed, worlds, lambda done: tell(done, worlds))
    if as_json:
        print(json.dumps(asdict(result), indent=2))
    elif result.failed is None:
        print(f"{result.sound} worlds from seed {seed} on are sound")
    else:
        print(f"world {result.failed} fails:")
        print("\n".join(f"  {line}" for line in result.said))
        chosen = "" if sanitizer.value == "undefined" else f" --sanitizer {sanitizer.value}"
        print(f"again: tools/cairn fuzz --worlds 1 --seed {result.failed}{chosen}")
    if result.failed is not None:
        raise typer.Exit(1)


def program(sanitizer: str) -> Path:
    """The test's program, built where it is not up to date."""
    preset = PRESETS[sanitizer]
    place = engine.build_target(preset, PROGRAM, f"{preset}-fuzz", ["-DCAIRN_BUILD_TESTS=ON"])
    return place / "tests" / PROGRAM


def play(program: Path, first: int, worlds: int, tell: Callable[[int], None]) -> Result:
    """Plays so many worlds, up to one that fails or does not end."""
    wish = {"CAIRN_FUZZ_SEED": str(first), "CAIRN_FUZZ_WORLDS": str(worlds), "UBSAN_OPTIONS": "print_stacktrace=1"}
    played, said = first - 1, []
    with subprocess.Popen(
        [str(program)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, **wish}
    ) as process:
        try:
            for line in _lines(process):
                if line.startswith("world "):
                    played = int(line.removeprefix("world "))
                    tell(played - first)
                else:
                    said.append(line)
        except TimeoutError as error:
            said.append(str(error))
        except BaseException:
            process.kill()
            raise
    if process.returncode == 0:
        return Result(first, worlds)
    if played < first:
        raise engine.EngineError(f"{program.name} ends before its first world: {' '.join(said)[:200]}")
    return Result(first, played - first, played, _telling(said))


def _lines(process: subprocess.Popen[bytes]) -> Iterator[str]:
    """What the program says, line by line; a program that says nothing for too long is ended."""
    assert process.stdout is not None
    rest = b""
    while True:
        if not select.select([process.stdout], [], [], PATIENCE)[0]:
            process.kill()
            raise TimeoutError(f"does not end within {PATIENCE:g} s")
        got = os.read(process.stdout.fileno(), 1 << 16)
        if not got:
            break
        *lines, rest = (rest + got).split(b"\n")
        yield from (line.decode(errors="replace") for line in lines)
    if rest:
        yield rest.decode(errors="replace")


def _telling(said: list[str]) -> tuple[str, ...]:
    """From where the sanitizer or the test says what is wrong; all of it where neither does."""
    lines = [line for line in said if line.strip()]
    start = next((i for i, line in enumerate(lines) if TELLING.search(line)), 0)
    return tuple(lines[start : start + SAID])
