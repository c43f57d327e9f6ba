"""The constants of the arithmetic are the ones their script derives."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tools" / "derive" / "arith_tables.py"


def check(source: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(SCRIPT), "--check", str(source)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_source_holds_the_derived_constants() -> None:
    result = check(ROOT / "src" / "arith_fixed.c")
    assert result.returncode == 0, result.stderr


def test_a_changed_constant_is_noticed(tmp_path: Path) -> None:
    text = (ROOT / "src" / "arith_fixed.c").read_text(encoding="utf-8")
    changed = tmp_path / "arith_fixed.c"
    changed.write_text(text.replace("#define SINE_7 (-77046)", "#define SINE_7 (-77047)"), encoding="utf-8")
    result = check(changed)
    assert result.returncode == 1
    assert "SINE_7" in result.stderr
