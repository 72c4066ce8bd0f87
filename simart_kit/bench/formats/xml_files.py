"""Reading XML files of others without being hurt by them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element, ParseError, TreeBuilder, XMLParser, parse

import numpy as np

from ...arrays import FloatArray
from ...errors import BadInputError


class _NoDoctype(TreeBuilder):
    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        """Entities, which make bombs and read other files, need one; robots have none."""
        raise BadInputError("it has a DOCTYPE, which is refused: remove it")


def read_xml(path: Path, tag: str) -> Element:
    """The root element of a file.

    Args:
        path: an XML file.
        tag: that the root must have.

    Raises:
        BadInputError: missing, no well-formed XML, another root, or a DOCTYPE; without the file's name.
    """
    try:
        root = parse(path, XMLParser(target=_NoDoctype())).getroot()
    except (ParseError, ValueError, OSError) as error:
        raise BadInputError(f"it is missing or no well-formed XML: {error}") from error
    if root is None or root.tag != tag:
        raise BadInputError(f"its root is not <{tag}>")
    return root


def numbers(element: Element, attribute: str, count: int, default: str) -> FloatArray:
    """(count,) finite numbers of an attribute; raises BadInputError that quotes it."""
    text = element.get(attribute, default)
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.array([np.nan])
    if values.shape != (count,) or not np.isfinite(values).all():
        raise BadInputError(f'<{element.tag} {attribute}="{text}"> should be {count} finite number(s)')
    return values


def nan_attributes(root: Element) -> Iterator[str]:
    """Each attribute that has NaN among its numbers, as text."""
    for element in root.iter():
        for attribute, text in element.attrib.items():
            if attribute != "name" and "nan" in text.lower().split():
                yield f'<{element.tag} {attribute}="{text}">'
