/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Put at the end of a page of an impact: uses it as a person would, and writes into #probe what it finds, a line each. */
"use strict";

(async () => {
  const found = document.body.appendChild(document.createElement("pre"));
  found.id = "probe";
  const tell = (name, value) => (found.textContent += `${name} ${value}\n`);
  const page = window.percuss, {data, scene} = page, $$ = (id) => document.getElementById(id);
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  const frames = async (count) => {
    const first = await frame();
    let now = first;
    while (count-- > 0) now = await frame();
    return now - first;
  };
  const canvas = (id) => $$(id).toDataURL();
  try {
    tell("restitution", $$("restitution-0").textContent);
    tell("warnings", $$("warnings").textContent);
    /* the animation runs by itself, and stops */
    await frames(10);
    const ran = page.t;
    tell("runs", page.playing && ran > page.first);
    $$("play").click();
    await frames(5);
    tell("stops", !page.playing && page.t === ran);
    /* ten times slower: a tenth of the motion in a time */
    const rate = async () => {
      page.show(page.first);
      $$("play").click();
      await frames(2);
      const from = page.t, ms = await frames(15);
      const moved = page.t - from;
      $$("play").click();
      return moved / ms;
    };
    const fast = await rate();
    $$("slow").value = 1;
    $$("slow").oninput();
    const ratio = fast / (await rate());
    tell("slower", (ratio > 7 && ratio < 14) || ratio);
    /* dragged: to the middle of the time axis, and on */
    const axis = $$("axis"), box = axis.getBoundingClientRect();
    axis.setPointerCapture = () => {};
    const drag = (kind, share) => axis.dispatchEvent(new PointerEvent(kind, {clientX: box.left + share * box.width}));
    drag("pointerdown", 0.5);
    const middle = (page.t - page.first) / (page.last - page.first);
    drag("pointermove", 0.75);
    const right = (page.t - page.first) / (page.last - page.first);
    drag("pointerup", 0.75);
    drag("pointermove", 0.1);
    tell("dragged", Math.abs(middle - 0.5) < 1e-6 && Math.abs(right - 0.75) < 1e-6);
    /* stepped: one instant, another picture of the bodies and the time; back to the same */
    const main = data.trace[scene.main], peak = main.force.indexOf(Math.max(...main.force));
    page.show(main.time[peak]);
    const pictures = [canvas("bodies"), canvas("axis")], now = $$("now").textContent;
    $$("on").click();
    const stepped = page.t === main.time[peak + 1] && $$("now").textContent !== now;
    page.show(main.time[Math.floor(main.time.length / 2)]);
    tell("moves", stepped && canvas("bodies") !== pictures[0] && canvas("axis") !== pictures[1]);
    page.show(main.time[peak]);
    tell("returns", canvas("bodies") === pictures[0]);
    tell("now", $$("now").textContent);
    /* what is drawn is the solver's: at the contact; its velocities; the energy that is left in vibration */
    scene.motions.forEach((motion, i) => tell(`drawn ${data.request.bodies[i].id}`, `${motion.shape} ${motion.miss}`));
    const worst = Math.max(...data.reply.velocity_after.map((after, i) => {
      const drawn = rigidMotion(data, i, scene.time).velocity;
      return data.bodies[i].mass === null ? 0 : Math.hypot(...add(drawn, after.velocity, -1));
    }));
    tell("velocities", worst / Math.hypot(...data.request.bodies[0].velocity));
    const {energy} = data.reply, rest = energies(data, scene.main)[0].find((part) => part.name === "vibration");
    const vibration = energy.damping + energy.vibration.reduce((sum, one) => sum + one.energy, 0);
    tell("vibration", rest ? Math.abs(rest.values.slice(-1)[0] - vibration) / energy.available : "unknown");
    /* values under the pointer, in all plots */
    page.plots.gap.setSelection(peak);
    page.point(peak, "gap");
    tell("pointer", $$("force-legend").textContent);
    page.plots.force.updateOptions({dateWindow: [0, 1e3 * main.time[peak]]});
    tell("zooms", Math.abs(page.plots.energy.xAxisRange()[1] - 1e3 * main.time[peak]) < 1e-9);
    tell("request", data.request.bodies.length === JSON.parse($$("request").textContent).bodies.length);
    tell("command", $$("command").textContent);
    tell("told", $$("drawn").textContent);
  } catch (error) {
    tell("error", error.stack);
  }
  tell("end", "of the probe");
})();
