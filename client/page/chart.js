/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Charts of points with bars, by dygraphs; the values of the point under the pointer stand above. */
"use strict";

const CURVE_COLOURS = [COLOURS.a, COLOURS.b, "#3c8c46", "#8a4ba0", "#a08020", "#208c8c", "#202020", "#c04080"];

/* Rows of points [{x, y, low, high, text}] of all series, ascending in x: {x, points: [of each series, or none]}. Points
 * of one x share a row, but those of one series. */
function rowsOf(series) {
  const all = series.flatMap((one, k) => one.points.map((point) => ({k, point})));
  all.sort((a, b) => a.point.x - b.point.x);
  const rows = [];
  for (const {k, point} of all) {
    let row = rows[rows.length - 1];
    if (!row || row.x !== point.x || row.points[k]) rows.push((row = {x: point.x, points: []}));
    row.points[k] = point;
  }
  return rows;
}

/* The plots tell series apart by their names. */
function differentNames(series) {
  const before = (name, k) => series.slice(0, k).filter((one) => one.name === name).length;
  return series.map((one, k) => ({...one, name: one.name + (before(one.name, k) ? ` (${before(one.name, k) + 1})` : "")}));
}

/* Where x is, in pixels, on a logarithmic axis, too: toDomXCoord knows none. */
const placeOf = (plot, area, x) => area.x + plot.toPercentXCoord(x) * area.w;

/* A bar from low to high at each point of a plot that has them. */
function drawBars(context, area, plot, series) {
  context.save();
  context.beginPath();
  context.rect(area.x, area.y, area.w, area.h);
  context.clip();
  context.globalAlpha = 0.5;
  context.lineWidth = 2.5;
  for (const one of series) {
    const {color} = plot.getPropertiesForSeries(one.name);
    context.strokeStyle = color;
    for (const {x, low, high} of one.points) {
      if (!(high > low)) continue;
      const place = placeOf(plot, area, x);
      context.beginPath();
      context.moveTo(place, plot.toDomYCoord(high));
      context.lineTo(place, plot.toDomYCoord(low));
      context.stroke();
    }
  }
  context.restore();
}

/* Lines over the whole height, with a word each: {x, text}. */
function drawMarks(context, area, plot, marks) {
  context.save();
  context.fillStyle = "#606060";
  context.font = "11px sans-serif";
  marks.forEach(({x, text}, i) => {
    const left = placeOf(plot, area, x);
    if (!(left >= area.x && left <= area.x + area.w)) return;
    context.fillRect(left, area.y, 1, area.h);
    context.fillText(text, left + 3, area.y + 11 + 12 * (i % 3));
  });
  context.restore();
}

/* Adds a chart. `x`: {label, unit, log}, `y`: {label, unit, zero: from 0 on}; `series`: [{name, points, kind}], whose
 * points have x, y and may have low and high, and a text for the pointer, and may miss y; kind: "line" (with dots), "curve", "dots" or "steps".
 * Returns the plot. */
function putChart(parent, id, x, y, series, marks = []) {
  const named = (axis) => (axis.unit ? `${axis.label} / ${axis.unit}` : axis.label);
  const said = (value, axis) => `${number(value, 5)}${axis.unit ? ` ${axis.unit}` : ""}`;
  series = differentNames(series);
  const rows = rowsOf(series);
  const legend = put(parent, "div"), place = put(put(parent, "div"), "div");
  legend.className = "legend";
  legend.id = `${id}-legend`;
  place.parentNode.className = place.className = "plot";
  place.id = id;
  const has = (value) => value !== null && value !== undefined;
  /* a point without y is a gap in its line, none is not */
  const cell = (point) => {
    if (!point) return null;
    if (!has(point.y)) return [NaN, NaN, NaN];
    return [has(point.low) ? point.low : point.y, point.y, has(point.high) ? point.high : point.y];
  };
  const drawn = {
    line: {drawPoints: true, pointSize: 2.5, strokeWidth: 1.2},
    dots: {drawPoints: true, pointSize: 2.5, strokeWidth: 0},
    curve: {strokeWidth: 1.5},
    steps: {stepPlot: true, strokeWidth: 1.5},
  };
  return new Dygraph(place, rows.map((row) => [row.x, ...series.map((one, k) => cell(row.points[k]))]), {
    labels: [named(x), ...series.map((one) => one.name)],
    customBars: true,
    fillAlpha: 0,
    connectSeparatedPoints: true,
    xlabel: named(x),
    ylabel: named(y),
    includeZero: y.zero === true,
    /* room at the rims; dygraphs' own would pass 0 on a logarithmic axis */
    ...(x.log && rows.length > 0 ? {dateWindow: [0.97 * rows[0].x, 1.03 * rows[rows.length - 1].x]} : {xRangePad: 8}),
    yRangePad: 8,
    colors: CURVE_COLOURS.slice(0, Math.max(1, series.length)),
    series: Object.fromEntries(series.map((one) => [one.name, drawn[one.kind]])),
    legend: "always",
    labelsDiv: legend,
    highlightCircleSize: 4,
    animatedZooms: false,
    axes: {
      x: {logscale: x.log === true, valueFormatter: (value) => said(value, x)},
      y: {
        axisLabelWidth: 70,
        valueFormatter: (value, options, name, plot, row, column) => {
          const point = rows[row] && rows[row].points[column - 1];
          return said(value, y) + (point && point.text ? ` ${point.text}` : "");
        },
      },
    },
    underlayCallback: (context, area, plot) => {
      drawBars(context, area, plot, series);
      drawMarks(context, area, plot, marks);
    },
  });
}
