"""Runs the tasks of all parts, two at a time where there are two processors, the long ones first."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

from ..engine import EngineError
from ..errors import UserError
from .model import BAD, Options, Part, Section, Task

Tell = Callable[[float, float, str], None]  # done, of how much, what ended last


@dataclass(frozen=True)
class Done:
    """A part at its end, with the seconds that its tasks took."""

    section: Section
    seconds: float
    broke: bool = False


@dataclass(frozen=True)
class Outcome:
    """What a task gave, or what went wrong."""

    result: Any
    seconds: float
    trouble: str = ""


def run(parts: list[Part], options: Options, workers: int, tell: Tell) -> list[Done]:
    """The sections in the order of the parts."""
    tasks = {part.key: part.tasks(options) for part in parts}
    order = sorted(((part.key, k) for part in parts for k in range(len(tasks[part.key]))),
                   key=lambda place: -tasks[place[0]][place[1]].weight)  # fmt: skip
    total = sum(task.weight for own in tasks.values() for task in own)
    outcomes: dict[tuple[str, int], Outcome] = {}
    done = 0.0
    # Not forked: threads of the libraries that are loaded here would be missing there.
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        waiting: dict[Future[Outcome], tuple[str, int]] = {
            pool.submit(outcome, tasks[key][k]): (key, k) for key, k in order
        }
        try:
            for future in as_completed(waiting):
                key, k = waiting[future]
                outcomes[key, k] = future.result()
                done += tasks[key][k].weight
                tell(done, total, tasks[key][k].name)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return [_done(part, [outcomes[part.key, k] for k in range(len(tasks[part.key]))]) for part in parts]


def outcome(task: Task) -> Outcome:
    """In a process of the pool."""
    start = time.perf_counter()
    try:
        return Outcome(task.call(*task.arguments), time.perf_counter() - start)
    except Exception as problem:  # whatever it is, the other parts run on
        known = isinstance(problem, EngineError | UserError)
        text = " ".join(f"{'' if known else type(problem).__name__ + ': '}{problem}".split())
        return Outcome(None, time.perf_counter() - start, f"{task.name}: {text}")


def _done(part: Part, outcomes: list[Outcome]) -> Done:
    """A part of which a task broke says so on the page, and the others stand."""
    seconds = sum(outcome.seconds for outcome in outcomes)
    trouble = next((outcome.trouble for outcome in outcomes if outcome.trouble), "")
    if trouble:
        return Done(Section(part.key, part.title, part.command, trouble, tone=BAD), seconds, broke=True)
    return Done(part.section([outcome.result for outcome in outcomes]), seconds)
