"""A server on loopback that is asked about a crate: it knows the truth, and does what servers may do."""

import functools
import json
import time
from contextlib import contextmanager

import numpy as np
from simart_kit_plugins.marks.segmenter import P3SamVlm

from simart_kit.plugins import Plugins
from simart_kit.recipe import read_options
from simart_kit.testing.meshes import boxes_mesh

from .endpoint_cases import serving, status
from .furniture import bar, box
from .marks_cases import Knowing
from .vlm_server import asked, said

# Boxes 0-1 are the body, 2 the drawer and 3 its handle; 12 faces each.
CRATE = boxes_mesh(
    [
        box((-0.2, 0.2), (-0.15, 0.15), (0.0, 0.02)),
        box((-0.2, 0.2), (0.13, 0.15), (0.02, 0.3)),
        box((-0.17, 0.17), (-0.14, 0.1), (0.03, 0.27)),
        bar(0.0, 0.15, -0.14, upright=False),
    ]
)
DRAWER = np.arange(48) >= 24
PARTS = [
    {"name": "body", "kind": "fixed", "parent": -1, "axis": None, "origin": None},
    {"name": "drawer", "kind": "prismatic", "parent": 0, "axis": np.array([0, -1.0, 0]), "origin": None},
]


@functools.cache
def truth():
    """A model that knows the crate."""
    plugins = Plugins(installed=False)
    piece = (
        P3SamVlm(read_options(P3SamVlm, {"proposer": {"use": "geometric"}}), plugins=plugins)
        ._proposed(CRATE)
        .piece
    )
    knowing = Knowing(CRATE, piece, DRAWER.astype(int), PARTS)
    knowing.answers["CriticAnswer"] = lambda question: {"faults": []}
    return knowing


def right(handler, text):
    status(200, said(text))(handler)


def spoken(change, **how):
    """The right answer's text, changed."""
    return lambda handler, text: status(200, said(change(text), **how))(handler)


def plain(code, body=b"", **head):
    return lambda handler, text: status(code, body, **head)(handler)


def silent(handler, text):
    time.sleep(3)


def cut(handler, text):
    """A reply that ends before its end."""
    body = said(text)
    handler.send_response(200)
    handler.send_header("Content-Length", str(len(body)))
    handler.end_headers()
    handler.wfile.write(body[:-50])


def half(text):
    return text[: len(text) // 2]


def prose(text):
    return f"<think>{{Which one?}}</think>Here it is:\n```json\n{text}\n```\nI hope {{that}} helps."


def told(code, message):
    return plain(code, json.dumps({"error": {"message": message}}).encode())


@contextmanager
def model(*replies):
    """Serve these replies in turn, the last for ever; each knows what the right answer's text would be."""

    def reply(handler):
        number = len(served.asked)
        text = truth().heard(asked(served.asked[-1][2]))
        replies[min(number, len(replies)) - 1](handler, text)

    truth()  # the first time takes longer than some clients wait
    with serving(reply) as served:
        yield served
