"""The table of tools/demo: each scene on two emulated cores, beside the same engine in double, by tools/cairn."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ROOT / "out" / "demo"
SCENES = ["projectile", "bounce", "rolling", "stack10", "pyramid10", "bridge", "balls50", "tower"]
STEPS = 240


class CairnError(Exception):
    """A call of tools/cairn that failed, with its one line."""


def cairn(*words: str) -> str:
    """What a call of tools/cairn prints."""
    done = subprocess.run([str(ROOT / "tools" / "cairn"), *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise CairnError(done.stderr.strip() or f"cairn {' '.join(words)} ended with {done.returncode}")
    return done.stdout


def measure(scene: str) -> dict[str, Any]:
    """One row: the runs on M0, M3 and the host, which must agree to the bit, and the distance from double."""
    steps = ["--steps", str(STEPS)]
    picture = PICTURES / f"{Path(scene).stem}.png"
    host = json.loads(cairn("run", scene, *steps, "--json", "--png", str(picture)))
    cores = {core: json.loads(cairn("run", scene, *steps, "--on", core, "--json")) for core in ("m0", "m3")}
    distance = json.loads(cairn("compare", scene, *steps, "--rounding", "--json"))["overall"]["max_position"]
    hashes = {host["hash"], *(run["hash"] for run in cores.values())}
    return {
        "scene": host["scene"],
        "contacts": host["statistics"]["points"],
        "m0": cores["m0"]["mean_instructions"],
        "m3": cores["m3"]["mean_instructions"],
        "distance": distance,
        "equal": len(hashes) == 1,
        "picture": picture,
    }


def show(rows: list[dict[str, Any]], out: Console) -> None:
    """The table for people."""
    table = Table(title=f"Cairn: {STEPS} steps of each scene")
    for name in ("scene", "steps", "contacts", "M0", "M3", "q16 to f64, m", "bits"):
        table.add_column(name, justify="left" if name == "scene" else "right")
    for row in rows:
        numbers = (f"{row['m0']:,.0f}", f"{row['m3']:,.0f}", f"{row['distance']:.1e}")
        bits = "equal" if row["equal"] else "[red]DIFFER[/red]"
        table.add_row(row["scene"], str(STEPS), str(row["contacts"]), *numbers, bits)
    out.print(table)
    out.print("contacts: points at the last step. M0, M3: mean instructions a step.")
    out.print("q16 to f64: the largest distance between fixed point and double, on the host, until chaos parts them.")
    out.print("bits: whether the host, the M0 and the M3 end in the same state to the bit.")
    out.print(f"Pictures: {PICTURES.relative_to(ROOT)}/")


def main() -> int:
    """Runs the scenes; 1 if a core differs from the host."""
    scenes = sys.argv[1:] or SCENES
    PICTURES.mkdir(parents=True, exist_ok=True)
    rows = []
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("building", total=len(scenes))
        for scene in scenes:
            progress.update(task, description=scene)
            rows.append(measure(scene))
            progress.advance(task)
    show(rows, Console())
    return 0 if all(row["equal"] for row in rows) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except CairnError as error:
        print(f"demo: {error}", file=sys.stderr)
        sys.exit(1)
