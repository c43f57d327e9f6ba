"""The verb `play`: for a person in a window, for a script without one, and its measurements."""

from __future__ import annotations

import json
import secrets
import sys
from dataclasses import asdict, dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from .. import engine
from ..errors import UserError
from ..terminal import JsonOption, folder, out, working, writable
from . import album as album_module
from . import budget as budget_module
from . import check as check_module
from . import headless, images, pictures, script, window


@dataclass(frozen=True)
class Wish:
    """The pictures asked for."""

    gif: Path | None
    png: Path | None
    stills: Path | None
    first: int
    every: int
    scale: int


Board = Enum("Board", {name: name for name in (*images.BOARDS, *images.OTHERS)}, type=str)
SEED = 1
FRAMES = 600  # without a script
SAVES = engine.ROOT / "build" / "play"  # where a person's games are kept


def play(
    game: Annotated[str, typer.Argument(help=f"One of {', '.join(images.GAMES)}.")] = "cairn",
    board: Annotated[Board, typer.Option(help="The emulated console, or this machine.")] = images.CONSOLE,
    without: Annotated[bool, typer.Option("--headless", help="No window: as fast as it goes, by a script.")] = False,
    frames: Annotated[int | None, typer.Option(min=1, max=1_000_000, help="With --headless: how many.")] = None,
    script_file: Annotated[Path | None, typer.Option("--input", metavar="SCRIPT", help="The buttons held.")] = None,
    seed: Annotated[int | None, typer.Option(min=0, max=2**31 - 1, help="Of the game's chance.")] = None,
    keep: Annotated[Path | None, typer.Option("--save", metavar="FILE", help="A kept game to go on with.")] = None,
    record: Annotated[Path | None, typer.Option(metavar="SCRIPT", help="Write what is pressed.")] = None,
    gif: Annotated[Path | None, typer.Option(help="With --headless: a film in real time.")] = None,
    png: Annotated[Path | None, typer.Option(help="With --headless: the last frame.")] = None,
    stills: Annotated[Path | None, typer.Option(metavar="DIR", help="With --headless: frames as PNG.")] = None,
    first: Annotated[int, typer.Option("--from", min=0, help="The first frame in pictures.")] = 0,
    every: Annotated[int, typer.Option(min=1, help="Each so many frames in pictures and hashes.")] = 3,
    scale: Annotated[int, typer.Option(min=1, max=16, help="Dots a pixel in pictures.")] = 4,
    budget: Annotated[bool, typer.Option("--budget", help="What frames cost on the console, RAM and flash.")] = False,
    check: Annotated[bool, typer.Option(help="One game on both boards; with --budget: hold it to its record.")] = False,
    put_down: Annotated[bool, typer.Option("--keep", help="With --budget: put it on record.")] = False,
    album: Annotated[Path | None, typer.Option(metavar="DIR", help="Draw the pictures of the docs.")] = None,
    as_json: JsonOption = False,
) -> None:
    """Play a game on the emulated console, or here; or have a script play it, for pictures and tests."""
    images.known_game(game)
    if put_down and not budget:
        raise UserError("--keep goes with --budget; a game is kept with --save FILE")
    if budget:
        budget_module.run(put_down, check, as_json)
        return
    if album:
        with working("pictures") as say:
            album_module.draw(folder(album), board.value, say)
        return
    if check:
        check_module.run(game, frames or check_module.FRAMES, as_json)
        return
    pictured = {"--gif": gif, "--png": png, "--stills": stills}
    for name, given in {"--frames": frames, "--input": script_file, **pictured}.items():
        if given is not None and not without:
            raise UserError(f"{name} goes with --headless")
    if not without and board.value in images.OTHERS:
        raise UserError(f"{board.value} has no display: play with --headless")
    if record and without:
        raise UserError("--record is for a window: a script is recorded by playing")
    if without:
        how = _asked(script_file, frames, seed, keep)
        _headless(game, board.value, how, Wish(gif, png, stills, first, every, scale), as_json)
    else:
        _window(game, board.value, seed, keep, record)


def _asked(file: Path | None, frames: int | None, seed: int | None, keep: Path | None) -> images.Play:
    """The play of the command line; what it leaves open a recorded script tells."""
    if keep and not keep.is_file():
        raise UserError(f"{keep}: no such file")
    known = script.about(file) if file else None
    if seed is None:
        seed = known.seed if known and known.seed is not None else SEED
    return images.Play(frames or (known.frames if known else FRAMES), file, seed, keep)


def _headless(game: str, board: str, how: images.Play, wish: Wish, as_json: bool) -> None:
    for file in (wish.gif, wish.png):
        if file:
            writable(file)
    if wish.stills:
        folder(wish.stills)
    if wish.first >= how.frames:
        raise UserError(f"--from {wish.first}: there are {how.frames} frames")
    with working(f"{game} on {board}") as say:
        image = images.build(game, board)
        say(f"{game} on {board}, {how.frames} frames")
        films = bool(wish.gif or wish.stills)
        got = headless.play(image, how, wish.every, wish.every if films else 0, bool(wish.png))
        say("pictures")
        _draw(got, how.frames, wish)
    recorded = script.about(how.script).end if how.script else None
    # A game in a window may have dropped that frame's picture.
    same = recorded.state == got.end.state if recorded and recorded.frame == how.frames else None
    if as_json:
        ran = {"game": game, "board": board, "frames": how.frames, "seed": how.seed, "as_recorded": same}
        hashes = [asdict(row) for row in got.hashes]
        print(json.dumps({**ran, "end": asdict(got.end), "cost": asdict(got.cost), "hashes": hashes}, indent=2))
    else:
        print(f"{game} on {board}: {how.frames} frames, state {got.end.state}, picture {got.end.picture}")
        unit = {"host": "ns", "rp2040": "cycles"}.get(board, "instructions")
        print(f"worst frame {got.cost.worst:,} {unit} (frame {got.cost.frame:,}), mean {got.cost.mean:,}")
    if same is False:
        print(f"cairn: {how.script}: ends otherwise than it was recorded", file=sys.stderr)
        raise typer.Exit(1)


def _draw(got: headless.Result, last: int, wish: Wish) -> None:
    film = {frame: one for frame, one in got.pictures.items() if frame >= wish.first and frame % wish.every == 0}
    if (wish.gif or wish.stills) and not film:
        raise UserError(f"no frame from {wish.first} on is one of --every {wish.every}")
    if wish.gif:
        pictures.gif(wish.gif, film.values(), wish.every, wish.scale)
    for frame, one in film.items() if wish.stills else ():
        pictures.png(wish.stills / f"{frame:06d}.png", one, wish.scale)
    if wish.png:
        pictures.png(wish.png, got.pictures[last], wish.scale)


def _window(game: str, board: str, seed: int | None, keep: Path | None, record: Path | None) -> None:
    if record:
        writable(record)
        if keep:
            raise UserError("--record is of a game from its start: leave out --save")
    else:
        keep = _save_file(keep or folder(SAVES) / f"{game}.save")
    how = images.Play(0, None, secrets.randbelow(10**9) if seed is None else seed, keep)
    out.print("arrow keys, and left ctrl for the button; close the window to end")
    got = window.play(game, board, how, bool(record))
    if record:
        end = got.end or (got.hashes[-1] if got.hashes else None)
        record.write_text(script.text(game, how.seed, got.held, end), encoding="utf-8")
        out.print(f"{record}: {len(got.held)} lines; play it again by --headless --input {record}")


def _save_file(file: Path) -> Path:
    """The image takes names of one word."""
    if any(c in file.name for c in " ,") or len(file.name) > 100:
        raise UserError(f"{file}: the file's name may have no blank and no comma, and 100 characters at most")
    return writable(file).absolute()
