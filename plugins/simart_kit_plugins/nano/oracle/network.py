"""The steps of the ladder that ask a network."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from simart_kit import Segmenter
from simart_kit.arrays import vec3
from simart_kit.assemble import assemble
from simart_kit.asset import clean_name
from simart_kit.bench.articulation import LinkJoint
from simart_kit.bench.formats.output_folder import in_asset_frame
from simart_kit.recipe import read_options

from ..array_network import ArrayNetwork
from ..grouping import Group
from ..predicting import PredictedPart, predict_groups
from ..segmenter import Nano
from ..stored_model import SKINS_FILE, read_model, reads_skins
from .case import Case, cloud_from_asset
from .judging import Judged, judge


@dataclass(frozen=True, eq=False)
class Model:
    """A network to ask.

    Attributes:
        network: that reads clouds.
        of_skins: the same of skins that are cut by relief, if there is another for these.
        segmenter: `nano` with these weights, and otherwise as it is by default.
    """

    network: ArrayNetwork
    of_skins: ArrayNetwork
    segmenter: Segmenter


def load_model(folder: Path) -> Model:
    """Read a folder such as `train nano` writes; raises BadInputError where it is none."""
    network = read_model(folder).network
    of_skins = read_model(folder, SKINS_FILE).network if reads_skins(folder) else network
    return Model(network, of_skins, Nano(read_options(Nano, {"model": str(folder)})))


def grouping_step(case: Case, model: Model) -> Judged:
    """True pieces grouped as they should be, with the joints that the network chooses for them."""
    asked = case.groups()
    found = [Group(pieces, 1.0) for pieces in asked.values()]
    network = model.of_skins if case.seen.relief else model.network
    said = predict_groups(network, case.seen.cloud, found)
    joints = {link: _joint(part) for link, part in zip(asked, said, strict=True)}
    return judge(case.truth, case.with_joints(joints))


def whole_step(case: Case, model: Model) -> Judged:
    """Everything as the segmenter says it."""
    said = model.segmenter.segment(case.mesh)
    name = clean_name(case.truth.name, "asset")
    asset = assemble(name, case.mesh, said, said.joints or (), case.asset_from_source)
    return judge(case.truth, in_asset_frame(asset).transformed(cloud_from_asset(case.seen)))


def _joint(part: PredictedPart) -> LinkJoint:
    limits = (part.lower, part.upper) if part.kind in ("revolute", "prismatic") else (None, None)
    return LinkJoint(part.kind, vec3(part.axis), vec3(part.origin), *limits)
