"""Constants of the elastic layer, its loading and its surface, in SI units."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from springblock.model.law import LawFile
from springblock.model.numbers import check_real

#: Distributions of the friction coefficients, see `springblock.model.asperities`.
DISTRIBUTIONS = ("normal", "lognormal", "weibull", "uniform")
#: Laws of friction, see `springblock.solver.laws`, with the constant that each of them needs.
LAWS = {"coulomb": "", "slip_weakening": "slip_distance", "velocity_weakening": "speed_scale"}
#: Whether a block that stops regains its strength; without healing, slip weakening is for good.
HEALING = ("instant", "none")
#: Fields that may be zero; all other numbers must be positive.
_MAY_VANISH = {"gamma", "mu_static", "mu_static_std", "mu_dynamic", "mu_dynamic_std"}
_MAY_VANISH |= {"correlation_length", "slip_distance", "speed_scale"}


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


def expanded(constants: Mapping[str, Any]) -> dict[str, Any]:
    """Return the constants of a table, with those of a law from a file under their own names."""
    law = as_law(constants["law"])
    own = law.constants if isinstance(law, LawFile) else {}
    return {**constants, **own, "law": str(law)}


def law_units(constants: Mapping[str, Any]) -> dict[str, str]:
    """Return the units of the constants of a law from a file, by name."""
    law = as_law(constants["law"])
    return dict(law.units) if isinstance(law, LawFile) else {}


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

    youngs_modulus: float = 1e7  #: E, Pa
    density: float = 1200.0  #: rho, kg/m³
    pressure: float = 5e4  #: P, Pa, over the whole nominal area
    slider_velocity: float = 5e-4  #: v, m/s
    spacing: float = 1e-5  #: l, m, distance between blocks
    thickness: float = 1e-5  #: l_z, m, of the layer
    gamma: float = 5e3  #: damping frequency, 1/s (the paper's 5 ms⁻¹)
    mu_static: float = 1.0  #: mean of the microscopic static coefficient
    mu_static_std: float = 0.1  #: its standard deviation
    mu_dynamic: float = 0.6  #: mean of the microscopic dynamic coefficient
    mu_dynamic_std: float = 0.05  #: its standard deviation
    distribution: str = "normal"  #: of both coefficients, one of `DISTRIBUTIONS`
    correlation_length: float = 0.0  #: ℓ, m, of both coefficients; 0 if they are independent
    law: str | LawFile = "coulomb"  #: law of friction, one of `LAWS` or from a file
    slip_distance: float = 0.0  #: d_c, m, of slip weakening; 0 with any other law
    speed_scale: float = 0.0  #: v_c, m/s, of velocity weakening; 0 with any other law
    healing: str = "instant"  #: of a block that stops, one of `HEALING`; "instant" with other laws

    def __post_init__(self) -> None:
        object.__setattr__(self, "law", as_law(self.law))
        for name, known in {"distribution": DISTRIBUTIONS, "healing": HEALING}.items():
            if (value := getattr(self, name)) not in known:
                raise ValueError(
                    f"Material.{name} must be one of {', '.join(known)}, not {value!r}"
                )
        for name, value in self.items():
            if name in ("distribution", "law", "healing"):
                continue
            number = check_real(f"Material.{name}", value, may_vanish=name in _MAY_VANISH)
            object.__setattr__(self, name, number)
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
            twice = self.law.constants.keys() & {field.name for field in fields(self)}
            if twice:
                raise ValueError(
                    f"{self.law.file}: {min(twice)!r} is a constant of the material; rename it"
                )

    def items(self) -> Iterator[tuple[str, float | str]]:
        """Yield (name, value) of every constant.

        A law from a file is described by a text that includes its constants.
        """
        for field in fields(self):
            value = getattr(self, field.name)
            yield field.name, value.described if isinstance(value, LawFile) else value

    def vary(self, constants: Mapping[str, Any]) -> "Material":
        """Return a material with other constants, including those of its law."""
        known = [field.name for field in fields(self)]
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
