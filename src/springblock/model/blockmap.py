"""Contact masks, friction coefficients and topographies from files."""

import hashlib
import math
import re
import reprlib
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote
from tokenize import TokenError  # NumPy parses headers
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.files import MENDING
from springblock.model.pattern import MAX_BLOCKS

Array = NDArray[Any]

#: Name of a mask cut by a study, which ends with its digest.
_IS_NAMED = re.compile(r".*-[0-9a-f]{8}")
_POINTS, _BYTES = 2**26, 2**28  #: largest topography, 8192 x 8192 points and some 260 MB
#: Image formats. Pillow reads more, among them PostScript, for which it starts another program.
_FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TIFF", "WEBP")
#: Trends that may be subtracted from heights, and their names in SurfaceTopography.
TRENDS = {"plane": "height", "quadratic": "curvature"}
_MODES = ("1", "L", "LA", "P", "PA", "RGB", "RGBA")  #: image modes, by Pillow's names


@dataclass(frozen=True)
class Cut:
    """Cut through a measured topography that defines a contact mask."""

    topography: Path
    spacing: float  #: m, distance between blocks
    bearing_area: float | None = None  #: share of all blocks that are in contact, the highest ones
    height: float | None = None  #: m, least height of the blocks in contact
    channel: str | None = None  #: name of the channel of heights; None: the reader's default
    detrend: str | None = None  #: trend subtracted from the heights before the cut, of `TRENDS`

    @property
    def arguments(self) -> str:
        """The cut as options of `springblock mask`."""
        given = {name: value for name, value in vars(self).items() if value is not None}
        del given["topography"]  # the argument of the command
        return " ".join(
            f"--{name.replace('_', '-')} {quote(str(value))}" for name, value in given.items()
        )

    def mask(self) -> Array:
        """Blocks in contact, (N_y, N_x) bool, [y, x].

        The height of a block is that of the measured point at its centre; a block without a value
        is not in contact. Without `detrend` the heights are those of the file, tilt included; with
        it they are relative to a plane or a quadratic surface, fitted by least squares.
        """
        if (self.bearing_area is None) == (self.height is None):
            raise ValueError(f"{self.topography}: give either bearing_area or height")
        if self.bearing_area is not None and not 0.0 < self.bearing_area <= 1.0:
            raise ValueError(f"bearing_area must be in (0, 1], not {self.bearing_area!r}")
        if not self.spacing > 0.0:
            raise ValueError(f"spacing must be positive, not {self.spacing!r}")
        heights = self._heights()
        level, number = self.height, round((self.bearing_area or 0.0) * heights.size)
        if level is None:
            highest = np.sort(heights[np.isfinite(heights)])[::-1]
            level = highest[min(max(number, 1), highest.size) - 1]
        contact = heights >= level  # False for NaN
        if self.bearing_area is not None and contact.sum() != number:
            possible = [np.count_nonzero(heights > level), contact.sum()]
            nearest = " or ".join(f"{n / heights.size:.8g}" for n in possible if n)
            raise ValueError(
                f"{self.topography}: no height puts a share of {self.bearing_area!r} of the blocks "
                f"in contact; choose the bearing area {nearest}, or a height"
            )
        if not contact.any():
            raise ValueError(
                f"{self.topography}: height = {level!r} m is above the highest block, "
                f"{np.nanmax(heights):.4g} m"
            )
        return contact

    @property
    def name(self) -> str:
        """Name of the file, channel, trend and, by which tables are sorted, level."""
        level = self.height if self.bearing_area is None else self.bearing_area
        words = self.topography.stem, self.channel, self.detrend, str(float(level or 0.0))
        return "_".join(filter(None, words))

    def _heights(self) -> Array:
        """Heights in m at the centres of blocks, (N_y, N_x), [y, x]; NaN if not measured."""
        heights, sizes = _measured(self.topography, self.channel, self.detrend)
        number = [size / self.spacing * (1.0 + 1e-9) for size in sizes]
        if not all(1.0 <= blocks < MAX_BLOCKS + 1.0 for blocks in number):
            raise ValueError(
                f"{self.topography} is {sizes[0]:.4g} x {sizes[1]:.4g} m; each side must hold 1 to "
                f"{MAX_BLOCKS} blocks of spacing = {self.spacing!r} m"
            )
        x, y = (
            ((np.arange(n) + 0.5) * self.spacing / size * points).astype(int)
            for n, size, points in zip(map(int, number), sizes, heights.shape, strict=True)
        )
        return heights[np.ix_(x, y)].T


@dataclass(frozen=True)
class BlockMap:
    """One value per block, from a file: a contact mask, or friction coefficients.

    The name contains a digest of the values, so that a changed file is a different map.
    """

    name: str  #: name of the file and eight digits, as islands-1a2b3c4d
    values: Array | None = field(default=None, compare=False, repr=False)  #: None if not known
    file: Path | None = field(default=None, compare=False, repr=False)  #: file that jobs read
    cut: Cut | None = field(default=None, compare=False, repr=False)  #: cut that makes this file

    def __str__(self) -> str:
        return self.name

    @classmethod
    def mask(cls, file: Path) -> "BlockMap":
        """Read a contact mask, (N_y, N_x) bool, [y, x], from an image or a NumPy array.

        In a black and white image, white pixels are in contact, and the last row is y = 0, as the
        image is seen. In an array (.npy), non-zero values are in contact, and the first row is
        y = 0.
        """
        values = _array(file) if file.suffix == ".npy" else _image(file)
        found = np.unique(values)
        is_number = values.dtype.kind in "biuf"
        if not (is_number and np.isfinite(found).all() and np.count_nonzero(found) <= 1):
            raise ValueError(
                f"{file}: a contact mask must hold zeros and one other value, "
                f"not {reprlib.repr(found.tolist())}"
            )
        if not found.any():
            raise ValueError(f"{file}: at least one block must be in contact, not zero or black")
        name = _name(file.stem, values != 0)
        if _IS_NAMED.fullmatch(file.stem) and name != file.stem:
            raise ValueError(f"{file} holds the mask {name}, not that of its name; {MENDING}")
        return cls(name, values != 0, file)

    @classmethod
    def coefficients(cls, file: Path) -> "BlockMap":
        """Read friction coefficients, (N_y, N_x) float, [y, x], from a NumPy array (.npy)."""
        values = _array(file)
        if values.dtype.kind not in "iuf":
            raise ValueError(f"{file} must hold real numbers, not {values.dtype}")
        values = values.astype(float)
        return cls(_name(file.stem, values), values, file)

    @classmethod
    def of_topography(cls, cut: Cut, folder: Path) -> "BlockMap":
        """Return the mask of a cut; jobs read it from `folder`."""
        values = cut.mask()
        name = _name(cut.name, values)
        return cls(name, values, folder / f"{name}.npy", cut)


def _name(stem: str, values: Array) -> str:
    """Name in characters that are safe in paths and tables, with a digest of `values`."""
    content = hashlib.sha256(f"{values.dtype.str} {values.shape} ".encode())
    content.update(np.ascontiguousarray(values).tobytes())
    digest = f"-{content.hexdigest()[:8]}"
    return re.sub(r"[^\w.-]", "_", stem).removesuffix(digest) + digest


def _array(file: Path) -> Array:
    """Read a two-dimensional array; pickled objects are never loaded."""
    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    try:
        with np.errstate(over="ignore"):  # a damaged header may give an impossible size
            values = np.load(file, mmap_mode="r", allow_pickle=False)
    except (ValueError, OSError, OverflowError, EOFError, TokenError):
        values = None
    if not isinstance(values, np.ndarray):
        raise ValueError(f"{file} must be an array of numbers saved by NumPy as .npy")
    if values.ndim != 2 or not values.size:
        raise ValueError(f"{file} must have the shape (N_y, N_x), not {values.shape}")
    if max(values.shape) > MAX_BLOCKS:  # only the header has been read
        raise ValueError(
            f"{file} is too large; a surface may have at most {MAX_BLOCKS} x {MAX_BLOCKS} blocks"
        )
    return np.array(values)


def _image(file: Path) -> Array:
    """Read a black and white image, (N_y, N_x) of 0 and 255, last row first."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            # from a stream: by name, Pillow 13 garbles plain TIFF files with an orientation
            with file.open("rb") as stream, Image.open(stream, formats=_FORMATS) as image:
                if max(image.size) > MAX_BLOCKS:  # only the header has been read
                    raise Image.DecompressionBombError
                mode, pictures = image.mode, getattr(image, "n_frames", 1)
                pixels = np.asarray(ImageOps.exif_transpose(image).convert("RGBA"))
    except UnidentifiedImageError:
        raise ValueError(f"{file} is neither an image nor a NumPy array (.npy)") from None
    except (Image.DecompressionBombWarning, Image.DecompressionBombError):
        raise ValueError(
            f"{file} is too large; a surface may have at most {MAX_BLOCKS} x {MAX_BLOCKS} blocks"
        ) from None
    except (OSError, SyntaxError, ValueError) as error:
        raise ValueError(f"{file} cannot be read: {error}") from None
    if pictures > 1:
        raise ValueError(f"{file} holds {pictures} pictures; save the one to be used as a file")
    shades, opacity = pixels[..., 0], pixels[..., 3]
    is_grey = mode in _MODES and (pixels[..., :3] == shades[..., None]).all()
    if not (is_grey and np.isin(shades, (0, 255)).all() and (opacity == 255).all()):
        raise ValueError(
            f"{file} must be black and white, with 1 or 8 bits per channel: only the values 0 and "
            "255, no grey, colour or transparency; choose a threshold and save the image again "
            "with white for the pixels in contact and black for all others"
        )
    return shades[::-1]


class _Unsuitable(ValueError):
    """A topography that can be read and not be used."""


def _measured(
    file: Path, channel: str | None, detrend: str | None
) -> tuple[Array, tuple[float, float]]:
    """Heights, [x, y], NaN if not measured, and size along x and y, all in m.

    Read by SurfaceTopography (https://contactengineering.github.io/SurfaceTopography/).
    """
    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    if file.stat().st_size > _BYTES:
        raise ValueError(f"{file} is too large; a topography may have at most {_BYTES} bytes")
    try:
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import ReadFileError
    except ImportError:
        raise ValueError(
            f"to read {file} install SurfaceTopography: pip install 'springblock[topography]'"
        ) from None
    try:
        with open_topography(file) as reader:
            named = [each for each in reader.channels if channel in (None, each.name)]
            if channel is not None and len(named) != 1:
                known = ", ".join(each.name for each in reader.channels)
                raise _Unsuitable(f"channel must be the name of one of {known}, not {channel!r}")
            chosen = reader.default_channel if channel is None else named[0]
            if not getattr(chosen, "is_height_channel", True):  # unknown to version 1.15
                raise _Unsuitable(
                    f"its channel {chosen.name!r} has no heights, but {chosen.data_unit}"
                )
            points = math.prod(chosen.nb_grid_pts)
            if points > _POINTS:
                raise _Unsuitable(f"it has {points} points; {_POINTS} is the largest number")
            read = reader.topography(channel_index=chosen.index)
    except _Unsuitable as error:
        raise ValueError(f"{file}: {error}") from None
    except ReadFileError:
        raise ValueError(f"{file} is not a topography that SurfaceTopography can read") from None
    except Exception as error:  # readers of some formats let any error pass
        if "physical_sizes" not in str(error):
            raise ValueError(f"{file} cannot be read: {error!r}") from None
        read = None
    if read is None or read.unit is None or read.physical_sizes is None:
        raise ValueError(f"{file} must contain the size of the surface and its unit of length")
    if read.dim != 2:
        raise ValueError(f"{file} must be a map of heights, not a profile")
    try:
        metres = read.to_unit("m")
        if detrend is not None:
            metres = metres.detrend(TRENDS[detrend])
        heights: Array = np.ma.filled(np.ma.asarray(metres.heights(), dtype=float), np.nan)
    except ValueError:
        raise ValueError(f"{file}: its unit must be a length, not {read.unit!r}") from None
    if not np.isfinite(heights).any():
        raise ValueError(f"{file} has no valid point; it must hold heights")
    return heights, metres.physical_sizes
