"""Pictures and films, and what they say of themselves, as parts of a page."""

from base64 import b64encode
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from springblock.io.records import Record, read_records
from springblock.plotting import film
from springblock.plotting.style import MICRO
from springblock.study.results import FIGURES

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
        "run": told(run),
        "source": address("image/gif", path.read_bytes()),
        "poster": _webp(poster),  # at the force maximum
        "width": poster.width,
        "height": poster.height,
    }


def told(run: Record) -> dict[str, Any]:
    """Return the scene and seed of a run, and when its blocks detach: times in µs, shares in %."""
    times, blocks = run.t_det[np.isfinite(run.t_det)], int(np.count_nonzero(run.contact))
    detached = times.size and {
        "first": MICRO * times.min(),
        "median": MICRO * np.median(times),
        "t_max": MICRO * run.t_max,
        "before": 100.0 * np.count_nonzero(times < run.t_max) / blocks,
    }
    return {"scene": str(run.scene), "seed": run.seed, "blocks": blocks, "detached": detached}


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
