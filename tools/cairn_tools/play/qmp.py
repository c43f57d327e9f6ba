"""The console's outside in QEMU: its keys and its display, by QEMU's machine protocol (JSON lines on a socket)."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterable
from pathlib import Path
from time import monotonic, sleep
from types import TracebackType
from typing import Any

from ..engine import EngineError

# The board's buttons, and the keys that QEMU gives them.
KEYS = {"up": "up", "down": "down", "left": "left", "right": "right", "select": "ctrl"}
PATIENCE = 20.0  # seconds
SCALE = 4  # of a pixel in a screen dump


class Console:
    """A connection to a QEMU that is being started; to be used in a `with`."""

    def __init__(self, path: Path) -> None:
        self._socket = _connected(path)
        self._file = self._socket.makefile("rw", encoding="utf-8")
        self._answer("QMP")
        self.ask("qmp_capabilities")

    def __enter__(self) -> Console:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()
        self._socket.close()

    def ask(self, command: str, **arguments: Any) -> Any:
        """Has QEMU do something and waits until it is done."""
        self._file.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self._file.flush()
        return self._answer("return")

    def _answer(self, wanted: str) -> Any:
        for line in self._file:
            message = json.loads(line)
            if "error" in message:
                raise EngineError(f"QEMU: {message['error']['desc']}")
            if wanted in message:
                return message[wanted]
        raise EngineError("QEMU has ended")

    def key(self, button: str, down: bool) -> None:
        """Holds a button of the pad, or lets it go."""
        key = {"type": "qcode", "data": KEYS[button]}
        self.ask("input-send-event", events=[{"type": "key", "data": {"down": down, "key": key}}])

    def wake(self, buttons: Iterable[str] = KEYS) -> None:
        """Presses each button once: QEMU takes a button for held until it has been let go of for the first time."""
        for button in buttons:
            self.key(button, True)
            self.key(button, False)

    def dump(self, file: Path) -> None:
        """The display as a PNG of SCALE by SCALE dots a pixel."""
        self.ask("screendump", filename=str(file.absolute()), format="png")


def _connected(path: Path) -> socket.socket:
    """QEMU makes the socket when it starts."""
    last = monotonic() + PATIENCE
    while True:
        client = socket.socket(socket.AF_UNIX)
        try:
            client.connect(str(path))
        except OSError as error:
            client.close()
            if monotonic() > last:
                raise EngineError(f"QEMU does not answer on {path}: {error.strerror}") from error
            sleep(0.02)
        else:
            client.settimeout(PATIENCE)
            return client
