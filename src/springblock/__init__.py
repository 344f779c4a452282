"""Two-dimensional spring-block model of the onset of sliding on patterned surfaces.

The model of Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from springblock.asperities import draw_friction
    from springblock.material import Material
    from springblock.pattern import Pattern
    from springblock.prelude import Prelude, compute_prelude
    from springblock.reading import read
    from springblock.realisation import Realisation
    from springblock.simulation import SimulationError, simulate

__all__ = [
    "Material",
    "Pattern",
    "Prelude",
    "Realisation",
    "SimulationError",
    "compute_prelude",
    "draw_friction",
    "read",
    "simulate",
]

#: Where these names are at home.
_HOMES = {
    "Material": "material",
    "Pattern": "pattern",
    "Prelude": "prelude",
    "Realisation": "realisation",
    "SimulationError": "simulation",
    "compute_prelude": "prelude",
    "draw_friction": "asperities",
    "read": "reading",
    "simulate": "simulation",
}

if not TYPE_CHECKING:  # mypy would accept any name if it saw this

    def __getattr__(name: str) -> object:
        """Import NumPy, the solver, or Parquet for those alone who ask for it (PEP 562)."""
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return getattr(import_module(f"springblock.{_HOMES[name]}"), name)

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
