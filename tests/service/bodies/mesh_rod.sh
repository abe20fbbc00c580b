#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The paper's rod as a mesh of tetrahedra, from Gmsh's drawing to restitutions at five speeds: a rod of
# 73 GPa, as another program's complete chain of the same method gives it.
. "$(dirname "$0")/../support/lib.sh"

command -v gmsh >/dev/null || {
    say "Gmsh is not installed: skipped"
    exit 77
}
cat >"$work/rod.geo" <<'END'
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 1000, 0, 0, 10};
Mesh.MeshSizeMin = 8;
Mesh.MeshSizeMax = 8;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 2;
END
gmsh -3 -format msh41 -o "$work/rod.msh" "$work/rod.geo" >"$out" 2>&1 || fail "gmsh makes no mesh"

say "reduced to 160 modes"
expect 0 "$bin/percuss-reduce" "$work/rod.msh" --unit mm --young 73e9 --poisson 0.33 --density 2780 \
    --modes 160 --site 1000,0,0 -o "$work/rod.h5"
cat >"$work/catalogue.yaml" <<'END'
materials:
  steel: {young: 210e9, poisson: 0.30, density: 7780}
  alloy: {young: 73e9, poisson: 0.33, density: 2780}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.015}
  rod: {shape: rod, material: alloy, radius: 0.010, length: 1.0}
  part: {shape: mesh, file: rod.h5, sites: {end: {point: [1000, 0, 0]}}}
END
start_daemon

# near A B ALLOWED
near() {
    awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; exit !(d * d <= r * r) }'
}

say "restitutions are those of a prototype in another language within the 6e-4 that its meshes differ by"
for case in 0.05:0.7769 0.1:0.7256 0.2:0.6710 0.3:0.6377 0.5:0.5942; do
    expect 0 percuss query --a ball --b part --at-b end --speed "${case%:*}" --json
    near "$(field restitution)" "${case#*:}" 6e-4 || fail "$(field restitution) at ${case%:*} m/s"
    grep -q '"compliance": "matched"' "$out" || fail "it does not count as matched"
    # and those of the rod in one dimension with matched compliance, which knows no sideways motion
    part=$(field restitution)
    expect 0 percuss query --a ball --b rod --speed "${case%:*}" --json
    near "$part" "$(field restitution)" 1e-3 || fail "the rod's $(field restitution), the mesh's $part"
done
stop_daemon
