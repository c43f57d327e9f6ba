"""The games of examples/ on the emulated console and on the host: played by a person or a script, drawn, measured."""
