"""Segmenter `simart`: the paper's model reads an object as voxel tokens and says its parts and joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field

from simart_kit import Note, Segmentation, Segmenter

from .labelling import TransferOptions
from .opening import ModelOptions, open_partner

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.grounding import Grounded

    from .asking import Sampling
    from .looking import Asked
    from .partner import Partner
    from .seeding import Decoder


class Simart(Segmenter):
    """Parts and joints by a multimodal language model that reads voxels, as SIMART has it."""

    name = "simart"

    class Options(ModelOptions, TransferOptions):
        """Which model, what it is shown, and how its answer is taken."""

        image: str = Field(
            default="", description="Picture of the object for the model; empty: one of the mesh."
        )
        text: str = Field(default="", description='What the object is, such as "a fridge".')
        vision: Literal["auto", "on", "off"] = Field(
            default="auto", description="Show the model a picture, or do as in its training (auto)."
        )
        seeds: Literal["auto", "codes", "cells"] = Field(
            default="auto",
            description="A part is where its codes decode to, or the object's own voxels in its cells; "
            "auto: what the model was found to do better with.",
        )
        max_tokens: int = Field(default=4096, ge=16, description="Longest answer [tokens].")
        max_parts: int = Field(default=16, ge=1, le=256, description="Most parts in an answer.")
        temperature: float = Field(
            default=0.0, ge=0, le=10, description="0 takes the likeliest token each time; 1 samples."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The model's parts on the mesh's faces, its joints as hints.

        Raises:
            BadInputError: the model cannot be had, its answer does not end, or nothing of it can be used.
        """
        from .conversion import segmentation_of
        from .prompt.texts import URDF_QUESTION, described

        partner = open_partner(self.options)
        asked = self._asked(mesh, partner, described(URDF_QUESTION, self.options.text))
        said = partner.answer(asked.prompt, self._sampling())
        return segmentation_of(mesh, asked, said, self._decoder(partner), self.options)

    def ground(self, mesh: Mesh, description: str) -> Grounded:
        """The faces that a description means; none where the model's voxels decode to nothing.

        Raises:
            BadInputError: the model cannot be had, its answer does not end, or the description is none.
        """
        from .grounded import grounded
        from .prompt.texts import grounding_question

        partner = open_partner(self.options)
        asked = self._asked(mesh, partner, grounding_question(description))
        said = partner.part(asked.prompt, self._sampling())
        return grounded(mesh, asked, said, self._decoder(partner), self.options)

    def _asked(self, mesh: Mesh, partner: Partner, question: str) -> Asked:
        """The prompt for a mesh, and what is to be told of it."""
        from .looking import Asked, chosen_picture, look
        from .prompt.texts import system_prompt
        from .prompt.values import Prompt

        seen = look(mesh, partner.encoder)
        picture, told = chosen_picture(mesh, partner.settings, self.options.vision, self.options.image)
        system = system_prompt(seen.tokens.grid, partner.settings.prompt)
        ignored = bool(self.options.image) and picture is None
        note = Note("segment", "warning" if ignored else "info", told)
        return Asked(Prompt(system, question, seen.tokens, picture), seen, (note,))

    def _decoder(self, partner: Partner) -> Decoder:
        from .seeding import Decoder

        seeds = partner.settings.seeds if self.options.seeds == "auto" else self.options.seeds
        return Decoder(partner.codec.model, seeds)

    def _sampling(self) -> Sampling:
        from .asking import Sampling

        options = self.options
        return Sampling(options.max_tokens, options.max_parts, options.temperature, self.seed)
