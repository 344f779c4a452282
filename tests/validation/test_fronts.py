"""The speed of a rupture front in a chain under Coulomb friction has a closed form.

Units: spring constant, mass and spacing 1, so that v_s = 1; forces over the drop of friction. Under
the prestress tau, a block that slides feels f = tau beyond its neighbours, and one at rest detaches
when its neighbours pull by s = 1 - tau. In a steady state U(T) is the displacement of each block at
a time T after it detached, and neighbours are T0 = 1/v apart:

    U"(T) = U(T + T0) + U(T - T0) - 2 U(T) + (f for T > 0, -U(T + T0) for T < 0),    U(T < 0) = 0.

Without springs to the slider, and for v > 1, waves of the chain stay behind: for real w the kernel

    G(w) = -w² g(w),    g(w) = 1 - (sin(w T0/2)/(w T0/2))²/v²,

has no zero but that at w = 0, and factors into g = g+ g-, which tend to 1 at large w, with g+(0) =
g-(0) = sqrt(g(0)), since g is even (Wiener-Hopf). Of the force only the pole of f at w = 0 belongs
to T > 0, so that U+ = f/(g-(0) g+(w) (i w)³). Large w give the acceleration at T = 0, which is the
force on a block that has just detached, s + f = 1:

    1 = f/g-(0),    tau² = g(0) = 1 - 1/v²,    v = 1/sqrt(1 - tau²).

It is the closed form of D. S. Amundsen et al., Phys. Rev. E 92, 032406 (2015),
doi:10.1103/PhysRevE.92.032406, as it is quoted; the derivation is ours.
"""

import math

import pytest

from springblock.study.accuracy.stability.surfaces import rupture_front


@pytest.mark.parametrize("prestress", [0.6, 0.8])
def test_a_rupture_front_has_the_speed_of_the_closed_form(prestress, integrator):
    """At the prestress as the front passes, to which the slider has added 1 % of the drop."""
    found = rupture_front(integrator, prestress)
    assert found.outcome == "agrees"
    assert found.value == pytest.approx(found.closed_form, rel=3e-3)
    tau = math.sqrt(1.0 - found.closed_form**-2)
    assert prestress < tau < prestress + 0.012
