"""Tables of the chapter as tests need them: few rows, with numbers that are easy to follow."""

from springblock.io.rows import Row

MODELS = ("independent", "quasi_static", "overshooting", "simulation")
#: Static friction of the models by n_p.
FRICTION = {2: (0.9, 0.8, 0.75, 0.752), 6: (0.7, 0.65, 0.6, 0.601), 20: (0.6, 0.7, 0.65, 0.6)}
UNEVEN = {2: 0.0, 6: 0.3, 20: 0.2}
_PLAIN = {"varied": "", "thickness": 1e-5, "mu_static_std": 0.1}
_LAYERS = [{"varied": f"thickness={t:g}", "thickness": t} for t in (5e-6, 4e-5)]


def rows() -> list[Row]:
    """Return the table `mechanism`."""
    return [
        {"n_p": n_p, "n_s": n_p, "n_blocks": 40, "seed": seed, "stress_variation": UNEVEN[n_p]}
        | {name: value + 0.001 * seed for name, value in zip(MODELS, values, strict=True)}
        for n_p, values in FRICTION.items()
        for seed in (-1, 0, 1)
    ]


def variants() -> list[Row]:
    """Return `mechanism_variants`: a flat surface, and all sizes on a thin and a thick layer."""
    flat = [
        _PLAIN
        | {"n_p": 0, "n_s": 0, "seed": seed, "stress_variation": 0.0}
        | dict.fromkeys(MODELS, 0.8 + 0.001 * seed)
        for seed in (-1, 0, 1)
    ]
    return flat + [_PLAIN | layer | row for layer in _LAYERS for row in rows()]
