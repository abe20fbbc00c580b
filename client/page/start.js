/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Shows what the page has, by its kind. */
"use strict";

function showPage() {
  const data = JSON.parse($("data").textContent), {command, request} = data;
  const {version, catalogue_revision: revision} = data.reply || data;
  const show = {sweep: showSweep, ensemble: showEnsemble, compare: showComparison}[data.kind];
  document.title = data.title || named(data, 0).join(" on ");
  $("title").textContent = document.title;
  $("command").textContent = command || "";
  $("request").textContent = request ? JSON.stringify(request, null, 2) : "";
  $("request-note").hidden = $("request").hidden = !request;
  if (data.request_note) $("request-note").textContent = data.request_note;
  $("version").textContent = version ? `percuss ${version}${revision ? `, catalogue ${revision}` : ""}` : "";
  if (show) for (const part of document.querySelectorAll(".impact")) part.remove();
  (show || showImpact)(data);
}

showPage();
