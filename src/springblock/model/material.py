"""Constants of the elastic layer, its loading and its surface, in SI units."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.law import LawFile
from springblock.model.numbers import check_real

#: Distributions of the friction coefficients, see `springblock.model.asperities`.
DISTRIBUTIONS = ("normal", "lognormal", "weibull", "uniform")
#: Laws of friction, see `springblock.solver.laws`, with the constant that each of them needs.
LAWS = {"coulomb": "", "slip_weakening": "slip_distance", "velocity_weakening": "speed_scale"}
#: Whether a block that stops regains its strength; without healing, slip weakening is for good.
HEALING = ("instant", "none")
#: Least number of samples while a flat surface is loaded: with fewer, static friction, the largest
#: force among them, is more than about 0.1 % too low (`docs/model.md`).
_LEAST_SAMPLES = 60


def number(default: float, unit: str, meaning: str, may_vanish: bool = False) -> Any:
    """Declare a constant that is a positive number, or that may also be zero."""
    said = {"unit": unit, "meaning": meaning, "may_vanish": may_vanish}
    return field(default=default, metadata=said)


def word(default: str, meaning: str, choices: tuple[str, ...] = (), read: Any = str) -> Any:
    """Declare a text, one of the choices if there are any; `read` converts what a user gives."""
    said = {"unit": "1", "meaning": meaning, "choices": choices, "read": read}
    return field(default=default, metadata=said)


def as_law(given: Any) -> str | LawFile:
    """Read a law: one of `LAWS`, a Python file, or the description of a file in a table."""
    if isinstance(given, LawFile) or (isinstance(given, str) and given in LAWS):
        return given
    is_file = isinstance(given, str | Path) and str(given).endswith(".py")
    law = LawFile.read(Path(given)) if is_file else LawFile.named(str(given))
    if law is None:
        raise ValueError(
            f"Material.law must be one of {', '.join(LAWS)}, or a file FILE.py, not {given!r}"
        )
    return law


@dataclass(frozen=True)
class Material:
    """Constants of the spring-block model (Costagliola et al. 2022, section 2).

    The defaults are the paper's values. Spring constants and block mass follow from them: the
    lattice is equivalent to an isotropic sheet with Poisson's ratio 1/3 in plane stress (Absi &
    Prager 1975, doi:10.1016/0045-7825(75)90013-2). Coefficients are those that `Surface.draw` draws
    with; a surface of given coefficients ignores them.

    Raises
    ------
    TypeError, ValueError
        If a field is not a finite number of the allowed sign, a derived quantity exceeds the range
        of floating point, the distribution, the law or the healing is unknown, or a law lacks its
        constant or has that of another.
    """

    # Columns of tables and the schema of configurations follow from these declarations.
    youngs_modulus: float = number(1e7, "Pa", "Young's modulus E")
    density: float = number(1200.0, "kg/m³", "density ρ")
    pressure: float = number(5e4, "Pa", "pressure P over the whole nominal area")
    slider_velocity: float = number(5e-4, "m/s", "velocity v of the slider")
    spacing: float = number(1e-5, "m", "lattice spacing l")
    thickness: float = number(1e-5, "m", "thickness l_z of the layer")
    gamma: float = number(5e3, "1/s", "damping frequency γ", may_vanish=True)  # 5 ms⁻¹
    mu_static: float = number(1.0, "1", "mean of static coefficients", may_vanish=True)
    mu_static_std: float = number(
        0.1, "1", "standard deviation of static coefficients", may_vanish=True
    )
    mu_dynamic: float = number(0.6, "1", "mean of dynamic coefficients", may_vanish=True)
    mu_dynamic_std: float = number(
        0.05, "1", "standard deviation of dynamic coefficients", may_vanish=True
    )
    distribution: str = word("normal", "distribution of the coefficients", DISTRIBUTIONS)
    correlation_length: float = number(
        0.0, "m", "ℓ in the normal variates' autocorrelation exp(-r²/ℓ²)", may_vanish=True
    )
    law: str | LawFile = word(  # noqa: RUF009 - a field
        "coulomb",
        "law of friction; for a file its name, digest, and constants with units as JSON",
        read=as_law,
    )
    slip_distance: float = number(
        0.0, "m", "d_c of slip weakening; 0 for other laws", may_vanish=True
    )
    speed_scale: float = number(
        0.0, "m/s", "v_c of velocity weakening; 0 for other laws", may_vanish=True
    )
    healing: str = word(
        "instant", "instant or none: whether a block that stops regains its strength", HEALING
    )

    def __post_init__(self) -> None:
        object.__setattr__(self, "law", as_law(self.law))
        kind = type(self).__name__
        for each in fields(self):
            name, said, value = each.name, each.metadata, getattr(self, each.name)
            if "may_vanish" in said:
                real = check_real(f"{kind}.{name}", value, may_vanish=said["may_vanish"])
                object.__setattr__(self, name, real)
            elif (known := said.get("choices")) and value not in known:
                choices = ", ".join(filter(None, known))
                raise ValueError(f"{kind}.{name} must be one of {choices}, not {value!r}")
        self._check_derived()
        self._check_law()

    def _check_derived(self) -> None:
        for name in ("k_int", "k_s", "mass", "block_load", "omega_max"):
            try:
                derived = getattr(self, name)
            except (OverflowError, ZeroDivisionError):
                derived = math.nan
            if not (math.isfinite(derived) and derived > 0.0):
                raise ValueError(
                    f"these constants give Material.{name} outside the range of floating point"
                )

    def _check_law(self) -> None:
        for law, name in LAWS.items():
            value = getattr(self, name) if name else 0.0
            if law == self.law and name and not value:
                raise ValueError(f"Material.{name} must be positive with {law}, not {value!r}")
            if law != self.law and value:
                raise ValueError(f"Material.{name} must be zero with {self.law}, not {value!r}")
        if self.healing != "instant" and self.law != "slip_weakening":
            raise ValueError(
                f"Material.healing must be instant with {self.law}, not {self.healing!r}"
            )
        if isinstance(self.law, LawFile):
            twice = self.law.constants.keys() & {each.name for each in fields(self)}
            if twice:
                raise ValueError(
                    f"{self.law.file}: {min(twice)!r} is a constant of the material; rename it"
                )

    def items(self) -> Iterator[tuple[str, float | str]]:
        """Yield (name, value) of every constant.

        A law from a file is described by a text that includes its constants.
        """
        for each in fields(self):
            value = getattr(self, each.name)
            yield each.name, value.described if isinstance(value, LawFile) else value

    def vary(self, constants: Mapping[str, Any]) -> Self:
        """Return a material with other constants, including those of its law."""
        known = [each.name for each in fields(self)]
        own = {name: value for name, value in constants.items() if name in known}
        of_law = {name: value for name, value in constants.items() if name not in known}
        material = replace(self, **own)
        if not of_law:
            return material
        if not isinstance(material.law, LawFile):
            raise ValueError(
                f"unknown constant {min(of_law)!r}; choose from {', '.join(known)}, or one of a "
                "law from a file"
            )
        return replace(material, law=material.law.vary(of_law))

    @property
    def k_int(self) -> float:
        """Stiffness of an axial spring, N/m: K_int = 3/4 E l_z; diagonal springs have half."""
        return 0.75 * self.youngs_modulus * self.thickness

    @property
    def k_s(self) -> float:
        """Stiffness between a block and the slider, N/m: K_s = K_int l²/l_z²."""
        return self.k_int * (self.spacing / self.thickness) ** 2

    @property
    def mass(self) -> float:
        """Mass of a block, kg: m = rho l² l_z."""
        return self.density * self.spacing**2 * self.thickness

    @property
    def block_load(self) -> float:
        """Normal force on one block of a flat surface, N: P l²."""
        return self.pressure * self.spacing**2

    def longest_interval(self) -> float:
        """Longest time between samples, s, at which static friction is about 0.1 % too low."""
        with np.errstate(all="ignore"):  # infinite where the slider hardly moves
            rate = np.float64(self.k_s * self.slider_velocity)
            loading = float(self.mu_static * self.block_load / rate)
        return loading / _LEAST_SAMPLES if loading else math.inf  # without thresholds no friction

    def usual_interval(self, step: float) -> float:
        """Time between samples, s, unless another is given: 2e-7 s, or less with fast sliders."""
        rest = abs(math.remainder(SAMPLE_INTERVAL, step))
        if self.longest_interval() >= SAMPLE_INTERVAL and rest < 1e-6 * SAMPLE_INTERVAL:
            return SAMPLE_INTERVAL
        longest = min(SAMPLE_INTERVAL, self.longest_interval())
        return step * max(1, math.floor(longest / step))

    @property
    def omega_min(self) -> float:
        """Lowest angular frequency of the lattice, rad/s: √(K_s/m), all blocks in phase."""
        return math.sqrt(self.k_s / self.mass)

    @property
    def omega_max(self) -> float:
        """Highest angular frequency of the lattice, rad/s, at wave vector (π, 0).

        The axial springs along x and the four diagonal ones contribute: m ω² = K_s + 6 K_int.
        """
        return math.sqrt((self.k_s + 6.0 * self.k_int) / self.mass)
