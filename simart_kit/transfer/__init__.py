"""Part seeds -> labels of a mesh's own faces."""

from .labels import Transfer, TransferMode, transfer

__all__ = ["Transfer", "TransferMode", "transfer"]
