# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of arrays with a description: .npz archives, in which NumPy finds the arrays."""

from __future__ import annotations

import contextlib
import io
import json
import os
import secrets
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ._core import Error, IoError


def write(
    path: str | os.PathLike[str],
    member: str,
    description: dict[str, Any],
    arrays: Mapping[str, np.ndarray],
    level: int | None = None,
) -> None:
    """Writes the description to a member of that name, as JSON, and the arrays beside it.

    `level`: of the compression. The file appears when it is complete. Raises IoError, which names
    it.
    """
    try:
        text = json.dumps(description, default=_plain, indent=1)
        with (
            _replacing(path) as file,
            zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as archive,
        ):
            archive.writestr(member, text)
            for name, array in arrays.items():
                with archive.open(f"{name}.npy", "w", force_zip64=True) as content:
                    np.lib.format.write_array(content, array, allow_pickle=False)
    except (OSError, ValueError, TypeError) as error:
        raise IoError(f"cannot write {os.fspath(path)}: {_reason(error)}") from error


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Writes a text file, or to what is no regular file, such as /dev/stdout.

    The file appears when it is complete. Raises IoError, which names it.
    """
    try:
        special = os.path.exists(path) and not os.path.isfile(path)
        with open(path, "wb") if special else _replacing(path) as file:
            file.write(text.encode())
    except OSError as error:
        raise IoError(f"cannot write {os.fspath(path)}: {_reason(error)}") from error


@contextlib.contextmanager
def reading(
    name: str, kind: str, member: str, file_format: str
) -> Iterator[tuple[dict[str, Any], zipfile.ZipFile]]:
    """The description of a file of that format, and the archive, for read_array().

    Raises IoError, which names the file, for what is not `kind` or damaged, whatever wrong data do
    to the lines that read it.
    """
    foreign = f"cannot read {name}: it is not {kind}"
    try:
        with zipfile.ZipFile(name) as archive:
            if member not in archive.namelist():
                raise IoError(foreign)
            description = json.loads(archive.read(member))
            if not isinstance(description, dict) or description.get("format") != file_format:
                raise IoError(foreign)
            yield description, archive
    except Error:
        raise
    except zipfile.BadZipFile as error:
        raise IoError(f"{foreign}, or damaged") from error
    except OSError as error:
        raise IoError(f"cannot read {name}: {_reason(error)}") from error
    except (
        ArithmeticError,
        AttributeError,
        EOFError,
        LookupError,
        MemoryError,
        RuntimeError,
        TypeError,
        ValueError,
        zipfile.LargeZipFile,
        zlib.error,
    ) as error:
        raise IoError(f"cannot read {name}: it is damaged ({_reason(error)})") from error


def read_array(archive: zipfile.ZipFile, name: str) -> np.ndarray:
    # The whole member at once: zipfile compares the checksum at its end.
    content = io.BytesIO(archive.read(f"{name}.npy"))
    return np.lib.format.read_array(content, allow_pickle=False)


def _plain(value: Any) -> Any:
    """What json does not know as what it knows: NumPy's numbers and arrays."""
    return value.tolist()


def _reason(error: BaseException) -> str:
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error) or type(error).__name__


@contextlib.contextmanager
def _replacing(path: str | os.PathLike[str]):
    """A binary file that takes the place of `path` if all goes well, and vanishes otherwise."""
    target = os.path.realpath(path)
    if os.path.exists(target) and not os.path.isfile(target):
        raise OSError(f"{target} is not a regular file")
    folder, name = os.path.split(target)
    temporary = os.path.join(folder, f".{name[:60]}.{os.getpid()}-{secrets.token_hex(4)}.tmp")
    try:
        with open(temporary, "xb") as file:
            yield file
        os.replace(temporary, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise
