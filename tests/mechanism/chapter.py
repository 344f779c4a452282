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


def peak(n_p2: int, direction: str, predicted: float, *measured: float, **own: object) -> list[Row]:
    """Return rows of `mechanism_peaks` on one surface, one per seed."""
    at = {"n_p": 0, "n_s2": 2, "n_p2": n_p2, "direction": direction, "varied": "", "trained": False}
    same = at | {"predicted": predicted} | own
    return [same | {"seed": seed, "measured": value} for seed, value in enumerate(measured)]


def peaks() -> list[Row]:
    """Return `mechanism_peaks`: hits of both kinds, misses of both kinds, and one trained on."""
    return [
        *peak(7, "x", 2.0, 1.9, 2.1),
        *peak(7, "y", 0.0, 0.1, 0.2),
        *peak(12, "x", 0.4, 0.7, 0.9),
        *peak(12, "y", 0.0, 1.2, 1.4),
        *peak(8, "x", 3.0, 0.0, 0.1, varied="mu_dynamic=0.5"),
        *peak(8, "y", 0.0, 0.0, 0.1, varied="mu_dynamic=0.5"),
        *peak(8, "x", 1.5, 2.9, 3.0, trained=True),
    ]


def budget() -> list[Row]:
    """Return `mechanism_budget`: edges bear most at 300 µs, the core at 420 µs."""
    events = {"x": 4.0, "y": 1.0}
    forces = {300: (0.2, 0.4), 360: (0.15, 0.5), 420: (0.1, 0.6), 480: (0.1, 0.3)}
    return [
        {"direction": direction, "model": model, "seed": seed, "edge_share": 0.25}
        | {"edge_event": events[direction] + seed if model == "simulation" else None}
        | {"time": 1e-6 * time, "edge": edges + 0.001 * seed, "core": core, "free": 0.0}
        for direction in "xy"
        for model in ("simulation", "overshooting")
        for seed in (0, 1)
        for time, (edges, core) in forces.items()
    ]
