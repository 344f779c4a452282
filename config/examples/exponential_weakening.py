"""Friction that falls exponentially with slip, from mu_s towards mu_d, but not below a floor."""

from math import exp

CONSTANTS = {"d_0": (2e-8, "m"), "floor": (0.3, "1")}
STATE = {"slip": 0.0}


def friction(mu_static, mu_dynamic, slip, d_0, floor):
    return max(mu_dynamic + (mu_static - mu_dynamic) * exp(-slip / d_0), floor)


def update(slip, speed, step):
    return slip + speed * step
