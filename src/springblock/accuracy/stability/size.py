"""Size: from one block to a million."""

from collections.abc import Iterator

import numpy as np

from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.stability.cases import FIRST, FRICTION, Case, Family, Outcome, refusal
from springblock.accuracy.stability.pull import PAPER, ROUNDING, SEED, Pull, pulled_at, release
from springblock.accuracy.stability.surface import first_detachment, scattered
from springblock.accuracy.surfaces import flat, uniform
from springblock.model.pattern import MAX_BLOCKS
from springblock.simulation.simulate import simulate


def blocks_alike(integrator: str, n: int) -> Outcome:
    """No spring between blocks is ever strained: N² times one block, in the midst of its slip.

    To rounding, of one step and of a sum over all blocks.
    """
    pull, count = Pull.at(0.1, integrator, UNDAMPED), 40
    pull = pull.with_speed(4.0 / (count * pull.h))
    one, run = (pull.simulate(uniform(size, 1.0, 0.6), count) for size in (1, n))
    tolerance = ROUNDING + 1e-16 * n * n
    return pull.judge(run, run.static_friction, one.static_friction, tolerance)


def first_of_a_million(integrator: str, n: int) -> Outcome:
    """Forty steps, in the middle of which the weakest of N² blocks lets go."""
    pull, surface = Pull.at(0.2, integrator, PAPER), flat(n, SEED)
    threshold, count = float(np.maximum(*surface[1:]).min()), 40
    pull = pull.with_speed(threshold / (0.5 * count * pull.h))
    run = pull.simulate(surface, count)
    tolerance = pull.step / release(pull.material, threshold)
    return pull.judge(run, run.t_first / release(pull.material, 1.0), threshold, tolerance)


def one_contact_block(integrator: str) -> Outcome:
    """It bears the whole load and holds all the others: static friction is its own.

    They are in balance, but for the swing that the slider's start has left, v each.
    """
    n, mu_static, speed = 6, 0.2, 1e-3
    contact = np.zeros((n, n), bool)
    contact[2, 3] = True
    pull = Pull.at(0.1, integrator, pulled_at(speed, PAPER))
    run = pull.simulate((contact, *uniform(n, mu_static, 0.1)[1:]))
    tolerance = 2.0 * speed / mu_static
    return pull.judge(run, run.static_friction, mu_static, tolerance, contact=1)


def refused_size(integrator: str, n: int, reason: str) -> Outcome:
    """The arrays take no memory."""
    contact, *mu = (np.broadcast_to(kind, (n, n)) for kind in (np.True_, 1.0, 0.6))
    return refusal(lambda: simulate(contact, mu[0], mu[1], integrator=integrator), reason)


def cases(integrator: str) -> Iterator[Case]:
    """Blocks alike, blocks with scatter, one in contact, and sizes that are refused."""
    case, agrees = Family("size", integrator).case, "agrees"
    for n in (2, 3, 1000):
        name, force = f"{n} x {n} blocks alike", "greatest force, P l² N²"
        yield case(name, n, agrees, force, blocks_alike, n)
    for n in (1, 2, 3):
        name = f"{n} x {n} blocks with scatter"
        yield case(name, n, agrees, FIRST, first_detachment, scattered(0.1), n)
    n = 1000
    yield case(f"{n} x {n} blocks with scatter", n, agrees, FIRST, first_of_a_million, n)
    yield case("one contact block", 6, agrees, FRICTION, one_contact_block)
    for n, reason in ((0, "contact"), (MAX_BLOCKS + 1, f"goes up to {MAX_BLOCKS}")):
        yield case(f"{n} x {n} blocks", n, "refused", "none", refused_size, n, reason)
