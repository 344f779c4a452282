"""A scene: one surface, pulled one way. What the study varies besides the seed."""

from dataclasses import dataclass

from springblock.pattern import Pattern


@dataclass(frozen=True)
class Scene:
    """Pattern and sliding direction; n_p = 0 (n_p2 = 0) stands for no such level.

    Grooves run along x; a sliding direction y puts them across.
    """

    n_blocks: int
    n_p: int = 0
    n_s: int = 0
    n_p2: int = 0
    n_s2: int = 0
    direction: str = "x"  #: "x", "y" or an angle from x in degrees

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 flat, 1 pillars, 2 grooved pillars."""
        return (self.n_p > 0) + (self.n_p2 > 0)

    @property
    def pattern(self) -> Pattern:
        """The pattern; raises ValueError where its lengths do not fit."""
        pattern = Pattern.flat(self.n_blocks)
        if self.n_p:
            pattern = pattern.pillared(self.n_p, self.n_s)
        if self.n_p2:
            pattern = pattern.grooved(self.n_p2, self.n_s2, along="x")
        return pattern

    @property
    def heading(self) -> str | float:
        """The direction as `simulate` takes it."""
        return self.direction if self.direction in ("x", "y") else float(self.direction)

    @property
    def folder(self) -> str:
        """Hive-style folder of its realisations."""
        lengths = ("n_p", "n_s", "n_p2", "n_s2")[: 2 * self.level]
        keys = ("n_blocks", "level", *lengths, "direction")
        return "/".join(f"{key}={getattr(self, key)}" for key in keys)

    @property
    def arguments(self) -> str:
        """The scene as options of `springblock simulate`."""
        lengths = ("n_p", "n_s", "n_p2", "n_s2")[: 2 * self.level]
        keys = ("n_blocks", *lengths, "direction")
        return " ".join(f"--{key.replace('_', '-')} {getattr(self, key)}" for key in keys)
