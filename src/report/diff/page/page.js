// SPDX-License-Identifier: MIT
//
// Who is pointed at is shown in the other tree as well.
"use strict";
const light = (target, on) => {
  const node = target instanceof Element && target.closest("[data-pair]");
  if (!node) return;
  document.querySelectorAll(`[data-pair="${node.dataset.pair}"]`)
    .forEach((each) => each.classList.toggle("lit", on));
};
for (const [begin, end] of [["mouseover", "mouseout"], ["focusin", "focusout"]]) {
  addEventListener(begin, (event) => light(event.target, true));
  addEventListener(end, (event) => light(event.target, false));
}
