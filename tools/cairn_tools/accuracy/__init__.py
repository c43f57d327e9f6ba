"""How wrong the engine is, and at what cost: arithmetic, smooth scenes, error against run time."""
