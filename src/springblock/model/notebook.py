"""How surfaces and runs show themselves: in a line, and in notebooks as pictures."""

from io import BytesIO

import numpy as np
from numpy.typing import NDArray


class Shown:
    """What a notebook shows as `springblock.plot` draws it."""

    def _repr_png_(self) -> bytes:
        from springblock import plot

        file = BytesIO()
        plot(self).savefig(file, format="png", dpi=110)
        return file.getvalue()


def in_words(contact: NDArray[np.bool_]) -> str:
    """Describe a mask: its size, and the share of its blocks in contact."""
    rows, columns = contact.shape
    return f"{columns} x {rows} blocks, {100.0 * contact.mean():.3g} % in contact"
