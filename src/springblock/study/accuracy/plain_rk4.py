"""Runge-Kutta method with the friction of each stage; its errors hardly decrease with the step.

Friction opposes the velocity of each *stage*, and a block sticks again when its velocity turns
back. The stage velocities of a slow block alternate in sign, so that it creeps instead of coming
to rest. SI units; not optimised: the force of the first stage is evaluated twice.
"""

import numpy as np
from numba import njit

from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.study.accuracy.solutions import Solution


@njit(cache=True)
def _accelerations(r, v, sliding, contact, mu_d_load, t, c, a, motive):
    n_y, n_x = contact.shape
    k_int, k_s, mass, length, gamma, speed = c
    for y in range(n_y):
        for x in range(n_x):
            fx = k_s * (speed * t - r[y, x, 0])
            fy = -k_s * r[y, x, 1]
            for dy in range(-1, 2):
                for dx in range(-1, 2):
                    i, j = y + dy, x + dx
                    if (dx == 0 and dy == 0) or i < 0 or j < 0 or i >= n_y or j >= n_x:
                        continue
                    ex = length * dx + r[i, j, 0] - r[y, x, 0]
                    ey = length * dy + r[i, j, 1] - r[y, x, 1]
                    rest = length * np.sqrt(float(dx * dx + dy * dy))
                    k = k_int if dx == 0 or dy == 0 else 0.5 * k_int
                    distance = np.sqrt(ex * ex + ey * ey)
                    pull = k * (distance - rest) / distance
                    fx += pull * ex
                    fy += pull * ey
            motive[y, x] = np.sqrt(fx * fx + fy * fy)
            s = np.sqrt(v[y, x, 0] ** 2 + v[y, x, 1] ** 2)
            if contact[y, x] and s > 0.0:
                fx -= mu_d_load[y, x] * v[y, x, 0] / s
                fy -= mu_d_load[y, x] * v[y, x, 1] / s
            moves = sliding[y, x] or not contact[y, x]
            a[y, x, 0] = (fx / mass - gamma * v[y, x, 0]) if moves else 0.0
            a[y, x, 1] = (fy / mass - gamma * v[y, x, 1]) if moves else 0.0


@njit(cache=True)
def _integrate(contact, mu_s_load, mu_d_load, c, h, every, force, t_det):
    n_y, n_x = contact.shape
    r, v, motive = np.zeros((n_y, n_x, 2)), np.zeros((n_y, n_x, 2)), np.zeros((n_y, n_x))
    sliding = np.zeros_like(contact)
    a1, a2, a3, a4 = np.zeros_like(r), np.zeros_like(r), np.zeros_like(r), np.zeros_like(r)
    for k in range(every * (len(force) - 1)):
        t = k * h
        _accelerations(r, v, sliding, contact, mu_d_load, t, c, a1, motive)
        sliding |= contact & (motive > mu_s_load)
        t_det[:] = np.where(sliding & np.isnan(t_det), t, t_det)
        _accelerations(r, v, sliding, contact, mu_d_load, t, c, a1, motive)
        v2 = v + 0.5 * h * a1
        _accelerations(r + 0.5 * h * v, v2, sliding, contact, mu_d_load, t + h / 2, c, a2, motive)
        v3 = v + 0.5 * h * a2
        _accelerations(r + 0.5 * h * v2, v3, sliding, contact, mu_d_load, t + h / 2, c, a3, motive)
        v4 = v + h * a3
        _accelerations(r + h * v3, v4, sliding, contact, mu_d_load, t + h, c, a4, motive)
        r += h / 6 * (v + 2 * v2 + 2 * v3 + v4)
        new = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        stops = sliding & (v[:, :, 0] * new[:, :, 0] + v[:, :, 1] * new[:, :, 1] < 0.0)
        sliding &= ~stops
        v = new * (1.0 - stops.reshape(n_y, n_x, 1))
        if (k + 1) % every == 0:
            fx = c[1] * (n_y * n_x * c[5] * (t + h) - r[:, :, 0].sum())
            force[(k + 1) // every] = np.sqrt(fx**2 + (c[1] * r[:, :, 1].sum()) ** 2)


def solve(surface: Surface, duration: float, step: float, sample_interval: float) -> Solution:
    """Pull a surface of the paper's material along x; all times in s."""
    m, contact = Material(), surface.contact
    load = m.block_load * contact.size / contact.sum()
    every, samples = round(sample_interval / step), round(duration / sample_interval)
    force, t_det = np.zeros(samples + 1), np.full(contact.shape, np.nan)
    constants = (m.k_int, m.k_s, m.mass, m.spacing, m.gamma, m.slider_velocity)
    loads = surface.mu_static * load, surface.mu_dynamic * load
    _integrate(contact, *loads, constants, step, every, force, t_det)
    peak = int(force.argmax())
    return Solution(
        time=np.arange(samples + 1.0) * sample_interval,
        force=force,
        t_det=t_det,
        static_friction=force[peak] / (m.block_load * contact.size),
        t_max=peak * sample_interval,
        t_avg=float(np.nanmean(t_det)),
        steps=every * samples,
    )
