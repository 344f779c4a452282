/* The leapfrog of springblock.solver, written down in plain C: what gcc makes of the same algorithm.

   Displacements in l, velocities in l per step, forces in the velocity that they add in one step.
   `restrict` tells the compiler that no two rows overlap; the two functions that it helps are not
   inlined, for the promise would be lost there. Not done here: the energy balance, and the watch
   over springs that leave the range of the polynomial; nor what the solver does by hand: friction
   without a root and a division, and rows filled up to whole vectors, which would help here as well. */

#include <math.h>
#include <string.h>

/* Distance of the rows of scratch: room for the longest row of blocks, and no power of two, so that
   they do not compete for the same cache lines. */
enum { PITCH = 4096 + 24, BANK = 6 * PITCH };

/* q times the polynomial c in q, see springblock.solver.springs. */
static inline double pull(double q, const double *restrict c)
{
    return q * (c[0] + q * (c[1] + q * (c[2] + q * (c[3] + q * (c[4] + q * (c[5] + q * c[6]))))));
}

/* Pull of all springs from one row to the east and to the next row, beyond the last block too;
   diagonal ones as if they were as stiff as the others. */
static __attribute__((noinline)) void springs(
    const double *restrict ux, const double *restrict uy,
    const double *restrict next_ux, const double *restrict next_uy,
    double *restrict e_x, double *restrict e_y,
    double *restrict n_x, double *restrict n_y,
    double *restrict ne_x, double *restrict ne_y,
    double *restrict nw_x, double *restrict nw_y,
    const double *restrict series, int n)
{
    for (int x = 0; x < n; x++) {
        double dx = ux[x + 1] - ux[x], dy = uy[x + 1] - uy[x];
        double q_e = 2.0 * dx + (dx * dx + dy * dy), f = pull(q_e, series);
        e_x[x] = f + f * dx;
        e_y[x] = f * dy;

        dx = next_ux[x] - ux[x], dy = next_uy[x] - uy[x];
        double q_n = 2.0 * dy + (dx * dx + dy * dy);
        f = pull(q_n, series);
        n_x[x] = f * dx;
        n_y[x] = f + f * dy;

        dx = next_ux[x + 1] - ux[x], dy = next_uy[x + 1] - uy[x];
        double q_ne = dx + dy + 0.5 * (dx * dx + dy * dy);
        f = pull(q_ne, series);
        ne_x[x] = f + f * dx;
        ne_y[x] = f + f * dy;

        dx = next_ux[x] - ux[x + 1], dy = next_uy[x] - uy[x + 1]; /* from the next block */
        double q_nw = dy - dx + 0.5 * (dx * dx + dy * dy);
        f = pull(q_nw, series);
        nw_x[x] = f * dx - f;
        nw_y[x] = f + f * dy;
    }
}

/* Kick, friction and drift of one row. */
static __attribute__((noinline)) void move(
    double *restrict ux, double *restrict uy, double *restrict wx, double *restrict wy,
    double *restrict t_det, const double *restrict mu_s_load, const double *restrict mu_d_load,
    const double *restrict east, const double *restrict north, const double *restrict south,
    int n, double a, double k_s, double slider_x, double slider_y, double now)
{
    const double *e_x = east, *e_y = east + PITCH;
    const double *n_x = north, *n_y = north + PITCH, *s_x = south, *s_y = south + PITCH;
    const double *ne_x = n_x + 2 * PITCH, *ne_y = n_y + 2 * PITCH;
    const double *nw_x = n_x + 4 * PITCH, *nw_y = n_y + 4 * PITCH;
    const double *sw_x = s_x + 2 * PITCH, *sw_y = s_y + 2 * PITCH; /* north-east, from below */
    const double *se_x = s_x + 4 * PITCH, *se_y = s_y + 4 * PITCH; /* north-west, from below */
    for (int x = 0; x < n; x++) {
        double fx = e_x[x] - e_x[x - 1] + (n_x[x] + 0.5 * (ne_x[x] + nw_x[x - 1]))
                    - (s_x[x] + 0.5 * (sw_x[x - 1] + se_x[x])) + k_s * (slider_x - ux[x]);
        double fy = e_y[x] - e_y[x - 1] + (n_y[x] + 0.5 * (ne_y[x] + nw_y[x - 1]))
                    - (s_y[x] + 0.5 * (sw_y[x - 1] + se_y[x])) + k_s * (slider_y - uy[x]);
        double vx = wx[x], vy = wy[x];
        double trial_x = a * vx + fx, trial_y = a * vy + fy;
        double speed2 = trial_x * trial_x + trial_y * trial_y;
        double along = trial_x * vx + trial_y * vy;
        double mean_x = along > 0.0 ? trial_x + vx : trial_x;
        double mean_y = along > 0.0 ? trial_y + vy : trial_y;
        double taken = mu_d_load[x] / sqrt(mean_x * mean_x + mean_y * mean_y);
        int held = (along <= 0.0) & (fx * fx + fy * fy <= mu_s_load[x] * mu_s_load[x]);
        int slides = (speed2 > mu_d_load[x] * mu_d_load[x]) & !held;
        double new_x = slides ? trial_x - taken * mean_x : 0.0;
        double new_y = slides ? trial_y - taken * mean_y : 0.0;
        wx[x] = new_x, wy[x] = new_y;
        ux[x] += new_x, uy[x] += new_y;
        double first = t_det[x];
        t_det[x] = slides & (mu_s_load[x] > 0.0) & (first > now) ? now : first;
    }
}

static double sum(const double *row, int n)
{
    double total = 0.0;
    for (int x = 0; x < n; x++)
        total += row[x];
    return total;
}

/* No forces between two rows: beyond the first and the last row there are none. */
static void clear(double *bank, int n)
{
    for (int field = 0; field < 6; field++)
        memset(bank + field * PITCH, 0, n * sizeof *bank);
}

/* Take `steps` steps from step `first`. `fields` holds ux, uy, wx, wy, t_det, mu_s F_n and mu_d F_n,
   (n, n + 1) each, the last column being a border; `force` gets the two components of the slider's
   force after each step. */
void advance(double *fields, int n, const double *series, double a, double k_s, double slider_x,
             double slider_y, int first, int steps, double *force)
{
    static double scratch[8 + 2 * PITCH + 2 * BANK];
    const size_t pitch = n + 1, field = n * pitch;
    double *east = scratch + 8, *north = east + 2 * PITCH, *south = north + BANK;
    for (int k = first; k < first + steps; k++) {
        double total_x = 0.0, total_y = 0.0;
        clear(south, n);
        for (int row = 0; row < n; row++) {
            double *u = fields + row * pitch;
            double *next = row + 1 < n ? u + pitch : u; /* the last row has no next: any will do */
            springs(u, u + field, next, next + field, east, east + PITCH,
                    north, north + PITCH, north + 2 * PITCH, north + 3 * PITCH,
                    north + 4 * PITCH, north + 5 * PITCH, series, n);
            east[n - 1] = east[PITCH + n - 1] = 0.0; /* no springs across the edges */
            for (int diagonal_field = 2; diagonal_field < 6; diagonal_field++)
                north[diagonal_field * PITCH + n - 1] = 0.0;
            if (row + 1 == n)
                clear(north, n);
            move(u, u + field, u + 2 * field, u + 3 * field, u + 4 * field, u + 5 * field,
                 u + 6 * field, east, north, south, n, a, k_s, slider_x * k, slider_y * k, k);
            total_x += sum(u, n);
            total_y += sum(u + field, n);
            double *other = north;
            north = south;
            south = other;
        }
        force[2 * (k - first)] = k_s * ((double)n * n * slider_x * (k + 1) - total_x);
        force[2 * (k - first) + 1] = k_s * ((double)n * n * slider_y * (k + 1) - total_y);
    }
}
