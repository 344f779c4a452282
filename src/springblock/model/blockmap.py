"""Contact masks and friction coefficients from files, and masks cut from topographies."""

import hashlib
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote
from textwrap import shorten
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.pattern import MAX_BLOCKS

Array = NDArray[Any]
#: Trends that may be subtracted from heights, and their names in SurfaceTopography.
TRENDS = {"plane": "height", "quadratic": "curvature"}
_MODES = ("1", "L", "LA", "P", "PA", "RGB", "RGBA")  #: of images with 1 or 8 bits per channel


@dataclass(frozen=True)
class Cut:
    """Cut through a measured topography that defines a contact mask."""

    topography: Path
    spacing: float  #: m, distance between blocks
    bearing_area: float | None = None  #: share of all blocks that are in contact, the highest ones
    height: float | None = None  #: m, least height of the blocks in contact
    channel: str | None = None  #: name of the channel of heights; None: the reader's default
    detrend: str | None = None  #: trend subtracted from the heights before the cut, of `TRENDS`
    size: float | None = None  #: side along x in `unit`, where the file has none; square pixels
    unit: str | None = None  #: of all lengths in the file, where it has none, as "um"

    @property
    def arguments(self) -> str:
        """The cut as options of `springblock mask`."""
        given = {k: v for k, v in vars(self).items() if k != "topography" and v is not None}
        return " ".join(f"--{key.replace('_', '-')} {quote(str(v))}" for key, v in given.items())

    @property
    def name(self) -> str:
        """Name of the file, channel, trend and, by which tables are sorted, level."""
        level = self.height if self.bearing_area is None else self.bearing_area
        words = self.topography.stem, self.channel, self.detrend, str(float(level or 0.0))
        return "_".join(filter(None, words))

    def mask(self) -> Array:
        """Return the blocks in contact, (N_y, N_x) bool, [y, x].

        A block without a height is not in contact. A ValueError says why there is no mask.
        """
        share = self.bearing_area
        if (share is None) == (self.height is None) or not (share is None or 0.0 < share <= 1.0):
            raise ValueError("a cut needs either a bearing_area in (0, 1] or a height")
        with _naming(self.topography):
            heights, level, number = self._heights(), self.height, 0
            if share is not None:
                number = round(share * heights.size)
                ascending = np.sort(np.nan_to_num(heights, nan=-np.inf), axis=None)
                level = ascending[-max(number, 1)]
            contact: Array = heights >= level  # False for NaN
            if share is not None and np.count_nonzero(contact) != number:
                raise ValueError(
                    f"no height puts a share of {share} of the blocks in contact; choose another "
                    f"bearing_area, for instance {contact.mean():.8g}, or a height"
                )
            if not contact.any():
                raise ValueError(f"no block reaches the height of {level} m")
        return contact

    def _heights(self) -> Array:
        """Return heights in m, those at the centres of blocks, (N_y, N_x), [y, x]; NaN: none."""
        try:
            from SurfaceTopography import open_topography
        except ImportError:
            raise ValueError(
                "it needs SurfaceTopography: pip install 'springblock[topography]'"
            ) from None
        with open_topography(self.topography) as reader:
            channels = {None: reader.default_channel} | {c.name: c for c in reader.channels}
            if self.channel not in channels:
                raise ValueError(f"channel must be one of {[*channels][1:]}, not {self.channel!r}")
            measured = self._measured(reader, channels[self.channel])
        if measured.dim != 2 or measured.unit is None:
            raise ValueError("it must hold a map of heights with a unit of length; or give unit")
        metres = measured.to_unit("m")
        metres = metres.detrend(TRENDS[self.detrend]) if self.detrend else metres
        heights: Array = np.ma.filled(np.ma.asarray(metres.heights(), dtype=float), np.nan)
        sides = [size * (1.0 + 1e-9) for size in metres.physical_sizes]
        if not all(self.spacing <= side < (MAX_BLOCKS + 1) * self.spacing for side in sides):
            raise ValueError(f"spacing must put 1 to {MAX_BLOCKS} blocks on each side")
        x, y = (
            ((np.arange(int(side / self.spacing)) + 0.5) * self.spacing / size * points).astype(int)
            for side, size, points in zip(sides, metres.physical_sizes, heights.shape, strict=True)
        )
        return heights[np.ix_(x, y)].T

    def _measured(self, reader: Any, channel: Any) -> Any:
        """Return a channel of a topography, with size and unit where the file has none."""
        known: dict[str, Any] = {}
        for name, own in (("size", channel.physical_sizes), ("unit", channel.unit)):
            if (given := getattr(self, name)) and own is not None:
                raise ValueError(f"its {name} is {own}; leave out {name} = {given}")
        if channel.dim == 2 and channel.physical_sizes is None:
            if not self.size:
                raise ValueError("it does not say how large the map is; give size and unit")
            columns, rows = channel.nb_grid_pts
            known["physical_sizes"] = self.size, self.size * rows / columns
        if self.unit:
            known["unit"] = self.unit
        return reader.topography(channel_index=channel.index, **known)


@dataclass(frozen=True)
class BlockMap:
    """One value per block, from a file: a contact mask, or friction coefficients."""

    name: str  #: name of the file and a digest of the values, as islands-1a2b3c4d
    values: Array | None = field(default=None, compare=False, repr=False)  #: None if not known
    file: Path | None = field(default=None, compare=False, repr=False)  #: file that jobs read
    cut: Cut | None = field(default=None, compare=False, repr=False)  #: cut that makes this file

    def __str__(self) -> str:
        return self.name

    @classmethod
    def mask(cls, file: Path) -> "BlockMap":
        """Read a contact mask, (N_y, N_x) bool, [y, x], from an image or a NumPy array.

        In an image, white pixels are in contact and the last row is y = 0. In an array (.npy),
        non-zero values are in contact and the first row is y = 0.
        """
        with _naming(file):
            values = _array(file) if file.suffix == ".npy" else _image(file)
            found = np.unique(values)
            if not np.isfinite(found).all() or np.count_nonzero(found) != 1:
                raise ValueError("a mask must hold zeros and one other value, in contact")
            return cls(_name(file.stem, values != 0), values != 0, file)

    @classmethod
    def coefficients(cls, file: Path) -> "BlockMap":
        """Read friction coefficients, (N_y, N_x) float, [y, x], from a NumPy array (.npy)."""
        with _naming(file):
            values = _array(file).astype(float)
            return cls(_name(file.stem, values), values, file)

    @classmethod
    def of_topography(cls, cut: Cut, folder: Path) -> "BlockMap":
        """Return the mask of a cut; jobs read it from `folder`."""
        values = cut.mask()
        name = _name(cut.name, values)
        return cls(name, values, folder / f"{name}.npy", cut)


@contextmanager
def _naming(file: Path) -> Iterator[None]:
    """Raise all errors, also those of libraries, as a ValueError of one sentence with the file."""
    try:
        file.stat()
        yield
    except Exception as error:
        raise ValueError(f"{file}: {shorten(str(error) or repr(error), 250)}") from None


def _name(stem: str, values: Array) -> str:
    """Return a name in characters that are safe in paths and tables, with a digest of `values`."""
    if max(values.shape) > MAX_BLOCKS:
        raise ValueError(f"a surface may have at most {MAX_BLOCKS} x {MAX_BLOCKS} blocks")
    content = hashlib.sha256(f"{values.dtype.str} {values.shape} ".encode())
    content.update(np.ascontiguousarray(values).tobytes())
    digest = f"-{content.hexdigest()[:8]}"
    return re.sub(r"[^\w.-]", "_", stem).removesuffix(digest) + digest


def _array(file: Path) -> Array:
    with file.open("rb") as stream:
        values = np.lib.format.read_array(stream, allow_pickle=False)
    if values.dtype.kind not in "biuf" or values.ndim != 2:
        raise ValueError(f"it must hold numbers, (N_y, N_x), not {values.dtype} {values.shape}")
    return values


def _image(file: Path) -> Array:
    """Read which pixels of a black and white image are white, (N_y, N_x), last row first."""
    from PIL import Image, ImageOps

    # from a stream: by name, Pillow 13 garbles plain TIFF files with an orientation
    with file.open("rb") as stream, Image.open(stream) as image:
        is_plain = image.mode in _MODES and getattr(image, "n_frames", 1) == 1
        pixels = np.asarray(ImageOps.exif_transpose(image).convert("RGBA"))
    black, white = ((pixels == (*[shade] * 3, 255)).all(axis=2) for shade in (0, 255))
    if not (is_plain and (black | white).all()):
        raise ValueError(
            "it must be one black and white picture of 1 or 8 bits, without grey, colour or "
            "transparency: choose a threshold, with white for the pixels in contact"
        )
    return white[::-1]
