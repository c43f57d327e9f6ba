"""A game for a person: QEMU's window or SDL's, and the script that is recorded on the way."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from .. import engine
from ..errors import UserError
from . import headless, images, qmp

FOLDER = "host-window"  # the host's build with a window
DISPLAYS = ("gtk", "sdl")
EVERY = 60  # frames between two hashes of a recorded play

Setup = Callable[[], None]


def need_screen(environment: Mapping[str, str] = os.environ) -> None:
    if not (environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY")):
        raise UserError("there is no screen to open a window on (DISPLAY is not set): play with --headless")


def install() -> None:
    """tools/setup --window; that it could not is seen by what is still missing."""
    subprocess.run([engine.ROOT / "tools" / "setup", "--window"], stdout=subprocess.DEVNULL, check=False)


def need_sdl(which: images.Which = shutil.which, setup: Setup = install) -> None:
    if which("sdl2-config") is None:
        setup()
    if which("sdl2-config") is None:
        raise UserError("SDL2 is missing: install libsdl2-dev, or play with --headless")


def qemu_displays() -> str:
    """What QEMU can show its display with."""
    done = subprocess.run(["qemu-system-arm", "-display", "help"], capture_output=True, text=True, check=False)
    return done.stdout


def qemu_display(ask: Callable[[], str] = qemu_displays, setup: Setup = install) -> str:
    """The kind of window that this QEMU can open."""
    for attempt in range(2):
        offered = ask().split()
        for kind in DISPLAYS:
            if kind in offered:
                return kind
        if attempt == 0:
            setup()
    raise UserError("QEMU has no window: install qemu-system-gui, or play with --board host or --headless")


def play(game: str, board: str, how: images.Play, record: bool) -> headless.Result:
    """Plays until the window is closed; gives what was recorded. A kept game is kept on while it is played."""
    need_screen()
    words = [f"seed={how.seed}", *(["record", f"every={EVERY}"] if record else [])]
    with tempfile.TemporaryDirectory(prefix="cairn-play-") as folder:
        place = Path(folder)
        cwd = place
        if how.keep:
            cwd = how.keep.parent
            words.append(f"keep={how.keep.name}")
        socket = None if board == "host" else place / "qmp"
        command = _on_host(game, words) if socket is None else _in_qemu(game, board, words, socket)
        return headless.parse(_watched(command, cwd, place / "output", socket))


def host_image(game: str) -> images.Image:
    """The game in a window of SDL's."""
    folder = engine.build_target("host", images.GAMES[game], FOLDER, ["-DCAIRN_WINDOW=ON"])
    return images.Image(game, "host", folder / "examples" / images.GAMES[game])


def _on_host(game: str, words: list[str]) -> list[str]:
    need_sdl()
    return images.command(host_image(game), words)


def _in_qemu(game: str, board: str, words: list[str], socket: Path) -> list[str]:
    images.need_qemu()
    return images.qemu(images.build(game, board), words, qemu_display(), socket)


def _watched(command: list[str], cwd: Path, output: Path, socket: Path | None) -> str:
    """Runs to the window's end, or until the person interrupts; a file takes the output, so nothing waits for it."""
    with output.open("w", encoding="utf-8") as file:
        process = subprocess.Popen(command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=file)
        try:
            if socket:
                with qmp.Console(socket) as console:
                    console.wake()
            code = process.wait()
        except KeyboardInterrupt:
            code = 0
        finally:
            process.terminate()
            process.wait()
    text = output.read_text(encoding="utf-8")
    if code != 0:
        last = (text.strip().splitlines() or [f"exit code {code}"])[-1]
        raise engine.EngineError(f"the game ended badly: {last}")
    return text
