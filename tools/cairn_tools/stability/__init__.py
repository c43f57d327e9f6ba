"""The stiff and extreme cases: `tools/cairn stability`. See docs/STABILITY.md."""
