#!/usr/bin/env python3
"""Holds the engine's library and the images to what they may contain, by their symbols.

tests/qemu/check_symbols.py NM library LIBRARY.a      no heap, no floating point, no 64-bit division, no writable data
tests/qemu/check_symbols.py NM circles IMAGE.elf      a game of circles brings none of the other features
"""

from __future__ import annotations

import re
import subprocess
import sys

FORBIDDEN_CALLS = re.compile(
    r"(malloc|calloc|realloc|free|_sbrk|.*printf"
    r"|__aeabi_[fd].*|__aeabi_c[fd].*|__aeabi_u?[il]2[fd]|__aeabi_u?ldivmod"
    r"|__\w+[sd]f[0-9]?|__u?divdi3|__u?moddi3)"
)
# The types that nm gives to writable data: initialised, zero, common, and small ones.
WRITABLE = set("DdBbCGgSs")
FEATURES = re.compile(
    r"cairn_\w*(polygon|hull|box|spring|quadtree|query|_ray|draw|slides|sleep|bullet|joint"
    r"|block|continuous)\w*",
    re.I,
)


def symbols(nm: str, path: str, *options: str) -> list[tuple[str, str]]:
    """Type and name of each symbol."""
    text = subprocess.run([nm, *options, path], capture_output=True, text=True, check=True).stdout
    return [(match[1], match[2]) for match in re.finditer(r"^(?:[0-9a-f]+)?\s+(\w) (\S+)$", text, re.M)]


def library_faults(found: list[tuple[str, str]]) -> list[str]:
    """What an engine may not have."""
    faults = [f"calls {name}" for kind, name in found if kind == "U" and FORBIDDEN_CALLS.fullmatch(name)]
    return faults + [f"has the writable global {name}" for kind, name in found if kind in WRITABLE]


def circles_faults(found: list[tuple[str, str]]) -> list[str]:
    """What a game of circles may not have."""
    return [f"contains {name}" for kind, name in found if kind != "U" and FEATURES.fullmatch(name)]


def main() -> int:
    """Checks one file and tells what is wrong."""
    nm, rule, path = sys.argv[1:]
    found = symbols(nm, path)
    if not any(name.startswith("cairn_") and kind in "Tt" for kind, name in found):
        print(f"{path}: no function of Cairn in it: the check would prove nothing")
        return 1
    faults = {"library": library_faults, "circles": circles_faults}[rule](found)
    for fault in sorted(set(faults)):
        print(f"{path}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
