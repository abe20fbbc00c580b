# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# A mesh for the stories. Sourced.

# block NX NY NZ: a deck of cubes of 20 nodes and 5 mm; set `low` holds x = 0, the cubes are `left` up to
# the middle and `right` beyond
block() {
    awk -v nx="$1" -v ny="$2" -v nz="$3" 'function node(i, j, k) { return 1 + i + (2 * nx + 1) * (j + (2 * ny + 1) * k) }
    BEGIN {
        print "*NODE"
        for (k = 0; k <= 2 * nz; k++)
            for (j = 0; j <= 2 * ny; j++)
                for (i = 0; i <= 2 * nx; i++)
                    if (i % 2 + j % 2 + k % 2 < 2)
                        printf "%d, %g, %g, %g\n", node(i, j, k), 2.5 * i, 2.5 * j, 2.5 * k
        split("0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 2 2 2 0 2 2 1 0 0 2 1 0 1 2 0 0 1 0 1 0 2 2 1 2 1 2 2 0 1 2 " \
            "0 0 1 2 0 1 2 2 1 0 2 1", at, " ")
        for (a = 0; a < nx; a++) {
            printf "*ELEMENT, TYPE=C3D20, ELSET=%s\n", a < nx / 2 ? "left" : "right"
            for (b = 0; b < ny; b++)
                for (c = 0; c < nz; c++) {
                    printf "%d", ++element
                    for (n = 0; n < 20; n++)
                        printf ",%s %d", n == 10 ? "\n" : "", node(2 * a + at[3 * n + 1], 2 * b + at[3 * n + 2], 2 * c + at[3 * n + 3])
                    print ""
                }
        }
        print "*NSET, NSET=low"
        for (k = 0; k <= 2 * nz; k++)
            for (j = 0; j <= 2 * ny; j++)
                if (j % 2 + k % 2 < 2)
                    printf "%d,\n", node(0, j, k)
    }'
}
