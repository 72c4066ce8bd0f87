"""Objects of files with ground truth as a source: PartNet-Mobility, PhysXNet, SIMART-Bench and others."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from simart_kit.asset import Asset, Joint, Limits, Part, clean_name, unique_names
from simart_kit.bench.articulation import FULL_TURN, Articulation, Link, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats import TruthFormat, find_truths
from simart_kit.bench.formats.simart_bench import without_hidden
from simart_kit.bench.frame import same_faces
from simart_kit.errors import BadInputError
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh, canonical
from simart_kit.plugins import Plugins
from simart_kit.stages import PartGuess

from .part_facts import plain_words
from .source_object import PartWords, SourceObject, UnusableError
from .stated import NOTHING_SAID, Stated, StatedPart, stated


@dataclass(frozen=True, slots=True)
class TruthJob:
    """An object of a file.

    Attributes:
        key: of the object.
        reader: of its truth.
        path: for that reader.
        name: of the object in its data set.
    """

    key: str
    reader: TruthFormat
    path: Path
    name: str

    def make(self) -> SourceObject:
        """The object in the pose of the file.

        Raises:
            UnusableError: it cannot be read, or its truth leaves open how it moves.
        """
        try:
            truth = self.reader.read(self.path)
        except BadInputError as error:
            raise UnusableError("cannot be read", str(error)) from error
        return source_object(truth, self.key, self.reader.name, stated(self.reader.name, self.path))


def truth_jobs(folder: Path) -> tuple[TruthJob, ...]:
    """All objects below a folder; raises BadInputError where there is none, or no such folder."""
    found = find_truths(folder)
    return tuple(
        TruthJob(f"{reader.name}-{_key(name)}", reader, path, name) for name, (reader, path) in found.items()
    )


def source_object(truth: Truth, key: str, source: str, told: Stated = NOTHING_SAID) -> SourceObject:
    """An object with ground truth in the canonical frame; links that are fixed to each other are one part.

    The size is the file's; a unit that nobody stated is taken for a metre. It has the looks of its file where
    that has the faces of the truth, else none.

    Args:
        truth: of a reader.
        key: for the data set.
        source: name of the data set's format.
        told: what the data set says of it beside the truth.

    Raises:
        UnusableError: its truth is points, leaves open how it moves, or its body has no surface.
    """
    if truth.articulation.is_cloud:
        raise UnusableError("no faces", f"{key} is a cloud of points")
    known = _single_root(without_hidden(truth.articulation.rigid())[0], key)
    mesh, known = _looks(truth, known) or _plain(truth, known)
    names = unique_names([_name(link, number) for number, link in enumerate(known.links)])
    parts = tuple(Part(name, link.label) for name, link in zip(names, known.links, strict=True))
    joints = tuple(
        _joint(link, names[number], names[link.parent], key)
        for number, link in enumerate(known.links)
        if link.parent >= 0
    )
    # What belongs to no part is the root's: it stays where it is whatever moves.
    root = next(number for number, link in enumerate(known.links) if link.parent < 0)
    labels = np.where(known.labels < 0, root, known.labels)
    asset = Asset(clean_name(truth.name, "object"), mesh, labels, parts, joints)
    said = [told.parts.get(link.name, StatedPart()) for link in known.links]
    guesses = tuple(
        PartGuess(part.name, link.label, one.material)
        for part, link, one in zip(parts, known.links, said, strict=True)
    )
    words = tuple(PartWords(frozenset([one.material]) - {""}, texts=one.texts) for one in said)
    name = told.name or _object_name(truth)
    return SourceObject(key, source, truth.category, name, asset, guesses, words)


def _key(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_\-]+", "_", name).strip("_") or "object"


def _object_name(truth: Truth) -> str:
    """The category, as people say it; else the name, unless it is a number."""
    words = re.sub(r"(?<=[a-z])(?=[A-Z])|[_\-]+", " ", truth.category).lower()
    return " ".join(words.split()) or plain_words(truth.name)


def _name(link: Link, number: int) -> str:
    """Name of a part: a link's own, or its label where that says nothing, such as "link_3"."""
    said = link.name if plain_words(link.name) else link.label
    return clean_name(said, f"part_{number}" if number else "body")


def _single_root(known: Articulation, key: str) -> Articulation:
    """The object itself, if it has one root, which does not move and has a surface."""
    roots = [n for n, link in enumerate(known.links) if link.parent < 0]
    if len(roots) != 1 or known.links[roots[0]].joint.moves:
        raise UnusableError("no single body that stands still", key)
    if not (known.labels == roots[0]).any():
        raise UnusableError("the body that stands still has no faces", key)
    return known


def _looks(truth: Truth, known: Articulation) -> tuple[Mesh, Articulation] | None:
    """The mesh of the object's file and the truth on its faces; None where their faces differ."""
    if truth.mesh is None or not truth.mesh.is_file():
        return None
    try:
        source = read_source(truth.mesh, _plugins(), truth.up, truth.metres_per_unit)
    except BadInputError as error:
        raise UnusableError("cannot be read", str(error)) from error
    moved = known.transformed(source.asset_from_source)
    found = replace(moved, vertices=source.mesh.vertices, faces=source.mesh.faces)
    partner = same_faces(found, moved)
    return None if partner is None else (source.mesh, replace(found, labels=moved.labels[partner]))


def _plain(truth: Truth, known: Articulation) -> tuple[Mesh, Articulation]:
    """The truth's own surface without looks."""
    surface = Mesh(known.vertices, known.faces, up=truth.up, metres_per_unit=truth.metres_per_unit)
    mesh, asset_from_source = canonical(surface)
    return mesh, known.transformed(asset_from_source)


def _joint(link: Link, name: str, parent: str, key: str) -> Joint:
    joint = link.joint
    if joint.kind == "unknown":
        raise UnusableError("a joint of unknown kind", f"{key}: '{link.name}'")
    if joint.origin is None and joint.kind in ("revolute", "continuous", "ball"):
        raise UnusableError("a joint without a place", f"{key}: '{link.name}'")
    limits = _limits(joint, link, key)
    endless = joint.kind == "revolute" and limits is not None and limits.upper - limits.lower >= FULL_TURN
    return Joint(
        f"{name}_joint",
        "continuous" if endless else joint.kind,
        parent,
        name,
        joint.origin or (0.0, 0.0, 0.0),
        joint.axis or (0.0, 0.0, 1.0),
        None if endless else limits,
    )


def _limits(joint: LinkJoint, link: Link, key: str) -> Limits | None:
    """Limits that include 0, the pose of the file, whatever is said."""
    if joint.kind not in ("revolute", "prismatic"):
        return None
    if joint.lower is None or joint.upper is None:
        raise UnusableError("a joint without limits", f"{key}: '{link.name}'")
    if joint.lower > joint.upper:
        raise UnusableError("a joint with reversed limits", f"{key}: '{link.name}'")
    return Limits(min(joint.lower, 0.0), max(joint.upper, 0.0))


@lru_cache(maxsize=1)
def _plugins() -> Plugins:
    """Who reads meshes; found once a process."""
    return Plugins()
