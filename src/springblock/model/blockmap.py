"""Surfaces of one's own: contact masks, coefficients and topographies, read from files."""

import hashlib
import math
import re
import reprlib
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.files import MENDING
from springblock.model.pattern import MAX_BLOCKS

Array = NDArray[Any]

_TOO_LARGE = f"is larger than the {MAX_BLOCKS} x {MAX_BLOCKS} blocks that the solver goes up to"
#: With the digest that a study puts into the name of a mask that it cuts.
_IS_NAMED = re.compile(r".*-[0-9a-f]{8}")
_POINTS, _BYTES = 2**26, 2**28  #: of a measurement, 8192 x 8192 and some 260 MB
#: Of images. Pillow knows more; one of them, PostScript, it has another program run.
_FORMATS = ("BMP", "GIF", "JPEG", "PNG", "PPM", "TIFF", "WEBP")
_MODES = ("1", "L", "LA", "P", "PA", "RGB", "RGBA")  #: of images, by Pillow's names


@dataclass(frozen=True)
class Cut:
    """How a contact mask follows from a measured topography."""

    topography: Path
    spacing: float  #: m, distance between blocks
    bearing_area: float | None = None  #: share of the blocks that are in contact, the highest
    height: float | None = None  #: m, that blocks in contact reach

    @property
    def arguments(self) -> str:
        """The cut as options of `springblock mask`."""
        named = {"spacing": self.spacing, "bearing-area": self.bearing_area, "height": self.height}
        return " ".join(f"--{key} {value}" for key, value in named.items() if value is not None)

    def mask(self) -> Array:
        """Blocks that are in contact, (N_y, N_x) bool, [y, x].

        A block takes the height of the point of measurement that its centre lies on; where there
        is no value it is not in contact. Heights are as the file has them: level a surface that
        is tilted beforehand.

        Raises
        ------
        ValueError
            Where the file cannot be read, has no units, or holds no block; where not one of
            bearing area and height is given; or where these or the spacing make no sense.
        """
        if (self.bearing_area is None) == (self.height is None):
            raise ValueError(f"{self.topography} is cut at either a bearing_area or a height")
        if self.bearing_area is not None and not 0.0 < self.bearing_area <= 1.0:
            raise ValueError(f"bearing_area must be above 0 and up to 1, not {self.bearing_area!r}")
        if not self.spacing > 0.0:
            raise ValueError(f"spacing must be positive, not {self.spacing!r}")
        heights = _on_blocks(self.topography, self.spacing)
        level = self.height
        if self.bearing_area is not None:
            highest = np.sort(heights[np.isfinite(heights)])[::-1]
            number = max(1, round(self.bearing_area * heights.size))
            level = highest[min(number, highest.size) - 1]
        contact = heights >= level  # False where there is none
        if not contact.any():
            raise ValueError(
                f"{self.topography} must reach the height it is cut at, {level!r} m; "
                f"its highest block is at {np.nanmax(heights):.4g} m"
            )
        return contact


@dataclass(frozen=True)
class BlockMap:
    """One value per block, from a file: a contact mask, or friction coefficients.

    Its name holds a digest of the values: a file that has changed is another map.
    """

    name: str  #: name of the file and eight digits, as islands-1a2b3c4d
    values: Array | None = field(default=None, compare=False, repr=False)  #: None: its name alone
    file: Path | None = field(default=None, compare=False, repr=False)  #: that jobs read it from
    cut: Cut | None = field(default=None, compare=False, repr=False)  #: that makes this file

    def __str__(self) -> str:
        return self.name

    @classmethod
    def mask(cls, file: Path) -> "BlockMap":
        """Read a contact mask, (N_y, N_x) bool, [y, x], from an image or an array of NumPy.

        White pixels of a black and white image are in contact; its last row is y = 0, so that it
        is seen upright. Of an array (.npy) all but zeros are in contact; its first row is y = 0.

        Raises
        ------
        ValueError
            With one sentence on what is wrong with the file.
        """
        values = _array(file) if file.suffix == ".npy" else _image(file)
        found = np.unique(values)
        is_number = values.dtype.kind in "biuf"
        if not (is_number and np.isfinite(found).all() and np.count_nonzero(found) <= 1):
            raise ValueError(
                f"{file} must hold zeros and one other value, as a contact mask does, "
                f"not {reprlib.repr(found.tolist())}"
            )
        if not found.any():
            raise ValueError(f"{file} must have a block in contact: it is zero, or black, all over")
        name = _name(file, values != 0)
        if _IS_NAMED.fullmatch(file.stem) and name != file.stem:
            raise ValueError(f"{file} holds {name}, not the mask of its name; {MENDING}")
        return cls(name, values != 0, file)

    @classmethod
    def coefficients(cls, file: Path) -> "BlockMap":
        """Read friction coefficients, (N_y, N_x) float, [y, x], from an array of NumPy (.npy).

        Raises
        ------
        ValueError
            With one sentence on what is wrong with the file.
        """
        values = _array(file)
        if values.dtype.kind not in "iuf":
            raise ValueError(f"{file} must hold real numbers, not {values.dtype}")
        values = values.astype(float)
        return cls(_name(file, values), values, file)

    @classmethod
    def of_topography(cls, cut: Cut, folder: Path) -> "BlockMap":
        """Cut a topography; jobs will find the mask in `folder`."""
        values = cut.mask()
        name = _name(cut.topography, values)
        return cls(name, values, folder / f"{name}.npy", cut)


def _name(file: Path, values: Array) -> str:
    """Name of a file without what paths and tables are built with, and a digest of its values."""
    content = hashlib.sha256(f"{values.dtype.str} {values.shape} ".encode())
    content.update(np.ascontiguousarray(values).tobytes())
    digest = f"-{content.hexdigest()[:8]}"
    return re.sub(r"[^\w.-]", "_", file.stem).removesuffix(digest) + digest


def _array(file: Path) -> Array:
    """Read an array of two dimensions; anything but plain numbers is never loaded."""
    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    try:
        with np.errstate(over="ignore"):  # of a size that no file has
            values = np.load(file, mmap_mode="r", allow_pickle=False)
    except (ValueError, OSError, OverflowError, EOFError):
        values = None
    if not isinstance(values, np.ndarray):
        raise ValueError(f"{file} must be an array of numbers that NumPy has saved as .npy")
    if values.ndim != 2 or not values.size:
        raise ValueError(f"{file} must have the shape (N_y, N_x), not {values.shape}")
    if max(values.shape) > MAX_BLOCKS:  # nothing but the header has been read
        raise ValueError(f"{file} {_TOO_LARGE}")
    return np.array(values)


def _image(file: Path) -> Array:
    """Read a black and white image, (N_y, N_x) of 0 and 255, from below."""
    from PIL import Image, UnidentifiedImageError

    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(file, formats=_FORMATS) as image:
                if max(image.size) > MAX_BLOCKS:  # nothing but the header has been read
                    raise Image.DecompressionBombError
                mode = image.mode
                pixels = np.asarray(image.convert("RGBA"))
    except UnidentifiedImageError:
        raise ValueError(f"{file} is neither an image nor an array of NumPy (.npy)") from None
    except (Image.DecompressionBombWarning, Image.DecompressionBombError):
        raise ValueError(f"{file} {_TOO_LARGE}") from None
    except (OSError, SyntaxError, ValueError) as error:
        raise ValueError(f"{file} cannot be read: {error}") from None
    shades, opacity = pixels[..., 0], pixels[..., 3]
    is_grey = mode in _MODES and (pixels[..., :3] == shades[..., None]).all()
    if not (is_grey and np.isin(shades, (0, 255)).all() and (opacity == 255).all()):
        raise ValueError(
            f"{file} must be black and white, of 8 bits or 1 a pixel and of the values 0 and 255 "
            "alone: neither grey, coloured nor transparent"
        )
    return shades[::-1]


def _on_blocks(file: Path, spacing: float) -> Array:
    """Heights in m at the centres of blocks, (N_y, N_x), [y, x]; NaN where there are none."""
    heights, sizes = _measured(file)
    number = [size / spacing * (1.0 + 1e-9) for size in sizes]
    if not all(1.0 <= blocks < MAX_BLOCKS + 1.0 for blocks in number):
        raise ValueError(
            f"{file} must hold 1 to {MAX_BLOCKS} blocks of {spacing!r} m a side; "
            f"it is {sizes[0]:.4g} x {sizes[1]:.4g} m"
        )
    x, y = (
        ((np.arange(n) + 0.5) * spacing / size * points).astype(int)
        for n, size, points in zip(map(int, number), sizes, heights.shape, strict=True)
    )
    return heights[np.ix_(x, y)].T


def _measured(file: Path) -> tuple[Array, tuple[float, float]]:
    """Heights, [x, y], NaN where there are none, and the size along x and y, all in m.

    SurfaceTopography reads the file (https://contactengineering.github.io/SurfaceTopography/).
    """
    if not file.is_file():
        raise ValueError(f"{file} does not exist")
    try:
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import ReadFileError
    except ImportError:
        raise ValueError(
            f"to read {file} install SurfaceTopography: pip install 'springblock[topography]'"
        ) from None
    if file.stat().st_size > _BYTES:
        raise ValueError(f"{file} has more than {_BYTES} bytes, the most that are read")
    no_units = f"{file} must say its size and its unit, which it does not"
    try:
        with open_topography(file) as reader:
            points = math.prod(reader.default_channel.nb_grid_pts)
            if points > _POINTS:
                raise ValueError(f"it has {points} points; {_POINTS} are the most that are read")
            read = reader.topography()
    except ReadFileError:
        raise ValueError(f"{file} is no topography that SurfaceTopography can read") from None
    except Exception as error:  # readers of some formats raise whatever goes wrong in them
        reason = no_units if "physical_sizes" in str(error) else f"{file} cannot be read: {error!r}"
        raise ValueError(reason) from None
    if read.dim != 2:
        raise ValueError(f"{file} must be a map of heights, not a line")
    if read.unit is None or read.physical_sizes is None:
        raise ValueError(no_units)
    try:
        metres = read.to_unit("m")
        heights: Array = np.ma.filled(np.ma.asarray(metres.heights(), dtype=float), np.nan)
    except ValueError:
        raise ValueError(f"{file} must have a unit of length, not {read.unit!r}") from None
    if not np.isfinite(heights).any():
        raise ValueError(f"{file} must hold heights; it has no valid point")
    return heights, metres.physical_sizes
