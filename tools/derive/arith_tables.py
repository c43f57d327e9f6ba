"""Derive the constants of src/arith_fixed.c: minimax polynomials and the two start tables.

Prints C text; `--check FILE` exits 1 unless every printed line stands in FILE as it is.
The polynomials come from Remez exchange on the interval where the engine uses them; a constrained leading
term (the cosine's 1) is taken out of the fit. The tables hold, per interval, the 8-bit value whose largest
relative error over the interval is smallest.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
GRID = 20001


def remez(basis: Callable[[Array], Array], target: Callable[[Array], Array], low: float, high: float) -> Array:
    """The coefficients whose largest |target - basis @ c| on [low, high] is smallest."""
    count = basis(np.array([low])).shape[1]
    grid = low + (high - low) * (1 - np.cos(np.linspace(0, np.pi, GRID))) / 2
    everywhere, wanted = basis(grid), target(grid)
    at = np.linspace(0, GRID - 1, count + 1).round().astype(int)
    coefficients = np.zeros(count)
    for _ in range(100):
        signs = (-1.0) ** np.arange(count + 1)
        solution = np.linalg.solve(np.column_stack([everywhere[at], signs]), wanted[at])
        coefficients = solution[:-1]
        error = wanted - everywhere @ coefficients
        # One extremum per run of equal sign, then the best count + 1 neighbouring runs.
        runs = np.split(np.arange(GRID), np.flatnonzero(np.diff(np.sign(error))) + 1)
        peaks = np.array([run[np.argmax(np.abs(error[run]))] for run in runs])
        while len(peaks) > count + 1:
            peaks = peaks[1:] if abs(error[peaks[0]]) < abs(error[peaks[-1]]) else peaks[:-1]
        if len(peaks) < count + 1 or np.array_equal(peaks, at):
            break
        at = peaks
    return coefficients


def powers(*exponents: int) -> Callable[[Array], Array]:
    return lambda x: np.column_stack([x**n for n in exponents])


def scaled(coefficients: Array, scale: float) -> list[int]:
    return [int(np.floor(c * scale + 0.5)) for c in coefficients]


def sine() -> list[int]:
    """sin(pi/4 z) / z in w = z^2 on [0, 1], Q31."""
    # The last factor z weighs the error, so fit the odd polynomial itself, from just above 0.
    c = remez(powers(1, 3, 5, 7), lambda z: np.sin(np.pi / 4 * z), 1e-6, 1.0)
    return scaled(c, 2.0**31)


def cosine() -> list[int]:
    """(cos(pi/4 z) - 1) in w = z^2 on [0, 1], without constant term, Q32."""
    c = remez(powers(2, 4, 6, 8), lambda z: np.cos(np.pi / 4 * z) - 1, 1e-6, 1.0)
    return scaled(c, 2.0**32)


def arc_tangent() -> list[int]:
    """2 atan(t) in binary angle on [0, tan(pi/8)]: odd polynomial."""
    c = remez(powers(1, 3, 5, 7, 9, 11), lambda t: np.arctan(t), 1e-6, float(np.tan(np.pi / 8)) + 1e-4)
    return scaled(c, 2.0**33 / (2 * np.pi))


def start_table(first: int, count: int, function: Callable[[float], float]) -> list[int]:
    """For m / 64 in [first + i, first + i + 1) / 64: 256 (function(m) - 1) in 8 bits."""
    values = []
    for i in range(first, first + count):
        ends = function(i / 64), function((i + 1) / 64)
        best = min(range(256), key=lambda v: max(abs((256 + v) / 256 / e - 1) for e in ends))
        values.append(best)
    return values


def c_list(values: list[int]) -> list[str]:
    return ["    " + ", ".join(map(str, values[i : i + 16])) + "," for i in range(0, len(values), 16)]


def lines() -> list[str]:
    out: list[str] = []
    for name, values in (("SINE", sine()), ("COSINE", cosine()), ("ARC", arc_tangent())):
        first = 0 if name == "COSINE" else 1
        out += [f"#define {name}_{2 * i + first + (2 if name == 'COSINE' else 0)} ({v})" for i, v in enumerate(values)]
    out += c_list(start_table(16, 48, lambda m: float(m**-0.5)))
    out += c_list(start_table(32, 32, lambda m: 1 / m))
    return out


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", type=Path, metavar="FILE", help="the C file that must hold these constants")
    arguments = parser.parse_args()
    derived = lines()
    if arguments.check is None:
        print("\n".join(derived))
        return 0
    present = set(arguments.check.read_text(encoding="utf-8").splitlines())
    missing = [line for line in derived if line not in present]
    for line in missing:
        print(f"not in {arguments.check}: {line}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
