# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that Blender writes, whole or not at all: of a full disk it tells nobody.

Knows nothing of the rest of the add-on: scenes/driver uses it without.
"""

import contextlib
import errno
import os

ROOM = 1 << 16  # bytes


@contextlib.contextmanager
def whole_file(path: str):
    """Gives another name, to be written to, in the same folder and with the same ending.

    In the end the file has its own name. Raises OSError if the disk is full then; what was there
    before stays.
    """
    folder, name = os.path.split(os.path.realpath(path))
    temporary = os.path.join(folder, f".{os.getpid()}_{name}")
    try:
        yield temporary
        try:
            _require_room(temporary)
            os.replace(temporary, os.path.join(folder, name))
        except OSError as error:
            raise OSError(error.errno, error.strerror, path) from error
    finally:
        with contextlib.suppress(OSError):
            os.unlink(temporary)


def _require_room(written: str) -> None:
    """A file that did not fit has taken all that there was, or is empty."""
    before = os.path.getsize(written)
    if before == 0:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    with open(written, "ab") as file:
        file.write(bytes(ROOM))
        file.flush()
        os.fsync(file.fileno())
        file.truncate(before)
