#!/usr/bin/env python3
"""Holds a board's port to ports/include/cairn_port.h: runs the probe image in QEMU and judges what it does.

tests/qemu/check_probe.py BOARD PROBE.elf
"""

from __future__ import annotations

import json
import re
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent.parent
QEMU_RUN = ROOT / "tools" / "qemu-run"
LOOP_INSTRUCTIONS = 2 * (21000 - 1000)
STACK_BYTES = 1024
STACK_SLACK = 128
HARD_FAULT = 3
SELECT = 16
KEY_SECONDS = 0.1
BOARD = ""
IMAGE = ""


def call(*arguments: str, timeout: float = 20.0) -> tuple[int, str]:
    """Runs the probe; its exit code and console."""
    line = [str(QEMU_RUN), "--timeout", str(timeout), BOARD, IMAGE, *arguments]
    result = subprocess.run(line, capture_output=True, text=True, check=False)
    return result.returncode, result.stdout


def core() -> str:
    """The board's core."""
    manifest = json.loads((ROOT / "ports" / BOARD / "board.json").read_text(encoding="utf-8"))
    return str(manifest["core"])


class Qmp:
    """A QEMU with its control socket: sends keys and takes pictures of the display."""

    def __init__(self, argument: str) -> None:
        self.directory = tempfile.TemporaryDirectory(prefix="cairn-qmp-")
        path = str(Path(self.directory.name) / "qmp")
        extra = ["--qemu=-qmp", f"--qemu=unix:{path},server=on,wait=off"]
        line = [str(QEMU_RUN), "--timeout", "20", "--no-icount", *extra, BOARD, IMAGE, argument]
        self.process = subprocess.Popen(line, stdout=subprocess.PIPE, text=True)
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(10.0)
        for _ in range(200):
            try:
                self.socket.connect(path)
                break
            except (FileNotFoundError, ConnectionRefusedError):
                time.sleep(0.02)
        self.lines = self.socket.makefile("r", encoding="utf-8")
        self.lines.readline()
        self.command("qmp_capabilities")

    def command(self, name: str, **arguments: Any) -> None:
        """One command; waits for its answer and skips events."""
        self.socket.sendall(json.dumps({"execute": name, "arguments": arguments}).encode())
        while True:
            line = self.lines.readline()
            if not line:
                return  # the image has ended
            answer = json.loads(line)
            if "error" in answer:
                raise RuntimeError(answer["error"]["desc"])
            if "return" in answer:
                return

    def key(self, code: str, down: bool) -> None:
        """Presses or releases a key."""
        event = {"type": "key", "data": {"down": down, "key": {"type": "qcode", "data": code}}}
        self.command("input-send-event", events=[event])
        # The image polls: give it time to see each state.
        time.sleep(KEY_SECONDS)

    def close(self) -> None:
        """Ends QEMU if it runs, and waits for it."""
        self.socket.close()
        if self.process.stdout:
            self.process.stdout.close()
        self.process.wait(timeout=30)
        self.directory.cleanup()


class Probe(unittest.TestCase):
    """One promise of the port a test."""

    def test_arguments_reach_the_image(self) -> None:
        code, text = call("scene", "a,b", "--steps=600")
        self.assertEqual((code, text), (0, "arguments: scene a,b --steps=600\n"))

    def test_no_arguments_are_an_empty_text(self) -> None:
        self.assertEqual(call(), (0, "arguments: \n"))

    def test_exit_code_is_the_images(self) -> None:
        self.assertEqual(call("exit")[0], 7)

    def test_fault_exits_with_100_and_its_exception(self) -> None:
        code, text = call("fault")
        self.assertEqual(code, 100 + (HARD_FAULT if core() == "m0" else 6))
        self.assertRegex(text, r"fault: exception 0x0000000[36] at pc 0x[0-9a-f]{8}\n")

    def test_stack_overflow_is_caught(self) -> None:
        code, text = call("overflow")
        self.assertGreaterEqual(code, 100 + HARD_FAULT)
        self.assertLess(code, 100 + 7)
        self.assertIn("fault: exception", text)

    def test_stack_mark_follows_use(self) -> None:
        code, text = call("stack")
        self.assertEqual(code, 0)
        match = re.fullmatch(r"stack (\d+) (\d+) (\d+) (\d+)\n", text)
        assert match is not None
        before, after, now, painted = (int(number) for number in match.groups())
        self.assertGreater(now, 0)
        self.assertLess(now, after - STACK_BYTES + STACK_SLACK)
        self.assertLess(before, STACK_BYTES)
        self.assertGreaterEqual(after, STACK_BYTES)
        self.assertGreaterEqual(painted, now)
        self.assertLess(painted, STACK_BYTES)
        self.assertLess(after, STACK_BYTES + before + STACK_SLACK)

    def test_clock_counts_instructions_exactly(self) -> None:
        code, text = call("clock")
        self.assertEqual(code, 0)
        match = re.fullmatch(r"loop (\d+)\nmany (\d+)\nempty((?: \d+)+)\n", text)
        assert match is not None
        self.assertEqual(int(match[1]), LOOP_INSTRUCTIONS)
        self.assertEqual(int(match[2]), 1000 * LOOP_INSTRUCTIONS)
        self.assertEqual(len(set(match[3].split())), 1, f"a call costs {match[3]}")

    def test_clock_is_the_same_in_every_run(self) -> None:
        self.assertEqual(call("clock"), call("clock"))

    def test_what_is_kept_outlives_the_image(self) -> None:
        with tempfile.TemporaryDirectory(prefix="cairn-") as directory:
            path = Path(directory) / "kept"
            self.assertEqual(call("keep", str(path)), (0, "keep -1 0 11 0 3 ort 0 -1\n"))
            self.assertEqual(path.read_bytes(), b"short")
            self.assertEqual([file.name for file in path.parent.iterdir()], ["kept"])
            self.assertEqual(call("keep", str(path)), (0, "keep 5 0 11 0 3 ort 0 -1\n"))


class Handheld(unittest.TestCase):
    """The display and the buttons of lm3s6965evb."""

    def setUp(self) -> None:
        if BOARD != "lm3s6965evb":
            self.skipTest("this board has neither display nor buttons")

    def test_picture_reaches_the_display(self) -> None:
        qemu = Qmp("picture")
        try:
            assert qemu.process.stdout is not None
            self.assertEqual(qemu.process.stdout.readline(), "drawn\n")
            with tempfile.TemporaryDirectory() as directory:
                path = Path(directory) / "screen.ppm"
                qemu.command("screendump", filename=str(path))
                data = path.read_bytes()
            header, pixels = data.split(b"\n255\n", 1)
            self.assertEqual(header.split()[1:], [b"512", b"256"])
            row = pixels[: 512 * 3]
            greys = [row[3 * (32 * column + 16)] for column in range(16)]
            self.assertEqual(greys, sorted(set(greys)), "16 greys, darkest left")
            self.assertEqual(pixels, row * 256)
        finally:
            qemu.command("quit")
            qemu.close()

    def test_button_is_read(self) -> None:
        qemu = Qmp("button")
        assert qemu.process.stdout is not None
        try:
            self.assertEqual(qemu.process.stdout.readline(), "ready\n")
            qemu.key("ctrl", down=True)
            qemu.key("ctrl", down=False)
            qemu.key("ctrl", down=True)
            self.assertEqual(qemu.process.stdout.readline(), f"button {SELECT}\n")
        finally:
            qemu.close()


if __name__ == "__main__":
    IMAGE = sys.argv.pop()
    BOARD = sys.argv.pop()
    unittest.main(verbosity=2)
