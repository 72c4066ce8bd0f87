"""What a plugin subclasses: Segmenter, JointPredictor, Modifier, Exporter, Check, and their Options."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from pydantic import BaseModel, ConfigDict

if TYPE_CHECKING:
    from .arrays import IntArray
    from .asset import Asset, Joint
    from .checks import CheckResult
    from .checks.subject import Subject
    from .evidence import Evidence
    from .mesh import Mesh, Note
    from .plugins import Plugins
    from .usage import ModelUsage


class Options(BaseModel):
    """Base of a stage's options: frozen, strict, no unknown keys. Describe every field with its unit."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    def needed_extras(self) -> tuple[str, ...]:
        """Extras of simart-kit that a stage with these options needs, such as ("torch",).

        A run of one who has them not is refused before anything is read.
        """
        return ()


_AnyOptions = Options  # inside Stage, the name `Options` is the nested class


class Stage(ABC):
    """Base of all stages. Nest `class Options(simart_kit.Options)` and annotate `options: Options`.

    Attributes:
        name: what recipes call it, unique within its kind.
        kind: set by the stage classes below.
        options: validated.
        seed: the recipe's; make generators with `numpy.random.default_rng(self.seed)`.
    """

    name: ClassVar[str]
    kind: ClassVar[str]

    class Options(Options):
        """A stage without options."""

    options: _AnyOptions

    def __init__(self, options: _AnyOptions | None = None, *, seed: int = 0) -> None:
        self.options = self.Options() if options is None else options
        self.seed = seed


class Composed(Stage):
    """A stage that makes use of others by their names, which only the run's plugins know.

    Attributes:
        plugins: of the run; None where the stage was made by hand, which then means all that are installed.
    """

    def __init__(
        self, options: _AnyOptions | None = None, *, seed: int = 0, plugins: Plugins | None = None
    ) -> None:
        super().__init__(options, seed=seed)
        self.plugins = plugins


@dataclass(frozen=True)
class PartGuess:
    """What a segmenter believes about a part.

    Attributes:
        name: such as "left_door"; cleaned and made unique by the core.
        label: what kind of thing it is, such as "door".
        material: key of the material table (`simart_kit.physics.MATERIALS`).
        score: 0..1.
        description: for people.
        mass: what a file or a person says that it weighs [kg], above 0; None where nobody does.
        material_stated: whether a model that looks at the object, or a person, states the material; else it
            is a guess, before which goes what the mesh's file calls its materials.
    """

    name: str
    label: str = ""
    material: str = "wood"
    score: float = 1.0
    description: str = ""
    mass: float | None = None
    material_stated: bool = False


@dataclass(frozen=True, eq=False)
class Segmentation:
    """A part for every face.

    Attributes:
        face_part: (F,) int32 part ids 0..P-1, every id used, in the order of the mesh's faces: of `mesh`
            where there is one, else of the mesh that was given.
        parts: one guess a part; part 0 is the body when no joint says otherwise.
        joints: joint hints of a model that predicts parts and joints at once, naming `parts` by their names;
            None when the segmenter has no opinion.
        face_segment: (F,) int32 finer pieces that were grouped, for the recording, or None.
        notes: what was decided, for the report.
        evidence: how it came about, for the recording: each piece gets a view of its name. Values at
            vertices are those of the mesh that `face_part` is of.
        usage: what it took of models that were asked, for provenance.
        mesh: the mesh that `face_part` is of, where faces had to be cut; None: the mesh that was given.
    """

    face_part: IntArray
    parts: tuple[PartGuess, ...]
    joints: tuple[Joint, ...] | None = None
    face_segment: IntArray | None = None
    notes: tuple[Note, ...] = ()
    evidence: tuple[Evidence, ...] = ()
    usage: tuple[ModelUsage, ...] = ()
    mesh: Mesh | None = None

    def mesh_of(self, given: Mesh) -> Mesh:
        """The mesh that `face_part` is of: the `given` one, unless faces had to be cut."""
        return given if self.mesh is None else self.mesh


@dataclass(frozen=True, eq=False)
class Prediction:
    """Joints, and how a predictor came to them.

    Attributes:
        joints: between parts, by their names.
        notes: what was decided, for the report.
        evidence: for the recording; see `Segmentation.evidence`, whose names it must not repeat.
        usage: what it took of models that were asked, for provenance.
    """

    joints: tuple[Joint, ...]
    notes: tuple[Note, ...] = ()
    evidence: tuple[Evidence, ...] = ()
    usage: tuple[ModelUsage, ...] = ()


class Segmenter(Stage):
    """Finds the parts of a mesh; one that takes long may take help, see `spec.protocols.HelpedSegmenter`."""

    kind = "segmenter"

    @abstractmethod
    def segment(self, mesh: Mesh) -> Segmentation:
        """Label every face of a mesh in the canonical frame (see DESIGN: +Z up, front -Y, nominal metres).

        Where a part ends inside a face, the faces there may be cut: the result then brings its mesh.
        """


class JointPredictor(Stage):
    """Says how the parts move."""

    kind = "joint predictor"

    @abstractmethod
    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """Joints between parts, by the names in `segmentation.parts`; parts left out are fixed to the body.

        The mesh is the one that `segmentation.face_part` is of. The names in `segmentation.parts` are already
        clean and unique. No joint at all is a valid answer:
        the object is static.
        """


class Modifier(Stage):
    """A small step from Asset to Asset; one that takes long may take help, see `beside.HelpedModifier`.

    Attributes:
        corrects_joints: whether it corrects how joints move, which predictors only guess; it is left out
            where the source file states its joints.
    """

    kind = "modifier"
    corrects_joints: ClassVar[bool] = False

    @abstractmethod
    def modify(self, asset: Asset) -> Asset:
        """A changed copy; say what was decided with `asset.with_notes`."""


class Exporter(Stage):
    """Writes an Asset in one format."""

    kind = "exporter"

    @abstractmethod
    def export(self, asset: Asset, directory: Path) -> Path:
        """Write into a fresh, empty directory and return the main file.

        Relative paths only, no timestamp, the same bytes every time. The core moves the result into place.
        """

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """What this format cannot express of the asset and what is written instead, a sentence each."""
        return ()


class Check(Stage):
    """Judges a finished object by its files, and by the asset that they were made from, if known.

    Attributes:
        drives: whether it simulates one joint after the other, which another process may do meanwhile.
    """

    kind = "check"
    drives: ClassVar[bool] = False

    @abstractmethod
    def check(self, subject: Subject) -> CheckResult:
        """A verdict in one line, with the numbers behind it; the same every time.

        Raise `BadInputError` when the files cannot be read or simulated: that is told as a failed check.
        """
