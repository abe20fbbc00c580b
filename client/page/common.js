/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the pages of one impact and of many share: elements, numbers as text, tables, warnings. */
"use strict";

const $ = (id) => document.getElementById(id);
const number = (x, digits = 6) => (x === null || x === undefined ? "not known" : String(Number(x.toPrecision(digits))));

/* Adds an element with this text; returns it. */
function put(parent, name, text = "") {
  const element = document.createElement(name);
  element.textContent = text;
  parent.appendChild(element);
  return element;
}

/* " ± 0.02"; empty from a server that does not know it. */
const bar = (error) => (error > 0 ? ` ± ${number(error, 2)}` : "");

/* A table with a line of headings; returns it. */
function putTable(parent, heads, rows) {
  const table = put(parent, "table");
  const line = (name, texts) => {
    const row = put(table, "tr");
    for (const text of texts) put(row, name, text);
  };
  line("th", heads);
  for (const texts of rows) line("td", texts);
  return table;
}

/* Lines of a name, a value and a remark; the values have the names as ids, with what is behind them. */
function putRows(parent, rows, behind = "") {
  const table = put(parent, "table");
  for (const [name, value, remark] of rows) {
    const row = put(table, "tr");
    put(row, "th", name);
    put(row, "td", value).id = name + behind;
    put(row, "td", remark);
  }
}

function showWarnings(status, message, warnings) {
  if (status !== "OK") put($("warnings"), "p", `${status}: ${message}`);
  for (const warning of warnings) put($("warnings"), "p", `Warning: ${warning}`);
}
