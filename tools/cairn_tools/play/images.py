"""The images of the games: built where they are not up to date, and run with their words (examples/shell/shell.h)."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from .. import engine
from ..errors import UserError

# The names that a person gives, and what CMake calls their images.
GAMES = {"cairn": "game-cairn", "pinball": "game-pinball", "platformer": "game-hop", "show": "game-show"}
CONSOLE = "lm3s6965evb"
BOARDS = (CONSOLE, "host")
OTHERS = ("rp2040",)  # without a display
SCRIPT = "input.txt"  # as the image sees it: its words have no blanks and are short
KEEP = "keep"
BAD_CALL = 2
FRAMES_A_MINUTE = 3600

Which = Callable[[str], str | None]


@dataclass(frozen=True)
class Image:
    """A game, linked for a board."""

    game: str
    board: str
    path: Path


@dataclass(frozen=True)
class Play:
    """What an image is asked to do: all of it decides how the game goes, but for the seed without a number."""

    frames: int
    script: Path | None = None
    seed: int = 1
    keep: Path | None = None  # where a game is resumed from; the file stays as it is


def known_game(name: str) -> str:
    if name not in GAMES:
        raise UserError(f"no game {name!r}; there are {', '.join(GAMES)}")
    return name


def need_qemu(which: Which = shutil.which) -> None:
    if which("qemu-system-arm") is None:
        raise UserError("qemu-system-arm is not installed: run tools/setup, or play with --board host")


def build(game: str, board: str) -> Image:
    """The image of a game for a board, or for the host without a window."""
    if board == "host":
        return Image(game, board, engine.build_target("host", GAMES[game]) / "examples" / GAMES[game])
    preset, own, options = engine.CORES[board].preset, "", []
    if board in OTHERS:
        own, options = board, [f"-DCAIRN_BOARD={board}"]
    else:
        need_qemu()
    folder = engine.build_target(preset, GAMES[game], own, options)
    return Image(game, board, folder / "examples" / f"{GAMES[game]}.elf")


def run(image: Image, play: Play, words: Sequence[str] = ()) -> str:
    """What the image prints until it ends. The script's own mistakes are the user's."""
    with workplace(play) as (place, own):
        given = [f"frames={play.frames}", *own, *words]
        line = command(image, given, ["--timeout", str(120 + play.frames)])
        nothing = subprocess.DEVNULL
        done = subprocess.run(line, cwd=place, stdin=nothing, capture_output=True, text=True, check=False)
    if done.returncode == BAD_CALL and play.script:
        raise UserError(script_trouble(done.stdout, play.script))
    if done.returncode != 0:
        last = ((done.stderr + done.stdout).strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        raise engine.EngineError(f"{image.game} on {image.board}: {last}")
    return done.stdout


def command(image: Image, words: Sequence[str], options: Sequence[str] = ()) -> list[str]:
    """The command line: the program itself, or its emulator's runner in tools with the options."""
    if image.board == "host":
        return [str(image.path), *words]
    if image.board in OTHERS:
        return [str(engine.ROOT / "tools" / "rp2040-run"), *options, str(image.path), *words]
    runner = [sys.executable, str(engine.ROOT / "tools" / "qemu-run"), *options]
    return [*runner, image.board, str(image.path), *words]


def qemu(image: Image, words: Sequence[str], display: str, socket: Path) -> list[str]:
    """QEMU's own command line for an image in real time, with a display and a socket for cairn_tools.play.qmp."""
    of_qemu = ("-display", display, "-qmp", f"unix:{socket},server=on,wait=off")
    options = ["--print", "--no-icount", *(f"--qemu={word}" for word in of_qemu)]
    done = subprocess.run(command(image, words, options), capture_output=True, text=True, check=True)
    return shlex.split(done.stdout)


@contextmanager
def workplace(play: Play) -> Iterator[tuple[Path, list[str]]]:
    """A folder for the image to read and write in, with the play's files under short names, and the words for them."""
    with tempfile.TemporaryDirectory(prefix="cairn-play-") as folder:
        words = [f"seed={play.seed}"]
        if play.script:
            _copy(play.script, Path(folder) / SCRIPT)
            words.append(f"input={SCRIPT}")
        if play.keep:
            _copy(play.keep, Path(folder) / KEEP)
            words.append(f"keep={KEEP}")
        yield Path(folder), words


def _copy(source: Path, to: Path) -> None:
    try:
        shutil.copyfile(source, to)
    except OSError as error:
        raise UserError(f"{source}: {os.strerror(error.errno or 0)}") from error


def script_trouble(output: str, script: Path) -> str:
    """The image's one line about a script, with the name that the user gave it."""
    last = (output.strip().splitlines() or ["refused"])[-1]
    return f"{script}{last.partition(SCRIPT)[2]}" if SCRIPT in last else last
