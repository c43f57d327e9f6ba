"""tools/cairn report: one page that needs no other file, and the same numbers twice."""

import json
import math
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cairn_tools.engine import EngineError
from cairn_tools.report import command, model, page, runner
from rich.table import Table

ROOT = Path(__file__).parents[2]
ABOUT = page.About("0", "c", "b", quick=True, peers=False)


def cairn(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "tools" / "cairn", "report", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Parsed(HTMLParser):
    """Which tags are open wrongly, what a page refers to, and its headings."""

    VOID = ("meta", "img", "source", "br", "link")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.links: list[str] = []
        self.ids: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in self.VOID:
            self.open.append(tag)
        for name, value in attributes:
            if name in ("src", "href", "srcset"):
                self.links.append(value or "")
            if name == "id":
                self.ids.append(value or "")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The quick report twice, by two processes and by one."""
    folders = [tmp_path_factory.mktemp("report") / "made" for _ in range(2)]
    for folder, jobs in zip(folders, (2, 1), strict=True):
        done = cairn("--quick", "--out", folder, "--jobs", jobs)
        assert done.returncode == 0, done.stdout + done.stderr
    return folders


def test_two_reports_give_the_same_numbers_but_for_the_hosts_times(reports: list[Path]) -> None:
    records = [json.loads((folder / "report.json").read_text()) for folder in reports]
    times = [record.pop("host_times") for record in records]
    assert records[0] == records[1]
    assert set(times[0]["seconds_of_processes"]) == set(records[0]["sections"])
    assert (reports[0] / "index.html").read_bytes() == (reports[1] / "index.html").read_bytes()


def test_the_page_needs_no_other_file_and_has_every_section(reports: list[Path]) -> None:
    text = (reports[0] / "index.html").read_text()
    parsed = Parsed(text)
    assert parsed.open == []
    assert set(parsed.ids) == {part.key for part in command.PARTS}
    assert all(link.startswith(("data:image/", "#")) for link in parsed.links)
    assert "url(" not in text and "@import" not in text
    for section in json.loads((reports[0] / "report.json").read_text())["sections"].values():
        assert section["command"].startswith("tools/cairn ") and section["finding"] and section["data"]


def test_a_bad_call_gives_one_line_and_exit_code_2(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for arguments, what in ((["--quick"], "--out"), (["--out", tmp_path / "file"], "file")):
        done = cairn(*arguments)
        assert (done.returncode, done.stdout) == (2, "")
        assert len(done.stderr.splitlines()) == 1 and what in done.stderr


def broken() -> None:
    raise EngineError("it does\nnot build")


def test_a_part_that_breaks_says_so_and_the_others_stand() -> None:
    def section(results: list[Any]) -> model.Section:
        return model.Section("whole", "Whole", "tools/cairn x", f"gave {results}")

    parts = [
        model.Part("whole", "Whole", "tools/cairn x", lambda _: [model.Task("a", math.sqrt, (4,)),
                                                                 model.Task("b", math.sqrt, (9,), 5)], section),
        model.Part("broken", "Broken", "tools/cairn y", lambda _: [model.Task("c", broken)], section),
    ]  # fmt: skip
    done = runner.run(parts, model.Options(), 1, lambda done, total, at: None)
    assert [(entry.section.finding, entry.broke) for entry in done] == [
        ("gave [2.0, 3.0]", False),
        ("c: it does not build", True),
    ]


def test_a_table_of_the_terminal_keeps_its_colours_as_tones() -> None:
    table = Table("name", title="[bold]T[/]", caption="c")
    table.add_column("number", justify="right")
    table.add_row("[red]! short[/]", "[green]1[/]")
    table.add_row("a [b] c", "2")
    grid = model.grid_of(table)
    assert (grid.title, grid.columns, grid.right, grid.caption) == ("T", ["name", "number"], [False, True], "c")
    assert grid.rows[0] == [model.Cell("! short", model.BAD), model.Cell("1", model.GOOD)]


def test_texts_are_escaped_on_the_page() -> None:
    grid = model.Grid("<t>", ["a"], [False], [[model.Cell("<script>1 & **2**</script>", model.BAD)]])
    section = model.Section("s", "S", "tools/cairn x", "2 < 3", grids=[grid])
    text = page.html([section], ABOUT)
    assert "<script>" not in text and "&lt;script&gt;1 &amp; <strong>2</strong>" in text
    assert Parsed(text).open == []
    lines = page.markdown([section]).splitlines()
    assert lines[-3:] == ["| a |", "| --- |", "| <script>1 & **2**</script> |"]


def test_json_has_no_odd_numbers() -> None:
    got = model.plain({"a": math.nan, "b": [math.inf, np.float64(2.5)], "c": np.arange(2), "d": model.Cell("x")})
    assert got == {"a": None, "b": ["inf", 2.5], "c": [0, 1], "d": {"text": "x", "tone": ""}}
    json.dumps(got, allow_nan=False)
