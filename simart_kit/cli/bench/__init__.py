"""`simart-kit bench`: each command has a file of its own."""

from .app import app

__all__ = ["app"]
