"""The kept errors of the arithmetic: a sample comes out as it was kept, and what was asked for holds."""

from __future__ import annotations

import dataclasses

import pytest
from cairn_tools.accuracy import arithmetic
from cairn_tools.errors import UserError


@pytest.fixture(scope="module")
def kept() -> list[arithmetic.Row]:
    return arithmetic.measure(lambda text: None)


def test_a_sample_comes_out_as_it_was_kept(kept):
    names = [row.operation for row in kept]
    assert len(names) == len(set(names))
    assert set(arithmetic.LIMITS) <= set(names)


def test_every_operation_is_within_its_bound(kept):
    assert [(row.operation, row.largest) for row in kept if not row.passes] == []


def test_what_takes_one_argument_was_measured_at_all_of_them(kept):
    roots = next(row for row in kept if row.operation == "real_sqrt")
    assert roots.every_argument and roots.results == 2**31


def test_a_row_beyond_its_limit_does_not_pass(kept):
    row = next(row for row in kept if row.operation == "real_mul")
    assert not dataclasses.replace(row, largest=0.51).passes


def test_ours_and_theirs_have_a_table_each(kept):
    grids = arithmetic.tables(kept)
    assert [grid.row_count for grid in grids] == [sum(row.ours for row in kept), sum(not row.ours for row in kept)]


def test_another_arithmetic_is_told_from_the_kept_one(kept, tmp_path, monkeypatch):
    file = tmp_path / "errors.json"
    monkeypatch.setattr(arithmetic, "KEPT", file)
    sample = list(arithmetic.run(arithmetic.SAMPLE, lambda text: None))
    arithmetic.keep([dataclasses.replace(row, rms=row.rms * 1.001) for row in sample], kept)
    with pytest.raises(UserError, match="comes out otherwise"):
        arithmetic.measure(lambda text: None)
    arithmetic.keep([*sample, dataclasses.replace(sample[0], operation="real_gone")], kept)
    with pytest.raises(UserError, match="real_gone is measured no more"):
        arithmetic.measure(lambda text: None)
    file.write_text("{}")
    with pytest.raises(UserError, match="cannot be read"):
        arithmetic.measure(lambda text: None)
