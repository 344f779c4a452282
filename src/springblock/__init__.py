"""Two-dimensional spring-block model of the onset of sliding on patterned surfaces.

The model of Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

from springblock.asperities import draw_friction
from springblock.material import Material
from springblock.pattern import Pattern
from springblock.prelude import Prelude, compute_prelude
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
    "simulate",
]
