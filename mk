#!/bin/sh
R=${R:-/work/main}
gcc -std=c17 -D_GNU_SOURCE -O2 -ftree-vectorize -g -ffp-contract=off -I$R/service -I$R/idl -I$R/tests $1.c $R/tests/bench/scenes.c $R/service/impact/*.c $R/service/contact/*.c $R/service/numeric/*.c $R/service/base/*.c $R/service/model/*.c $R/service/solve/*.c $R/service/catalogue/*.c -lyaml -lsundials_cvode -lsundials_nvecserial -llapacke -llapack -lm -o $1
