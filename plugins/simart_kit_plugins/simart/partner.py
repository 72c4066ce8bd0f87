"""Who is asked: a model that is loaded here, or one that a server runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from .answer.parsing import parse_answer, parse_grounding
from .answer.values import ObjectAnswer
from .asking import Said, Sampling, ask_answer, ask_part
from .codec import TokenModel, nearest_codes
from .endpoint.asking import ask
from .endpoint.client import quoted
from .endpoint.values import Endpoint
from .prompt.values import Prompt
from .tokens import VoxelTokens

if TYPE_CHECKING:
    from .default_model import LoadedModel
    from .mllm.settings import Settings
    from .mllm.simart_model import SimartModel

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Partner:
    """A model that can be asked.

    Attributes:
        settings: how it was trained to be asked.
        codec: the voxel model whose codes it reads and writes.
        answer: asks for an object's parts and joints.
        part: asks for the voxels of one part.
    """

    settings: Settings
    codec: LoadedModel
    answer: Callable[[Prompt, Sampling], Said[ObjectAnswer]]
    part: Callable[[Prompt, Sampling], Said[VoxelTokens]]

    @property
    def encoder(self) -> TokenModel:
        """The codec as objects are encoded for the model."""
        return nearest_codes(self.codec.model) if self.settings.candidates == 1 else self.codec.model


def partner_here(bundle: SimartModel) -> Partner:
    """A model that is loaded here; see `asking`."""
    return Partner(bundle.settings, bundle.codec, partial(ask_answer, bundle), partial(ask_part, bundle))


def partner_at(endpoint: Endpoint, settings: Settings, codec: LoadedModel) -> Partner:
    """A model on a server, where no grammar watches over the answer: it is read strictly, and may be refused.

    Args:
        endpoint: the server.
        settings: of the model that it serves.
        codec: whose codes that model reads and writes; the server cannot tell.
    """
    return Partner(settings, codec, partial(_answer, endpoint), partial(_part, endpoint))


def _answer(endpoint: Endpoint, prompt: Prompt, sampling: Sampling) -> Said[ObjectAnswer]:
    grid, cells = prompt.voxels.grid, prompt.voxels.index
    said = _said(endpoint, prompt, sampling, lambda text: parse_answer(text.strip(), grid, allowed=cells))
    beyond = len(said.value.parts) - sampling.max_parts
    if beyond <= 0:
        return said
    # Parents come before their children, so that the first parts are a tree of their own.
    value = replace(said.value, parts=said.value.parts[: sampling.max_parts])
    remark = f"parts beyond max_parts, {sampling.max_parts}, are left out: {beyond}"
    return replace(said, value=value, remarks=(*said.remarks, remark))


def _part(endpoint: Endpoint, prompt: Prompt, sampling: Sampling) -> Said[VoxelTokens]:
    grid, cells = prompt.voxels.grid, prompt.voxels.index
    return _said(endpoint, prompt, sampling, lambda text: parse_grounding(text.strip(), grid, cells))


def _said(endpoint: Endpoint, prompt: Prompt, sampling: Sampling, read: Callable[[str], T]) -> Said[T]:
    told = ask(
        endpoint,
        prompt,
        read,
        temperature=sampling.temperature,
        seed=sampling.seed,
        max_tokens=sampling.max_tokens,
    )
    again = f"its first answer could not be read ({quoted(told.mistake)}), its second could"
    remarks = (again,) if told.mistake else ()
    return Said(told.text, told.value, (), f"model {endpoint.model} at {endpoint.url}", remarks)
