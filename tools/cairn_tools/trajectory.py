"""What a run gives: the state of every body at chosen steps, and its CSV form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

CSV_HEADER = "step,body,x,y,angle,vx,vy,omega"


@dataclass(frozen=True)
class Trajectory:
    """states[k, body] is x, y, angle, vx, vy, omega after steps[k] steps; SI units, angle unwrapped."""

    steps: NDArray[np.int64]
    states: NDArray[np.float64]

    @property
    def poses(self) -> NDArray[np.float64]:
        """x, y, angle of every body at every recorded step."""
        return self.states[:, :, :3]

    def write_csv(self, out: TextIO) -> None:
        """One row a body a step, in the order of the scene's bodies; shortest digits that give the same double."""
        out.write(CSV_HEADER + "\n")
        for step, bodies in zip(self.steps, self.states, strict=True):
            for body, state in enumerate(bodies):
                out.write(f"{step},{body}," + ",".join(_number(value) for value in state) + "\n")


def _number(value: float) -> str:
    """Shortest text that reads back as the same double; no negative zero."""
    return repr(float(value) + 0.0).removesuffix(".0")
