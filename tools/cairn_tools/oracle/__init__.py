"""The oracle: an independent reference for scenes, in double, that shares no code with the engine."""
