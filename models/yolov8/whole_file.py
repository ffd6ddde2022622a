"""Files that are written whole or not at all: a reader never sees half of one, nor does an interruption leave one."""
import contextlib
import os
import pathlib


@contextlib.contextmanager
def whole(path):
    """The name of a file beside `path` to write; at the end it takes the place of `path`, after a fault it is gone.
    Raises OSError, which names `path`."""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    try:
        yield part
        with open(part, "rb+") as stream:
            os.fsync(stream.fileno())
        os.replace(part, path)
    except OSError as fault:
        raise OSError(f"{path} cannot be written: {fault}") from None
    finally:
        part.unlink(missing_ok=True)
