#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A catalogue is written with units, by somebody with a handbook and a caliper.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"

catalogue() {
    cat >"$work/catalogue.yaml"
}

# refused LINE TEXT: of the catalogue on stdin
refused() {
    catalogue
    expect 1 "$bin/percussd" --config "$work/percussd.yaml" --check-config
    says "catalogue.yaml:$1: $2"
}

say "with units and without them it is the same catalogue, and the same answers"
catalogue <<'END'
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
  tin: {young: 47e9, poisson: 0.33, density: 7280, yield: 9e6}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.009}
  bar: {shape: rod, material: tin, radius: 0.008, length: 1.1}
  slab: {shape: block, material: steel, size: [0.05, 0.05, 0.0254]}
END
start_daemon
percuss bodies --json >"$work/plain.json"
revision=$(percuss status --json | grep '"catalogue_revision"')
percuss query --a ball --b bar --speed 0.3 --json >"$work/plain-reply.json"
catalogue <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8 g/cm^3}
  tin: {young: 47e3 N/mm^2, poisson: 0.33, density: 7280 kg/m³, yield: 9 MPa}
bodies:
  ball:
    shape: sphere
    material: steel
    radius: 9 mm   # not to the bit what 9 * 0.001 is
  bar: {shape: rod, material: tin, radius: 8mm, length: 110 cm}
  slab: {shape: block, material: steel, size: [50 mm, 5 cm, 1 in]}
END
kill -HUP "$daemon"
wait_for 10 logged 'reload: 3 bodies, catalogue revision .* as before' || fail "the catalogue was not read again"
percuss bodies --json >"$work/units.json"
cmp "$work/plain.json" "$work/units.json" || fail "other bodies"
[ "$(percuss status --json | grep '"catalogue_revision"')" = "$revision" ] || fail "another revision"
percuss query --a ball --b bar --speed 0.3 --json >"$work/units-reply.json"
numbers "$work/plain-reply.json" >"$work/plain.txt"
numbers "$work/units-reply.json" | cmp - "$work/plain.txt" || fail "another answer"
stop_daemon

say "a unit that does not fit is refused with file, line, key and what is allowed"
refused 4 "bodies.ball.radius: 8 kg: must be a length, such as 8 mm; kg is no length" <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8 g/cm^3}
bodies:
  ball: {shape: sphere, material: steel, radius: 8 kg}
END
refused 2 "materials.steel.young: 210 Gpa: must be a stress, such as 70 GPa; Gpa is no unit that is known" <<'END'
materials:
  steel: {young: 210 Gpa, poisson: 0.3, density: 7.8 g/cm^3}
bodies:
  ball: {shape: sphere, material: steel, radius: 8 mm}
END
refused 2 "materials.steel.density: 7.8 g/cm^2: must be a density, such as 2.7 g/cm^3; g/cm^2 is no density" <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8 g/cm^2}
bodies:
  ball: {shape: sphere, material: steel, radius: 8 mm}
END
refused 4 "bodies.ball.radius: 8 km: must be a finite length > 0 m (1e-9 to 1e3 m)" <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8 g/cm^3}
bodies:
  ball: {shape: sphere, material: steel, radius: 8 km}
END

say "the example of the page and of the man page is good"
awk '/^```yaml/ { inside = 1; next } /^```/ && inside { exit } inside' "$source_dir/docs/reference/catalogue.md" | catalogue
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
awk '/^.Bd/ { inside = 1; next } /^.Ed/ { inside = 0 } inside' "$source_dir/client/man/percuss-catalogue.5" | catalogue
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config

say "percuss-tables and percuss-reduce read the same materials"
catalogue <<'END'
materials:
  steel: {young: 210 GPa, poisson: 0.3, density: 7.8 g/cm^2}
bodies:
  ball: {shape: sphere, material: steel, radius: 8 mm}
END
expect 1 "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder "$work"
says "materials.steel.density: 7.8 g/cm^2: must be a density"
block 4 1 1 >"$work/block.inp"
expect 1 "$bin/percuss-reduce" "$work/block.inp" --catalogue "$work/catalogue.yaml" --material steel \
    --output "$work/block.h5"
says "materials.steel.density: 7.8 g/cm^2: must be a density"
sed -i 's/cm^2/cm^3/' "$work/catalogue.yaml"
expect 0 "$bin/percuss-reduce" "$work/block.inp" --catalogue "$work/catalogue.yaml" --material steel \
    --output "$work/block.h5" --json
