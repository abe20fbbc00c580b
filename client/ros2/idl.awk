# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# From .msg and .srv files to the IDL that ROS 2 would put on DDS: names with underscores, @final structs, no
# keys, and before the members of a service's halves what rmw_cyclonedds puts there. A file comes after
# those that it mentions.
# usage: awk -f idl.awk FILE... >percuss_msgs.idl

BEGIN {
    split("bool boolean uint8 octet uint32 unsigned_long uint64 unsigned_long_long int64 long_long " \
          "float64 double string string", pairs, " ")
    for (i = 1; i in pairs; i += 2) {
        name[pairs[i]] = pairs[i + 1]
        gsub(/_/, " ", name[pairs[i]])
    }
    print "module geometry_msgs { module msg { module dds_ {"
    print "  @final @nested struct Point_ { double x; double y; double z; };"
    print "  @final @nested struct Vector3_ { double x; double y; double z; };"
    print "  @final @nested struct Quaternion_ { double x; double y; double z; double w; };"
    print "}; }; };"
}

function fail(text) {
    print FILENAME ":" FNR ": " text >"/dev/stderr"
    failed = 1
    exit 1
}

function type_of(text,    parts) {
    if (text in name)
        return name[text]
    if (text in written)
        return "percuss_msgs::msg::dds_::" text "_"
    if (split(text, parts, "/") == 2 && parts[1] == "geometry_msgs" && parts[2] ~ /^(Point|Vector3|Quaternion)$/)
        return "geometry_msgs::msg::dds_::" parts[2] "_"
    fail("unknown type " text)
}

function open_struct(kind, suffix) {
    members = "  @final struct " struct suffix "_ {\n"
    if (kind == "srv")
        members = members "    unsigned long long header_guid;\n    long long header_number;\n"
}

function close_struct() {
    print "module percuss_msgs { module " kind " { module dds_ {"
    printf "%s", constants
    print members "  };\n}; }; };"
    constants = ""
}

FNR == 1 {
    if (struct)
        close_struct()
    struct = FILENAME
    kind = struct ~ /\.srv$/ ? "srv" : "msg"
    sub(/.*\//, "", struct)
    sub(/\..*/, "", struct)
    open_struct(kind, kind == "srv" ? "_Request" : "")
    if (kind == "msg")
        written[struct] = 1
}

/^---$/ {
    close_struct()
    open_struct(kind, "_Response")
    next
}

{ sub(/#.*/, "") }

# a constant: TYPE NAME=VALUE
NF && /=/ {
    split($2, parts, "=")
    constants = constants "  const " type_of($1) " " struct "_" parts[1] " = " parts[2] ";\n"
    next
}

NF {
    if (NF != 2)
        fail("not a member: " $0)
    count = ""
    type = $1
    if (match(type, /\[[0-9]*\]$/)) {
        count = substr(type, RSTART)
        type = substr(type, 1, RSTART - 1)
    }
    type = type_of(type)
    if (count == "[]") {
        type = "sequence<" type ">"
        count = ""
    }
    members = members "    " type " " $2 count ";\n"
}

END {
    if (!failed)
        close_struct()
}
