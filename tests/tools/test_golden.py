"""The golden hashes' record: what changes it, and what it refuses. The runs themselves are tools/cairn golden."""

import json
from pathlib import Path

import pytest
from cairn_tools import golden
from cairn_tools.errors import UserError

OLD = "## [0.1.0] - 2020-01-01\n\n### State hashes\n\n- `00000001` Old.\n"
EMPTY = "# Changelog\n\n## [Unreleased]\n\n### Added\n\n- A thing.\n\n" + OLD


@pytest.fixture
def record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the record and the change log that a test may spoil; gives the hashes' file."""
    for name in ("HASHES", "CHANGELOG"):
        source = getattr(golden, name)
        copy = tmp_path / source.name
        copy.write_text(source.read_text())
        monkeypatch.setattr(golden, name, copy)
    return golden.HASHES


def spoil(file: Path, key: str, value: str) -> None:
    data = json.loads(file.read_text())
    data["hashes"][key] = value
    file.write_text(json.dumps(data))


def quiet(_: str) -> None:
    pass


def test_the_record_is_whole() -> None:
    assert golden.record_troubles() == []


def test_every_scene_is_on_record() -> None:
    names = set(json.loads(golden.HASHES.read_text())["hashes"])
    assert names == {case.name for case in golden.cases()}
    assert {path.stem for path in golden.scene.SCENES_DIR.glob("*.json")} <= names


def test_a_hash_changed_without_the_change_log_is_refused(record: Path) -> None:
    spoil(record, "stack10", "00000000")
    (trouble,) = golden.record_troubles()
    assert "CHANGELOG.md" in trouble


def test_a_hash_changed_back_needs_a_new_line_too(record: Path) -> None:
    digest = golden.digest(json.loads(record.read_text()))
    text = golden.with_line(golden.CHANGELOG.read_text(), "12345678", "A detour.")
    golden.CHANGELOG.write_text(text)
    assert f"`{digest}`" in text
    assert golden.record_troubles() != []


def test_a_search_for_pairs_that_changes_the_motion_is_refused(record: Path) -> None:
    spoil(record, "circles100 broad_phase=quadtree", "00000000")
    assert "circles100 broad_phase=quadtree gives 00000000" in golden.record_troubles()[0]


def test_a_hash_of_no_case_is_refused(record: Path) -> None:
    spoil(record, "a scene that was deleted", "00000000")
    assert any("a scene that was deleted" in trouble for trouble in golden.record_troubles())


def test_a_target_that_differs_is_found(record: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chosen = [case for case in golden.cases() if case.name in ("spring", "bounce")]
    monkeypatch.setattr(golden, "cases", lambda: chosen)
    golden.write("These two alone.", quiet)
    truth = json.loads(record.read_text())["hashes"]["spring"]
    spoil(record, "spring", "00000000")
    (failed,) = [result for result in golden.check(["host"], quiet) if not result.passed]
    assert (failed.target, failed.case, failed.got, failed.expected) == ("host", "spring", truth, "00000000")


def test_a_case_that_is_not_on_record_fails(record: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = next(case for case in golden.cases() if case.name == "spring")
    monkeypatch.setattr(golden, "cases", lambda: [golden.Case("new", case.scene)])
    (result,) = golden.check(["host"], quiet)
    assert not result.passed
    assert "not on record" in str(result)


def test_writing_mends_the_record_and_names_the_reason(record: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chosen = [case for case in golden.cases() if case.name in ("spring", "bounce")]
    monkeypatch.setattr(golden, "cases", lambda: chosen)
    assert golden.write("A reason.", quiet)
    assert golden.record_troubles() == []
    digest = golden.digest(json.loads(record.read_text()))
    assert f"- `{digest}` A reason." in golden.CHANGELOG.read_text()
    assert not golden.write("Nothing changed.", quiet)


def test_writing_without_a_reason_changes_nothing(record: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chosen = [case for case in golden.cases() if case.name == "spring"]
    monkeypatch.setattr(golden, "cases", lambda: chosen)
    before = record.read_text()
    with pytest.raises(UserError, match="reason"):
        golden.write(" ", quiet)
    assert record.read_text() == before


def test_lines_go_to_the_unreleased_section_newest_first() -> None:
    text = golden.with_line(golden.with_line(EMPTY, "aaaaaaaa", "First."), "bbbbbbbb", "Second.")
    unreleased = text.partition("## [0.1.0]")[0]
    assert unreleased.endswith("- A thing.\n\n### State hashes\n\n- `bbbbbbbb` Second.\n- `aaaaaaaa` First.\n\n")
    assert text.endswith("- `aaaaaaaa` First.\n\n" + OLD)
    assert golden.newest_digest(text) == "bbbbbbbb"


def test_the_same_reason_twice_is_one_line() -> None:
    text = golden.with_line(golden.with_line(EMPTY, "aaaaaaaa", "Why."), "bbbbbbbb", "Why.")
    assert "aaaaaaaa" not in text
    assert text.count("Why.") == 1
