/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Put at the end of a page of many impacts: what its charts have and say under the pointer, its numbers and tables, a
 * line each in #probe. */
"use strict";

{
  const found = document.body.appendChild(document.createElement("pre"));
  found.id = "probe";
  const tell = (name, value) => (found.textContent += `${name} ${value}\n`);
  const text = (id) => (document.getElementById(id) ? document.getElementById(id).textContent : "");
  try {
    const {plots, data} = window.percuss;
    tell("title", document.title);
    for (const row of document.querySelectorAll("#numbers tr"))
      tell("number", [...row.children].map((cell) => cell.textContent).join(" | "));
    tell("warnings", text("warnings"));
    for (const [id, plot] of Object.entries(plots)) {
      const [left, right] = plot.xAxisRange(), [low, high] = plot.yAxisRange();
      const names = plot.getLabels().slice(1), last = plot.numRows() - 1;
      tell(`chart ${id}`, `${plot.numRows()} rows of ${names.join("; ")}`);
      /* inside: every point, its bar, and none at the rim */
      let inside = true;
      for (let row = 0; row <= last; row++)
        names.forEach((name, k) => {
          const cell = plot.getValue(row, k + 1), x = plot.getValue(row, 0);
          if (cell && Number.isFinite(cell[1]))
            inside = inside && x >= left && x <= right && cell[0] >= low && cell[2] <= high && cell[0] <= cell[1] && cell[1] <= cell[2];
        });
      tell(`inside ${id}`, inside);
      const pointed = (row) => {
        plot.setSelection(row);
        return text(`${id}-legend`);
      };
      tell(`first ${id}`, pointed(0));
      tell(`last ${id}`, pointed(last));
      tell(`x ${id}`, plot.getOptionForAxis("logscale", "x") ? "logarithmic" : "linear");
      plot.clearSelection();
      /* every point, and the bar above it where that is long enough, has a colour at its place: the plot's own, not
       * what the page makes of x */
      const image = plot.hidden_ctx_, coloured = (x, y) => {
        const ratio = plot.hidden_.width / plot.hidden_.clientWidth;
        const near = image.getImageData(Math.round(ratio * x) - 3, Math.round(ratio * y) - 3, 7, 7).data;
        let most = 0;
        for (let i = 0; i < near.length; i += 4)
          if (near[i + 3] > 0) most = Math.max(most, Math.max(...near.slice(i, i + 3)) - Math.min(...near.slice(i, i + 3)));
        return most > 20;
      };
      let points = 0, drawn = 0, bars = 0, barred = 0;
      for (const point of plot.layout_.points.flat()) {
        if (!Number.isFinite(point.yval)) continue;
        points++;
        drawn += coloured(point.canvasx, point.canvasy);
        const top = plot.toDomYCoord(point.yval_plus);
        if (!(point.canvasy - top > 12)) continue;
        bars++;
        barred += coloured(point.canvasx, (point.canvasy + top) / 2);
      }
      tell(`drawn ${id}`, points > 0 && drawn === points ? true : `${drawn} of ${points}`);
      tell(`bars ${id}`, `${barred} of ${bars}`);
    }
    /* the samples over another column */
    if (document.getElementById("samples-x")) {
      const before = plots.samples, select = document.getElementById("samples-x");
      select.value = "impulse";
      select.onchange();
      tell("chosen", plots.samples !== before && plots.samples.getLabels()[0]);
    }
    tell("tables", [...document.querySelectorAll("#charts table")].map((table) => table.rows.length - 1).join(" "));
    tell("impact", document.querySelectorAll(".impact, canvas#bodies").length);
    tell("request", data.request ? JSON.parse(text("request")).bodies.length : document.getElementById("request").hidden);
    tell("command", text("command"));
  } catch (error) {
    tell("error", error.stack || error);
  }
  tell("end", "of the probe");
}
