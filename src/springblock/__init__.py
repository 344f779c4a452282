"""Two-dimensional spring-block model of the onset of sliding on patterned surfaces.

The model of Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from importlib.metadata import version
from pkgutil import resolve_name
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from springblock.analysis.refine import refine as refine
    from springblock.analysis.runs import Runs as Runs
    from springblock.analysis.runs import ensemble as ensemble
    from springblock.io.records import read as read
    from springblock.model.asperities import draw_friction as draw_friction
    from springblock.model.material import Material as Material
    from springblock.model.pattern import Pattern as Pattern
    from springblock.model.surface import Surface as Surface
    from springblock.model.texture import Texture as Texture
    from springblock.plotting.film import animate as animate
    from springblock.plotting.still import plot as plot
    from springblock.simulation.fields import Fields as Fields
    from springblock.simulation.motion import SimulationError as SimulationError
    from springblock.simulation.prelude import Prelude as Prelude
    from springblock.simulation.prelude import compute_prelude as compute_prelude
    from springblock.simulation.run import Realisation as Realisation
    from springblock.simulation.setup import Setup as Setup
    from springblock.simulation.simulate import simulate as simulate
    from springblock.theory.predict import predict as predict

    __version__: str
else:  # mypy would accept any name if it saw `__getattr__`
    _MODULES = {
        "Fields": "simulation.fields",
        "Material": "model.material",
        "Pattern": "model.pattern",
        "Prelude": "simulation.prelude",
        "Realisation": "simulation.run",
        "Runs": "analysis.runs",
        "Setup": "simulation.setup",
        "SimulationError": "simulation.motion",
        "Surface": "model.surface",
        "Texture": "model.texture",
        "animate": "plotting.film",
        "compute_prelude": "simulation.prelude",
        "draw_friction": "model.asperities",
        "ensemble": "analysis.runs",
        "plot": "plotting.still",
        "predict": "theory.predict",
        "read": "io.records",
        "refine": "analysis.refine",
        "simulate": "simulation.simulate",
    }

    __all__ = list(_MODULES)

    def __getattr__(name: str) -> object:
        """Import a public name when it is first used (PEP 562): `import springblock` is quick."""
        if name == "__version__":
            return version("springblock")
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return resolve_name(f"springblock.{_MODULES[name]}:{name}")

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
