/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Opens the pages of its iframes one after the other, each until its probe has ended, and collects what they found. */
"use strict";

(async () => {
  const found = document.getElementById("probes");
  for (const frame of document.querySelectorAll("iframe")) {
    frame.srcdoc = frame.dataset.page;
    const probe = () => frame.contentDocument && frame.contentDocument.getElementById("probe");
    for (let wait = 0; wait < 400 && !(probe() && probe().textContent.endsWith("end of the probe\n")); wait++)
      await new Promise((done) => setTimeout(done, 25));
    found.textContent += `page ${frame.id}\n${probe() ? probe().textContent : ""}`;
    frame.remove();
  }
  found.textContent += "end of all\n";
})();
