"""tools/cairn play: games by scripts on both boards, the console seen and pressed from outside, and bad calls."""

import json
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import sleep

import numpy as np
import pytest
from cairn_tools.errors import UserError
from cairn_tools.play import budget, headless, images, pictures, qmp, script, window
from PIL import Image

ROOT = Path(__file__).parents[2]
SEED = 5
RP2040JS = ROOT / "build" / "rp2040" / "node_modules"


def cairn_play(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "tools" / "cairn", "play", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def script_file(folder: Path, *lines: str) -> Path:
    file = folder / "script.txt"
    file.write_text("\n".join(lines) + "\n")
    return file


# ---- bad calls ----


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (["tetris"], "no game 'tetris'; there are cairn, pinball, platformer, show"),
        (["--gif", "a.gif"], "--gif goes with --headless"),
        (["--frames", "9"], "--frames goes with --headless"),
        (["--headless", "--record", "a.txt"], "--record"),
        (["--keep"], "--budget"),
        (["--board", "rp2040"], "rp2040 has no display"),
        (["--headless", "--board", "gameboy"], "--board"),
        (["--headless", "--board", "host", "--gif", "/nowhere/a.gif"], "no folder /nowhere"),
        (["--headless", "--board", "host", "--frames", "9", "--from", "9"], "--from 9"),
        (["--headless", "--board", "host", "--input", "/nowhere/script"], "/nowhere/script: No such file"),
        (["--headless", "--board", "host", "--save", "/nowhere/save"], "/nowhere/save: no such file"),
    ],
)
def test_a_bad_call_gives_one_line_and_exit_code_2(arguments: list[str], what: str) -> None:
    done = cairn_play(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("cairn: ")
    assert what in done.stderr


@pytest.mark.parametrize("board", images.BOARDS)
@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("30 jump", "buttons are up, down, left, right, select, joined by '+', or none"),
        ("soon left", "a line begins with a frame number"),
        ("10 left", "frame numbers must rise"),
    ],
)
def test_a_bad_script_gives_one_line_that_names_the_place(tmp_path: Path, board: str, line: str, what: str) -> None:
    file = script_file(tmp_path, "20 left", line)
    done = cairn_play("--headless", "--board", board, "--frames", 60, "--input", file)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"cairn: {file} line 2: {what}\n"


def test_a_script_that_is_no_text_is_said_to_be_none(tmp_path: Path) -> None:
    file = tmp_path / "script"
    file.write_bytes(b"\xff\xfe\x00")
    done = cairn_play("--headless", "--board", "host", "--input", file)
    assert (done.returncode, done.stderr) == (2, f"cairn: {file}: this is no text\n")


def test_what_is_missing_is_named() -> None:
    def nothing(_: str) -> None:
        return None

    with pytest.raises(UserError, match="qemu-system-arm is not installed"):
        images.need_qemu(nothing)
    asked: list[str] = []
    with pytest.raises(UserError, match="SDL2 is missing: install libsdl2-dev"):
        window.need_sdl(nothing, lambda: asked.append("setup"))
    with pytest.raises(UserError, match="QEMU has no window: install qemu-system-gui"):
        window.qemu_display(lambda: "none\ncurses\n", lambda: asked.append("setup"))
    with pytest.raises(UserError, match="no screen"):
        window.need_screen({})
    assert asked == ["setup", "setup"]
    assert window.qemu_display(lambda: "none\nsdl\n") == "sdl"


# ---- scripts ----


def test_a_recorded_script_tells_how_to_play_it_again(tmp_path: Path) -> None:
    end = headless.Hashes(120, "0123abcd", "4567ef89")
    file = tmp_path / "script"
    file.write_text(script.text("cairn", 99, ["60 left", "90 none"], end))
    assert script.about(file) == script.About(99, 120, end)
    file.write_text("60 left\n  90 none # let go\n")
    assert script.about(file) == script.About(None, 90 + script.AFTER_LAST, None)


def test_a_long_play_is_a_good_script_and_always_the_same() -> None:
    lines = script.long_play(3600, 1)
    frames = [int(line.split()[0]) for line in lines]
    assert frames == sorted(set(frames)) and frames[-1] < 3600 and len(frames) > 100
    assert lines == script.long_play(3600, 1) != script.long_play(3600, 2)


# ---- the same game everywhere ----


@pytest.mark.parametrize("game", images.GAMES)
def test_a_script_gives_the_same_states_and_pictures_on_console_and_host(tmp_path: Path, game: str) -> None:
    how = images.Play(240, script_file(tmp_path, *script.long_play(240, 3)), SEED)
    console, host = (headless.play(images.build(game, board), how, 20, 80, True) for board in images.BOARDS)
    assert console.end == host.end and console.end is not None
    assert console.hashes == host.hashes and len(console.hashes) == 12
    assert sorted(console.pictures) == sorted(host.pictures) == [80, 160, 240]
    assert all((console.pictures[frame] == host.pictures[frame]).all() for frame in host.pictures)
    assert len({row.picture for row in host.hashes}) > 3


def test_a_headless_play_writes_its_pictures(tmp_path: Path) -> None:
    gif, png, stills = tmp_path / "a.gif", tmp_path / "a.png", tmp_path / "stills"
    done = cairn_play("show", "--board", "host", "--headless", "--frames", 40, "--every", 6, "--scale", 2,
                      "--gif", gif, "--png", png, "--stills", stills, "--from", 12, "--json")  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["end"]["frame"] == 40
    with Image.open(gif) as film:
        assert (film.size, film.n_frames, film.info["duration"]) == ((256, 128), 5, 100)
    assert sorted(file.name for file in stills.iterdir()) == [f"0000{frame}.png" for frame in (12, 18, 24, 30, 36)]
    of_file = pictures.of_dump(png, 2)
    assert of_file is not None and of_file.shape == (64, 128) and len(set(of_file.flat)) > 3


def test_a_script_that_ends_otherwise_than_recorded_fails(tmp_path: Path) -> None:
    end = headless.play(images.build("pinball", "host"), images.Play(50)).end
    assert end is not None
    good, bad = tmp_path / "good", tmp_path / "bad"
    good.write_text(script.text("pinball", 1, [], end))
    bad.write_text(script.text("pinball", 1, [], headless.Hashes(50, "00000000", end.picture)))
    assert cairn_play("pinball", "--board", "host", "--headless", "--input", good).returncode == 0
    done = cairn_play("pinball", "--board", "host", "--headless", "--input", bad)
    assert (done.returncode, done.stderr) == (1, f"cairn: {bad}: ends otherwise than it was recorded\n")


@pytest.mark.skipif(shutil.which("sdl2-config") is None, reason="tools/setup --window has not been asked for")
def test_the_window_of_the_host_plays_the_same_game(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    how = images.Play(60, script_file(tmp_path, "5 select", "7 none"), SEED)
    image = images.build("cairn", "host")
    assert headless.play(window.host_image("cairn"), how).end == headless.play(image, how).end


@pytest.mark.skipif(not RP2040JS.is_dir(), reason="tools/setup --rp2040 has not been asked for")
def test_the_rp2040_plays_the_same_game_and_keeps_it(tmp_path: Path) -> None:
    save = tmp_path / "save"
    save.write_bytes(b"no kept game")
    how = images.Play(40, script_file(tmp_path, "5 select", "7 none"), SEED, save)
    ends = [headless.play(images.build("cairn", board), how, 20).hashes for board in ("rp2040", "host")]
    assert ends[0] == ends[1] and len(ends[0]) == 2


# ---- the console from outside ----


@contextmanager
def console(folder: Path, game: str, *words: str) -> Iterator[tuple[qmp.Console, Path]]:
    """A game in real time, with its keys and its display, and the file of what it prints."""
    image, socket, output = images.build(game, images.CONSOLE), folder / "qmp", folder / "output"
    with output.open("w") as file:
        command = images.qemu(image, [f"seed={SEED}", *words], "none", socket)
        nothing = subprocess.DEVNULL
        process = subprocess.Popen(command, cwd=folder, stdin=nothing, stdout=file, stderr=nothing)
        try:
            with qmp.Console(socket) as connection:
                yield connection, output
        finally:
            process.terminate()
            process.wait()


def find(picture: np.ndarray, frames: dict[int, np.ndarray]) -> int:
    """The frame whose picture this is. A dump may fall into a flush: then it ends with rows of a frame just before."""
    numbers = sorted(frames)
    for place, number in enumerate(numbers):
        rows = (frames[number] == picture).all(axis=1)
        before = [(frames[other] == picture).all(axis=1) for other in numbers[max(0, place - 4) : place]]
        whole = rows.argmin() if not rows.all() else len(rows)
        if whole == len(rows) or (whole > 0 and any(other[whole:].all() for other in before)):
            return number
    raise AssertionError("the dump is no picture of the host's")


def test_the_display_shows_the_host_s_own_pictures(tmp_path: Path) -> None:
    frames = headless.play(images.build("cairn", "host"), images.Play(900, seed=SEED), pictures=1).pictures
    seen = []
    with console(tmp_path, "cairn") as (connection, _):
        for _ in range(4):
            sleep(0.4)
            connection.dump(tmp_path / "dump.png")
            picture = pictures.of_dump(tmp_path / "dump.png", qmp.SCALE)
            assert picture is not None
            seen.append(find(picture, frames))
    assert seen == sorted(seen) and seen[-1] > seen[0]


def test_a_play_recorded_on_the_console_is_the_same_when_played_again(tmp_path: Path) -> None:
    frames = 210
    with console(tmp_path, "cairn", f"frames={frames}", "paced", "record") as (connection, output):
        connection.wake()
        for button, seconds in (("select", 0.1), ("right", 0.5), ("up", 0.3), ("select", 0.1)):
            sleep(0.2)
            connection.key(button, True)
            sleep(seconds)
            connection.key(button, False)
        while (played := headless.parse(output.read_text())).end is None:
            sleep(0.1)
    held = ["select", "none", "right", "none", "up", "none", "select", "none"]
    assert [line.split()[1] for line in played.held] == held
    file = tmp_path / "script"
    file.write_text(script.text("cairn", SEED, played.held, played.end))
    again = images.Play(script.about(file).frames, file, SEED)
    for board in images.BOARDS:
        assert headless.play(images.build("cairn", board), again).end == played.end
    idle = headless.play(images.build("cairn", "host"), images.Play(frames, seed=SEED)).end
    assert played.end.frame == frames and idle is not None and idle.state != played.end.state


# ---- costs ----


def test_a_figure_over_its_record_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    file = tmp_path / "game.json"
    file.write_text(json.dumps({"flash": 1000, "RAM": 1000}))
    monkeypatch.setattr(budget, "FILE", file)
    rows = [budget.Row("flash", 1020), budget.Row("RAM", 1021, unit="bytes"), budget.Row("new", 1)]
    assert list(budget.troubles(rows)) == ["RAM: 1,021 bytes, on record 1,000", "new: not on record"]
    assert not budget.Row("flash", 11, 10).fits and budget.Row("flash", 10, 10).fits


def test_the_game_has_a_record_within_the_limits_of_a_frame_and_of_ram() -> None:
    record = json.loads(budget.FILE.read_text())
    assert max(count for name, count in record.items() if name.startswith("worst frame")) < budget.FRAME
    assert record["RAM with 8 KB of stack"] < budget.RAM
