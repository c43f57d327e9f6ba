"""python -m cairn_tools: what tools/cairn starts."""

# Processes that a sweep starts import this file too.
if __name__ == "__main__":
    from .app import main

    main()
