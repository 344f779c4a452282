"""Two-dimensional spring-block model of the onset of sliding on patterned surfaces.

The model of Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from pkgutil import resolve_name
from typing import TYPE_CHECKING

__all__ = [
    "Material",
    "Pattern",
    "Prelude",
    "Realisation",
    "SimulationError",
    "animate",
    "compute_prelude",
    "draw_friction",
    "plot",
    "read",
    "simulate",
    "write_fields",
]

if TYPE_CHECKING:
    from springblock.io.fields import write_fields
    from springblock.io.records import read
    from springblock.model.asperities import draw_friction
    from springblock.model.material import Material
    from springblock.model.pattern import Pattern
    from springblock.plotting.film import animate
    from springblock.plotting.still import plot
    from springblock.simulation.prelude import Prelude, compute_prelude
    from springblock.simulation.run import Realisation
    from springblock.simulation.simulate import SimulationError, simulate
else:  # mypy would accept any name if it saw `__getattr__`
    _MODULES = {
        "Material": "model.material",
        "Pattern": "model.pattern",
        "Prelude": "simulation.prelude",
        "Realisation": "simulation.run",
        "SimulationError": "simulation.simulate",
        "animate": "plotting.film",
        "compute_prelude": "simulation.prelude",
        "draw_friction": "model.asperities",
        "plot": "plotting.still",
        "read": "io.records",
        "simulate": "simulation.simulate",
        "write_fields": "io.fields",
    }

    def __getattr__(name: str) -> object:
        """Import a public name when it is first used (PEP 562): `import springblock` is quick."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return resolve_name(f"springblock.{_MODULES[name]}:{name}")

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
