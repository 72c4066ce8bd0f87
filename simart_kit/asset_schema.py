"""asset.json as pydantic models: what it may hold, with units. The JSON schema in docs comes from here."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from .arrays import FloatArray, IntArray, Mat3, Vec3, frozen_floats
from .asset import Asset, Joint, JointKind, Limits, MassProperties, Material, Part, Scale
from .mesh import Mesh, Note, VisualMaterial
from .primitives import Primitive, PrimitiveKind

Row4 = tuple[float, float, float, float]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class MaterialTable(_Table):
    """What a part is made of."""

    name: str = Field(description="Key of the material table.")
    density: float = Field(gt=0, description="Density [kg/m^3].")
    friction: float = Field(ge=0, description="Sliding friction coefficient.")
    restitution: float = Field(ge=0, le=1, description="0 (no bounce) .. 1.")
    youngs_modulus: float = Field(default=1e10, gt=0, description="Stiffness of the solid material [Pa].")


class MassTable(_Table):
    """Inertial properties of a part at rest."""

    mass: float = Field(gt=0, description="Mass [kg].")
    center: Vec3 = Field(description="Centre of mass in the asset frame [m].")
    inertia: Mat3 = Field(description="About the centre, along the asset's axes [kg*m^2].")
    method: str = Field(description="How the volume was found.")


class PrimitiveTable(_Table):
    """A collision shape that is a box, a cylinder along its own z, or a sphere."""

    shape: int = Field(ge=0, description="Which of the part's collision shapes it is.")
    kind: PrimitiveKind = Field(description="Type of the primitive.")
    size: Vec3 = Field(description="Extents along its own axes [m]; diameters of what is round.")
    asset_T_shape: tuple[Row4, Row4, Row4, Row4] = Field(
        description="4x4 as rows: pose of its middle in the asset frame at rest."
    )

    def value(self) -> Primitive:
        """The primitive."""
        return Primitive(self.kind, self.size, frozen_floats(self.asset_T_shape))


class PartTable(_Table):
    """A rigid piece; `face_part` in parts.npz gives its faces by its position in this list."""

    name: str = Field(description="Unique, [a-z][a-z0-9_]*; the link's name in every export.")
    label: str = Field(default="", description="What kind of thing it is.")
    description: str = Field(default="", description="For people.")
    material: MaterialTable = Field(description="What it is made of.")
    stated_mass: float | None = Field(default=None, gt=0, description="What a person says it weighs [kg].")
    mass: MassTable | None = Field(default=None, description="Inertial properties.")
    collision_shapes: int = Field(default=0, ge=0, description="Number of convex shapes in parts.npz.")
    primitives: tuple[PrimitiveTable, ...] = Field(
        default=(), description="Those of its collision shapes that are primitives."
    )

    def value(self) -> Part:
        """The part, without its collision shapes."""
        mass = MassProperties(**self.mass.model_dump()) if self.mass else None
        material = Material(**self.material.model_dump())
        return Part(self.name, self.label, self.description, material, mass, stated_mass=self.stated_mass)

    def primitive(self, shape: int) -> Primitive | None:
        """What a collision shape is exactly; None for a mesh."""
        return next((row.value() for row in self.primitives if row.shape == shape), None)


class LimitsTable(_Table):
    """Range about the rest position 0."""

    lower: float = Field(le=0, description="Lowest position [rad or m].")
    upper: float = Field(ge=0, description="Highest position [rad or m].")


class JointTable(_Table):
    """How one part moves against another."""

    name: str = Field(description="Unique, [a-z][a-z0-9_]*.")
    kind: JointKind = Field(description="Type of the joint.")
    parent: str = Field(description="Part that carries it.")
    child: str = Field(description="Part that it moves.")
    origin: Vec3 = Field(description="A point on the axis in the asset frame at rest [m].")
    axis: Vec3 = Field(description="Unit direction in the asset frame at rest.")
    limits: LimitsTable | None = Field(default=None, description="Required for revolute and prismatic.")
    damping: float = Field(default=0.0, ge=0, description="[N*m*s/rad or N*s/m].")
    friction: float = Field(default=0.0, ge=0, description="Dry friction [N*m or N].")
    armature: float = Field(default=0.0, ge=0, description="Inertia added for solvers [kg*m^2 or kg].")
    effort: float = Field(default=50.0, ge=0, description="Largest torque or force [N*m or N].")
    velocity: float = Field(default=2.0, ge=0, description="Largest speed [rad/s or m/s].")
    confidence: float = Field(default=1.0, ge=0, le=1, description="The predictor's own.")
    evidence: tuple[str, ...] = Field(default=(), description="Why it was chosen.")
    flags: tuple[str, ...] = Field(default=(), description="Checks that it failed.")

    def value(self) -> Joint:
        """The joint."""
        limits = Limits(self.limits.lower, self.limits.upper) if self.limits else None
        return Joint(**{**self.model_dump(), "limits": limits})


class VisualMaterialTable(_Table):
    """How a surface looks (glTF 2.0 metallic-roughness); pictures are in parts.npz."""

    name: str = Field(description="Name in the source.")
    base_color: Row4 = Field(description="Linear RGBA factor, 0..1.")
    metallic: float = Field(description="0 .. 1.")
    roughness: float = Field(description="0 .. 1.")

    def value(self) -> VisualMaterial:
        """The material, without its pictures."""
        return VisualMaterial(**self.model_dump())


class ScaleTable(_Table):
    """How the size was decided."""

    factor: float = Field(gt=0, description="Factor on the metres that the file claims.")
    reason: str = Field(description="One sentence.")


class NoteTable(_Table):
    """Something a person should know."""

    stage: str = Field(description="Where it was noticed.")
    level: Literal["info", "warning"] = Field(description="A decision, or something lost or doubtful.")
    text: str = Field(description="One sentence.")


class AssetTable(_Table):
    """The top level of asset.json."""

    version: Literal[1] = Field(default=1, alias="schema", description="Version of this format.")
    name: str = Field(description="[a-z][a-z0-9_]*; names the exported files.")
    floating: bool = Field(
        default=False, description="Whether the root is free instead of fixed to the world."
    )
    parts: tuple[PartTable, ...] = Field(description="The parts, in the order of their ids.")
    joints: tuple[JointTable, ...] = Field(
        default=(), description="A tree: one joint a part, but for the root."
    )
    asset_from_source: tuple[Row4, Row4, Row4, Row4] = Field(
        description="4x4 as rows: maps the source file's coordinates to the asset frame [m]."
    )
    scale: ScaleTable = Field(description="How the size was decided.")
    visual_materials: tuple[VisualMaterialTable, ...] = Field(description="Materials of `face_material`.")
    notes: tuple[NoteTable, ...] = Field(default=(), description="What stages decided or could not do.")

    @classmethod
    def of(cls, asset: Asset) -> AssetTable:
        """The table of an asset."""
        return cls.model_validate(
            {
                "schema": 1,
                "name": asset.name,
                "floating": asset.floating,
                "parts": [_part(p) for p in asset.parts],
                "joints": [JointTable(**_fields(j, JointTable)) for j in asset.joints],
                "asset_from_source": asset.asset_from_source.tolist(),
                "scale": {"factor": asset.scale.factor, "reason": asset.scale.reason},
                "visual_materials": [_fields(m, VisualMaterialTable) for m in asset.mesh.materials],
                "notes": [_fields(n, NoteTable) for n in asset.notes],
            }
        )

    def asset(self, mesh: Mesh, face_part: IntArray, parts: tuple[Part, ...]) -> Asset:
        """The asset of this table and its arrays."""
        asset_from_source: FloatArray = frozen_floats(self.asset_from_source)
        return Asset(
            self.name,
            mesh,
            face_part,
            parts,
            tuple(j.value() for j in self.joints),
            asset_from_source,
            Scale(self.scale.factor, self.scale.reason),
            self.floating,
            tuple(Note(n.stage, n.level, n.text) for n in self.notes),
        )


def _part(part: Part) -> dict[str, object]:
    row = _fields(part, PartTable, leave_out=("material", "mass", "collision_shapes", "primitives"))
    row["material"] = _fields(part.material, MaterialTable)
    row["mass"] = _fields(part.mass, MassTable) if part.mass else None
    row["collision_shapes"] = len(part.collision)
    shapes = [(number, shape.primitive) for number, shape in enumerate(part.collision)]
    row["primitives"] = [_primitive(number, p) for number, p in shapes if p is not None]
    return row


def _primitive(shape: int, primitive: Primitive) -> dict[str, object]:
    pose = primitive.asset_T_shape.tolist()
    return {"shape": shape, "kind": primitive.kind, "size": primitive.size, "asset_T_shape": pose}


def _fields(value: object, table: type[_Table], leave_out: tuple[str, ...] = ()) -> dict[str, object]:
    """The attributes of a value that a table has fields for."""
    row = {name: getattr(value, name) for name in table.model_fields if name not in leave_out}
    limits = row.get("limits")
    if isinstance(limits, Limits):
        row["limits"] = {"lower": limits.lower, "upper": limits.upper}
    return row
