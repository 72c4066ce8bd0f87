"""Asking a model that a server runs: an OpenAI-compatible endpoint, such as vLLM's."""
