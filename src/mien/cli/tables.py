"""Tables for other programs: CSV, and Parquet where pyarrow is there."""

import csv
from collections.abc import Mapping, Sequence
from importlib import import_module
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

from ..errors import MienError
from ..formats import files

TABLES = (".csv", ".parquet")
Columns = Mapping[str, Sequence[Any]]


def checked_table(path: Path) -> Path:
    """Return ``path`` if a table can be written to a file of that name; raise ``MienError`` otherwise."""
    if path.suffix.lower() not in TABLES:
        raise MienError(f"{path}: a table is {' or '.join(TABLES)}")
    if path.suffix.lower() == ".parquet":
        _pyarrow(path)
    files.check_folder(path.parent)
    return path


def write_table(path: Path, columns: Columns) -> None:
    """Write columns of equal length as the kind of table that the name says, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write(
        path, _parquet(path, columns) if path.suffix.lower() == ".parquet" else as_csv(columns).encode()
    )


def as_csv(columns: Columns) -> str:
    """Return columns as CSV with a line of names; numbers with all their digits."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values(), strict=True))
    return out.getvalue()


def _parquet(path: Path, columns: Columns) -> bytes:
    arrow, out = _pyarrow(path), BytesIO()
    import_module("pyarrow.parquet").write_table(arrow.table(dict(columns)), out)
    return out.getvalue()


def _pyarrow(path: Path) -> Any:
    try:
        return import_module("pyarrow")
    except ImportError:
        raise MienError(f"{path}: Parquet needs pyarrow: pip install pyarrow (or write a .csv)") from None
