"""Vision-language models: asked about pictures on a server or here, answers checked, kept and counted."""

from .ledger import Ledger
from .options import VlmOptions
from .values import Question, Reply, Usage, Vlm

__all__ = ["Ledger", "Question", "Reply", "Usage", "Vlm", "VlmOptions", "open_vlm"]


def open_vlm(options: VlmOptions) -> Vlm:
    """The model that options name; see `opening.open_vlm`, which is imported when it is needed."""
    from .opening import open_vlm as opened

    return opened(options)
