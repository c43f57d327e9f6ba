"""The oracle: an independent reference for scenes, in double, that shares no code with the engine.

model         a scene's masses, shapes and laws            shapes    who touches whom, and where
closed_forms  motion by formulas, where there are any      contacts  contacts as rows
world         the scene as flat arrays                     solver    all contacts of a step as one problem
motion        gravity and springs                          stepping  steps, cut where something is hit
simulate      run(), what the rest of the tools call       kept      runs that are kept in the repository
"""

from __future__ import annotations

import os
from typing import Any

# Numba compiles nearly twice as fast so, and the loops run as fast as with more.
os.environ.setdefault("NUMBA_OPT", "1")

__all__ = ["METHODS", "OracleRun", "run"]


def __getattr__(name: str) -> Any:
    """Numba takes a second to load, which commands that never run the oracle need not wait for."""
    if name not in __all__:
        raise AttributeError(name)
    from . import simulate

    return getattr(simulate, name)
