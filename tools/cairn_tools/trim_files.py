"""The files that `tools/cairn trim` writes: config header, tables, pools, CMake fragment, summary."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from . import engine, trim_recording

if TYPE_CHECKING:
    from .scene import Scene
    from .trim import Needs, Trimmed, Wish

POOLS_FROM = "/* The memory to build it in. */"  # where tools/runner/table.c begins with it


def write(folder: Path, scenes: list[Scene], needs: Needs, wish: Wish) -> None:
    """All but the summary."""
    from .trim import identifier

    folder.mkdir(exist_ok=True)
    names = [identifier(scene) for scene in scenes]
    by = f"Written by tools/cairn trim for {', '.join(scene.name for scene in scenes)}"
    (folder / "cairn_trim.h").write_text(_header(needs, by), encoding="utf-8")
    for scene, name in zip(scenes, names, strict=True):
        table = engine.table(scene, f"scene_{name}").partition(POOLS_FROM)[0]
        if scene.play:
            table = trim_recording.cut(table, scene.play)
        (folder / f"scene_{name}.c").write_text(table, encoding="utf-8")
    (folder / "cairn_trim_scenes.h").write_text(_scene_header(names, by), encoding="utf-8")
    pools = _pools(needs, f"{by}: {wish.steps} steps, {wish.margin:g} % more.")
    (folder / "scene.c").write_text(pools, encoding="utf-8")
    (folder / "trim.cmake").write_text(_fragment(names, by), encoding="utf-8")


def _header(needs: Needs, by: str) -> str:
    lines = [f"/* {by}: what they need of Cairn. Name it by CAIRN_CONFIG, as trim.cmake does. */",
             "#ifndef CAIRN_TRIM_H", "#define CAIRN_TRIM_H", ""]  # fmt: skip
    for name, value in needs.options.items():
        lines += [f"#ifndef {name}", f"#define {name} {value} /* {needs.why[name]} */", "#endif"]
    return "\n".join([*lines, "", "/* config.h checks them with #error. */", "#endif", ""])


def _scene_header(names: list[str], by: str) -> str:
    scenes = "\n".join(f"extern const cairn_scene scene_{name};" for name in names)
    return (
        f"/* {by}. */\n#ifndef CAIRN_TRIM_SCENES_H\n#define CAIRN_TRIM_SCENES_H\n\n#include <scene.h>\n\n{scenes}\n\n"
        "/* The memory to build any of them in. */\nextern const cairn_scene_storage scene_storage;\n\n#endif\n"
    )


def _pools(needs: Needs, by: str) -> str:
    pools = needs.pools
    lines = [f"/* {by} */", "#include <scene.h>", "", f"CAIRN_WORLD(world, {pools['bodies']}, {pools['arbiters']});"]
    springs, tree, blocks = "springs" in pools, "cells" in pools, bool(needs.options["CAIRN_WITH_BLOCKS"])
    if springs:
        lines.append(f"CAIRN_SPRINGS(springs, {pools['springs']});")
    if tree:
        lines.append(f"CAIRN_QUADTREE(quadtree, {pools['bodies']}, {pools['cells']}, {pools['entries']});")
    if blocks:
        lines.append("CAIRN_BLOCKS(blocks);")
    used = {"springs": springs, "quadtree": tree, "blocks": blocks}
    parts = ["&world", *(f"&{name}" if here else "NULL" for name, here in used.items())]
    return "\n".join([*lines, "", "extern const cairn_scene_storage scene_storage;",
                      f"const cairn_scene_storage scene_storage = {{ {', '.join(parts)} }};", ""])  # fmt: skip


def _fragment(names: list[str], by: str) -> str:
    sources = "".join(f'\n    "${{CMAKE_CURRENT_LIST_DIR}}/scene_{name}.c"' for name in names)
    return f"""\
# {by}. Include it after Cairn itself (add_subdirectory or FetchContent), and link
# cairn_trimmed: the tables, their pools and what builds worlds from them. Compile all with -Os -flto.
target_compile_definitions(cairn PUBLIC "CAIRN_CONFIG=\\"${{CMAKE_CURRENT_LIST_DIR}}/cairn_trim.h\\"")
add_library(cairn_trimmed STATIC
    "${{cairn_SOURCE_DIR}}/examples/scene/scene.c"
    "${{CMAKE_CURRENT_LIST_DIR}}/scene.c"{sources})
target_include_directories(cairn_trimmed PUBLIC "${{cairn_SOURCE_DIR}}/examples/scene" "${{CMAKE_CURRENT_LIST_DIR}}")
target_link_libraries(cairn_trimmed PUBLIC cairn::cairn)
"""


def write_summary(folder: Path, needs: Needs, result: list[Trimmed], wish: Wish) -> None:
    (folder / "SUMMARY.json").write_text(json.dumps(record(needs, result, wish), indent=2) + "\n", encoding="utf-8")


def record(needs: Needs, result: list[Trimmed], wish: Wish) -> dict[str, object]:
    rows = [asdict(row) | {"flash_saved": row.flash_saved, "ram_saved": row.ram_saved} for row in result]
    return {"asked": asdict(wish), "options": needs.options, "why": needs.why, "pools": needs.pools,
            "found": [asdict(finding) for finding in needs.found], "scenes": rows}  # fmt: skip
