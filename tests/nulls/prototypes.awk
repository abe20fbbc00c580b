# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# From the public headers to a C source that calls every function of them once for each of its pointers, with that
# one NULL and all other arguments valid (nulls.c). A pointer may be NULL where nulls.allowed says so, and then the
# comment above the function says so, too.
# usage: awk -f prototypes.awk nulls.allowed HEADER...

function fail(text) {
    print "prototypes.awk: " text > "/dev/stderr"
    failed = 1
    exit 1
}

function trim(text) {
    gsub(/[ \t\n]+/, " ", text)
    sub(/^ /, "", text)
    sub(/ $/, "", text)
    return text
}

# The name of a type as a macro of nulls.c ends: "const double *" is const_double_p.
function mangle(type) {
    gsub(/\*/, " p ", type)
    type = trim(type)
    gsub(/ /, "_", type)
    return type
}

# "double timeout" into types[i] and names[i]; an array is a pointer.
function split_parameter(text, i) {
    text = trim(text)
    array = sub(/\[[^]]*\]$/, "", text)
    match(text, /[A-Za-z_0-9]+$/)
    names[i] = substr(text, RSTART)
    types[i] = substr(text, 1, RSTART - 1) (array ? "*" : "")
}

function call(name, count, null_one, i, text) {
    for (i = 1; i <= count; i++)
        text = text (i > 1 ? ", " : "") (i == null_one ? "NULL" : "VALID_" mangle(types[i]))
    return "function(" text ")"
}

function prototype(text, comment, i, count, name, parts, key, result) {
    text = trim(text)
    match(text, /[A-Za-z_0-9]+ ?\(/)
    name = trim(substr(text, RSTART, RLENGTH - 1))
    result = text ~ /^enum percuss_result /
    parameters = substr(text, RSTART + RLENGTH)
    sub(/\)$/, "", parameters)
    count = parameters == "void" ? 0 : split(parameters, parts, ",")
    for (i = 1; i <= count; i++)
        split_parameter(parts[i], i)
    functions++
    calls[functions] = name
    printf "static void call_%s(void)\n{\n    FUNCTION(%s);\n", name, name
    for (i = 1; i <= count; i++) {
        if (types[i] !~ /\*/)
            continue
        key = name "." names[i]
        may = key in allowed || name ~ /_free$/ || (types[i] == "void *" && names[i] == "context")
        if (key in allowed && comment !~ /NULL/)
            fail(key " may be NULL, and the comment of its function does not say so")
        delete allowed[key]
        printf "    BEGIN(%s);\n", names[i]
        if (result)
            printf "    returned = %s;\n", call(name, count, i)
        else
            printf "    (void)%s;\n", call(name, count, i)
        printf "    END(%s, %s);\n", may ? "true" : "false", result ? "true" : "false"
    }
    print "}\n"
}

FILENAME == ARGV[1] {
    if (NF && $1 !~ /^#/)
        allowed[$1] = 1
    next
}

{ source[FILENAME] = source[FILENAME] $0 "\n" }

END {
    if (failed)
        exit 1
    for (f = 2; f < ARGC; f++) {
        text = source[ARGV[f]]
        gsub(/\n *#[^\n]*PERCUSS_API[^\n]*/, "", text)
        comment = ""
        while (match(text, /\/\*([^*]|\*+[^*\/])*\*+\/|PERCUSS_API[^;]*;/)) {
            piece = substr(text, RSTART, RLENGTH)
            text = substr(text, RSTART + RLENGTH)
            if (piece ~ /^\/\*/) {
                comment = piece
                continue
            }
            sub(/^PERCUSS_API */, "", piece)
            sub(/;$/, "", piece)
            prototype(piece, comment)
        }
    }
    for (key in allowed)
        fail(key " of nulls.allowed is in no header")
    print "static const struct call CALLS[] = {"
    for (i = 1; i <= functions; i++)
        printf "    {\"%s\", call_%s},\n", calls[i], calls[i]
    print "};"
}
