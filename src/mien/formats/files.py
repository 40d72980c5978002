"""Bytes from and to disk: errors that say what to do, and files that appear whole or not at all."""

import secrets
from pathlib import Path

from ..errors import FormatError


def read(path: Path) -> bytes:
    """Return the bytes of a file; ``FormatError`` when it is missing, a folder or not readable."""
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise FormatError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise FormatError(f"{path} is a folder; give a file in it") from None
    except PermissionError:
        raise FormatError(f"{path}: no permission to read it") from None
    except (OSError, ValueError) as error:
        raise FormatError(f"{path}: cannot be read ({error})") from None


def check_target(path: Path, *, force: bool) -> None:
    """Raise ``FormatError`` unless ``path`` may be written: its folder exists, and nothing is lost."""
    if path.is_dir():
        raise FormatError(f"{path} is a folder; give the name of the file to write in it")
    check_folder(path.parent)
    if not path.parent.is_dir():
        raise FormatError(f"{path}: there is no folder {path.parent}; make it first")
    if path.exists() and not force:
        raise exists_already(path)


def check_folder(folder: Path) -> None:
    """Raise ``FormatError`` when ``folder``, or what it would lie in, is a file."""
    there = next((path for path in (folder, *folder.parents) if path.exists()), folder)
    if there.exists() and not there.is_dir():
        raise FormatError(f"{there} is a file, not a folder")


def exists_already(path: Path, *, more: int = 0) -> FormatError:
    """Return the error for a file that would be lost, and how many ``more`` would be."""
    others = f" (and {more} more)" if more else ""
    return FormatError(
        f"{path}{others} exists already: give another name, or allow replacing it "
        "(--force, in Python force=True)"
    )


def write(path: Path, data: bytes) -> None:
    """Write ``data`` beside ``path`` and move it into place, so that no half-written file is ever seen."""
    target = path.resolve()  # a link stays a link: what it points to is replaced
    # Named before it is there: an interrupt at any moment still finds it to take away.
    temporary = target.with_name(f".mien-{secrets.token_hex(8)}")
    try:
        with temporary.open("xb") as file:
            file.write(data)
        if target.exists():
            temporary.chmod(target.stat().st_mode & 0o777)
        temporary.replace(target)
    except OSError as error:
        raise FormatError(f"{path}: cannot be written ({error.strerror or error})") from None
    finally:
        temporary.unlink(missing_ok=True)
