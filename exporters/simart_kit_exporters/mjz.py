"""MJZ: an MJCF model with all of its files in one zip archive."""

from __future__ import annotations

import shutil
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

ROOT = "model.xml"
_EARLIEST = (1980, 1, 1, 0, 0, 0)


def pack(model: Path) -> Path:
    """Turn a model `NAME.xml` and all that lies beside it into `NAME.mjz`, the only file left in the folder.

    MuJoCo's own encoder stamps the time and orders files by a hash; here equal models give equal bytes.

    Raises:
        OSError: a file cannot be read, written or removed.
    """
    folder, archive = model.parent, model.with_suffix(".mjz")
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path != model)
    with ZipFile(archive, "w") as mjz:
        for path in (model, *files):
            name = ROOT if path == model else path.relative_to(folder).as_posix()
            info = ZipInfo(name, _EARLIEST)
            info.compress_type = ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            mjz.writestr(info, path.read_bytes())
    for path in folder.iterdir():
        if path.is_dir():
            shutil.rmtree(path)
        elif path != archive:
            path.unlink()
    return archive
