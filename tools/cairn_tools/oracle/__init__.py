"""The oracle: an independent reference for scenes, in double, that shares no code with the engine."""

from .run import METHODS, OracleRun, run

__all__ = ["METHODS", "OracleRun", "run"]
