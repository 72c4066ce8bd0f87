"""An object with its truth, as nano sees it: everything in the frame of the cloud."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats import DEFAULT_VARIANT, TruthFormat
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.bench.importing import write_case
from simart_kit.bench.overlay import overlay
from simart_kit.bench.protocols.simart_pairing import moving_surfaces
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.segments import find_segments

from ..meshes import MeshCloud, mesh_cloud
from ..truth import majority

# Of the places that the surface is looked at: what the segmenter takes when nobody says otherwise.
_SEED = 0


@dataclass(frozen=True, eq=False)
class Case:
    """An object to climb the ladder with.

    Attributes:
        truth: rigid bodies, in the frame of the cloud: the longest side is 1.
        category: such as "cabinet", or "".
        mesh: in the canonical frame [m].
        asset_from_source: (4, 4) the mesh's frame from that of its file.
        seen: what the network reads of the mesh.
        piece_link: (S,) link of the truth that most of a piece's area is of; -1 for none.
    """

    truth: Articulation
    category: str
    mesh: Mesh
    asset_from_source: FloatArray
    seen: MeshCloud
    piece_link: IntArray

    @property
    def parts(self) -> tuple[int, ...]:
        """Links that move and have a surface: those that there are to find."""
        return moving_surfaces(self.truth)

    def pieces(self, link: int) -> IntArray:
        """The pieces that are mostly of a link, ascending."""
        return np.flatnonzero(self.piece_link == link)

    def groups(self) -> dict[int, IntArray]:
        """The pieces of each part that nano could find: one that has some, and does not have them all."""
        own = {link: self.pieces(link) for link in self.parts}
        return {link: pieces for link, pieces in own.items() if 0 < len(pieces) < self.seen.cloud.count}

    def with_joints(self, joints: Mapping[int, LinkJoint]) -> Articulation:
        """The pieces as given to their true parts, which have other joints; parts not named do not move."""
        links = list(self.truth.links)
        for link in self.parts:
            links[link] = replace(links[link], joint=joints.get(link, LinkJoint()))
        return self.with_links(tuple(links))

    def with_links(self, links: tuple[Link, ...]) -> Articulation:
        """The pieces as they are given to their true links, which may move otherwise."""
        return _of_faces(self.truth.name, self.mesh, self.seen, self.piece_link[self.seen.face_piece], links)


def read_case(reader: TruthFormat, path: Path, variant: str, plugins: Plugins, relief: bool = True) -> Case:
    """Read an object with its truth and cut its mesh into pieces.

    Args:
        reader: of the truth.
        path: for that reader.
        variant: which mesh of the object.
        plugins: who reads meshes.
        relief: whether a finely meshed skin is cut by relief.

    Raises:
        BadInputError: the truth or the mesh cannot be read, or it is points and no surface.
    """
    truth = reader.read(path, variant)
    if truth.mesh is not None:
        return _case(truth, truth.mesh, plugins, relief)
    with TemporaryDirectory() as folder:  # of an object in pieces, as `bench run` does
        write_case(truth, Path(folder))
        surface = Path(folder) / f"{DEFAULT_VARIANT}.glb"
        return _case(SimartBench().read(Path(folder)), surface, plugins, relief)


def _case(truth: Truth, path: Path, plugins: Plugins, relief: bool) -> Case:
    source = read_source(path, plugins, truth.up, truth.metres_per_unit)
    segments = find_segments(source.mesh, relief=relief)
    seen = mesh_cloud(source.mesh, segments, np.random.default_rng(_SEED))
    known = truth.articulation.rigid().transformed(cloud_from_asset(seen) @ source.asset_from_source)
    pieces = tuple(Link(str(number)) for number in range(seen.cloud.count))
    laid = overlay(known, _of_faces(truth.name, source.mesh, seen, seen.face_piece, pieces))
    there = laid.predicted_labels >= 0
    piece, label = laid.predicted_labels[there], laid.true_labels[there] + 1  # 0 is none
    owner = majority(label, piece, laid.weights[there], len(known.links) + 1, len(pieces)) - 1
    return Case(known, truth.category, source.mesh, source.asset_from_source, seen, owner)


def cloud_from_asset(seen: MeshCloud) -> FloatArray:
    """(4, 4) the similarity that centres the mesh at 0 and makes its longest side 1."""
    matrix = np.diag([1 / seen.size, 1 / seen.size, 1 / seen.size, 1.0])
    matrix[:3, 3] = -seen.center / seen.size
    return matrix


def _of_faces(
    name: str, mesh: Mesh, seen: MeshCloud, labels: IntArray, links: tuple[Link, ...]
) -> Articulation:
    return Articulation(name, (mesh.vertices - seen.center) / seen.size, mesh.faces, labels, links)
