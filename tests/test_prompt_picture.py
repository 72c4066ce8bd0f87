"""Pictures of objects, and photos of users: what is read, how it is fitted, and what is refused."""

import io
import struct
import zlib

import numpy as np
import pytest
from PIL import Image
from simart_kit_plugins.simart.prompt import picture as pictures
from simart_kit_plugins.simart.prompt.picture import from_png, object_picture, png, read_picture

from simart_kit.errors import BadInputError
from simart_kit.testing.meshes import cabinet_mesh

RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)


def saved(path, image, **options):
    image.save(path, **options)
    return path


def color(picture, row, column):
    return tuple(picture[row, column].tolist())


def test_an_object_stands_on_white_and_keeps_off_the_border():
    picture = object_picture(cabinet_mesh())
    assert picture.shape == (252, 252, 3)
    assert picture.dtype == np.uint8
    border = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
    assert (border == 255).all()
    assert 0.05 < (picture != 255).any(axis=2).mean() < 0.8
    assert object_picture(cabinet_mesh(), 64).shape == (64, 64, 3)


def test_png_keeps_every_pixel_and_gives_the_same_bytes():
    picture = np.random.default_rng(0).integers(0, 256, (9, 7, 3), dtype=np.uint8)
    assert (from_png(png(picture)) == picture).all()
    assert png(picture) == png(picture.copy())


@pytest.mark.parametrize("suffix", ["png", "jpg", "webp"])
def test_a_wide_photo_is_fitted_and_padded_to_a_white_square(tmp_path, suffix):
    picture = read_picture(saved(tmp_path / f"photo.{suffix}", Image.new("RGB", (400, 200), BLUE)))
    assert picture.shape == (252, 252, 3)
    assert not picture.flags.writeable
    # 400 x 200 becomes 252 x 126 in the middle: rows 63 to 188.
    assert (picture[:62] == 255).all()
    assert (picture[190:] == 255).all()
    assert np.abs(picture[65:187].astype(int) - BLUE).max() <= 3


def test_a_small_photo_is_enlarged_and_a_thin_one_is_kept(tmp_path):
    small = read_picture(saved(tmp_path / "small.png", Image.new("RGB", (2, 2), RED)))
    assert (small == RED).all()
    thin = read_picture(saved(tmp_path / "thin.png", Image.new("RGB", (3000, 1), RED)))
    assert (thin == RED).all(axis=2).any()
    assert thin.shape == (252, 252, 3)


def test_a_phones_orientation_is_followed(tmp_path):
    image = Image.new("RGB", (40, 20), RED)
    image.paste(GREEN, (0, 0, 20, 20))  # green is left, and 6 says: turn right, so that it is above
    exif = Image.Exif()
    exif[0x0112] = 6
    picture = read_picture(saved(tmp_path / "phone.png", image, exif=exif.tobytes()))
    assert color(picture, 40, 126) == GREEN
    assert color(picture, 210, 126) == RED
    assert color(picture, 126, 20) == (255, 255, 255)


@pytest.mark.parametrize("mode", ["RGBA", "LA", "P"])
def test_transparent_places_become_white(tmp_path, mode):
    image = Image.new("RGBA", (20, 20), (0, 0, 0, 0))
    image.paste((0, 0, 0, 255), (0, 10, 20, 20))
    picture = read_picture(saved(tmp_path / "cut_out.png", image.convert(mode)))
    assert color(picture, 30, 126) == (255, 255, 255)
    assert color(picture, 220, 126) == (0, 0, 0)


def test_half_transparent_is_mixed_with_white(tmp_path):
    picture = read_picture(saved(tmp_path / "glass.png", Image.new("RGBA", (8, 8), (0, 0, 0, 51))))
    assert color(picture, 100, 100) == (204, 204, 204)  # a fifth of black


@pytest.mark.parametrize(("mode", "value", "seen"), [("L", 80, 80), ("I;16", 80 * 256, 80), ("1", 1, 255)])
def test_grey_photos_of_any_depth_are_read(tmp_path, mode, value, seen):
    picture = read_picture(saved(tmp_path / "grey.png", Image.new(mode, (8, 8), value)))
    assert (picture == seen).all()


def test_a_printers_jpeg_is_read(tmp_path):
    picture = read_picture(saved(tmp_path / "cmyk.jpg", Image.new("CMYK", (8, 8), (255, 255, 0, 0))))
    assert picture[100, 100].argmax() == 2  # cyan and magenta ink give blue


def test_the_shorter_way_through_a_large_jpeg_shows_the_same(tmp_path):
    ramp = np.broadcast_to(np.linspace(0, 255, 2000).astype(np.uint8)[:, None, None], (2000, 1000, 3))
    picture = read_picture(saved(tmp_path / "large.jpg", Image.fromarray(ramp.copy()), quality=95))
    middle = picture[:, 126].astype(float)[:, 0]
    assert np.abs(middle - np.linspace(0, 255, 252)).max() < 4


@pytest.mark.parametrize("kind", ["png", "jpg", "webp"])
def test_a_truncated_photo_is_refused(tmp_path, kind):
    noise = np.random.default_rng(1).integers(0, 256, (90, 90, 3), dtype=np.uint8)
    path = saved(tmp_path / f"cut.{kind}", Image.fromarray(noise))
    path.write_bytes(path.read_bytes()[:-2000])
    with pytest.raises(BadInputError, match=rf"cut\.{kind}: .*(damaged or cut off|is no PNG, JPEG or WebP)"):
        read_picture(path)


def test_a_file_that_is_no_photo_is_refused(tmp_path):
    (tmp_path / "note.png").write_text("hello")
    (tmp_path / "empty.png").write_bytes(b"")
    saved(tmp_path / "old.png", Image.new("RGB", (4, 4)), format="BMP")
    for name in ("note.png", "empty.png", "old.png"):
        with pytest.raises(BadInputError, match=rf"{name}: this is no PNG, JPEG or WebP picture; save it as"):
            read_picture(tmp_path / name)
    with pytest.raises(BadInputError, match=r"none\.png: there is no such picture file"):
        read_picture(tmp_path / "none.png")
    with pytest.raises(BadInputError, match=r"cannot be read \(Is a directory\)"):
        read_picture(tmp_path)
    with pytest.raises(BadInputError, match=r"cannot be read \(embedded null"):
        read_picture(tmp_path / "a\0b.png")


def header(width, height):
    """A PNG file that says its size, and ends where its pixels begin."""
    chunk = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    start = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + chunk + struct.pack(">I", zlib.crc32(chunk))
    return start + struct.pack(">I", 100) + b"IDAT"


@pytest.mark.parametrize("side", [9_000, 9_500, 60_000])
def test_a_huge_picture_is_refused_before_it_is_decoded(tmp_path, side):
    (tmp_path / "bomb.png").write_bytes(header(side, side))
    with pytest.raises(BadInputError, match=r"bomb\.png: the picture has more than 80 megapixels .*smaller"):
        read_picture(tmp_path / "bomb.png")


def test_a_huge_file_is_refused_before_it_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr(pictures, "MAX_BYTES", 2**20)
    path = tmp_path / "long.png"
    path.write_bytes(bytes(3 * 2**20))
    with pytest.raises(BadInputError, match=r"long\.png: the file has 3 MiB, at most 1 are read"):
        read_picture(path)


def test_a_data_sets_picture_must_be_a_whole_png():
    data = png(np.random.default_rng(2).integers(0, 256, (20, 20, 3), dtype=np.uint8))
    with pytest.raises(BadInputError, match="shard 3: the picture is damaged"):
        from_png(data[: len(data) // 2], "shard 3")
    buffer = io.BytesIO()
    Image.new("RGB", (4, 4)).save(buffer, "JPEG")
    with pytest.raises(BadInputError, match="the picture: this is no PNG picture"):
        from_png(buffer.getvalue())
