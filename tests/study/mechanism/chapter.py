"""Tables of the chapter as tests need them: few rows, with numbers that are easy to follow."""

from springblock.io.rows import Row, limits
from springblock.study.mechanism.page import NAMES

#: Static friction of the models by n_p.
FRICTION = {
    2: (0.9, 0.8, 0.85, 0.75, 0.752),
    6: (0.7, 0.65, 0.8, 0.6, 0.601),
    20: (0.6, 0.7, 0.82, 0.65, 0.6),
}
UNEVEN = {2: 0.0, 6: 0.3, 20: 0.2}


def rows(**constants: float) -> list[Row]:
    """Return the table `mechanism`, or rows with other constants."""
    return [
        {"n_p": n_p, "n_s": n_p, "n_blocks": 40, "seed": seed, "stress_variation": UNEVEN[n_p]}
        | {name: value + 0.001 * seed for name, value in zip(NAMES, values, strict=True)}
        | constants
        for n_p, values in FRICTION.items()
        for seed in (-1, 0, 1)
    ]


def damped() -> list[Row]:
    """Return `mechanism_damped`: friction in the simulation is that of load transfer and 0.01."""
    return [
        row | {"simulation": row["quasi_static"] + 0.01}
        for gamma in (1e7, 4e7)
        for row in rows(gamma=gamma)
    ]


def springs() -> list[Row]:
    """Return `mechanism_springs`, for half and twice K_s: thickness goes with K_s^(-1/2)."""
    return [row for factor in (0.5, 2.0) for row in rows(thickness=1e-5 / factor**0.5)]


def grooves() -> list[Row]:
    """Return `mechanism_grooves`: overshoot together has the friction of the full model."""
    values = {"sticking": (0.84, 0.001), "overshooting": (0.73, 0.01)}
    values |= {"collective": (0.69, 0.01), "simulation": (0.69, 0.02)}
    return [
        {"model": name}
        | limits("static_friction", (value, value, value))
        | limits("prominence", (dip, dip, dip))
        for name, (value, dip) in values.items()
    ]


def settings() -> list[Row]:
    """Return `sensitivities` of a few settings."""
    quantities = {"size": 6.0, "friction": 0.6, "depth": 0.05, "lag": -1e-5, "prominence": 0.03}
    places = [("", "", "free", 5e3), ("gamma", "1e+06 1/s", "free", 1e6)]
    places += [("edges", "periodic", "periodic", 5e3), ("gamma", "1e+06 1/s", "periodic", 1e6)]
    return [
        dict(zip(("varied", "value", "edges", "gamma"), place, strict=True))
        | {"quantity": name, "seeds": 8}
        | limits("mean", (value + 0.01 * i, value, value + 0.02 * i))
        for i, place in enumerate(places)
        for name, value in quantities.items()
    ]
