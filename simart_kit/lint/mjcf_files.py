"""The files that an MJCF names, and its numbers as text."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from xml.etree.ElementTree import Element

from ..bench.formats.xml_files import nan_attributes, read_xml
from ..errors import BadInputError
from .findings import Finding
from .paths import is_absolute, path_finding

_FOLDERS = {"mesh": "meshdir", "hfield": "meshdir", "skin": "meshdir", "texture": "texturedir"}


def models(folder: Path) -> list[Path]:
    """MJCF files at the top of an unpacked archive, or in its one folder."""
    return sorted(folder.glob("*.xml")) or sorted(folder.glob("*/*.xml"))


def file_findings(path: Path) -> Iterator[Finding]:
    """Breaches by the names of files, and by NaN.

    Raises:
        BadInputError: the file itself cannot be read.
    """
    roots: list[Element] = []
    yield from _included(path, path.parent, roots)
    settings = _settings(roots)
    for root in roots:
        for text in nan_attributes(root):
            yield Finding("number-invalid", "", f"{text} should have finite numbers")
        for element in root.iter():
            yield from _element_findings(element, path.parent, settings)


def _included(path: Path, root: Path, roots: list[Element]) -> Iterator[Finding]:
    """Read a file and all that it includes into `roots`; breaches by the names of those."""
    waiting, seen = [path], {path.resolve()}
    while waiting:
        file = waiting.pop()
        try:
            roots.append(read_xml(file, "mujoco" if file == path else _root_tag(roots)))
        except BadInputError as error:
            if file == path:
                raise
            yield Finding("unreadable", file.name, f"{error}")
            continue
        for include in roots[-1].iter("include"):
            name = include.get("file", "")
            found = path_finding(name, root, root, "include")
            target = (root / name).resolve()
            if found:
                yield found
            elif target not in seen:
                seen.add(target)
                waiting.append(target)


def _root_tag(roots: list[Element]) -> str:
    """Included files have the root of the one that includes them; older ones <mujocoinclude>."""
    return roots[0].tag


def _settings(roots: list[Element]) -> dict[str, str]:
    """Attributes of all `<compiler>` elements; later ones win."""
    found: dict[str, str] = {}
    for root in roots:
        for compiler in root.iter("compiler"):
            found |= compiler.attrib
    return found


def _element_findings(element: Element, root: Path, settings: dict[str, str]) -> Iterator[Finding]:
    setting = _FOLDERS.get(element.tag)
    names = [text for key, text in element.attrib.items() if key.startswith("file") and text]
    if element.tag == "model":
        names, setting = [element.get("file", "")], ""
    if setting is None:
        return
    for name in names:
        where = element.get("name") or name
        if settings.get("strippath") == "true":
            name = PurePosixPath(name.replace("\\", "/")).name
        folder = settings.get(setting, settings.get("assetdir", ""))
        if is_absolute(folder):
            yield Finding("file-absolute", where, f"{setting} '{folder}' is absolute: name it relatively")
            continue
        found = path_finding(name, root / folder, root, where)
        if found:
            yield found
