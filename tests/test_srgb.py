"""The sRGB transfer function against numbers of the standard, and there and back."""

import numpy as np
import pytest

from simart_kit.srgb import decoded, encoded, linear_to_srgb, srgb_to_linear, tinted

EVERY = np.stack(np.broadcast_arrays(*[np.arange(256, dtype=np.uint8)] * 4), axis=-1)


@pytest.mark.parametrize(("srgb", "linear"), [(0.0, 0.0), (1.0, 1.0), (0.5, 0.21404), (0.02, 0.02 / 12.92)])
def test_known_values(srgb: float, linear: float) -> None:
    assert float(srgb_to_linear(np.array(srgb))) == pytest.approx(linear, abs=1e-5)
    assert float(linear_to_srgb(np.array(linear))) == pytest.approx(srgb, abs=1e-5)


def test_every_byte_comes_back() -> None:
    np.testing.assert_array_equal(encoded(decoded(EVERY).astype(np.float64)), EVERY)


def test_opacity_is_linear() -> None:
    np.testing.assert_allclose(decoded(EVERY)[:, 3], np.arange(256) / 255, atol=1e-7)


def test_what_is_outside_is_clipped() -> None:
    assert encoded(np.array([-1.0, 2.0, 0.0, 1.5])).tolist() == [0, 255, 0, 255]


def test_a_tint_multiplies_light_and_keeps_opacity() -> None:
    light = decoded(EVERY)[:, :3] * np.float32(0.5)
    np.testing.assert_allclose(decoded(tinted(EVERY, (0.5, 0.5, 0.5, 0.1)))[:, :3], light, atol=5e-3)
    np.testing.assert_array_equal(tinted(EVERY, (0.5, 0.5, 0.5, 0.1))[:, 3], EVERY[:, 3])
