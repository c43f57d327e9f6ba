"""The images of one scene for one core, built once, and runs of them with any settings."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from .. import engine, peers
from ..scene import Scene
from .frames import errors
from .reference import FRAMES, Reference
from .rows import Row, Settings


@dataclass(frozen=True)
class Rig:
    """The folder holds cairn.elf, with memory for a quadtree, and an image of each peer where they were asked for."""

    scene: Scene
    core: str
    folder: Path

    @staticmethod
    def build(scene: Scene, core: str, folder: Path, with_peers: bool) -> Rig:
        place = Path(tempfile.mkdtemp(dir=folder))
        engine.build_image(_with_tree(scene, place), core, place / "runner.elf")
        if with_peers:
            peers.fetch()
            peers.link(scene, core, place)
        return Rig(scene, core, place)

    def measure(self, settings: Settings, reference: Reference) -> Row:
        """One run on the core; of Cairn, whose states are the same bits everywhere, poses are those of the host."""
        steps = round(reference.seconds * settings.steps_per_second)
        every = settings.steps_per_second // FRAMES
        if every * FRAMES != settings.steps_per_second:
            raise ValueError(f"{settings.steps_per_second} steps a second have no {FRAMES} frames")
        run = self._cairn if settings.engine == "cairn" else self._peer
        costs, poses = run(settings, steps, every)
        mean = sum(costs) / len(costs)
        return Row(
            scene=self.scene.name,
            core=self.core,
            settings=settings,
            is_default=settings == Settings.of(self.scene),
            seconds=reference.seconds,
            compared_seconds=reference.compared_seconds,
            reference=reference.name,
            instructions_per_step=mean,
            worst_instructions=max(costs),
            instructions_per_frame=mean * settings.steps_per_second / 60,
            errors=errors(self.scene, poses, reference),
        )

    def _cairn(self, settings: Settings, steps: int, every: int) -> tuple[list[int], np.ndarray]:
        scene = with_settings(self.scene, settings)
        counted = engine.run_built(scene, self.core, self.folder / "runner.elf", steps, 0)
        states = engine.run(scene, "q16", "host", steps, every)
        if counted.hash != states.hash:
            raise engine.EngineError(f"{scene.name}, {settings.label}: {counted.hash} on {self.core}, "
                                     f"{states.hash} on the host")  # fmt: skip
        return counted.costs, states.trajectory.poses

    def _peer(self, settings: Settings, steps: int, every: int) -> tuple[list[int], np.ndarray]:
        words = [str(number) for number in (steps, every, settings.passes, settings.steps_per_second)]
        image = self.folder / f"{settings.engine}.elf"
        got = peers.parse(engine.run_image(self.scene, self.core, image, words, timeout=1800))
        return got.costs, np.array(got.poses)


def with_settings(scene: Scene, settings: Settings) -> Scene:
    return replace(
        scene,
        solver=settings.solver,
        steps_per_second=settings.steps_per_second,
        substeps=settings.substeps,
        passes=settings.passes,
        broad_phase="quadtree" if settings.quadtree else "pairs",
        sleep=settings.sleep,
    )


def _with_tree(scene: Scene, folder: Path) -> Scene:
    """Its file with a quadtree: an image of it has the memory, and is told by words whether to use it."""
    data = json.loads(scene.path.read_text(encoding="utf-8-sig"))
    path = folder / "scene.json"
    path.write_text(json.dumps({**data, "broad_phase": "quadtree"}), encoding="utf-8")
    return replace(scene, path=path)
