#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Includes go downward only: fails on an include that goes upward or sideways, on modules that include each
# other round, on a client that looks into the service, and on libraries used outside the one folder that may.
# usage: layers.sh SOURCE_DIR
set -u
cd "$1" || exit 2

# each folder of service/ with the folders it may include from
allowed() {
    case $1 in
    base) echo "base" ;;
    numeric) echo "base numeric" ;;
    model) echo "base numeric model" ;;
    mesh) echo "base numeric model mesh" ;;
    fe) echo "base numeric model fe" ;;
    contact) echo "base numeric model fe contact" ;;
    impact) echo "base numeric model fe contact impact" ;;
    solve) echo "base numeric model fe contact impact solve" ;;
    ensemble) echo "base numeric model fe contact impact solve ensemble" ;;
    catalogue) echo "base numeric model mesh catalogue" ;;
    store) echo "base numeric model fe contact store" ;;
    exchange) echo "base numeric model contact impact solve ensemble exchange" ;;
    respond) echo "base model fe contact solve ensemble catalogue store exchange respond" ;;
    endpoint) echo "base model contact solve exchange endpoint" ;;
    tables) echo "base model fe contact catalogue store tables" ;;
    reduce) echo "base numeric model mesh catalogue reduce" ;;
    reduce_mpi) echo "base mesh reduce reduce_mpi" ;;
    daemon) echo "base numeric model fe contact impact solve ensemble catalogue store exchange respond endpoint daemon" ;;
    esac
}

# includes [brackets=1] FILE...: "FILE HEADER" a line, of all in quotes, and with the one of those in brackets
includes() {
    awk '/^ *# *include *"[^"]*"/ || (brackets && /^ *# *include *<[^>]*>/) {
        split($0, part, /["<>]/)
        print FILENAME " " part[2]
    }' "$@"
}

bad=0
checked=0
complain() {
    echo "layers: $*" >&2
    bad=1
}

for folder in service/core/*/ service/tools/*/ service/*/; do
    case $folder in service/core/ | service/tools/) continue ;; esac
    layer=$(basename "$folder")
    list=$(allowed "$layer")
    [ -n "$list" ] || complain "$folder is in no layer: add it to tests/layers.sh and docs/architecture.md"
    # the folder's sources, and those of a folder below
    # shellcheck disable=SC2046
    set -- $(find "$folder" -maxdepth 2 -name '*.[ch]')
    checked=$((checked + $#))
    [ $# -gt 0 ] || continue
    while read -r file include; do
        case $include in
        "" | percuss/vocabulary.h | percuss/fields.h | percuss/plausible.h | percuss/habits.h) continue ;;
        percuss_wire.h | wire_partition.h)
            case $layer in exchange | respond | endpoint | daemon) ;; *) complain "$file includes $include" ;; esac
            continue
            ;;
        wire.h | wire_clock.h | wire_security.h | wire_validity.h | wire_whole.h)
            case $layer in endpoint | daemon) ;; *) complain "$file includes $include" ;; esac
            continue
            ;;
        esac
        target=${include%%/*}
        case " $list " in
        *" $target "*) ;;
        *) complain "$file ($layer) includes $include" ;;
        esac
    done <<EOF
$(includes "$@")
EOF
done

# no module (a .c and a .h of one name) includes itself round: the shortest way through each that does
# shellcheck disable=SC2046
rounds=$(includes brackets=1 $(find service -name '*.[ch]') client/*/*.[ch] client/include/*/*.h | awk '
    function module(path) { sub(/\.[ch]$/, "", path); sub(/^service\/((core|tools)\/)?/, "", path); return path }
    {
        folder = $1
        sub(/[^\/]*$/, "", folder)
        to = $2 ~ /^percuss\// ? "client/include/" $2 : $2 ~ /\// ? $2 : folder $2
        if (module($1) != module(to))
            next_of[module($1)] = next_of[module($1)] " " module(to)
    }
    END {
        for (start in next_of) {
            split("", way)
            split("", queue)
            queue[1] = start
            here = ""
            for (i = n = 1; i <= n && !(start in way); here = way[queue[++i]]) {
                count = split(next_of[queue[i]], includes, " ")
                for (k = 1; k <= count; k++)
                    if (!(includes[k] in way)) {
                        way[includes[k]] = here " > " includes[k]
                        queue[++n] = includes[k]
                    }
            }
            if (start in way)
                print start way[start]
        }
    }' | sort)
[ -z "$rounds" ] || complain "modules include each other:
$rounds"

# one owner for each library (a folder or a module); no files, clock or output below the catalogue
only() {
    pattern=$1
    owner=$2
    found=$(grep -lE "^ *# *include *<($pattern)" $(find service -name '*.[ch]') client/*/*.[ch] 2>/dev/null | grep -vE "^($owner)[/.]")
    [ -z "$found" ] || complain "<$pattern> outside $owner: $found"
}
only 'cvode|arkode|sundials|nvector|sunlinsol|sunmatrix|sunnonlinsol' 'service/core/numeric'
only 'lapacke|Random123' 'service/core/numeric'
only 'cblas' 'service/core/numeric'
only 'dmumps' 'service/tools/reduce'
only 'petsc|slepc' 'service/tools/reduce_mpi'
only 'mpi\.h' 'service/tools/reduce_mpi|client/mpi'
only 'cminpack' 'client/measured'
only 'yaml' 'service/core/catalogue|service/respond'
only 'jansson' 'client/cli|service/store'
only 'sqlite3' 'service/store'
only 'hdf5' 'service/core/mesh'
only 'zmumps' 'tests/reference/spatial'
only 'dds/' 'service/endpoint|service/daemon|client/lib|client/ros2|client/doctor'
only 'time\.h|sys/|unistd|pthread' 'service/core/base/atomic_file|service/exchange|service/respond|service/endpoint|service/daemon|service/core/catalogue|service/core/mesh|service/store|service/tools/tables|service/tools/reduce|client/api|client/lib|client/local|client/cli|client/twins|client/ros2|client/doctor'

# clients do not look into the service, but for the one that is a service to itself; the slow scale is built
# with its complementarity solver, and clients, command lines and files of measurements with its numbers
# with units
found=$(grep -nE '^ *# *include *"(base|numeric|model|fe|contact|impact|solve|ensemble|store|catalogue|exchange|respond|endpoint|daemon)/' client/*/*.[ch] |
    grep -v -e '^client/slowscale/.*"numeric/lcp\.h"' -e '^client/\(api/quantity\.c\|cli/quantity\.h\|measured/column\.h\|measured/divide\.c\|ros2/main\.c\):.*"base/units\.h"' -e '^client/local/.*"\(catalogue\|ensemble\|exchange\|respond\|store\)/')
[ -z "$found" ] || complain "client looks into the service: $found"

# which therefore needs nothing of the rest, and the slow scale no DDS
found=$(grep -nE '^ *# *include *("(base|model)/|<(lapacke|cvode|sundials))' service/core/numeric/lcp.[ch] service/core/numeric/linear_solve.c service/core/numeric/linear.h
    grep -nE '^ *# *include *["<](dds/|wire|percuss_wire|pthread)' client/slowscale/*.[ch] client/include/percuss/*.h)
[ -z "$found" ] || complain "the slow scale must stand alone: $found"

[ "$checked" -gt 30 ] || complain "only $checked files found in service/"
echo "layers: $checked files checked"
exit $bad
