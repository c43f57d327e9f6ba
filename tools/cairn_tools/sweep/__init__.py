"""Large sweeps over scenes and settings, run on Dask: `tools/cairn sweep`."""
