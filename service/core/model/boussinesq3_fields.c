/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Three loads at many points: both potentials, psi = sigma (ln s - ln s') of the normal load and
 * t.x F of one along t, depend on R = |x| and z = x.e alone, so that their derivatives are made of
 * x, e and t with coefficients that all loads share. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "model/boussinesq3.h"
#include "model/vector.h"

/* Points whose arithmetic goes side by side. */
enum { TOGETHER = 4 };
typedef double lane[TOGETHER];

/* Points as seen from the load's, and from the end of its reach. With sigma = 1, s = R + z; beyond
 * the reach outwards sigma = -1, s = R - z, as R + z = (distance from the axis)^2 / (R - z) and the
 * distance cancels between both. */
struct seen {
    lane r[3], z, sigma;
    lane inverse, share;         /* 1/R, 1/s */
    lane end_inverse, end_share; /* 1/R', 1/s' */
};

/* grad psi = x psi_x + e psi_e, grad F = x fall_x + e fall_e; b is the balance of cerruti3_field's
 * reach, grad b = x balance_x + e balance_e. */
struct slopes {
    lane psi_x, psi_e;
    lane f, fall_x, fall_e;
    lane balance, balance_x, balance_e;
};

/* Second derivatives: even + xx x x^T + xe (x e^T + e x^T) + ee e e^T, of psi and of F. */
struct bends {
    lane psi_even, psi_xx, psi_xe, psi_ee;
    lane f_even, f_xx, f_xe, f_ee;
};

static void look(const struct boussinesq3 *load, const double (*x)[3], struct seen *seen)
{
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < TOGETHER; l++)
            seen->r[k][l] = x[l][k] - load->point[k];
    const double *e = load->inward;
    double reach = load->reach;
    bool ends = isfinite(reach);
    for (int l = 0; l < TOGETHER; l++) {
        double square = seen->r[0][l] * seen->r[0][l] + seen->r[1][l] * seen->r[1][l] +
                        seen->r[2][l] * seen->r[2][l];
        double z = seen->r[0][l] * e[0] + seen->r[1][l] * e[1] + seen->r[2][l] * e[2];
        double distance = sqrt(square), sigma = z + reach > 0.0 ? 1.0 : -1.0;
        seen->z[l] = z;
        seen->sigma[l] = sigma;
        seen->inverse[l] = 1.0 / distance;
        seen->share[l] = 1.0 / (distance + sigma * z);
    }
    for (int l = 0; ends && l < TOGETHER; l++) {
        double from_end[3] = {seen->r[0][l], seen->r[1][l], seen->r[2][l]};
        add_scaled3(reach, e, from_end);
        double distance = norm3(from_end);
        seen->end_inverse[l] = 1.0 / distance;
        seen->end_share[l] = 1.0 / (distance + seen->sigma[l] * dot3(from_end, e));
    }
}

/* First derivatives: psi = sigma ln s, F = 1/s. */
static void find_slopes(const struct seen *seen, struct slopes *slopes)
{
    memset(slopes, 0, sizeof *slopes);
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->inverse[l], s = seen->share[l], sigma = seen->sigma[l];
        slopes->psi_x[l] = sigma * i * s;
        slopes->psi_e[l] = s;
        slopes->f[l] = s;
        slopes->fall_x[l] = -i * s * s;
        slopes->fall_e[l] = -sigma * s * s;
    }
}

/* Takes the reach's part off them: sigma ln s', and 1/s' + sigma L/(R' s'), whose derivatives along
 * x' = x + L e have L times as much along e. */
static void end_slopes(const struct seen *seen, double reach, struct slopes *slopes)
{
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->end_inverse[l], s = seen->end_share[l], sigma = seen->sigma[l];
        double lever = sigma * reach, g = i * s, cube = i * i * i, z = seen->z[l] + reach;
        double fall_x = -g * s - lever * g * (i * i + g);
        slopes->psi_x[l] -= sigma * g;
        slopes->psi_e[l] -= s + lever * g;
        slopes->f[l] -= s + lever * g;
        slopes->fall_x[l] -= fall_x;
        slopes->fall_e[l] -= -sigma * s * s - reach * g * s + reach * fall_x;
        double balance_x = -(1.0 + 3.0 * reach * z * i * i) * cube;
        slopes->balance[l] = i + reach * z * cube;
        slopes->balance_x[l] = balance_x;
        slopes->balance_e[l] = reach * (cube + balance_x);
    }
}

/* Second derivatives of the same. */
static void find_bends(const struct seen *seen, struct bends *bends)
{
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->inverse[l], s = seen->share[l], sigma = seen->sigma[l];
        double g = i * s, square = i * i;
        bends->psi_even[l] = sigma * g;
        bends->psi_xx[l] = -sigma * (square + g) * g;
        bends->psi_xe[l] = -g * s;
        bends->psi_ee[l] = -sigma * s * s;
        bends->f_even[l] = -g * s;
        bends->f_xx[l] = (square + 2.0 * g) * g * s;
        bends->f_xe[l] = 2.0 * sigma * g * s * s;
        bends->f_ee[l] = 2.0 * s * s * s;
    }
}

static void end_bends(const struct seen *seen, double reach, struct bends *bends)
{
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->end_inverse[l], s = seen->end_share[l], sigma = seen->sigma[l];
        double g = i * s, square = i * i, sum = square + g, lever = sigma * reach * g;
        double xx = -sigma * sum * g, xe = -g * s;
        bends->psi_even[l] -= sigma * g;
        bends->psi_xx[l] -= xx;
        bends->psi_xe[l] -= xe + reach * xx;
        bends->psi_ee[l] -= -sigma * s * s + 2.0 * reach * xe + reach * reach * xx;
        /* those of 1/s', and of 1/(R' s') times the lever */
        xx = (square + 2.0 * g) * g * s +
             lever * (sum * sum + 2.0 * square * square + square * g + g * g);
        xe = 2.0 * sigma * g * s * s + lever * sigma * s * (sum + g);
        bends->f_even[l] -= -g * s - lever * sum;
        bends->f_xx[l] -= xx;
        bends->f_xe[l] -= xe + reach * xx;
        bends->f_ee[l] -= 2.0 * s * s * (s + lever) + 2.0 * reach * xe + reach * reach * xx;
    }
}

/* u = (1 + nu)/(2 pi E) times: of the normal load x (z/R^3 - side psi_x) + e ((3 - 4 nu)/R - side
 * psi_e); of one along t, t.x (x own_x + e own_e) + t own_t. */
static void displace(const struct boussinesq3 *load, const double along[2][3],
                     const struct seen *seen, const struct slopes *slopes, double (*u)[3][3])
{
    const double *e = load->inward;
    double poisson = load->poisson, side = 1.0 - 2.0 * poisson;
    double unit = (1.0 + poisson) / (2.0 * M_PI * load->young);
    lane normal_x, normal_e, own_x, own_e, own_t, lever[2], all[3][3];
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->inverse[l], cube = i * i * i, z = seen->z[l];
        normal_x[l] = unit * (z * cube - side * slopes->psi_x[l]);
        normal_e[l] = unit * ((3.0 - 4.0 * poisson) * i - side * slopes->psi_e[l]);
        own_x[l] = unit * (cube + side * slopes->fall_x[l]);
        own_e[l] = -unit * side * (slopes->fall_e[l] + 2.0 * z * slopes->fall_x[l]);
        own_t[l] = unit * (i + side * (slopes->f[l] + 2.0 * slopes->balance[l]));
    }
    for (int j = 0; j < 2; j++)
        for (int l = 0; l < TOGETHER; l++)
            lever[j][l] = along[j][0] * seen->r[0][l] + along[j][1] * seen->r[1][l] +
                          along[j][2] * seen->r[2][l];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < TOGETHER; l++) {
            double way = seen->r[k][l] * own_x[l] + e[k] * own_e[l];
            all[0][k][l] = seen->r[k][l] * normal_x[l] + e[k] * normal_e[l];
            all[1][k][l] = lever[0][l] * way + along[0][k] * own_t[l];
            all[2][k][l] = lever[1][l] * way + along[1][k] * own_t[l];
        }
    for (int l = 0; l < TOGETHER; l++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                u[l][j][k] = all[j][k][l];
}

/* Parts of the tractions on the area n along n, x and e: those of the normal load, those of t.x,
 * and of one along t besides t even + t.n (x cross_x + e cross_e). */
struct pulls {
    lane normal_n, normal_x, normal_e;
    lane own_n, own_x, own_e;
    lane even, cross_x, cross_e;
};

static void find_pulls(double side, const struct seen *seen, const struct slopes *slopes,
                       const struct bends *bends, const lane on_x, const lane on_e,
                       struct pulls *pulls)
{
    static const double UNIT = 0.5 / M_PI;
    for (int l = 0; l < TOGETHER; l++) {
        double i = seen->inverse[l], cube = i * i * i, z = seen->z[l], push = 3.0 * cube * i * i;
        double x = on_x[l], e = on_e[l], twist = cube + bends->psi_xe[l];
        /* Boussinesq's stress: -3 z x x^T/R^5 + side (z/R^3 - (x e^T + e x^T)/R^3 - psi'') */
        pulls->normal_n[l] = UNIT * side * (z * cube - bends->psi_even[l]);
        pulls->normal_x[l] = UNIT * ((-push * z - side * bends->psi_xx[l]) * x - side * twist * e);
        pulls->normal_e[l] = -UNIT * side * (twist * x + bends->psi_ee[l] * e);
        /* Cerruti's: t.x (side/R^3 - 3 x x^T/R^5) + side (S - e (S e)^T - S e e^T + t grad b^T +
         * grad b t^T), S = t grad F^T + grad F t^T + t.x F'' */
        double down = slopes->fall_x[l] * z + slopes->fall_e[l];
        pulls->own_n[l] = UNIT * side * (cube + bends->f_even[l]);
        pulls->own_x[l] = UNIT * (side * bends->f_xx[l] * (x - z * e) - push * x);
        pulls->own_e[l] =
            -UNIT * side *
            (bends->f_xx[l] * z * x +
             (2.0 * bends->f_even[l] + 2.0 * bends->f_xe[l] * z + bends->f_ee[l]) * e);
        pulls->cross_x[l] = UNIT * side * (slopes->fall_x[l] + slopes->balance_x[l]);
        pulls->cross_e[l] = UNIT * side * (slopes->fall_e[l] + slopes->balance_e[l] - down);
        pulls->even[l] = UNIT * side *
                         ((slopes->fall_x[l] + slopes->balance_x[l]) * x +
                          (slopes->fall_e[l] + slopes->balance_e[l] - down) * e);
    }
}

static void pull(const struct boussinesq3 *load, const double along[2][3], const double (*areas)[3],
                 const struct seen *seen, const struct slopes *slopes, const struct bends *bends,
                 double (*t)[3][3])
{
    const double *e = load->inward;
    struct pulls pulls;
    lane n[3], on_x, on_e, lever[2], on_t[2], all[3][3];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < TOGETHER; l++)
            n[k][l] = areas[l][k];
    for (int l = 0; l < TOGETHER; l++) {
        on_x[l] = seen->r[0][l] * n[0][l] + seen->r[1][l] * n[1][l] + seen->r[2][l] * n[2][l];
        on_e[l] = e[0] * n[0][l] + e[1] * n[1][l] + e[2] * n[2][l];
    }
    for (int j = 0; j < 2; j++)
        for (int l = 0; l < TOGETHER; l++) {
            const double *a = along[j];
            lever[j][l] = a[0] * seen->r[0][l] + a[1] * seen->r[1][l] + a[2] * seen->r[2][l];
            on_t[j][l] = a[0] * n[0][l] + a[1] * n[1][l] + a[2] * n[2][l];
        }
    find_pulls(1.0 - 2.0 * load->poisson, seen, slopes, bends, on_x, on_e, &pulls);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < TOGETHER; l++) {
            double x = seen->r[k][l];
            double way = n[k][l] * pulls.own_n[l] + x * pulls.own_x[l] + e[k] * pulls.own_e[l];
            double cross = x * pulls.cross_x[l] + e[k] * pulls.cross_e[l];
            all[0][k][l] =
                n[k][l] * pulls.normal_n[l] + x * pulls.normal_x[l] + e[k] * pulls.normal_e[l];
            all[1][k][l] = lever[0][l] * way + on_t[0][l] * cross + along[0][k] * pulls.even[l];
            all[2][k][l] = lever[1][l] * way + on_t[1][l] * cross + along[1][k] * pulls.even[l];
        }
    for (int l = 0; l < TOGETHER; l++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                t[l][j][k] = all[j][k][l];
}

/* So many points at once, TOGETHER of them. */
static void find_fields(const struct boussinesq3 *load, const double along[2][3],
                        const double (*x)[3], const double (*areas)[3], double (*u)[3][3],
                        double (*t)[3][3])
{
    struct seen seen;
    struct slopes slopes;
    struct bends bends;
    bool ends = isfinite(load->reach);
    look(load, x, &seen);
    find_slopes(&seen, &slopes);
    if (ends)
        end_slopes(&seen, load->reach, &slopes);
    displace(load, along, &seen, &slopes, u);
    if (!areas || !t)
        return;
    find_bends(&seen, &bends);
    if (ends)
        end_bends(&seen, load->reach, &bends);
    pull(load, along, areas, &seen, &slopes, &bends, t);
}

void boussinesq3_fields(const struct boussinesq3 *load, const double along[2][3], size_t count,
                        const double (*x)[3], const double (*areas)[3], double (*u)[3][3],
                        double (*t)[3][3])
{
    size_t first = 0;
    for (; first + TOGETHER <= count; first += TOGETHER)
        find_fields(load, along, x + first, areas ? areas + first : NULL, u + first,
                    t ? t + first : NULL);
    if (first == count)
        return;
    /* the last few, filled up by copies of the last */
    double points[TOGETHER][3], parts[TOGETHER][3], moved[TOGETHER][3][3], pulled[TOGETHER][3][3];
    size_t left = count - first;
    for (size_t l = 0; l < TOGETHER; l++) {
        size_t from = first + (l < left ? l : left - 1);
        memcpy(points[l], x[from], sizeof points[l]);
        memcpy(parts[l], areas ? areas[from] : x[from], sizeof parts[l]);
    }
    find_fields(load, along, (const double(*)[3])points, areas ? (const double(*)[3])parts : NULL,
                moved, t ? pulled : NULL);
    memcpy(u + first, moved, left * sizeof *u);
    if (areas && t)
        memcpy(t + first, pulled, left * sizeof *t);
}
