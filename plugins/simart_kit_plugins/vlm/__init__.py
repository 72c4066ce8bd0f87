"""Vision-language models: asked about pictures on a server or here, answers checked, kept and counted."""

from .ledger import Ledger
from .opening import open_vlm
from .options import VlmOptions
from .values import Question, Reply, Usage, Vlm

__all__ = ["Ledger", "Question", "Reply", "Usage", "Vlm", "VlmOptions", "open_vlm"]
