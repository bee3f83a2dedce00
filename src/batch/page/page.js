// SPDX-License-Identifier: MIT
//
// Folds and filters; without it the page says the same.
"use strict";
const entries = [...document.querySelectorAll("details.entry")];

function pressed(button) {
  const is = button.getAttribute("aria-pressed") !== "true";
  button.setAttribute("aria-pressed", String(is));
  return is;
}

document.querySelector(".tools").hidden = false;
document.getElementById("wanting").addEventListener("click", (event) => {
  const only = pressed(event.currentTarget);
  for (const entry of entries) entry.hidden = only && entry.dataset.met === "1";
});
document.getElementById("unfold").addEventListener("click", (event) => {
  const open = pressed(event.currentTarget);
  for (const entry of entries) entry.open = open;
});

// A link to an entry or a finding shows what is in it.
function reveal() {
  const entry = document.getElementById(location.hash.slice(1));
  if (entry && entry.matches("details")) {
    entry.hidden = false;
    entry.open = true;
    entry.querySelector("summary").focus();
  }
}
addEventListener("hashchange", reveal);
reveal();

// Paper does not unfold.
let folded = [];
addEventListener("beforeprint", () => {
  folded = [...document.querySelectorAll("details:not([open])")];
  for (const entry of folded) entry.open = true;
});
addEventListener("afterprint", () => {
  for (const entry of folded) entry.open = false;
});
