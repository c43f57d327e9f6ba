#!/usr/bin/env python3
"""Holds the game to what a handheld has: runs its image on lm3s6965evb and judges from outside.

tests/qemu/check_games.py GAME.elf
"""

from __future__ import annotations

import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
BOARD = "lm3s6965evb"
FRAME_INSTRUCTIONS = 833_000  # of 50 MHz at 60 Hz
RAM_BYTES = 48 * 1024
FLASH_BYTES = 64 * 1024
STONES = 24
ONE = 65536
IMAGE = ""

# What examples/cairn/keep.h lays down: magic and checksum, then the game, then 24 stones.
MAGIC, LAYOUT, BASIS, PRIME = 0x4361726E, 1, 2166136261, 16777619
GAME = struct.Struct("<IIIII6iHBBBBBB")
STONE = struct.Struct("<Iiii")


def kept_game(stones: list[tuple[int, int, int, int]], level: int = 0, supply: int = 0) -> bytes:
    """A kept game with these stones: seed, x and y in 1/65536 m, angle."""
    lives, streak = 5, 1
    body = GAME.pack(0, 0, 12345, 99, 7, *[0] * 6, level, 1, lives, supply, streak, len(stones), 0)
    body += b"".join(STONE.pack(*stone) for stone in stones).ljust(STONES * STONE.size, b"\0")
    checksum = (BASIS + LAYOUT) & 0xFFFFFFFF
    for byte in body:
        checksum = ((checksum ^ byte) * PRIME) & 0xFFFFFFFF
    return struct.pack("<II", MAGIC, checksum) + body


def three_piles() -> list[tuple[int, int, int, int]]:
    """All 24 stones in the air, in three piles with gaps: they fall on one another."""
    dice = random.Random(4)
    return [
        (
            dice.getrandbits(32),
            round((place % 3 - 1) * 1.45 * ONE),
            round((0.4 + place // 3 * 0.72) * ONE),
            dice.randint(-(2**28), 2**28),
        )
        for place in range(STONES)
    ]


class Games(unittest.TestCase):
    """One promise a test."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="cairn-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def play(self, *words: str, script: str | None = None, timeout: float = 120.0) -> tuple[int, str]:
        """Runs the image with its words; the exit code and the console."""
        line = [str(ROOT / "tools" / "qemu-run"), "--timeout", str(timeout), BOARD, IMAGE, *words]
        if script is not None:
            (self.folder / "input").write_text(script, encoding="utf-8")
            line.append("input=input")
        result = subprocess.run(line, capture_output=True, text=True, check=False, cwd=self.folder)
        return result.returncode, result.stdout

    def test_the_worst_frame_with_24_stones_in_play_is_in_time(self) -> None:
        (self.folder / "kept").write_bytes(kept_game(three_piles()))
        code, text = self.play("frames=200", "seed=1", "keep=kept", "cost", script="5 select\n7 none\n")
        self.assertEqual(code, 0)
        match = re.search(r"cost worst (\d+) in frame \d+ .* stack (\d+)\n", text)
        assert match is not None
        print(match[0], end="", file=sys.stderr)
        self.assertLess(int(match[1]), FRAME_INSTRUCTIONS)

    def test_it_fits_in_the_memory_of_a_small_chip(self) -> None:
        sizes = subprocess.run(["arm-none-eabi-size", IMAGE], capture_output=True, text=True, check=True).stdout
        text, data, bss = (int(word) for word in sizes.splitlines()[1].split()[:3])
        print(f"flash {text + data}, RAM {data + bss}", file=sys.stderr)
        self.assertLess(data + bss, RAM_BYTES)
        self.assertLess(text + data, FLASH_BYTES)

    def test_a_killed_game_goes_on_with_all_but_the_stone_in_hand(self) -> None:
        stones = three_piles()[:6]
        (self.folder / "kept").write_bytes(kept_game(stones, supply=9))
        # A stone hangs, is kept with the six that stand, falls, and the power goes.
        self.play("frames=240", "seed=1", "keep=kept", script="5 select\n7 none\n200 select\n")
        kept = (self.folder / "kept").read_bytes()
        game = GAME.unpack_from(kept, 8)
        number, playing, lives, supply, _streak, count = game[11:17]
        self.assertEqual((number, playing, lives, supply, count), (0, 1, 5, 9, 6))
        seeds = {STONE.unpack_from(kept, 8 + GAME.size + STONE.size * place)[0] for place in range(count)}
        self.assertEqual(seeds, {stone[0] for stone in stones})

    def test_the_same_script_gives_the_same_frames(self) -> None:
        words = ["frames=300", "seed=9", "every=100"]
        script = "5 select\n7 none\n60 right\n90 right+select\n95 up\n200 left+select\n"
        first = self.play(*words, script=script)
        self.assertEqual(first[0], 0)
        self.assertEqual(first, self.play(*words, script=script))
        self.assertNotEqual(first[1], self.play(*words, script="5 select\n7 none\n60 left\n")[1])

    def test_a_bad_script_and_a_bad_word_are_one_line_each(self) -> None:
        message = "buttons are up, down, left, right, select, joined by '+', or none"
        self.assertEqual(self.play("frames=60", script="5 jump\n"), (2, f"cairn: input line 1: {message}\n"))
        self.assertEqual(self.play("frames=60", "input=nothing"), (2, "cairn: nothing: cannot be read\n"))
        self.assertEqual(self.play("frames=x"), (2, "cairn: a number has digits only\n"))


if __name__ == "__main__":
    IMAGE = str(Path(sys.argv.pop()).resolve())
    unittest.main(verbosity=2)
