"""A scene: one surface, pulled one way. What the study varies besides the seed."""

from dataclasses import dataclass

from springblock.pattern import Pattern

LENGTHS = ("n_p", "n_s", "n_p2", "n_s2", "n_p3", "n_s3")  #: of a scene, two for each level
_SIDE = 6  #: blocks of the shortest side along which a correlation is measured


@dataclass(frozen=True)
class Scene:
    """Pattern and sliding direction; lengths of 0 stand for no such level.

    The grooves of level 2 run along x, those of level 3 along y; a sliding direction y swaps their
    parts.

    Raises
    ------
    ValueError
        Where a length is given without its partner or without the levels above it.
    """

    n_blocks: int
    n_p: int = 0
    n_s: int = 0
    n_p2: int = 0
    n_s2: int = 0
    n_p3: int = 0
    n_s3: int = 0
    direction: str = "x"  #: "x", "y" or an angle from x in degrees

    def __post_init__(self) -> None:
        given = [key for key in LENGTHS if getattr(self, key)]
        missing = [key for key in LENGTHS[: 2 * self.level] if key not in given]
        if missing:
            raise ValueError(f"{given[-1]} = {getattr(self, given[-1])} needs {missing[0]}")

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 flat, 1 pillars, 2 strips, 3 strips cut across."""
        deepest = max((i for i, key in enumerate(LENGTHS) if getattr(self, key)), default=-1)
        return deepest // 2 + 1

    @property
    def pattern(self) -> Pattern:
        """The pattern; raises ValueError where its lengths do not fit."""
        pattern = Pattern.flat(self.n_blocks)
        if self.n_p:
            pattern = pattern.pillared(self.n_p, self.n_s)
        if self.n_p2:
            pattern = pattern.grooved(self.n_p2, self.n_s2, along="x")
        if self.n_p3:
            pattern = pattern.grooved(self.n_p3, self.n_s3, along="y")
        return pattern

    @property
    def sides(self) -> tuple[str, ...]:
        """Axes along which pillars have sides that nothing cuts, 6 blocks long or more."""
        if self.n_p < _SIDE:
            return ()
        return ((), ("x", "y"), ("x",), ())[self.level]

    @property
    def heading(self) -> str | float:
        """The direction as `simulate` takes it."""
        return self.direction if self.direction in ("x", "y") else float(self.direction)

    @property
    def folder(self) -> str:
        """Hive-style folder of its realisations."""
        keys = ("n_blocks", "level", *LENGTHS[: 2 * self.level], "direction")
        return "/".join(f"{key}={getattr(self, key)}" for key in keys)

    @property
    def arguments(self) -> str:
        """The scene as options of `springblock simulate`."""
        keys = ("n_blocks", *LENGTHS[: 2 * self.level], "direction")
        return " ".join(f"--{key.replace('_', '-')} {getattr(self, key)}" for key in keys)
