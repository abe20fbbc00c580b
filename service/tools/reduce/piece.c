/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/piece.h"

#include <string.h>

const struct piece WHOLE_PIECE[ELEMENT_TYPES] = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                                 {{{-1, -1, -1}, {1, 1, 1}}},
                                                 {{{-1, -1, -1}, {1, 1, 1}}},
                                                 {{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}}}};

void piece_point(enum element_type type, const struct piece *piece, const double at[3],
                 double natural[3])
{
    for (int k = 0; k < 3; k++) {
        double from = piece->corners[0][k], to = piece->corners[1][k];
        natural[k] = from;
        if (type == ELEMENT_TET10)
            for (int i = 0; i < 3; i++)
                natural[k] += at[i] * (piece->corners[i + 1][k] - from);
        else if (type == ELEMENT_WEDGE15)
            natural[k] += at[0] * (to - from) + at[1] * (piece->corners[2][k] - from) +
                          0.5 * (1.0 + at[2]) * (piece->corners[3][k] - from);
        else
            natural[k] += 0.5 * (1.0 + at[k]) * (to - from);
    }
}

/* four of the triangle, below and above */
static void split_wedge(const struct piece *piece, struct piece parts[8])
{
    static const int PARTS[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    const double(*corners)[3] = piece->corners;
    double points[6][3];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            points[i][k] = corners[i][k];
            points[3 + i][k] = 0.5 * (corners[i][k] + corners[(i + 1) % 3][k]);
        }
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) {
            double half = 0.5 * (corners[3][k] - corners[0][k]), low = i < 4 ? 0.0 : half;
            for (int c = 0; c < 3; c++)
                parts[i].corners[c][k] = points[PARTS[i % 4][c]][k] + low;
            parts[i].corners[3][k] = parts[i].corners[0][k] + half;
        }
}

void piece_split(enum element_type type, const struct piece *piece, struct piece parts[8])
{
    if (type == ELEMENT_WEDGE15) {
        split_wedge(piece, parts);
        return;
    }
    if (type != ELEMENT_TET10) {
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 3; k++) {
                double from = piece->corners[0][k], half = 0.5 * (piece->corners[1][k] - from);
                parts[i].corners[0][k] = from + (i >> k & 1) * half;
                parts[i].corners[1][k] = parts[i].corners[0][k] + half;
            }
        return;
    }
    /* corners 0 to 3, middles 01 02 03 12 13 23; four at the corners, four about the line 03-12 */
    static const int PARTS[8][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
                                    {6, 7, 4, 5}, {6, 7, 5, 9}, {6, 7, 9, 8}, {6, 7, 8, 4}};
    static const int MIDDLES[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    double points[10][3];
    memcpy(points, piece->corners, sizeof piece->corners);
    for (int m = 0; m < 6; m++)
        for (int k = 0; k < 3; k++)
            points[4 + m][k] = 0.5 * (points[MIDDLES[m][0]][k] + points[MIDDLES[m][1]][k]);
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 4; c++)
            memcpy(parts[i].corners[c], points[PARTS[i][c]], sizeof points[0]);
}
