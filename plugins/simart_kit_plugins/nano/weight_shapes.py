"""Which weights a network of some sizes has: to tell what is wrong with a file, without torch."""

from __future__ import annotations

from .config import NanoConfig
from .evidence import WAY
from .novelty import LAYERS
from .reading import PAIR_WIDTH, POINT_NUMBERS
from .scene import PAIR_NUMBERS, PIECE_NUMBERS
from .truth import KINDS
from .ways import WAY_NUMBERS


def weight_shapes(config: NanoConfig) -> dict[str, tuple[int, ...]]:
    """The shape of each of `NanoNetwork(config).state_dict()`, by its name."""
    width, points, choice = config.channels, config.point_channels, config.choice_channels
    biases = config.layers * config.heads + 1
    shapes: dict[str, tuple[int, ...]] = {
        "biases.weight": (biases, PAIR_NUMBERS, 1, 1),
        "biases.bias": (biases,),
        **_perceptron("points", POINT_NUMBERS, points, points),
        **_perceptron("enter", 2 * points + PIECE_NUMBERS, config.hidden, width),
        **_perceptron("part", 3 * width, config.hidden, width),
        **_perceptron("candidate", WAY.start, choice, choice),
        **_perceptron("opening", width, choice, WAY_NUMBERS + 3),
        **_perceptron("carrier", 2 * width, config.hidden // 2, 1),
        **_norm("norm", width),
    }
    for number in range(config.layers):
        shapes |= _layer(f"layers.{number}", config)
    shapes |= _pairs(config)
    heads = {"left": width, "right": width, "moves": 1, "kind": len(KINDS), "part_kind": len(KINDS)}
    heads |= {"label": len(config.labels) + 1, "category": len(config.categories) + 1, "size": 1}
    for name, outer in (heads | {"asking": choice}).items():
        shapes |= _linear(name, width, outer)
    return shapes | _linear("choice", choice, 1)


def statistic_shapes(config: NanoConfig) -> dict[str, tuple[int, ...]]:
    """The shape of each array of `TokenStatistics`, in their order, by the name that it is stored by."""
    width = config.channels
    return {"statistics.mean": (LAYERS, width), "statistics.whitening": (LAYERS, width, width)}


def kind_shapes(config: NanoConfig) -> dict[str, tuple[int, ...]]:
    """The same of `KindStatistics`."""
    width = config.channels
    return {"kinds.means": (len(config.categories), width), "kinds.whitening": (width, width)}


def _layer(name: str, config: NanoConfig) -> dict[str, tuple[int, ...]]:
    width = config.channels
    return {
        **_norm(f"{name}.before", width),
        **_norm(f"{name}.after", width),
        **_linear(f"{name}.ask", width, 3 * width),
        **_linear(f"{name}.answer", width, width),
        **_perceptron(f"{name}.think", width, config.hidden, width),
    }


def _pairs(config: NanoConfig) -> dict[str, tuple[int, ...]]:
    width, own, half = config.channels, config.pair_channels, config.pair_channels // 2
    shapes = _perceptron("pairs.enter", 2 * half + PAIR_WIDTH, 2 * own, own) | _norm("pairs.norm", own)
    shapes |= _linear("pairs.together", own, 1)
    for name in ("product", "difference"):
        shapes |= _linear(f"pairs.{name}", width, half)
    for name in (f"pairs.layers.{number}" for number in range(config.pair_layers)):
        shapes |= _norm(f"{name}.before", own) | _norm(f"{name}.after", own) | _norm(f"{name}.sum", half)
        shapes |= _linear(f"{name}.side", own, half) | _linear(f"{name}.open", own, half)
        shapes |= _linear(f"{name}.answer", half, own) | _linear(f"{name}.heed", own, own)
        shapes |= _perceptron(f"{name}.think", own, 2 * own, own)
    return shapes


def _perceptron(name: str, inner: int, hidden: int, outer: int) -> dict[str, tuple[int, ...]]:
    return _linear(f"{name}.0", inner, hidden) | _linear(f"{name}.2", hidden, outer)


def _linear(name: str, inner: int, outer: int) -> dict[str, tuple[int, ...]]:
    return {f"{name}.weight": (outer, inner), f"{name}.bias": (outer,)}


def _norm(name: str, width: int) -> dict[str, tuple[int, ...]]:
    return {f"{name}.weight": (width,), f"{name}.bias": (width,)}
