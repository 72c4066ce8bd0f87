"""The sRGB transfer function of IEC 61966-2-1: how bytes of pictures and linear light translate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import ByteArray, Float32Array, FloatArray


def srgb_to_linear(values: FloatArray) -> FloatArray:
    """Turn sRGB values 0..1 into linear light 0..1."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def linear_to_srgb(values: FloatArray) -> FloatArray:
    """Turn linear light into sRGB values 0..1; light outside 0..1 is clipped."""
    light = np.clip(values, 0.0, 1.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


_BYTE_TO_LINEAR = srgb_to_linear(np.arange(256) / 255.0)


def decoded(rgba: ByteArray) -> Float32Array:
    """(..., 4) linear RGBA 0..1 of sRGB bytes; opacity is linear already."""
    linear: Float32Array = _BYTE_TO_LINEAR.astype(np.float32)[rgba]
    linear[..., 3] = rgba[..., 3] * np.float32(1 / 255)
    return linear


def encoded(linear: FloatArray) -> ByteArray:
    """(..., 4) sRGB bytes of linear RGBA; what is outside 0..1 is clipped."""
    alpha = np.clip(linear[..., 3:], 0.0, 1.0)
    values = np.concatenate([linear_to_srgb(linear[..., :3]), alpha], axis=-1)
    return np.asarray(np.rint(255.0 * values), dtype=np.uint8)


def tinted(rgba: ByteArray, factor: Sequence[float]) -> ByteArray:
    """(..., 4) sRGB bytes times a linear RGB(A) factor, as glTF 2.0 multiplies them; alpha is kept."""
    table = np.round(255.0 * linear_to_srgb(_BYTE_TO_LINEAR[:, None] * np.array(factor[:3]))).astype(np.uint8)
    channels = [table[rgba[..., channel], channel] for channel in range(3)]
    return np.stack([*channels, rgba[..., 3]], axis=-1)
