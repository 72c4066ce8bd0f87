"""What the model is told and asked: the paper's system prompt and its two questions.

The system prompt "paper" follows the paper's appendix line by line, headings and rules, as plain ASCII text.
The printed prompt is of the 16x8x8 grid with 8192 codes; the numbers of the grid in use are filled in. It
says more, or something else, where the paper's form leaves a question open:

- code 0 is the empty code and is never written, and cells rise, so that an answer can be checked;
- "rigid" is not written, fixed means the same; a hinge without axis and limits is a ball joint;
- `center` is said to be in the object's cube, and `scale` to be its longest side;
- `axis` has negative numbers where two components differ in sign, which 0..100 cannot express; else the sign
  is folded into the limits;
- `limits` are any rising pair about the pose of the input, as in the paper's own example [-54, 45], and the
  "max distance" is the object's longest side;
- parts have a `name`, the root comes first and parents come before their children.

The paper lists the picture last in its sequence; ours stands first in the user's turn, as in the examples of
Qwen3-VL.
"""

from __future__ import annotations

from typing import Literal

from simart_kit.errors import BadInputError

from ..tokens import TokenGrid

SystemPrompt = Literal["paper", "short", "none"]

URDF_QUESTION = (
    "Describe the object with real scale and separate the object to different functional parts "
    "with each physical properties."
)
TEXT_LENGTH = 200
"""Longest description that a person may give, in characters."""

_GROUNDING = "Generate the part of this object with description: {text}"
_HINT = "This object is {text}. {question}"

_PAPER = """\
You are a multimodal 3D reasoning assistant operating on SPARSE VOXEL REPRESENTATIONS.

## VOXEL REPRESENTATION
The 3D space is represented as a {x}x{y}x{z} voxel grid. Each occupied voxel is encoded as three atomic \
tokens in the exact order: <voxel> [xyz] [K].
Coordinate System (right-handed):
- x: left -> right (0-{last_x}); y: front -> back (0-{last_y}); z: ground -> top (0-{last_z}).
Index mapping: xyz = 64x + 8y + z (range: 0-{last_cell}).
K: An atomic geometry token (K in [0, {last_code}]) representing local surface geometry. \
0 is empty space and is never written.

## TASK: OBJECT2URDF
Input: A sequence of tokens representing the sparse voxel structure of a 3D object.
Goal: Decompose the object into functional parts, predict real-world scale (longest side in cm), and specify \
kinematic parameters (fixed, revolute, prismatic, free, hinge; rigid is written as fixed).
Output (Strict JSON only): {{"object_captions": {{...}}, "parts_captions": {{...}}, "parts_voxels": {{...}}}}

## TASK: OBJECT PART REASONING AND LOCALIZATION
Input: Voxel sequence and a functional question describing a specific part.
Goal: Identify and localize the specific part; output the voxel tokens corresponding to that part.

## STRICT RULES
- Output voxels must be a subset of the input, in order of increasing xyz.
- Every part has a name and a type. Part "0" is the root and fixed; every other part has a parent with a \
smaller number.
- center: [x, y, z] integers in [0, 200], representing grid points at 0.005 resolution of the object's cube.
- axis: [dx, dy, dz] integers in [0, 100], representing a direction vector, the largest 100; where two \
components differ in sign, integers in [-100, 100]. The sign of any other direction is in the limits.
- limits: [lower, upper] about the pose of the input, where 100 represents 180 degrees for revolute or the \
object's longest side for prismatic. A hinge without axis and limits is a ball joint.
- No extra text, headers, or formatting beyond the JSON."""

_SHORT = (
    "You read a 3D object as sparse voxels <voxel> [xyz] [K] of a {x}x{y}x{z} grid, xyz = 64x + 8y + z. "
    "Answer with strict JSON of its parts and joints, or with the voxels of the part that is asked for."
)


def system_prompt(grid: TokenGrid, kind: SystemPrompt = "paper") -> str:
    """The text of the system's turn, with the numbers of a grid; "" for kind "none".

    "paper" is what the paper prints, "short" two sentences for small models, to which long texts are costly.
    """
    if kind == "none":
        return ""
    x, y, z = grid.shape
    return (_PAPER if kind == "paper" else _SHORT).format(
        x=x,
        y=y,
        z=z,
        last_x=x - 1,
        last_y=y - 1,
        last_z=z - 1,
        last_cell=grid.cells - 1,
        last_code=grid.codebook - 1,
    )


def grounding_question(description: str) -> str:
    """The paper's question for one part, such as "the lid".

    Raises:
        BadInputError: the description is empty, too long, or holds < or >, see `plain_text`.
    """
    return _GROUNDING.format(text=plain_text(description, "description of the part"))


def described(question: str, text: str) -> str:
    """A question with what the user says about the object, such as "a fridge", before it; "" adds nothing.

    Raises:
        BadInputError: the text is too long, or holds < or >, see `plain_text`.
    """
    if not text.strip():
        return question
    return _HINT.format(text=plain_text(text, "text about the object").rstrip("."), question=question)


def plain_text(text: str, what: str) -> str:
    """A user's words on one line, each blank one space.

    Raises:
        BadInputError: nothing is said, more than `TEXT_LENGTH` characters are, or < or > is in it: the names
            of the model's own tokens are made of them, so that a user's text can never pass for one.
    """
    line = " ".join(text.split())
    if not line:
        raise BadInputError(f"the {what} is empty: say it in a few words, such as 'the lid'")
    if len(line) > TEXT_LENGTH:
        raise BadInputError(
            f"the {what} has {len(line)} characters, at most {TEXT_LENGTH} are read: say it shorter"
        )
    if "<" in line or ">" in line:
        raise BadInputError(
            f"the {what} {line!r} holds < or >, which mark the model's own tokens: leave them out"
        )
    return line
