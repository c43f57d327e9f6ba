"""tools/cairn footprint: what it holds to the record, that a planted call would be seen, and the README's tables."""

import json
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from cairn_tools import call_graph, footprint, footprint_record
from cairn_tools.errors import UserError
from cairn_tools.footprint import SETS, Row

ROOT = Path(__file__).parents[2]
BALLS = next(entry for entry in SETS if entry.name == "balls")
ROW = Row("m0", "balls", "balls only", 20_000, 300, 2_000, 500, None, None, None)
TYPES = {f"cairn_{name}": size for size, name in enumerate(footprint.TYPES, 10)}


def kept(flash: int = 20_000, ram: int = 2_000) -> footprint_record.Record:
    return {"m0": {"balls": {"flash": flash, "constants": 300, "ram": ram, "stack": 500}}}


def wrong(checks: list[footprint_record.Check]) -> list[str]:
    return [f"{what}: {said}" for what, said in checks if said]


@pytest.mark.parametrize("flash", [19_608, 20_000, 20_400])
def test_two_percent_more_or_less_pass(flash: int) -> None:
    assert wrong(list(footprint_record.size_checks([replace(ROW, flash=flash)], kept()))) == []


@pytest.mark.parametrize("flash", [19_599, 20_401])
def test_what_changes_by_more_than_two_percent_fails_a_gain_too(flash: int) -> None:
    told = wrong(list(footprint_record.size_checks([replace(ROW, flash=flash)], kept())))
    assert told == [f"balls on m0: {flash:,} bytes of flash, on record 20,000"]


def test_ram_is_held_and_what_is_not_on_record_is_told() -> None:
    told = wrong(list(footprint_record.size_checks([replace(ROW, ram=2_100), replace(ROW, core="m3")], kept())))
    assert told == ["balls on m0: 2,100 bytes of ram, on record 2,000", "balls on m3: not on record"]


@pytest.mark.parametrize(
    "name", [n for n, f in footprint.FEATURES.items() if (f.files or f.functions) and n not in BALLS.features]
)
def test_a_function_of_each_feature_in_a_game_of_balls_is_a_stranger(name: str) -> None:
    feature = footprint.FEATURES[name]
    planted = feature.functions[0] if feature.functions else "planted"
    found = {"cairn_world_step": "world.c", planted: f"{(*feature.files, 'body')[0]}.c"}
    assert footprint.strangers(BALLS.features, found) == [planted]
    assert footprint.strangers((*BALLS.features, name), found) == []


def test_a_ball_in_a_game_of_boxes_is_a_stranger() -> None:
    boxes = next(entry for entry in SETS if entry.name == "boxes")
    assert footprint.strangers(boxes.features, {"area": "shape_circle.c"}) == ["area"]


def test_nothing_of_the_soft_solver_nor_its_bounces_is_in_a_game_without_it() -> None:
    small = [entry for entry in SETS if footprint.WITHOUT_SOFT in entry.options]
    assert {entry.name for entry in small} == {"shapes_small", "balls_walls_small", "everything_small"}
    for entry in small:
        for file in ("solver_soft", "sweep", "sweep_careful", "sweep_quick", "slide", "hold", "idle",
                     "bounce", "bounce_meet", "bounce_strike"):  # fmt: skip
            assert footprint.strangers(entry.features, {"planted": f"{file}.c"}, entry.options) == ["planted"]
        assert footprint.strangers(entry.features, {"solve": "solver_small.c"}, entry.options) == []
    shapes = next(entry for entry in SETS if entry.name == "shapes")
    assert footprint.strangers(shapes.features, {"solve": "solver_soft.c", "meet": "bounce.c"}, shapes.options) == []


def test_a_table_is_known_by_the_file_that_defines_it() -> None:
    known = footprint.constant_names()
    assert known["cairn_polygon_class"] == "shape_polygon.c"
    assert known["cairn_solver_slides"] == known["cairn_solver_small"] == "solver_small.c"


def test_each_file_of_the_engine_is_of_a_feature_or_of_the_core() -> None:
    assert footprint.unplaced_files() == []


def test_names_that_are_foreign_or_not_on_record_fail_and_so_does_a_feature_without_names() -> None:
    found = {entry.name: {"cairn_world_step": "world.c", f"of_{entry.name}": "world.c"} for entry in SETS[1:]}
    found["balls"] |= {"cairn_sleep_enable": "sleep.c", "cairn_new": "body.c"}
    found["sleep"] |= {"cairn_sleep_enable": "sleep.c"}
    names = {entry.name: ["cairn_world_step"] for entry in SETS[1:]}
    names["sleep"].append("cairn_sleep_enable")
    told = wrong(list(footprint_record.name_checks(found, {"names": names})))
    foreign = "cairn_sleep_enable, of a feature that it does not use"
    new = "cairn_new, not on record; cairn_sleep_enable, not on record"
    assert told[0] == f"names in balls: contains {foreign}; {new}"
    assert "seeing quadtree: a game of it has no name that tells it from one without" in told
    assert not any(line.startswith("seeing sleep") for line in told)


def test_without_a_record_the_check_says_so_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(footprint_record, "FILE", tmp_path / "footprint.json")
    with pytest.raises(UserError, match=r"there is no record; tools/cairn footprint --keep makes it"):
        footprint_record.read()
    footprint_record.FILE.write_text("{", encoding="utf-8")
    with pytest.raises(UserError, match="no record: "):
        footprint_record.read()


def test_a_record_is_made_and_cores_not_measured_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(footprint_record, "FILE", tmp_path / "bench" / "footprint.json")
    found = {"balls": {"cairn_world_step": "world.c", "solve": "solver_soft.c", "cairn_clamp": "arith_fixed.h"}}
    footprint_record.write([ROW, replace(ROW, core="rv32")], found, TYPES)
    footprint_record.write([replace(ROW, flash=1)], found, TYPES)
    record = json.loads(footprint_record.FILE.read_text())
    assert (record["m0"]["balls"]["flash"], record["rv32"]["balls"]["flash"]) == (1, 20_000)
    assert record["names"] == {"balls": ["cairn_world_step"]}


def test_the_readme_has_what_the_record_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = {"flash": 1_234, "constants": 10, "ram": 2_000, "stack": 500}
    record = {core: {entry.name: sizes for entry in SETS[1:]} for core in footprint.CORES} | {"types": TYPES}
    monkeypatch.setattr(footprint_record, "README", tmp_path / "README.md")
    footprint_record.README.write_text("nothing\n", encoding="utf-8")
    with pytest.raises(UserError, match="has no lines <!-- by tools/cairn footprint"):
        footprint_record.write_readme(record)
    footprint_record.README.write_text(f"a\n{footprint_record.BEGIN}\n{footprint_record.END}\nb\n", encoding="utf-8")
    assert footprint_record.readme_check(record)[1].startswith("is not what the record says")
    footprint_record.write_readme(record)
    assert footprint_record.readme_check(record)[1] == ""
    text = footprint_record.README.read_text()
    assert (text.startswith("a\n<!--"), text.endswith("-->\nb\n")) == (True, True)
    assert "| balls and walls | 16, 16 | 1,234 | 1,234 | 1,234 | 1,234 | 5,120 | 10 | 2,000 | 2,560 | 500 |" in text
    assert "| `CAIRN_WORLD` | 10 + 13 x bodies + 16 x arbiters | `CAIRN_WORLD_BYTES` |" in text


def test_the_readme_of_the_clone_is_what_its_record_says() -> None:
    assert footprint_record.readme_check(footprint_record.read()) == ("README.md", "")


def test_the_formula_is_held_to_the_game_of_balls() -> None:
    right = 10 + 16 * 13 + 16 * 16
    assert footprint_record.world_check([replace(ROW, ram=right)], TYPES)[1] == ""
    assert footprint_record.world_check([ROW], TYPES)[1] == f"says {right} bytes, and balls takes 2,000"


def test_the_stack_of_an_image_sees_through_its_link(tmp_path: Path) -> None:
    image = tmp_path / "game"
    with pytest.raises(Exception, match="no call graph"):
        call_graph.image_depth(image)
    text = """\
node: { title: "main" label: "main\\n/game.c:1:5\\n8 bytes (static)" }
node: { title: "/tmp/x.ltrans0.o:solve" label: "solve\\n/c/src/solver_soft.c:9:6\\n100 bytes (static)" }
node: { title: "/tmp/x.ltrans0.o:cairn_clamp.lto_priv.0" label: "cairn_clamp\\n/c/arith.h:1:1\\n40 bytes (static)" }
edge: { sourcename: "main" targetname: "__indirect_call" label: "src/world.c:%d:9" }
edge: { sourcename: "/tmp/x.ltrans0.o:solve" targetname: "/tmp/x.ltrans0.o:cairn_clamp.lto_priv.7" label: "a.c:1:1" }
"""
    lines = (ROOT / "src" / "world.c").read_text(encoding="utf-8").splitlines()
    number = next(i for i, line in enumerate(lines, 1) if "solver(world)->solve(" in line)
    (tmp_path / "game.ltrans0.ltrans.ci").write_text(text % number, encoding="utf-8")
    assert call_graph.image_depth(image) == 8 + 100 + 40


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--core", "m7"], "m7"),
        (["--check", "--core", "m3"], "about m0 too"),
        (["--readme", "--keep"], "--readme goes alone"),
    ],
)
def test_bad_input_gives_one_line(words: list[str], said: str) -> None:
    done = subprocess.run([ROOT / "tools" / "cairn", "footprint", *words], capture_output=True, text=True, check=False)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert said in done.stderr


def test_a_core_without_its_compiler_is_told_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(footprint.COMPILERS, "rv32", "no-such-gcc")
    with pytest.raises(UserError, match="rv32 takes no-such-gcc with picolibc: tools/setup --rv32"):
        footprint.build("rv32")
