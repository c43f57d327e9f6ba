"""python -m cairn_tools: what tools/cairn starts."""

from .app import main

main()
