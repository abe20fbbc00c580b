/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The page of one impact: its numbers, the animation with its time axis, the plots by dygraphs. */
"use strict";

/* The last instant that is not after t. */
function instantAt(time, t) {
  let low = 0, high = time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/* The numbers. */

const named = (data, contact) => {
  const c = data.request.contacts[contact];
  return [data.request.bodies[c.a].id, data.request.bodies[c.b].id];
};

/* With all that is known to be wrong with it, and the parts of that. A server of 0.1.0 knows no error of the models. */
function restitutionText(reply, contact) {
  const e = reply.error, numerical = Math.abs(e.restitution_time) + Math.abs(e.restitution_modes);
  const whole = e.restitution_total >= numerical || e.restitution_model > 0;
  const text = `${number(contact.restitution)} ± ${number(whole ? e.restitution_total : numerical, 2)}`;
  const parts = [`the models ${whole ? number(e.restitution_model, 2) : "not known"}`,
    `modes and steps ${number(numerical, 1)}`];
  if (whole && e.restitution_yield > 0.1 * e.restitution_total)
    parts.push(`± ${number(e.restitution_total - e.restitution_yield, 2)} if metals whose yield is not stated stay elastic`);
  return [text, parts.join("; ")];
}

function contactRows(data, c) {
  const {reply} = data, contact = reply.contacts[c];
  const rows = [["restitution", ...restitutionText(reply, contact)],
    ["impulse", `${number(contact.impulse)} N s${bar(contact.impulse_error)}`,
     `${number(contact.impulse_compression)} N s stops the approach`]];
  if (contact.friction > 0) {
    rows.push(["friction", `${number(contact.friction)}, ${contact.friction_state}`, ""]);
    rows.push(["tangential impulse", `(${contact.impulse_tangential.map((x) => number(x)).join(", ")}) N s` +
      bar(contact.impulse_tangential_error), ""]);
  }
  rows.push(["duration", `${number(1e3 * contact.end_time, 4)} ms`, reply.end_reason]);
  rows.push(["sub-impacts", String(contact.sub_impact_count), ""]);
  return rows;
}

function showSubImpacts(parent, contact) {
  putTable(parent, ["#", "start / ms", "length / µs", "impulse / N s", "share / %", "peak / N", "indentation / µm"],
    contact.sub_impacts.map((sub, i) => [String(i + 1) + (sub.negligible ? " (negligible)" : ""),
      (1e3 * sub.start).toFixed(4), (1e6 * (sub.end - sub.start)).toFixed(2), number(sub.impulse),
      ((100 * sub.impulse) / contact.impulse).toFixed(2), number(sub.peak_force, 4), number(1e6 * sub.max_indentation, 4)]));
  if (contact.sub_impacts.length < contact.sub_impact_count)
    put(parent, "p", `${contact.sub_impact_count - contact.sub_impacts.length} more are not listed.`);
}

function showNumbers(data) {
  const {reply} = data, parent = $("numbers");
  reply.contacts.forEach((contact, c) => {
    put(parent, "h2", named(data, c).join(" on "));
    putRows(parent, contactRows(data, c), `-${c}`);
    showSubImpacts(parent, contact);
  });
  const list = put(parent, "table");
  for (const after of reply.velocity_after) {
    const row = put(list, "tr"), vector = (v) => `(${v.map((x) => number(x, 5)).join(", ")})`;
    put(row, "th", `${after.id} after it`);
    put(row, "td", `${vector(after.velocity)} m/s${bar(after.velocity_error)}`);
    put(row, "td", `turning at ${vector(after.angular_velocity)} rad/s${bar(after.angular_velocity_error)}`);
  }
  const {energy} = reply, percent = (x) => `${((100 * x) / energy.available).toFixed(2)} %`;
  const parts = [["rigid motion", energy.rigid_after], ...energy.vibration.map((v) => [`vibration of ${v.id}`, v.energy]),
    ["damping", energy.damping], ["plastic", energy.plastic], ["friction", energy.friction], ["stored", energy.stored]];
  put(parent, "p", `Energy: ${number(energy.available, 5)} J available; ` +
    parts.filter(([, x]) => x !== 0).map(([name, x]) => `${name} ${percent(x)}`).join(", ") +
    ` (closure ${number(energy.closure / energy.available, 1)}).`);
  const bodies = reply.model.bodies.map((b) => (b.rigid ? `${b.id} rigid` : `${b.id} ${b.theory}, ${b.modes} modes`));
  put(parent, "p", `Model: ${reply.model.contact_model} contact, ${reply.model.compliance} compliance, ` +
    `${reply.model.method} method; ${bodies.join("; ")}. ${reply.model.reason}`);
  showWarnings(reply.status, reply.message, reply.warnings);
}

/* The plots. */

/* Integral from the first instant on, by straight lines from instant to instant. */
function integral(x, y) {
  const sums = [0];
  for (let i = 1; i < x.length; i++) sums.push(sums[i - 1] + ((x[i] - x[i - 1]) * (y[i] + y[i - 1])) / 2);
  return sums;
}

/* Energies over time, J: [{name, values}], and a sentence. The work of the contact force is known in any case; of the
 * rest only where one contact without friction has all of it. */
function energies(data, main) {
  const {reply, request} = data, list = [];
  const many = request.contacts.length > 1;
  data.trace.forEach((trace, c) => {
    const of = many ? ` of ${named(data, c).join(" on ")}` : "";
    list.push({name: `into the contact${of}`, values: integral(depthOf(data, c), trace.force)});
    if (!trace.slip_1) return;
    const power = trace.time.map((t, i) =>
      -trace.force_tangential_1[i] * trace.slip_1[i] - trace.force_tangential_2[i] * trace.slip_2[i]);
    list.push({name: `friction${of}`, values: integral(trace.time, power)});
  });
  const trace = data.trace[main], contact = reply.contacts[main];
  const simple = !many && !trace.slip_1 && request.contacts[main].gap_acceleration === 0 &&
    request.bodies.every((body) => !body.state);
  if (!simple)
    return [list, "Over time only the work of the contact forces is known to this page: rigid motion and vibration " +
      "divide the rest in a way that the histories do not carry (several contacts, friction, gravity, or a body that " +
      "vibrated before)."];
  const rigid = trace.gap_rate.map((rate) => (rate * rate) / (2 * contact.inverse_effective_mass));
  const rest = rigid.map((e, i) => reply.energy.available - e - list[0].values[i]);
  list.unshift({name: "rigid motion", values: rigid});
  list.push({name: "vibration", values: rest});
  return [list, "Rigid motion is that of the approach, rate of the gap² / (2 × inverse effective mass); the contact's is " +
    "∫ force d(indentation); vibration (with damping) is what the available energy leaves."];
}

/* One plot of several curves over the time in ms. */
function makePlot(page, id, label, unit, curves) {
  const {time} = page.scene;
  const rows = time.map((t, i) => [1e3 * t, ...curves.map((curve) => curve.values[i])]);
  const results = page.data.reply.contacts;
  return new Dygraph($(id), rows, {
    labels: ["ms", ...curves.map((curve) => curve.name)],
    ylabel: `${label} / ${unit}`,
    xlabel: "time / ms",
    colors: curves.length > 1 ? [COLOURS.b, COLOURS.a, "#3c8c46", "#8a4ba0"] : ["#202020"],
    legend: "always",
    labelsDiv: $(`${id}-legend`),
    strokeWidth: 1.5,
    highlightCircleSize: 3,
    animatedZooms: false,
    axes: {
      x: {valueFormatter: (x) => `${x.toFixed(4)} ms`},
      y: {valueFormatter: (y) => `${number(y, 5)} ${unit}`, axisLabelWidth: 70},
    },
    highlightCallback: (event, x, points, row) => page.point(row, id),
    unhighlightCallback: () => page.point(-1, id),
    drawCallback: (plot, initial) => !initial && page.zoom(plot),
    underlayCallback: (context, area, plot) => {
      context.fillStyle = "rgba(200, 180, 60, 0.25)";
      for (const contact of results)
        for (const sub of contact.sub_impacts) {
          const left = plot.toDomXCoord(1e3 * sub.start), right = plot.toDomXCoord(1e3 * sub.end);
          context.fillRect(left, area.y, Math.max(1, right - left), area.h);
        }
    },
  });
}

function makePlots(page) {
  const {data, scene} = page, many = data.trace.length > 1;
  const of = (c, name) => (many ? `${name}, ${named(data, c).join(" on ")}` : name);
  const forces = [], gaps = [];
  data.trace.forEach((trace, c) => {
    forces.push({name: of(c, "force"), values: trace.force});
    if (trace.force_tangential_1)
      forces.push({name: of(c, "tangential 1"), values: trace.force_tangential_1},
        {name: of(c, "tangential 2"), values: trace.force_tangential_2});
    gaps.push({name: of(c, "gap of the rigid bodies"), values: trace.gap.map((g) => 1e6 * g)});
    if (trace.displacement_a[0] !== null)
      gaps.push({name: of(c, "with their vibration"), values: trace.displacement_a.map((a, i) =>
        1e6 * (data.request.contacts[c].gap + a - trace.displacement_b[i]))});
  });
  const [parts, sentence] = energies(data, scene.main);
  $("energy-note").textContent = sentence;
  page.plots = {
    force: makePlot(page, "force", "contact force", "N", forces),
    gap: makePlot(page, "gap", "gap", "µm", gaps),
    energy: makePlot(page, "energy", "energy", "mJ",
      parts.map((part) => ({name: part.name, values: part.values.map((e) => 1e3 * e)}))),
  };
}

/* The page's life. */

class Page {
  constructor(data) {
    this.data = data;
    this.scene = makeScene(data);
    const {time} = this.scene;
    this.first = time[0];
    this.last = time[time.length - 1];
    this.t = this.first;
    this.playing = false;
    this.seconds = 12;
    this.slower = 1;
    makePlots(this);
    this.listen();
    this.choose("whole");
    this.tell();
  }

  /* Which window on the bodies, and its factor. */
  choose(name) {
    this.window = {...this.scene.windows[name]};
    $("factor").value = 100;
    this.magnify();
  }

  magnify() {
    const own = this.scene.windows[$("window").value].factor;
    this.window.factor = own * 10 ** ((Number($("factor").value) - 100) / 100);
    $("factor-text").textContent = `${number(this.window.factor, 2)} ×`;
    this.show(this.t);
  }

  /* Goes to time t, s. */
  show(t) {
    this.t = Math.min(this.last, Math.max(this.first, t));
    const i = instantAt(this.scene.time, this.t), trace = this.data.trace[this.scene.main];
    drawScene(this.scene, $("bodies"), this.window, i);
    this.drawAxis();
    for (const id in this.plots) {
      const plot = this.plots[id], x = plot.toDomXCoord(1e3 * this.t), area = plot.getArea();
      const mark = $(`${id}-mark`);
      mark.style.display = x >= area.x && x <= area.x + area.w ? "block" : "none";
      mark.style.left = `${x}px`;
    }
    const names = named(this.data, this.scene.main);
    const moved = [trace.displacement_a[i], trace.displacement_b[i]].map((d, side) =>
      d === null ? "" : `; ${names[side]} moved ${number(1e6 * d, 4)} µm there`);
    $("now").textContent = `${(1e3 * trace.time[i]).toFixed(4)} ms: force ${number(trace.force[i], 4)} N, indentation ` +
      `${number(1e6 * this.scene.depth[i], 4)} µm${moved.join("")}`;
  }

  /* The time axis: the force as a hill, the sub-impacts as bars with their numbers, the present as a line. */
  drawAxis() {
    const canvas = $("axis"), context = canvas.getContext("2d"), ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth || 900, height = canvas.clientHeight || 48;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    context.scale(ratio, ratio);
    const at = (t) => (width * (t - this.first)) / (this.last - this.first);
    context.fillStyle = "#f0f0f0";
    context.fillRect(0, 0, width, height);
    const {contacts} = this.data.reply;
    contacts.forEach((contact) => contact.sub_impacts.forEach((sub, k) => {
      context.fillStyle = sub.negligible ? "#e8dca0" : "#d8bc40";
      context.fillRect(at(sub.start), 14, Math.max(2, at(sub.end) - at(sub.start)), height - 14);
      context.fillStyle = "#404040";
      context.font = "11px sans-serif";
      if (!sub.negligible) context.fillText(String(k + 1), at(sub.start), 11);
    }));
    context.strokeStyle = "#202020";
    context.beginPath();
    const trace = this.data.trace[this.scene.main];
    trace.time.forEach((t, i) =>
      context[i ? "lineTo" : "moveTo"](at(t), height - 1 - ((height - 16) * trace.force[i]) / this.scene.peak));
    context.stroke();
    context.fillStyle = "#c00000";
    context.fillRect(at(this.t) - 1, 0, 2, height);
  }

  play(playing) {
    if (playing && this.t >= this.last) this.t = this.first;
    this.playing = playing;
    cancelAnimationFrame(this.frame);
    $("play").textContent = playing ? "Stop" : "Play";
    let before = null;
    const frame = (now) => {
      const rate = (this.last - this.first) / (this.seconds * this.slower);
      if (before !== null) this.show(this.t + (rate * (now - before)) / 1e3);
      before = now;
      if (this.t >= this.last) this.play(false);
      else this.frame = requestAnimationFrame(frame);
    };
    if (playing) this.frame = requestAnimationFrame(frame);
  }

  /* The instants before and after. */
  step(by) {
    this.play(false);
    const {time} = this.scene, i = instantAt(time, this.t) + by;
    this.show(time[Math.min(time.length - 1, Math.max(0, i))]);
  }

  /* The pointer is at a row of a plot, -1: at none; the others say their values there. */
  point(row, from) {
    for (const id in this.plots) {
      if (id === from) continue;
      if (row >= 0) this.plots[id].setSelection(row);
      else this.plots[id].clearSelection();
    }
  }

  /* All plots show the same times. */
  zoom(from) {
    if (this.zooming || !this.plots) return;
    this.zooming = true;
    const [low, high] = from.xAxisRange();
    for (const id in this.plots) {
      const plot = this.plots[id], range = plot.xAxisRange();
      if (plot !== from && (range[0] !== low || range[1] !== high)) plot.updateOptions({dateWindow: [low, high]});
    }
    this.zooming = false;
    this.show(this.t);
  }

  listen() {
    $("play").onclick = () => this.play(!this.playing);
    $("back").onclick = () => this.step(-1);
    $("on").onclick = () => this.step(1);
    $("window").onchange = () => this.choose($("window").value);
    $("factor").oninput = () => this.magnify();
    const slow = () => {
      this.slower = 10 ** Number($("slow").value);
      const shown = (this.seconds * this.slower) / (this.last - this.first);
      $("slow-text").textContent = `1 s is ${number(1e6 / shown, 2)} µs`;
    };
    $("slow").oninput = slow;
    slow();
    const axis = $("axis");
    const drag = (event) => {
      this.play(false);
      const box = axis.getBoundingClientRect();
      this.show(this.first + ((event.clientX - box.left) / box.width) * (this.last - this.first));
    };
    axis.onpointerdown = (event) => {
      axis.onpointermove = drag;
      drag(event);
      axis.setPointerCapture(event.pointerId);
    };
    axis.onpointerup = axis.onpointercancel = () => (axis.onpointermove = null);
    document.onkeydown = (event) => {
      if (event.target.tagName === "INPUT" || event.target.tagName === "SELECT") return;
      if (event.key === "ArrowLeft") this.step(-1);
      else if (event.key === "ArrowRight") this.step(1);
      else return;
      event.preventDefault();
    };
    window.onresize = () => this.show(this.t);
  }

  /* What is drawn and how true it is. */
  tell() {
    const {data, scene} = this, lines = $("drawn");
    scene.motions.forEach((motion, index) => {
      const body = data.bodies[index], id = data.request.bodies[index].id;
      put(lines, "li", `${id}${body ? ` (${body.shape} of ${body.material}; ${body.description})` : ""}. ${motion.note}` +
        `${body && body.shape === "mesh" ? " The dashed box is as large as the body, about its centre of mass." : ""}`);
    });
    put(lines, "li", "The dots are the contact points without their local indentation, by the solver; the arrows are the " +
      "contact force. Displacements are drawn too large by the factor above, and the indentation with them: as a flat on " +
      "the one body in the other.");
  }
}

function showImpact(data) {
  showNumbers(data);
  window.percuss = new Page(data);
  /* "#1.25" opens the page at that many ms, stopped */
  const asked = parseFloat(location.hash.slice(1));
  if (Number.isFinite(asked)) window.percuss.show(asked / 1e3);
  else window.percuss.play(true);
}
