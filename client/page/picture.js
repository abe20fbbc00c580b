/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The bodies on a canvas: in the plane of the contact's normal and the longest body, displacements times a factor. */
"use strict";

const COLOURS = {a: "#1f5fa8", b: "#c8501e", other: "#707070"};
const STATIONS = 80;
const ASPECT = 3; /* of the canvas, about */

/* The plane: the normal upwards, a long body to the right; a body that is hit on its end lies, its normal to the
 * right. */
function viewOf(data, contact) {
  const c = data.request.contacts[contact], n = c.normal;
  let longest = null, most = 0;
  for (const index of [c.b, c.a]) {
    const body = data.bodies[index];
    if (!body || body.shape === "sphere" || body.shape === "half-space") continue;
    const k = body.half_extents.indexOf(Math.max(...body.half_extents));
    if (body.half_extents[k] > most) {
      most = body.half_extents[k];
      longest = axesOf(data.request.bodies[index].orientation)[k];
    }
  }
  const tangent = tangentOf(c, data.reply.contacts[contact]);
  if (!longest) return {right: tangent, up: n};
  const along = dot(longest, n);
  if (Math.abs(along) > 0.7) return {right: n, up: tangent};
  return {right: unit(add(longest, n, -along)), up: n};
}

/* The convex hull of points in the plane, in order. */
function hull(points) {
  const sorted = points.slice().sort((p, q) => p[0] - q[0] || p[1] - q[1]);
  const half = (list) => {
    const kept = [];
    for (const p of list) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(p);
    }
    return kept.slice(0, -1);
  };
  return half(sorted).concat(half(sorted.reverse()));
}

/* The outline of a body in the plane at instant i: {points} or {centre, radius} or {line}; m. */
function outlineOf(scene, index, i, factor) {
  const {data, view} = scene, body = data.bodies[index], motion = data.request.bodies[index];
  const moved = scene.motions[index];
  const flat = (p) => {
    const q = add(p, moved.at(i, p), factor);
    return [dot(q, view.right), dot(q, view.up)];
  };
  if (!body) return null;
  const axes = axesOf(motion.orientation), centre = motion.position, half = body.half_extents;
  if (body.shape === "sphere") return {centre: flat(centre), radius: body.radius};
  if (body.shape === "half-space") {
    const normal = axes[2], away = unit([dot(normal, view.right), dot(normal, view.up)]);
    return {line: flat(centre), away};
  }
  const seenAlong = Math.hypot(dot(axes[0], view.right), dot(axes[0], view.up));
  if (moved.shape === "line" && seenAlong > 0.2) {
    /* the line and half the thickness to either side, across it on the screen */
    const ends = [-dot(axes[0], view.up), dot(axes[0], view.right)].map((v) => v / seenAlong);
    const across = add(times(ends[0], view.right), view.up, ends[1]);
    const thick = body.radius > 0 ? body.radius
      : Math.abs(dot(axes[1], across)) * half[1] + Math.abs(dot(axes[2], across)) * half[2];
    const upper = [], lower = [];
    for (let k = 0; k <= STATIONS; k++) {
      const p = flat(add(centre, axes[0], half[0] * ((2 * k) / STATIONS - 1)));
      upper.push([p[0] + thick * ends[0], p[1] + thick * ends[1]]);
      lower.push([p[0] - thick * ends[0], p[1] - thick * ends[1]]);
    }
    return {points: upper.concat(lower.reverse()), sections: STATIONS + 1};
  }
  /* a bar that is seen on its end moves as where it is hit */
  if (moved.shape === "line") {
    const c = data.request.contacts.find((one) => one.a === index || one.b === index);
    const station = add(centre, axes[0], dot(add(c.point, centre, -1), axes[0]));
    if (body.radius > 0) return {centre: flat(station), radius: body.radius};
    const u = moved.at(i, station), corners = [];
    for (const y of [-1, 1])
      for (const z of [-1, 1]) {
        const q = add(add(add(station, axes[1], y * half[1]), axes[2], z * half[2]), u, factor);
        corners.push([dot(q, view.right), dot(q, view.up)]);
      }
    return {points: hull(corners)};
  }
  const corners = [];
  for (const x of [-1, 1])
    for (const y of [-1, 1])
      for (const z of [-1, 1]) corners.push(flat(add(centre, toWorld(axes, [x * half[0], y * half[1], z * half[2]]))));
  return {points: hull(corners), boxed: body.shape === "mesh"};
}

/* Where a contact's points are at instant i, by the solver's displacements: [a, b], m in the plane. */
function contactPoints(scene, contact, i, factor) {
  const {data, view} = scene, c = data.request.contacts[contact], trace = data.trace[contact];
  return [trace.displacement_a, trace.displacement_b].map((told, side) => {
    if (told[i] === null) return null;
    /* along the surface it goes with what is drawn of its body */
    const u = scene.motions[side === 0 ? c.a : c.b].at(i, c.point);
    const along = add(u, c.normal, told[i] - dot(u, c.normal));
    const p = add(c.point, along, factor);
    return [dot(p, view.right), dot(p, view.up)];
  });
}

/* A number of one digit. */
function roundDown(x) {
  const ten = 10 ** Math.floor(Math.log10(x));
  return Math.max(1, Math.floor(x / ten)) * ten;
}

/* The scene of the page: the motions, the plane, and two windows on it, "whole" and "near": {middle, width, factor},
 * in which nothing that is drawn moves further than a part of the window. */
function makeScene(data) {
  const results = data.reply.contacts;
  const main = results.reduce((best, one, c) => (one.impulse > results[best].impulse ? c : best), 0);
  const time = data.trace[main].time;
  const scene = {data, main, time, view: viewOf(data, main), motions: [], depth: depthOf(data, main)};
  data.request.bodies.forEach((body, index) => scene.motions.push(motionOf(data, index, time)));
  const contact = data.request.contacts[main];
  let box = [Infinity, -Infinity, Infinity, -Infinity], smallest = Infinity, furthest = 0;
  for (const index of data.request.bodies.keys()) {
    const outline = outlineOf(scene, index, 0, 0), body = data.bodies[index];
    if (!outline || outline.line) continue;
    if (index === contact.a || index === contact.b)
      smallest = Math.min(smallest, body.radius || Math.min(...body.half_extents));
    const around = outline.points ||
      [-1, 1].map((s) => [outline.centre[0] + s * outline.radius, outline.centre[1] + s * outline.radius]);
    for (const [x, y] of around)
      box = [Math.min(box[0], x), Math.max(box[1], x), Math.min(box[2], y), Math.max(box[3], y)];
  }
  data.trace[main].displacement_a.forEach((d, i) => {
    furthest = Math.max(furthest, Math.abs(d), Math.abs(data.trace[main].displacement_b[i]));
  });
  const {right, up} = scene.view, at = [dot(contact.point, right), dot(contact.point, up)];
  const wide = Math.max(1.12 * (box[1] - box[0]), ASPECT * 1.5 * (box[3] - box[2]));
  const deepest = Math.max(...scene.depth);
  /* nothing moves further than that, and no dent is drawn deeper than that */
  const factorOf = (width) => roundDown(Math.min((0.12 * width) / furthest, (0.4 * smallest) / deepest));
  const window = (middle, width) => ({middle, width, factor: furthest > 0 && deepest > 0 ? factorOf(width) : 1});
  scene.windows = {
    whole: window([(box[0] + box[1]) / 2, (box[2] + box[3]) / 2], wide),
    near: window(at, Math.min(wide, 12 * smallest)),
  };
  scene.peak = Math.max(...data.trace[main].force);
  return scene;
}

/* Of what follows, up to restore(), leaves out all that lies beyond the line through p with that normal (both m, in
 * the plane). */
function clipBehind(context, place, p, normal) {
  const far = 1e4, [x, y] = place(p), along = [normal[1], normal[0]], out = [normal[0], -normal[1]];
  context.beginPath();
  for (const [s, t] of [[-far, 0], [far, 0], [far, far], [-far, far]])
    context.lineTo(x + s * along[0] + t * out[0], y + s * along[1] + t * out[1]);
  context.closePath();
  context.clip();
}

function fillOutline(context, place, outline, colour) {
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  context.setLineDash(outline.boxed ? [5, 4] : []);
  context.beginPath();
  if (outline.centre) {
    const [x, y] = place(outline.centre);
    context.arc(x, y, outline.radius * place.scale, 0, 2 * Math.PI);
  } else outline.points.forEach((p, k) => context[k ? "lineTo" : "moveTo"](...place(p)));
  context.closePath();
  for (const fill of ["#ffffff", colour + "30"]) {
    context.fillStyle = fill;
    context.fill();
  }
  context.stroke();
  context.setLineDash([]);
  /* sections, which show how a bar is compressed */
  context.lineWidth = 0.5;
  for (let k = 0; k < (outline.sections || 0); k += 4) {
    context.beginPath();
    context.moveTo(...place(outline.points[k]));
    context.lineTo(...place(outline.points[outline.points.length - 1 - k]));
    context.stroke();
  }
}

/* The surface of a half-space: a line, and strokes behind it. */
function strokeSurface(context, place, outline, width) {
  const [x, y] = place(outline.line), along = [-outline.away[1], outline.away[0]];
  context.strokeStyle = COLOURS.b;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x - width * along[0], y + width * along[1]);
  context.lineTo(x + width * along[0], y - width * along[1]);
  for (let k = -width; k < width; k += 14) {
    const p = [x + k * along[0], y - k * along[1]];
    context.moveTo(...p);
    context.lineTo(p[0] - 10 * (outline.away[0] + along[0]), p[1] + 10 * (outline.away[1] + along[1]));
  }
  context.stroke();
}

/* Draws instant i. `view`: a window of the scene, whose factor may be another one. */
function drawScene(scene, canvas, view, i) {
  const context = canvas.getContext("2d"), ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth || 900, height = canvas.clientHeight || 300;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  context.scale(ratio, ratio);
  context.clearRect(0, 0, width, height);
  const scale = width / view.width;
  const place = (p) => [width / 2 + scale * (p[0] - view.middle[0]), height / 2 - scale * (p[1] - view.middle[1])];
  place.scale = scale;
  const contact = scene.data.request.contacts[scene.main];
  const colourOf = (index) => (index === contact.a ? COLOURS.a : index === contact.b ? COLOURS.b : COLOURS.other);
  /* body a of the contact comes last, flattened where it presses the other one */
  const {right, up} = scene.view, last = scene.data.bodies[contact.a] ? contact.a : -1;
  const order = [...scene.data.request.bodies.keys()].sort((p, q) => (p === last) - (q === last));
  const pressed = contactPoints(scene, scene.main, i, view.factor);
  const normal = [dot(contact.normal, right), dot(contact.normal, up)];
  for (const index of order) {
    const outline = outlineOf(scene, index, i, view.factor);
    if (outline && outline.line) strokeSurface(context, place, outline, width);
    else if (outline) {
      context.save();
      if (index === last && pressed[0] && pressed[1] && scene.depth[i] > 0)
        clipBehind(context, place, pressed[0].map((x, k) => (x + pressed[1][k]) / 2), normal);
      fillOutline(context, place, outline, colourOf(index));
      context.restore();
    }
  }
  /* the contact points, and the force on either body as an arrow */
  scene.data.request.contacts.forEach((one, c) => {
    const force = scene.data.trace[c].force[i] / scene.peak, n = [dot(one.normal, right), dot(one.normal, up)];
    contactPoints(scene, c, i, view.factor).forEach((p, side) => {
      if (!p) return;
      const [x, y] = place(p), s = side === 0 ? 1 : -1, long = 70 * force * s;
      context.fillStyle = context.strokeStyle = side === 0 ? COLOURS.a : COLOURS.b;
      context.beginPath();
      context.arc(x, y, 3, 0, 2 * Math.PI);
      context.fill();
      if (!(force > 0)) return;
      context.lineWidth = 2.5;
      const tip = [x + long * n[0], y - long * n[1]];
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(...tip);
      for (const turn of [-1, 1]) {
        context.moveTo(...tip);
        context.lineTo(tip[0] - s * 7 * (n[0] - 0.6 * turn * n[1]), tip[1] + s * 7 * (n[1] + 0.6 * turn * n[0]));
      }
      context.stroke();
    });
  });
}
