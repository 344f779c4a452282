"""A film of one run: the detaching blocks beside the force curve."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from springblock.files import whole_file
from springblock.model.numbers import Array
from springblock.plotting import maps, style
from springblock.plotting.style import MICRO, MM
from springblock.simulation.run import Run, friction

FRAMES, PER_SECOND = 150, 20  #: 7.5 s
_HOLD = 15  #: of these frames show the end
_AROUND = 0.1  #: time shown before the first and after the last detachment over that in between
_PIXELS = 5  #: per mm
_HEIGHT = 112.0  #: mm
_MAP, _SIDE = 13.0, 72.0  #: left edge of the map and its side, mm: 360 pixels
_CURVES = _MAP + _SIDE + 19.0  #: left edge of the curves, mm

Frame = NDArray[np.uint8]  #: (height, width, 3)
#: Moves the film on to a time, given the time of the frame before, s; returns what has moved.
Update = Callable[[float, float], list[Artist]]


def animate(run: Run, path: str | Path) -> None:
    """Write a film as GIF or MP4, by the suffix of `path`, whole or not at all.

    MP4 needs the package imageio-ffmpeg; a ValueError names it if it is missing.
    """
    file = Path(path)
    if file.suffix not in _WRITERS:
        raise ValueError(f"{file}: unknown type of film; choose {' or '.join(_WRITERS)}")
    with whole_file(file) as partial:
        _WRITERS[file.suffix](frames(run), partial)


@style.journal
def frames(run: Run, times: ArrayLike | None = None) -> list[Frame]:
    """Draw the frames at these times in s, or all; static artists are drawn only once."""
    picture, update = scenery(run)
    canvas: Any = FigureCanvasAgg(picture)  # which has no types of its own
    canvas.draw()
    still, drawn, before = canvas.copy_from_bbox(picture.bbox), [], 0.0
    for now in moments(run) if times is None else np.asarray(times, dtype=float):
        canvas.restore_region(still)
        for artist in update(now, before):
            picture.draw_artist(artist)
        drawn.append(np.array(canvas.buffer_rgba())[..., :3])
        before = now
    return drawn


def moments(run: Run) -> Array:
    """Return the times of the frames in s, (FRAMES,): evenly spaced, then held at the end."""
    return np.pad(np.linspace(*span(run), FRAMES - _HOLD), (0, _HOLD), mode="edge")


def span(run: Run) -> tuple[float, float]:
    """Return the time span of the film, s.

    That is the time from the first to the last detachment, and a little before and after it: the
    loading, half of a run or more, and steady sliding show nothing.
    """
    end = float(run.time[-1])
    seen = run.t_det[np.isfinite(run.t_det)]
    first, last = (seen.min(), seen.max()) if seen.size else (0.0, end)
    around = _AROUND * (last - first) + run.time[1]
    return max(0.0, first - around), min(end, last + around)


@style.journal
def scenery(run: Run) -> tuple[Figure, Update]:
    """Draw the static artists, and return them with the function that moves the others."""
    picture = Figure(figsize=((_CURVES + 84.0) * MM, _HEIGHT * MM), dpi=_PIXELS / MM)
    picture.suptitle(run.name, y=0.975, fontsize="medium")
    blocks = _place(picture, _MAP, 26.0, _SIDE, _SIDE)
    force = _place(picture, _CURVES, 63.0, 80.0, 37.0)
    detached = _place(picture, _CURVES, 11.0, 80.0, 37.0)
    image = maps.draw_times(blocks, run, until=0.0)
    image.set_animated(True)
    others = [] if run.contact.all() else ["not in contact"]
    maps.draw_key(blocks, "not detached", "detaching now", *others)
    share = 100.0 * np.cumsum(run.detachments) / np.count_nonzero(run.contact)
    curves = [_curve(force, run, friction(run)), _curve(detached, run, share)]
    start, stop = (MICRO * end for end in span(run))
    force.axvspan(start, stop, color="0.93", linewidth=0.0, zorder=0)
    force.set(xlim=(0.0, MICRO * run.time[-1]), ylabel=style.FORCE)
    detached.set(xlim=(start, stop), ylabel="detached blocks (%)")
    middle: style.Look = {"ha": "center", "va": "bottom", "transform": force.get_xaxis_transform()}
    force.text(MICRO * run.t_max, 1.03, r"$t_\mathrm{max}$", **middle)

    def update(now: float, before: float) -> list[Artist]:
        image.set_data(maps.painted(run, now, before))
        return [image, *(artist for move in curves for artist in move(now))]

    return picture, update


def _place(picture: Figure, left: float, bottom: float, width: float, height: float) -> Axes:
    """Add axes at a place in mm, so that all blocks of a map have equal numbers of pixels."""
    across, up = picture.get_size_inches() / MM
    return picture.add_axes((left / across, bottom / up, width / across, height / up))


def _curve(ax: Axes, run: Run, values: Array) -> Callable[[float], list[Artist]]:
    """Draw a curve against time, its past in black, with a cursor and t_max."""
    time = MICRO * run.time
    ax.plot(time, values, color="0.75", linewidth=0.8)  # faint: still to come
    (so_far,) = ax.plot([], [], color=style.BLACK, animated=True)
    cursor = ax.axvline(0.0, color=style.VERMILION, linewidth=0.8, animated=True)
    ax.axvline(MICRO * run.t_max, color=style.GREY, linestyle=":", linewidth=0.8, zorder=0.5)
    ax.set_xlabel("time (µs)")

    def update(now: float) -> list[Artist]:
        count = int(np.searchsorted(run.time, now, side="right"))
        so_far.set_data(time[:count], values[:count])
        cursor.set_xdata([MICRO * now] * 2)
        return [so_far, cursor]

    return update


def _gif(drawn: list[Frame], file: Path) -> None:
    # one palette for all: that of the last frame, whose keys and bars hold every colour
    palette = Image.fromarray(drawn[-1]).quantize(method=Image.Quantize.FASTOCTREE)
    first, *rest = (
        Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE)
        for frame in drawn
    )
    pace = 1000 // PER_SECOND  # ms
    first.save(file, "GIF", save_all=True, append_images=rest, duration=pace, loop=0)


def _mp4(drawn: list[Frame], file: Path) -> None:
    try:
        from imageio_ffmpeg import write_frames
    except ModuleNotFoundError:
        raise ValueError(
            "films of type MP4 need the package imageio-ffmpeg; install springblock[mp4]"
        ) from None

    height, width, _ = drawn[0].shape
    look = {"fps": PER_SECOND, "codec": "libx264", "macro_block_size": 2}
    film = write_frames(str(file), (width, height), output_params=["-f", "mp4"], **look)
    film.send(None)
    for frame in drawn:
        film.send(np.ascontiguousarray(frame))
    film.close()


_WRITERS = {".gif": _gif, ".mp4": _mp4}
