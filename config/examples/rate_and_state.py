"""Rate-and-state friction with the ageing law, in two state variables.

mu = mu_d + a ln(V/v_0) + b_1 ln(v_0 θ_1/d_1) + b_2 ln(v_0 θ_2/d_2) and dθ/dt = 1 - V θ/d
(Ruina 1983, doi:10.1029/JB088iB12p10359), at low speeds in the form that holds down to V = 0
(Rice et al. 2001, doi:10.1016/S0022-5096(01)00042-4). A block has no threshold: give
mu_static = 0, so that it creeps from the start. With b_2 = 0 it has one state variable.
"""

from math import asinh, exp, expm1, log

CONSTANTS = {
    "a": (0.01, "1"),
    "b_1": (0.012, "1"),
    "b_2": (0.003, "1"),
    "d_1": (1e-7, "m"),
    "d_2": (1e-6, "m"),
    "v_0": (1e-3, "m/s"),
    "theta_0": (1e-4, "s"),
}
STATE = {"theta_1": "theta_0", "theta_2": "theta_0"}


def friction(mu_dynamic, speed, theta_1, theta_2, a, b_1, b_2, d_1, d_2, v_0):
    strength = mu_dynamic + b_1 * log(v_0 * theta_1 / d_1) + b_2 * log(v_0 * theta_2 / d_2)
    return a * asinh(speed / (2.0 * v_0) * exp(strength / a))


def update(theta_1, theta_2, speed, step, d_1, d_2):
    return aged(theta_1, speed, step, d_1), aged(theta_2, speed, step, d_2)


def aged(theta, speed, step, d):
    """θ after a step at constant speed, exactly."""
    x = speed * step / d
    return theta * exp(-x) + step * (-expm1(-x) / x if x > 0.0 else 1.0)
