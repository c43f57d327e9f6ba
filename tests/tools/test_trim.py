"""tools/cairn trim: what it finds that a scene needs, the folder it writes, and that bad input writes nothing."""

import json
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from cairn_tools import engine, footprint_record, scene, trim
from cairn_tools.errors import UserError

ROOT = Path(__file__).parents[2]
WISH = trim.Wish(60, 20, None, (), None, None)


def named(name: str) -> scene.Scene:
    return scene.load(scene.find(name))


def needs(*names: str, wish: trim.Wish = WISH) -> trim.Needs:
    return needs_of([named(name) for name in names], wish)


def needs_of(scenes: list[scene.Scene], wish: trim.Wish = WISH) -> trim.Needs:
    return trim.needs_of(scenes, [engine.run(one, "q16", "host", wish.steps, 1) for one in scenes], wish)


def test_round_bodies_need_one_point_and_only_what_they_use() -> None:
    found = needs("curtain150")
    on = {name for name, value in found.options.items() if name.startswith("CAIRN_WITH") and value}
    assert on == {f"CAIRN_WITH_{name}" for name in ("SOFT_SOLVER", "SPRINGS", "FRICTION", "TURNING", "SORT")}
    assert found.options["CAIRN_MAX_POINTS"] == 1
    assert found.pools == {"bodies": 150, "arbiters": 1, "springs": 261}


def test_several_scenes_need_what_any_of_them_does() -> None:
    found = needs("curtain150", "stack10")
    assert found.options["CAIRN_WITH_SPRINGS"] == 1
    assert found.options["CAIRN_MAX_POINTS"] == 2
    assert found.pools["arbiters"] >= 12  # ten contacts and a fifth more


def test_upright_boxes_that_move_need_slopes_where_something_turns() -> None:
    found = needs("stack10").options
    assert (found["CAIRN_WITH_TURNING"], found["CAIRN_WITH_SLOPES"], found["CAIRN_WITH_POLYGONS"]) == (1, 1, 0)


SOLVERS = ("SOFT_SOLVER", "SLIDES_SOLVER", "SMALL_SOLVER", "SETTINGS")


@pytest.mark.parametrize(
    ("settings", "wanted"),
    [
        ([{}], (1, 0, 0, 0)),
        ([{"solver": "small"}], (0, 0, 1, 0)),
        ([{"solver": "slides"}], (0, 1, 0, 0)),
        ([{"solver": "small", "substeps": 8}], (0, 0, 1, 0)),  # which are the soft solver's
        ([{"solver": "small", "passes": 5}], (0, 0, 1, 1)),
        ([{"passes": 5}], (1, 0, 0, 0)),
        ([{"solver": "small"}, {"solver": "slides"}], (0, 1, 1, 0)),
        ([{"solver": "small"}, {}], (1, 0, 1, 1)),
    ],
)
def test_a_build_has_the_solvers_of_its_scenes(settings: list[dict[str, object]], wanted: tuple[int, ...]) -> None:
    found = needs_of([replace(named("stack10"), **changes) for changes in settings])
    assert tuple(found.options[f"CAIRN_WITH_{name}"] for name in SOLVERS) == wanted
    accepted(found)


def test_blocks_are_of_the_soft_solver() -> None:
    small = replace(named("heavy100"), solver="small")
    assert needs_of([named("heavy100")]).options["CAIRN_WITH_BLOCKS"] == 1
    assert needs_of([small]).options["CAIRN_WITH_BLOCKS"] == 0
    kept = needs_of([small], replace(WISH, keep=("blocks",)))
    assert kept.options["CAIRN_WITH_BLOCKS"] == kept.options["CAIRN_WITH_SOFT_SOLVER"] == 1
    accepted(kept)


def accepted(found: trim.Needs) -> None:
    """By config.h."""
    command = ["gcc", "-std=c99", "-fsyntax-only", "-x", "c", f"-I{ROOT / 'include'}", "-"]
    command += [f"-D{name}={value}" for name, value in found.options.items()]
    subprocess.run(command, input="#include <cairn/cairn.h>\n", text=True, check=True)


def test_what_the_user_keeps_stays() -> None:
    assert needs("stack10").options["CAIRN_WITH_SLEEP"] == 0
    assert needs("stack10", wish=replace(WISH, keep=("sleep",))).options["CAIRN_WITH_SLEEP"] == 1


def test_fast_bodies_need_continuous_collision_within_the_margin() -> None:
    assert needs("projectile").options["CAIRN_WITH_CONTINUOUS"] == 1
    assert needs("stack10").options["CAIRN_WITH_CONTINUOUS"] == 0


def test_sub_steps_are_the_fewest_within_the_tolerance() -> None:
    found, error = trim.with_substeps(named("stack10"), replace(WISH, tolerance=0.01), print)
    assert error <= 0.01
    assert 1 <= found.substeps <= 16


def test_a_tolerance_that_nothing_holds_is_refused() -> None:
    with pytest.raises(UserError, match="no sub-steps keep it within 1e-12 m"):
        trim.with_substeps(named("projectile"), replace(WISH, tolerance=1e-12), print)


def test_another_solver_is_held_to_the_tolerance_as_well() -> None:
    small = replace(named("stack10"), solver="small")
    found, error = trim.with_substeps(small, replace(WISH, tolerance=0.03), print)
    assert found == small
    assert 0.01 < error <= 0.03  # its slop
    with pytest.raises(UserError, match=r"the small solver does not keep it within 0.001 m .* it is 0.02"):
        trim.with_substeps(small, replace(WISH, tolerance=0.001), print)


def crowd(folder: Path, count: int) -> Path:
    """Discs all in one place: more pairs than the pool of arbiters has room for."""
    body = {"shape": "disc", "position": [0, 0]}
    data = {"cairn_scene": 1, "name": "crowd", "shapes": {"disc": {"circle": 0.5}}, "bodies": [body] * count}
    file = folder / "crowd.json"
    file.write_text(json.dumps(data), encoding="utf-8")
    return file


def test_a_scene_that_overflows_its_pool_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="overflows the pool of arbiters"):
        trim.peaks(scene.load(crowd(tmp_path, 40)), replace(WISH, steps=2), print)


def refused(tmp_path: Path, *words: object) -> str:
    """The one line that the command says; it wrote nothing."""
    out = tmp_path / "trimmed"
    command = [ROOT / "tools" / "cairn", "trim", *map(str, words), "--out", out]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert not out.exists()
    return done.stderr


def test_an_impossible_tolerance_and_an_overflow_are_refused_and_nothing_is_written(tmp_path: Path) -> None:
    assert "no sub-steps keep it within 1e-12 m" in refused(tmp_path, "rolling", "--tolerance", "1e-12", "--steps", 30)
    assert "overflows the pool of arbiters" in refused(tmp_path, crowd(tmp_path, 40), "--steps", 2)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no_such_scene"], "no such scene file"),
        (["stack10", "--tolerance", "-1"], "must be above zero"),
        (["stack10", "--tolerance", "nan"], "must be above zero"),
        (["stack10", "--keep", "magic"], "no such feature"),
        (["stack10", "--margin", "-5"], "--margin"),
    ],
)
def test_bad_input_gives_one_line_and_writes_nothing(tmp_path: Path, words: list[str], said: str) -> None:
    assert said in refused(tmp_path, *words)


def test_an_unknown_field_gives_one_line_and_writes_nothing(tmp_path: Path) -> None:
    file = tmp_path / "bad.json"
    file.write_text('{"cairn_scene": 1, "name": "bad", "shapes": {}, "bodies": [], "gravty": 1}', encoding="utf-8")
    assert "gravty: unknown field" in refused(tmp_path, file)


@pytest.mark.parametrize("name", ["tower", "balls50", "curtain150"])
def test_pools_of_known_scenes_take_at_least_30_percent_less(name: str) -> None:
    types = {kind.removeprefix("cairn_"): size for kind, size in footprint_record.read()["types"].items()}
    fixed, body, arbiter = footprint_record.world_bytes({f"cairn_{kind}": size for kind, size in types.items()})
    found, bodies = needs(name, wish=replace(WISH, steps=120)).pools, len(named(name).bodies)
    springs = found.get("springs", 0) * types["spring"]
    before = fixed + bodies * body + (4 * bodies + 16) * arbiter + springs  # as tools/runner gives it
    after = fixed + found["bodies"] * body + found["arbiters"] * arbiter + springs
    assert after <= 0.7 * before


def test_the_trimmed_tower_and_a_recorded_run_of_it_are_smaller_with_the_same_bits(tmp_path: Path) -> None:
    file = tmp_path / "visit.jsonl"
    bodies = len(named("tower").bodies)
    spawn = {"step": 2, "spawn": {"shape": "column", "position": [20, 20]}}
    impulse, remove = {"step": 4, "impulse": [0.5, 1], "body": bodies}, {"step": 15, "remove": bodies - 1}
    lines = [{"cairn_run": 1, "scene": "tower"}, spawn, impulse, remove]
    file.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
    scenes = [named("tower"), trim.load(str(file))]
    wish = replace(WISH, steps=20)
    _, rows = trim.trim(scenes, wish, tmp_path / "trimmed", print)
    for loaded, row in zip(scenes, rows, strict=True):
        assert row.before.hash == row.after.hash == engine.run(loaded, "q16", "host", 20, 0).hash
        assert row.ram_saved >= 0.3
        assert row.flash_saved > 0
    row = rows[0]
    assert row.after.hash != rows[1].after.hash
    tables = {"scene.c", "scene_tower.c", "scene_visit.c"}
    names = {"cairn_trim.h", "cairn_trim_scenes.h", *tables, "trim.cmake", "SUMMARY.json"}
    assert {file.name for file in (tmp_path / "trimmed").iterdir()} == names
    with pytest.raises(UserError, match="bytes of flash"):
        trim._check_limits([row.after], replace(wish, flash=100))


@pytest.mark.parametrize(("solver", "passes"), [("small", 10), ("slides", 6)])
def test_a_scene_of_another_solver_has_the_same_bits_without_the_soft_one(
    solver: str, passes: int, tmp_path: Path
) -> None:
    """Balls, boxes and polygons that bounce and rub; a third of the flash and more goes."""
    data = json.loads(scene.find("mixed50").read_text(encoding="utf-8")) | {"solver": solver, "passes": passes}
    rubber = {"static_friction": 0.5, "kinetic_friction": 0.4, "restitution": 0.6}
    file = tmp_path / f"{solver}.json"
    file.write_text(json.dumps(data | {"name": solver, "materials": {"default": rubber}}), encoding="utf-8")
    loaded = scene.load(file)
    found, (row,) = trim.trim([loaded], replace(WISH, steps=40), tmp_path / "trimmed", print)
    assert row.before.hash == row.after.hash == engine.run(loaded, "q16", "host", 40, 0).hash
    assert row.after.hash != engine.run(replace(loaded, solver="soft"), "q16", "host", 40, 0).hash
    assert found.options["CAIRN_WITH_SOFT_SOLVER"] == 0
    assert found.options["CAIRN_WITH_BOUNCE"] == found.options["CAIRN_WITH_POLYGONS"] == 1
    assert row.flash_saved > 0.33
