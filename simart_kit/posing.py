"""The asset's mesh in a pose, whole: for pictures and measurements."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .arrays import IntArray
from .asset import Asset
from .kinematics import Positions, rest_to_posed
from .mesh import Mesh
from .normals import with_normals


@dataclass(frozen=True, eq=False)
class PosableMesh:
    """An asset's mesh with normals, vertices doubled where parts shared them; faces keep their order.

    Attributes:
        asset: whose joints move it.
        mesh: at rest.
        vertex_part: (V,) index into `asset.parts`.
    """

    asset: Asset
    mesh: Mesh
    vertex_part: IntArray

    @classmethod
    def of(cls, asset: Asset) -> PosableMesh:
        """Prepare an asset once for many poses."""
        mesh = with_normals(asset.mesh)
        keys = mesh.faces.astype(np.int64) * len(asset.parts) + asset.face_part[:, None]
        used, faces = np.unique(keys, return_inverse=True)
        source, part = np.divmod(used, len(asset.parts))
        return cls(asset, mesh.on_vertices(source, faces.reshape(-1, 3)), part.astype(np.int32))

    def posed(self, positions: Positions) -> Mesh:
        """The mesh with every part where joint positions [rad | m] take it."""
        moved = rest_to_posed(self.asset, positions)
        posed_T_rest = np.stack([moved[part.name] for part in self.asset.parts])[self.vertex_part]
        turn, shift = posed_T_rest[:, :3, :3], posed_T_rest[:, :3, 3]
        assert self.mesh.normals is not None
        vertices = (turn @ self.mesh.vertices[:, :, None])[..., 0] + shift
        normals = (turn @ self.mesh.normals[:, :, None])[..., 0]
        return replace(self.mesh, vertices=vertices, normals=normals)
