/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Put at the beginning of a page: a browser without a screen has hardly any frames, so that after the first two of its
 * own a timer makes them. */
"use strict";

{
  const own = window.requestAnimationFrame.bind(window), drop = window.cancelAnimationFrame.bind(window);
  let left = 2;
  window.requestAnimationFrame = (draw) =>
    left-- > 0 ? own(draw) : 1e6 + setTimeout(() => draw(performance.now()), 16);
  window.cancelAnimationFrame = (id) => (id > 1e6 ? clearTimeout(id - 1e6) : drop(id));
}
