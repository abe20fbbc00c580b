/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How the bodies of an impact move, from what the page carries: request, reply, the bodies of the catalogue and the
 * time histories of the contacts. SI units. The solver's displacement of each contact point judges what is made here. */
"use strict";

/* A line that misses the solver's displacement of the contact point by more than this share of its largest is not
 * drawn: the page then moves the contact point alone. */
const MOST_MISS = 0.05;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const times = (k, a) => [k * a[0], k * a[1], k * a[2]];
const unit = (a) => times(1 / Math.hypot(...a), a);

/* Columns of the rotation of a unit quaternion (w, x, y, z): the body's axes in the world. */
function axesOf(q) {
  const [w, x, y, z] = q;
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
}

const toWorld = (axes, p) => add(add(times(p[0], axes[0]), axes[1], p[1]), axes[2], p[2]);
const toBody = (axes, v) => axes.map((axis) => dot(axis, v));

/* Solves the symmetric 3 x 3 system of the inertia tensor. */
function solveInertia(body, v) {
  const [a, b, c] = body.inertia, [yz, zx, xy] = body.products;
  const m = [[a, xy, zx], [xy, b, yz], [zx, yz, c]];
  const columns = [0, 1, 2].map((i) => m.map((row) => row[i]));
  const det = (p, q, r) => dot(p, cross(q, r));
  const d = det(...columns);
  return [0, 1, 2].map((i) => det(...columns.map((column, k) => (k === i ? v : column))) / d);
}

/* The first tangent of a contact: the one that the reply used, or the world axis least parallel to the normal. */
function tangentOf(contact, result) {
  if (result && Math.hypot(...result.tangent) > 0.5) return result.tangent;
  const n = contact.normal, size = n.map(Math.abs);
  const least = size.indexOf(Math.min(...size));
  const axis = [0, 0, 0];
  axis[least] = 1;
  return unit(add(axis, n, -n[least]));
}

/* How deep the bodies are pressed together over the instants, m, from the stated instant on; 0 where they are apart. The
 * histories' own indentation is measured from the dent as it grows, and stands in where the displacements are not known. */
function depthOf(data, contact) {
  const trace = data.trace[contact], gap = data.request.contacts[contact].gap;
  return trace.indentation.map((own, i) => {
    const known = trace.displacement_a[i] !== null && trace.force[i] > 0;
    return known ? trace.displacement_b[i] - trace.displacement_a[i] - gap : own;
  });
}

/* The forces on a body over time: [{point, force(i): world, N}], one a contact. */
function forcesOn(data, index) {
  const list = [];
  data.request.contacts.forEach((contact, c) => {
    const trace = data.trace[c];
    if ((contact.a !== index && contact.b !== index) || !trace) return;
    const sign = contact.a === index ? 1 : -1;
    const first = tangentOf(contact, data.reply.contacts[c]), second = cross(contact.normal, first);
    const force = (i) => {
      let f = times(trace.force[i], contact.normal);
      if (trace.force_tangential_1)
        f = add(add(f, first, trace.force_tangential_1[i]), second, trace.force_tangential_2[i]);
      return times(sign, f);
    };
    list.push({contact: c, sign, point: contact.point, force});
  });
  return list;
}

const isHeld = (body) => body.supports.some((support) => support !== "free");

/* Motion of the rigid body over the instants: {shift, turn}: displacement of the centre of mass (m) and rotation (rad)
 * since the stated instant, and the velocities at the end. */
function rigidMotion(data, index, time) {
  const body = data.bodies[index], motion = data.request.bodies[index];
  const axes = axesOf(motion.orientation);
  const moves = body.mass !== null && !isHeld(body);
  const forces = forcesOn(data, index);
  let v = motion.velocity, w = motion.angular_velocity, x = [0, 0, 0], a = [0, 0, 0];
  const shift = [x], turn = [a];
  const rates = (i) => {
    let dv = [0, 0, 0], torque = [0, 0, 0];
    for (const one of forces) {
      const f = one.force(i);
      dv = add(dv, f, 1 / body.mass);
      torque = add(torque, cross(add(one.point, motion.position, -1), f));
    }
    return [dv, toWorld(axes, solveInertia(body, toBody(axes, torque)))];
  };
  for (let i = 1; i < time.length; i++) {
    const h = time[i] - time[i - 1];
    if (moves) {
      /* the force is taken as a straight line from instant to instant */
      const [dv0, dw0] = rates(i - 1), [dv1, dw1] = rates(i);
      const advance = (y, rate, r0, r1) => add(add(add(y, rate, h), r0, (h * h) / 3), r1, (h * h) / 6);
      x = advance(x, v, dv0, dv1);
      a = advance(a, w, dw0, dw1);
      v = add(add(v, dv0, h / 2), dv1, h / 2);
      w = add(add(w, dw0, h / 2), dw1, h / 2);
    }
    shift.push(x);
    turn.push(a);
  }
  return {shift, turn, velocity: v, angularVelocity: w};
}

/* Rows of the conditions at an end: which derivatives of the deflection vanish. */
const CONDITIONS = {free: [2, 3], pinned: [0, 2], clamped: [0, 1]};

/* The four waves of a uniform beam at x, differentiated k times and divided by b^k: cos, sin, and the two that decay
 * from either end. */
function waves(b, length, x, k) {
  const c = Math.cos(b * x), s = Math.sin(b * x);
  const left = Math.exp(-b * x), right = Math.exp(-b * (length - x));
  return [[c, -s, -c, s][k], [s, c, -s, -c][k], k % 2 ? -left : left, right];
}

function conditionRows(b, length, supports) {
  const rows = [];
  supports.forEach((support, end) => {
    for (const k of CONDITIONS[support]) rows.push(waves(b, length, end * length, k));
  });
  return rows;
}

/* Elimination with complete pivoting: the determinant, and the vector that the rows send to nearly zero. */
function eliminate(rows) {
  const m = rows.map((row) => row.slice()), order = [0, 1, 2, 3];
  let det = 1;
  for (let k = 0; k < 3; k++) {
    let p = k, q = k;
    for (let i = k; i < 4; i++)
      for (let j = k; j < 4; j++) if (Math.abs(m[i][j]) > Math.abs(m[p][q])) [p, q] = [i, j];
    if (p !== k) [m[p], m[k], det] = [m[k], m[p], -det];
    if (q !== k) {
      for (const row of m) [row[q], row[k]] = [row[k], row[q]];
      [order[q], order[k], det] = [order[k], order[q], -det];
    }
    det *= m[k][k];
    for (let i = k + 1; i < 4; i++) {
      const factor = m[i][k] / m[k][k];
      for (let j = k; j < 4; j++) m[i][j] -= factor * m[k][j];
    }
  }
  const solved = [0, 0, 0, 1];
  for (let i = 2; i >= 0; i--) {
    let sum = 0;
    for (let j = i + 1; j < 4; j++) sum += m[i][j] * solved[j];
    solved[i] = -sum / m[i][i];
  }
  const vector = [0, 0, 0, 0];
  order.forEach((place, k) => (vector[place] = solved[k]));
  return {det: det * m[3][3], vector};
}

/* Mass-normalised shape: `shape` divided by the root of the integral of (mass per length) shape^2, by Simpson's rule. */
function normalise(shape, length, perLength, waveNumber) {
  const n = 2 * Math.ceil(20 + 8 * waveNumber * length);
  let sum = 0;
  for (let i = 0; i <= n; i++) sum += (i === 0 || i === n ? 1 : i % 2 ? 4 : 2) * shape((i * length) / n) ** 2;
  const scale = 1 / Math.sqrt((perLength * sum * length) / (3 * n));
  return (x) => scale * shape(x);
}

/* So many modes of each kind are drawn. */
const MODES = 40;

/* Bending of a uniform beam with that radius of gyration: Bernoulli's shapes; Timoshenko's frequencies to the first
 * order in (gyration b)^2 where the solver's beam is his (Graff, Wave Motion in Elastic Solids, section 3.4). */
function bendingModes(beam, gyration, shear) {
  const {length, perLength, supports} = beam, modes = [];
  const make = (b, shape) => {
    const slender = (gyration * b) ** 2;
    modes.push({
      omega: (beam.speed * gyration * b * b) / Math.sqrt(1 + slender * shear),
      shape: normalise(shape, length, perLength, b),
    });
  };
  /* a pinned and a free end: it turns about the pin */
  if (supports.includes("pinned") && supports.includes("free"))
    make(0, (x) => (supports[0] === "pinned" ? x : length - x));
  const step = 0.05;
  const value = (y) => eliminate(conditionRows(y / length, length, supports)).det;
  let low = 0.5, at = value(low);
  while (modes.length < MODES) {
    let high = low + step;
    const next = value(high);
    if (at * next < 0) {
      let a = low, fa = at;
      for (let i = 0; i < 60; i++) {
        const middle = (a + high) / 2, f = value(middle);
        if (f * fa > 0) [a, fa] = [middle, f];
        else high = middle;
      }
      const b = (a + high) / 2 / length;
      const {vector} = eliminate(conditionRows(b, length, supports));
      make(b, (x) => waves(b, length, x, 0).reduce((sum, wave, i) => sum + wave * vector[i], 0));
    }
    [low, at] = [low + step, next];
  }
  return modes;
}

/* Waves along a uniform bar. A support of any kind holds its end. */
function longitudinalModes(bar) {
  const held = bar.supports.map((support) => support !== "free"), modes = [];
  for (let k = 0; k < MODES; k++) {
    const b = ((held[0] !== held[1] ? k + 0.5 : k + 1) * Math.PI) / bar.length;
    const shape = held[0] ? (x) => Math.sin(b * x) : (x) => Math.cos(b * x);
    modes.push({omega: b * bar.speed, shape: normalise(shape, bar.length, bar.perLength, b)});
  }
  return modes;
}

/* The coordinate of one mode over the instants, from rest: q'' + 2 damping omega q' + omega^2 q = force, exactly for a
 * force that is a straight line from instant to instant. */
function drive(mode, damping, time, force) {
  const q = new Float64Array(time.length), w = mode.omega, d = w * Math.sqrt(1 - damping * damping);
  let x = 0, v = 0;
  for (let i = 1; i < time.length; i++) {
    const h = time[i] - time[i - 1], f = force[i - 1], slope = h > 0 ? (force[i] - f) / h : 0;
    if (w === 0) {
      x += h * (v + h * (f / 2 + (h * slope) / 6));
      v += h * (f + (h * slope) / 2);
    } else {
      const rate = slope / (w * w), base = (f - (2 * damping * slope) / w) / (w * w);
      const c = x - base, s = (v - rate + damping * w * c) / d;
      const e = Math.exp(-damping * w * h), cos = Math.cos(d * h), sin = Math.sin(d * h);
      x = base + rate * h + e * (c * cos + s * sin);
      v = rate + e * ((s * d - damping * w * c) * cos - (c * d + damping * w * s) * sin);
    }
    q[i] = x;
  }
  return q;
}

/* What a beam or rod vibrates in: [{axis: the body's, modes}]; empty: the page has no modes of such a body. */
function familiesOf(data, index, forces) {
  const body = data.bodies[index], [hx, hy, hz] = body.half_extents;
  const theory = (data.reply.model.bodies.find((one) => one.id === body.id) || {rigid: true});
  const line = {
    length: 2 * hx,
    perLength: body.mass / (2 * hx),
    speed: Math.sqrt(body.young / body.density),
    supports: body.supports,
  };
  if (theory.rigid || !["beam", "rod"].includes(body.shape)) return [];
  const axes = axesOf(data.request.bodies[index].orientation);
  const acts = (axis) =>
    forces.some((one) => data.trace[one.contact].time.some((t, i) => Math.abs(dot(one.force(i), axes[axis])) > 1e-9));
  const families = [];
  const along = {axis: 0, modes: longitudinalModes(line)};
  const shear = /timoshenko/i.test(theory.theory) && theory.shear_factor
    ? 1 + (2 * (1 + body.poisson)) / theory.shear_factor : 0;
  if (acts(0)) families.push(along);
  if (body.shape === "rod") return families;
  for (const axis of [1, 2]) {
    if (!acts(axis)) continue;
    const gyration = body.radius > 0 ? body.radius / 2 : (axis === 1 ? hy : hz) / Math.sqrt(3);
    families.push({axis, modes: bendingModes(line, gyration, shear)});
  }
  return families;
}

/* Vibration of a beam or rod along its axis: displacement(i, x) in the world at instant i, x from the end at -x. */
function vibrationOf(data, index, time) {
  const forces = forcesOn(data, index), body = data.bodies[index], motion = data.request.bodies[index];
  const axes = axesOf(motion.orientation), half = body.half_extents[0];
  const families = familiesOf(data, index, forces);
  for (const family of families)
    for (const mode of family.modes) {
      const weights = forces.map((one) => mode.shape(dot(add(one.point, motion.position, -1), axes[0]) + half));
      const force = time.map((t, i) =>
        forces.reduce((sum, one, k) => sum + weights[k] * dot(one.force(i), axes[family.axis]), 0));
      mode.q = drive(mode, body.damping || 0, time, force);
    }
  const known = new Map();
  const shapes = (x) => {
    if (!known.has(x)) known.set(x, families.map((family) => family.modes.map((mode) => mode.shape(x))));
    return known.get(x);
  };
  const displacement = (i, x) => {
    let u = [0, 0, 0];
    shapes(x).forEach((values, f) => {
      let sum = 0;
      families[f].modes.forEach((mode, k) => (sum += mode.q[i] * values[k]));
      u = add(u, axes[families[f].axis], sum);
    });
    return u;
  };
  return {families, displacement};
}

/* How the i-th body moves, and how far what is drawn is off the solver's displacement of its contact points.
 *   shape      "line": beam or rod with its vibration; "rigid": it moves as a rigid body; "still": it is not moved
 *   at(i, p)   displacement of its material point p (world, m) at instant i
 *   miss       largest difference at a contact point, as a share of the largest displacement there; NaN: not known
 *   note       a sentence for people */
function motionOf(data, index, time) {
  const body = data.bodies[index], motion = data.request.bodies[index];
  const still = {shape: "still", at: () => [0, 0, 0], miss: NaN};
  if (!body) return {...still, note: "The page does not know its shape."};
  if (body.shape === "half-space") return {...still, miss: 0, note: "It is immovable; its surface is a line."};
  const axes = axesOf(motion.orientation), half = body.half_extents[0];
  const rigid = rigidMotion(data, index, time), vibration = vibrationOf(data, index, time);
  const arm = (p) => add(p, motion.position, -1);
  const rigidAt = (i, p) => add(rigid.shift[i], cross(rigid.turn[i], arm(p)));
  const lineAt = (i, p) => {
    const x = Math.min(2 * half, Math.max(0, dot(arm(p), axes[0]) + half));
    return add(rigidAt(i, p), vibration.displacement(i, x));
  };
  const missOf = (at) => {
    let worst = 0, largest = 0;
    for (const one of forcesOn(data, index)) {
      const trace = data.trace[one.contact], n = data.request.contacts[one.contact].normal;
      const told = one.sign > 0 ? trace.displacement_a : trace.displacement_b;
      told.forEach((d, i) => {
        worst = d === null ? NaN : Math.max(worst, Math.abs(dot(at(i, one.point), n) - d));
        largest = Math.max(largest, Math.abs(d));
      });
    }
    return largest > 0 ? worst / largest : worst > 0 ? Infinity : NaN;
  };
  const percent = (miss) => `${(100 * miss).toPrecision(2)} %`;
  if (vibration.families.length > 0) {
    const miss = missOf(lineAt);
    if (miss <= MOST_MISS)
      return {shape: "line", at: lineAt, miss, note: `Its vibration is made of ${MODES} modes of a ` +
        `${body.shape === "rod" ? "bar (one-dimensional waves)" : "uniform beam"} and the contact force above; at the ` +
        `contact it differs from the solver's by at most ${percent(miss)}.`};
  }
  const miss = missOf(rigidAt), vibrates = !(data.reply.model.bodies.find((one) => one.id === body.id) || {}).rigid;
  const told = forcesOn(data, index).every((one) => data.trace[one.contact].displacement_a[0] !== null);
  const where = !vibrates ? "" : told ? "Its vibration is known at the contact alone, where the dot is. "
    : "Its vibration is not known to this page. ";
  /* by how much the velocities at the end differ from the reply's tells whether the masses are those of the solver */
  const after = data.reply.velocity_after[index];
  const scale = Math.max(Math.hypot(...rigid.velocity), ...data.request.bodies.map((one) => Math.hypot(...one.velocity)));
  const off = after ? Math.hypot(...add(rigid.velocity, after.velocity, -1)) / scale : Infinity;
  if (!(off <= MOST_MISS))
    return {...still, note: `${where}Its motion as a whole is not known to this page, and it is drawn at rest.`};
  return {shape: "rigid", at: rigidAt, miss, note: `${where}The body is drawn rigid.`};
}
