/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The pages of many impacts: a sweep, an ensemble, measured ones beside simulated ones. */
"use strict";

/* Rows of a table that a page has at most; all are behind --csv. */
const MOST_ROWS = 500;

const known = (x) => x !== null && x !== undefined;

function putLimitedTable(parent, heads, rows) {
  putTable(parent, heads, rows.slice(0, MOST_ROWS)).className = "several";
  if (rows.length > MOST_ROWS)
    put(parent, "p", `${rows.length - MOST_ROWS} rows more are not listed here; the charts have them.`);
}

/* A sweep. */

/* Bars end where no restitution is, unless the restitution itself is beyond. */
function restitutionPoint(x, e, error) {
  if (!known(e)) return {x, y: null};
  if (!(error > 0)) return {x, y: e};
  return {x, y: e, low: Math.max(e - error, Math.min(e, 0)), high: Math.min(e + error, Math.max(e, 1)), text: bar(error).trim()};
}

/* What a sweep's charts show: [id, axis, points of a curve at place i]. A row of a file that was gone on with has no
 * peak force. */
function sweepCharts(data) {
  const of = (name, factor, error) => (curve, i, x) => {
    const y = known(curve[name][i]) ? factor * curve[name][i] : null, width = error && known(y) ? factor * curve[error][i] : 0;
    return width > 0 ? {x, y, low: y - width, high: y + width, text: bar(width).trim()} : {x, y};
  };
  const list = [
    ["restitution", {label: "restitution"}, (curve, i, x) =>
      restitutionPoint(x, curve.restitution[i], known(curve.error_total[i]) ? curve.error_total[i] : curve.error[i])],
    ["sub-impacts", {label: "sub-impacts", zero: true}, (curve, i, x) => ({
      x, y: known(curve.restitution[i]) ? curve.sub_impacts[i] : null,
      text: curve.significant[i] < curve.sub_impacts[i] ? `(${curve.significant[i]} not negligible)` : ""})],
    ["duration", {label: "duration", unit: "ms", zero: true}, of("end_time", 1e3)],
    ["peak-force", {label: "peak force", unit: "N", zero: true}, of("peak_force", 1)],
    ["impulse", {label: "impulse", unit: "N s", zero: true}, of("impulse", 1, "impulse_error")],
  ];
  if (data.curves.some((curve) => curve.tangential_restitution.some(known)))
    list.push(["tangential-impulse", {label: "tangential impulse", unit: "mN s"}, of("impulse_tangential_1", 1e3)],
      ["tangential-restitution", {label: "tangential restitution"}, of("tangential_restitution", 1)]);
  return list;
}

/* By what the curves differ. */
function curveName(data, curve) {
  const several = (name) => data.curves.some((one) => one[name] !== data.curves[0][name]);
  const parts = [...(several("b") ? [curve.b] : []), ...(several("contact_model") ? [curve.contact_model] : [])];
  return parts.join(", ") || curve.b;
}

/* Measured impacts in the charts of what they tell. */
function measuredSeries(data, id) {
  const points = {
    "restitution": (one) => ({...restitutionPoint(one.speed, one.restitution, one.half_width)}),
    "sub-impacts": (one) => ({x: one.speed, y: one.sub_impacts}),
  }[id];
  return points ? data.measured.map((set) => ({name: `measured: ${set.name}`, kind: "dots",
    points: set.impacts.map(points).filter((point) => known(point.y))})) : [];
}

function showSweep(data) {
  const place = data.by_angle ? "angle" : "speed", unit = data.by_angle ? "degrees" : "m/s";
  const all = data.curves.flatMap((curve) => curve[place]), refused = {};
  for (const status of data.curves.flatMap((curve) => curve.status)) refused[status] = (refused[status] || 0) + 1;
  const counts = Object.entries(refused).map(([name, count]) => `${count} ${name}`).join(", ");
  putRows($("numbers"), [["points", `${all.length}`, counts],
    [place, `${number(Math.min(...extremes(all)))} to ${number(Math.max(...extremes(all)))} ${unit}`, ""]]);
  showWarnings("OK", "", data.warnings);
  const plots = {}, parent = $("charts");
  put(parent, "p", "Bars: the total error, of models, modes and steps, where it is known. Drag to zoom, double-click for all.");
  for (const [id, axis, point] of sweepCharts(data)) {
    const series = data.curves.map((curve) => ({name: curveName(data, curve), kind: axis.label === "sub-impacts" ? "dots" : "line",
      points: curve[place].map((x, i) => point(curve, i, x))}));
    if (!series.some((one) => one.points.some((each) => known(each.y)))) continue;
    plots[id] = putChart(parent, id, {label: place, unit, log: data.logarithmic}, axis, [...series, ...measuredSeries(data, id)]);
  }
  for (const curve of data.curves) {
    put(parent, "h2", `${data.a} on ${curve.b}, contact model ${curve.contact_model}`);
    putLimitedTable(parent, [`${place} / ${data.by_angle ? "degrees" : "(m/s)"}`, "restitution", "impulse / N s", "sub-impacts",
      "peak force / N", "duration / ms", "status"],
    curve[place].map((x, i) => {
      const error = known(curve.error_total[i]) ? curve.error_total[i] : curve.error[i], text = (y, factor = 1, digits = 6) =>
        known(y) ? number(factor * y, digits) : "";
      const answered = known(curve.restitution[i]);
      return [number(x), answered ? number(curve.restitution[i]) + bar(error) : "", text(curve.impulse[i]),
        answered ? String(curve.sub_impacts[i]) : "", text(curve.peak_force[i], 1, 4), text(curve.end_time[i], 1e3, 5), curve.status[i]];
    }));
  }
  window.percuss = {data, plots};
}

/* Lowest and highest; Math.min takes no long lists. */
const extremes = (list) => list.reduce(([low, high], x) => [Math.min(low, x), Math.max(high, x)], [Infinity, -Infinity]);

/* An ensemble. */

const percent = (share, digits = 3) => `${number(100 * share, digits)} %`;
const inputName = (one) => (one.body ? `${one.input}@${one.body}` : one.input);

/* "0.1 to 0.2"; so few samples may not give both. */
const interval = (low, high) => [low, high].map((x) => (known(x) ? number(x, 4) : "?")).join(" to ");

function ensembleRows(reply) {
  const e = reply.statistics[0], varies = e.standard_deviation > 0, last = e.quantiles.length - 1;
  const answered = reply.samples - reply.refused, leading = leadingInput(reply);
  const rows = [];
  if (e.count === 0) rows.push(["restitution", "no sample has one", ""]);
  else rows.push(["restitution", number(e.mean, 5), varies ? `mean; with 95 % confidence ${interval(e.mean_low, e.mean_high)}`
    : e.count === 1 ? "of a single sample" : `of each of ${e.count} samples: it does not vary`]);
  if (varies)
    rows.push(["spread", number(e.standard_deviation, 4), `standard deviation; from ${interval(e.lowest, e.highest)}` +
      (last > 0 ? `, ${percent(e.probabilities[last] - e.probabilities[0], 4)} between ${number(e.quantiles[0], 4)} and ` +
        number(e.quantiles[last], 4) : "")]);
  const counts = reply.sub_impact_counts.map((count, k) => [k, count / answered]).filter(([, share]) => share > 0);
  rows.push(["sub-impacts", counts.map(([k, share]) => `${k} in ${percent(share)}`).join(", "), ""]);
  if (varies && leading) rows.push(["cause", inputName(leading), `${percent(leading.first_order, 2)} of the variance by itself`]);
  const lost = reply.refused || reply.truncated ? `${reply.refused} refused, ${reply.truncated} truncated` : "";
  const check = reply.check.count > 0 ? `${percent(reply.check.within)} of ${reply.check.count} solved again are within the tolerance`
    : "";
  rows.push(["samples", String(reply.samples), [lost, check].filter((text) => text).join("; ")]);
  return rows;
}

/* The input that explains most by itself. */
function leadingInput(reply) {
  const found = reply.sensitivities.filter((one) => known(one.first_order));
  return found.sort((a, b) => b.first_order - a.first_order)[0];
}

function showDistribution(parent, plots, e) {
  if (!(e.standard_deviation > 0)) return;
  const marks = e.quantiles.map((x, i) => ({x, text: `${number(100 * e.probabilities[i], 4)} %`}));
  const edges = e.bin_edges, steps = e.bin_counts.map((count, i) =>
    ({x: edges[i], y: count, text: `from ${number(edges[i], 4)} to ${number(edges[i + 1], 4)}`}));
  if (steps.length > 0) steps.push({x: edges[edges.length - 1], y: 0});
  put(parent, "h2", "Distribution of the restitution");
  put(parent, "p", "Lines: its percentiles. Drag to zoom, double-click for all.");
  if (steps.length > 0)
    plots.histogram = putChart(parent, "histogram", {label: "restitution"}, {label: "samples", zero: true},
      [{name: "samples", kind: "steps", points: [{x: edges[0], y: 0}, ...steps]}], marks);
  if (e.curve_values.length > 0)
    plots.distribution = putChart(parent, "distribution", {label: "restitution"}, {label: "share below", unit: "%", zero: true},
      [{name: "share below", kind: "curve", points: e.curve_values.map((x, i) => ({x, y: 100 * e.curve_shares[i]}))}], marks);
  putTable(parent, ["percentile", "restitution", "95 % confidence"], e.quantiles.map((x, i) =>
    [percent(e.probabilities[i], 4), number(x, 4), interval(e.quantiles_low[i], e.quantiles_high[i])]));
}

function showSensitivities(parent, heading, list) {
  if (list.length === 0) return;
  const share = (value, low, high) => (known(value) ? `${number(value, 3)} (${interval(low, high)})` : "not known");
  put(parent, "h2", heading);
  put(parent, "p", "Share of the variance that an input explains by itself, and that is left when all others are known, with 95 % " +
    "confidence.");
  putTable(parent, ["input", "of", "by itself", "left"], list.map((one) => [inputName(one), one.quantity || "restitution",
    share(one.first_order, one.first_order_low, one.first_order_high), share(one.total, one.total_low, one.total_high)]));
}

/* The samples, any column over any other; a colour for each number of sub-impacts. */
function showSamples(parent, plots, data) {
  const {columns, samples: rows} = data;
  if (rows.length < 2) return;
  put(parent, "h2", "Samples");
  if (rows.length < data.reply.samples)
    put(parent, "p", `The first ${rows.length} of ${data.reply.samples}; percuss ensemble --csv FILE writes all.`);
  const controls = put(parent, "div"), place = put(parent, "div"), choices = [];
  controls.className = "controls";
  const leading = leadingInput(data.reply), significant = columns.indexOf("significant");
  const first = {x: leading ? inputName(leading) : columns[0], y: "restitution"};
  for (const side of ["y", "x"]) {
    const select = put(put(controls, "label", side === "y" ? "draw " : "over "), "select");
    for (const name of columns) if (name !== "status") put(select, "option", name);
    select.value = first[side];
    select.id = `samples-${side}`;
    choices.push(select);
  }
  const draw = () => {
    const [y, x] = choices.map((select) => columns.indexOf(select.value));
    const groups = new Map();
    for (const row of rows) {
      if (!known(row[x]) || !known(row[y])) continue;
      if (!groups.has(row[significant])) groups.set(row[significant], []);
      groups.get(row[significant]).push({x: row[x], y: row[y]});
    }
    place.replaceChildren();
    const series = [...groups.keys()].sort((a, b) => a - b).map((count) =>
      ({name: count === 1 ? "1 sub-impact" : `${count} sub-impacts`, kind: "dots", points: groups.get(count)}));
    plots.samples = series.length > 0 ? putChart(place, "samples", {label: columns[x]}, {label: columns[y]}, series) : null;
  };
  for (const select of choices) select.onchange = draw;
  draw();
  put(parent, "p", "In SI units. Sub-impacts that are negligible are not counted here.");
}

function showEnsemble(data) {
  const {reply} = data, parent = $("charts"), plots = {};
  putRows($("numbers"), reply.statistics.length > 0 ? ensembleRows(reply) : []);
  showWarnings(reply.status, reply.message, reply.warnings);
  if (reply.statistics.length > 0) {
    showDistribution(parent, plots, reply.statistics[0]);
    put(parent, "h2", "All quantities, in SI units");
    putTable(parent, ["quantity", "mean", "95 % confidence", "standard deviation", "lowest", "highest"],
      reply.statistics.filter((one) => one.count > 0).map((one) => [one.quantity, number(one.mean, 5),
        interval(one.mean_low, one.mean_high), number(one.standard_deviation, 4), number(one.lowest, 5), number(one.highest, 5)]));
    showSensitivities(parent, "What causes the spread", [...reply.sensitivities, ...reply.tangential_sensitivities]);
    showSamples(parent, plots, data);
  }
  window.percuss = {data, plots};
}

/* Measured impacts beside simulated ones. */

function comparisonRows(data) {
  const {measured, simulated, residual, impacts} = data;
  const moments = (one) => (known(one.standard_deviation) ? `standard deviation ${number(one.standard_deviation, 4)}`
    : "of a single impact");
  const distance = (one) => (impacts.length < data.least_impacts
    ? `${impacts.length} impacts are too few for a p-value: ${data.least_impacts} or more are needed`
    : `p = ${number(one.p, 3)}`);
  const rows = [["measured", number(measured.mean, 4), `mean restitution; ${moments(measured)}`],
    ["simulated", number(simulated.mean, 4), `mean restitution; ${moments(simulated)}`],
    ["residual", number(residual.mean, 4) + (known(residual.half_width) ? ` ± ${number(residual.half_width, 2)} (95 %)` : ""),
     `simulated less measured; root mean square ${number(residual.root_mean_square, 4)}`],
    ["Kolmogorov-Smirnov", number(data.kolmogorov_smirnov.value, 4), distance(data.kolmogorov_smirnov)],
    ["energy distance", number(data.energy_distance.value, 4), distance(data.energy_distance)]];
  if (data.sub_impacts_known > 0)
    rows.push(["sub-impacts", `equal in ${data.sub_impacts_equal}`, `of ${data.sub_impacts_known} impacts`]);
  return rows;
}

/* Shares of the impacts below a value, as steps. */
function sharesBelow(values) {
  const sorted = values.filter(known).sort((a, b) => a - b);
  return sorted.length === 0 ? [] : [{x: sorted[0], y: 0}, ...sorted.map((x, i) => ({x, y: (100 * (i + 1)) / sorted.length}))];
}

function showComparison(data) {
  const {impacts} = data, parent = $("charts"), plots = {};
  putRows($("numbers"), comparisonRows(data));
  if (data.left_out.length > 0)
    put($("warnings"), "p", `${data.left_out.length} rows of the file are left out: ` +
      data.left_out.map((one) => `line ${one.line}: ${one.reason}`).join("; "));
  showWarnings("OK", "", data.warnings);
  /* impacts of one speed stand side by side */
  const [low, high] = extremes(impacts.map((one) => one.speed)), one = !(high > low);
  const axis = one ? {label: "impact"} : {label: "speed", unit: "m/s"}, at = (impact, i) => (one ? i + 1 : impact.speed);
  const series = (make) => [["measured", "measured"], ["simulated", "simulated"]].map(([name, key]) => ({name, kind: "dots",
    points: impacts.map((impact, i) => make(impact, key, at(impact, i), i)).filter((point) => known(point.y))}));
  put(parent, "p", "Bars: of the measured ones the 95 % interval by what is known of the instruments, of the simulated ones the " +
    "total error. Drag to zoom, double-click for all.");
  plots.restitution = putChart(parent, "restitution", axis, {label: "restitution"}, series((impact, key, x, i) =>
    restitutionPoint(x, impact[key].restitution, key === "measured" ? impact.restitution_half_width : data.error_total[i])));
  plots.residual = putChart(parent, "residual", axis, {label: "residual", zero: true}, [{name: "simulated less measured", kind: "dots",
    points: impacts.map((impact, i) => ({x: at(impact, i), y: impact.residual})).filter((point) => known(point.y))}]);
  plots["sub-impacts"] = putChart(parent, "sub-impacts", axis, {label: "sub-impacts", zero: true},
    series((impact, key, x) => ({x, y: impact[key].sub_impacts})));
  plots.distribution = putChart(parent, "distribution", {label: "restitution"}, {label: "impacts below", unit: "%", zero: true},
    ["measured", "simulated"].map((key) => ({name: key, kind: "steps",
      points: sharesBelow(impacts.map((impact) => impact[key].restitution))})));
  const text = (x, digits = 4) => (known(x) ? number(x, digits) : "");
  put(parent, "h2", "Impacts");
  putLimitedTable(parent, ["#", "speed / (m/s)", "measured e", "simulated e", "residual", "measured sub-impacts", "simulated"],
    impacts.map((impact, i) => [String(i + 1), number(impact.speed, 5),
      text(impact.measured.restitution) + bar(impact.restitution_half_width), text(impact.simulated.restitution) + bar(data.error_total[i]),
      text(impact.residual), text(impact.measured.sub_impacts), text(impact.simulated.sub_impacts)]));
  window.percuss = {data, plots};
}
