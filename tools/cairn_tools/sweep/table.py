"""The results file: CSV or Parquet by its ending, and beside it the rows of a sweep that is not at its end.

A Parquet file is written as a whole, so each row goes to FILE.rows first, one line of JSON a row, and at the end, or
when the sweep is stopped, all go into the file. A sweep that was killed finds its rows there.
"""

from __future__ import annotations

import fcntl
import json
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path
from types import TracebackType
from typing import Any

import pandas as pd

from ..errors import UserError
from .measure import COLUMNS, KEY, Measured, Row, build
from .settings import Job, Settings

ENDINGS = (".csv", ".parquet")
# How pandas reads and writes the columns: whole numbers that may be missing stay whole.
_PANDAS = {"str": "str", "float": "float64", "int": "int64", "bool": "bool", "int | None": "Int64",
           "float | None": "float64"}  # fmt: skip
TYPES = {name: "str" for name in ("scene", "digest", "build")} | {"seconds": "float64"}
TYPES |= {part.name: _PANDAS[str(part.type)] for part in (*fields(Settings), *fields(Measured))}

Record = dict[str, Any]


class Results:
    """The rows of a file that are there, and a place for new ones."""

    def __init__(self, file: Path, jobs: list[Job], seconds: float) -> None:
        if file.suffix not in ENDINGS:
            raise UserError(f"{file}: the results are written as {' or '.join(ENDINGS)}")
        self.file = file
        self.journal = file.with_name(file.name + ".rows")
        try:
            # Read and write, and never cut: the rows of a run that was killed are in it.
            self._lines = self.journal.open("a+", encoding="utf-8")
        except OSError as error:
            raise UserError(f"{self.journal}: {error.strerror}") from None
        try:
            self._take_lock()
            self.rows = {_key(record): record for record in (*self._of_file(), *self._of_journal())}
            self._check(jobs, seconds)
        except BaseException:
            self._leave()
            raise

    def __enter__(self) -> Results:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: BaseException | TracebackType | None) -> None:
        self.write()
        self._leave()

    def add(self, row: Row) -> None:
        record = row.flat()
        self.rows[_key(record)] = record
        self._lines.write(json.dumps(record) + "\n")
        self._lines.flush()

    def write(self) -> None:
        """All rows into the file, at once or not at all, in an order that does not tell who came first."""
        if not self.rows:
            return
        table = as_table(sorted(self.rows.values(), key=_order))
        beside = self.file.with_name(self.file.name + ".new")
        try:
            if self.file.suffix == ".csv":
                table.to_csv(beside, index=False)
            else:
                table.to_parquet(beside, index=False)
            beside.replace(self.file)
        except OSError as error:
            raise UserError(f"{self.file}: {error.strerror or error}") from None
        self._lines.truncate(0)

    def _take_lock(self) -> None:
        try:
            fcntl.flock(self._lines, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UserError(f"{self.file}: another sweep is writing it") from None

    def _leave(self) -> None:
        """An empty journal is not left behind."""
        if self.journal.exists() and self.journal.stat().st_size == 0:
            self.journal.unlink()
        self._lines.close()

    def _of_file(self) -> Iterable[Record]:
        return read(self.file).to_dict("records") if self.file.exists() else []

    def _of_journal(self) -> Iterable[Record]:
        """Its whole lines: the last one may be torn, and is cut off."""
        self._lines.seek(0)
        text = self._lines.read()
        whole = text[: text.rfind("\n") + 1]
        if whole != text:
            self._lines.truncate(len(whole.encode()))
        try:
            records = [json.loads(line) for line in whole.splitlines()]
        except ValueError:
            records = [{}]
        if any(tuple(record) != COLUMNS for record in records):
            raise UserError(f"{self.journal}: not the rows of a sweep")
        return records

    def _check(self, jobs: list[Job], seconds: float) -> None:
        """Whether what is there may stand in one table with the rows to come."""
        digests = {job.scene: job.digest for job in jobs}
        for record in self.rows.values():
            name = record["scene"]
            if record["build"] != build():
                raise UserError(f"{self.file}: holds a sweep of another engine, build {record['build']}, not {build()}")
            if record["seconds"] != seconds:
                raise UserError(f"{self.file}: holds a sweep of {record['seconds']:g} s, not of {seconds:g} s")
            if digests.get(name, record["digest"]) != record["digest"]:
                raise UserError(f"{self.file}: holds a sweep of another scene named {name}")


def read(file: Path) -> pd.DataFrame:
    """A results file, or one line on what is wrong with it."""
    try:
        if file.suffix == ".csv":
            lacking = {name: [""] for name, kind in TYPES.items() if kind in ("Int64", "float64")}
            table = pd.read_csv(file, dtype=TYPES, keep_default_na=False, na_values=lacking)
        else:
            table = pd.read_parquet(file)
    except OSError as error:
        raise UserError(f"{file}: {error.strerror or 'not a Parquet file'}") from None
    except Exception:  # whatever pandas and pyarrow stumble over
        raise UserError(f"{file}: not a results file of a sweep") from None
    if tuple(table.columns) != COLUMNS:
        raise UserError(f"{file}: not a results file of a sweep, or of another version: other columns")
    return table


def as_table(records: Iterable[Record]) -> pd.DataFrame:
    return pd.DataFrame(list(records), columns=list(COLUMNS)).astype(TYPES)


def _key(record: Record) -> tuple[Any, ...]:
    return tuple(record[name] for name in KEY)


def _order(record: Record) -> list[Any]:
    return [record[name] for name in KEY]
