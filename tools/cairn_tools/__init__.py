"""The Python half of tools/cairn: scenes, runs of the engine, comparison, cost and pictures."""
