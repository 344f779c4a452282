"""Pictures and films, and what they say of themselves, as parts of a page."""

from base64 import b64encode
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from springblock.io.records import Record, read_records
from springblock.plotting import film
from springblock.plotting.caption import sample_in_words
from springblock.plotting.figures import FIGURES
from springblock.plotting.style import MICRO

_WIDE = 1800  #: pixels that a picture in the page has at least, if the file has them


def picture(path: Path) -> dict[str, Any]:
    """Read a figure for the page; its caption is the one that the file keeps."""
    declared, name = FIGURES.get(path.stem), path.stem
    with Image.open(path) as file:
        written = str(file.info.get("Description", ""))
        size = 25.4 * file.width / float(file.info.get("dpi", (600.0,))[0])
        small = file.convert("RGB").reduce(max(1, file.width // _WIDE))
    caption = declared.caption if declared and written.startswith(declared.caption) else written
    return {
        "name": name,
        "category": declared.category if declared else "Sweeps",
        "title": _title(name, declared.title if declared else ""),
        "caption": caption,
        "sample": written.removeprefix(caption).strip(),  # and what bands and symbols mean
        "source": _webp(small),
        "width": small.width,
        "height": small.height,
        "size": size,  # mm, its width in print
    }


def moving(path: Path, batch: Path) -> dict[str, Any]:
    """Read a film of the first run of a batch, and say from the run what it shows."""
    run = read_records([batch])[0]
    poster = Image.fromarray(film.frames(run, [run.t_max - run.time[1], run.t_max])[-1])
    return {
        "name": path.stem,
        "text": in_words(run),
        "source": address("image/gif", path.read_bytes()),
        "poster": _webp(poster),  # at the force maximum
        "width": poster.width,
        "height": poster.height,
    }


def in_words(run: Record) -> str:
    """Say what a film of a run shows, and when most of its blocks detach."""
    times = run.t_det[np.isfinite(run.t_det)]
    blocks = int(np.count_nonzero(run.contact))
    surface = sample_in_words({run.scene: range(run.seed, run.seed + 1)})
    said = f"{surface} {blocks} blocks are in contact."
    if not times.size:
        return f"{said} None of them detaches."
    first, half = MICRO * times.min(), MICRO * np.median(times)
    before = 100.0 * np.count_nonzero(times < run.t_max) / blocks
    return (
        f"{said} The first detaches at {first:.1f} µs and the median one at {half:.1f} µs. The "
        f"force is largest at {MICRO * run.t_max:.1f} µs, when {before:.1f} % have detached."
    )


def _title(name: str, declared: str) -> str:
    """Figure 6: Force and detachments, ...: what a figure is called, numbered if in the paper."""
    words = name.replace("_", " ").capitalize()
    return f"{words}: {declared}" if name.startswith("figure_") else declared or words


def _webp(image: Image.Image) -> str:
    """A picture, to the bit, in half the bytes of PNG."""
    kept = BytesIO()
    image.save(kept, "WEBP", lossless=True, quality=50, method=4)
    return address("image/webp", kept.getvalue())


def address(kind: str, content: bytes) -> str:
    """Return a data URL, which holds all of a file's content."""
    return f"data:{kind};base64,{b64encode(content).decode()}"
