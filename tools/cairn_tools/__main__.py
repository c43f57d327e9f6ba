"""python -m cairn_tools: what tools/cairn starts."""

# Processes that a sweep starts import this file too.
if __name__ == "__main__":
    try:
        from .app import main

        main()
    except KeyboardInterrupt:  # while the libraries load: main() knows it from then on
        raise SystemExit(130) from None
