// SPDX-License-Identifier: MIT
//
// Shows runs. What they have in common is there once: the tree, its text, the
// steps that come again; the viewer gets a run as it gets any other.
"use strict";
const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);
const dialog = byId("shown");
const numbers = Object.keys(data.runs).map(Number).sort((a, b) => a - b);
// Runs are packed one behind the other, so that texts and changes are those of
// all that came before.
const texts = numbers.flatMap((number) => data.runs[number].texts);
const changes = numbers.flatMap((number) => data.runs[number].changes);
let shown = 0;

function packed(number) {
  return { ...data.shared, ...data.runs[number], texts, changes };
}

// As text in HTML, and as JSON in a script.
const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt()};`);
const inScript = (value) => JSON.stringify(value)
  .replace(/[<\u2028\u2029]/g, (c) =>
    `\\u${c.charCodeAt().toString(16).padStart(4, "0")}`);

function show(number) {
  const run = data.runs[number];
  if (!run) return;
  shown = number;
  byId("shown-title").textContent = run.property;
  byId("viewer").srcdoc = data.viewer
    .replace("{{title}}", () => escaped(run.property))
    .replace("{{run}}", () => inScript(packed(number)));
  const at = numbers.indexOf(number);
  byId("earlier").disabled = at === 0;
  byId("later").disabled = at + 1 === numbers.length;
  if (!dialog.open) dialog.showModal();
  history.replaceState(null, "", `#row=${number}`);
}

function go(by) {
  const next = numbers[numbers.indexOf(shown) + by];
  if (next !== undefined) show(next);
}

document.addEventListener("click", ({ target }) => {
  const button = target.closest("button[data-row]");
  if (button) show(Number(button.dataset.row));
});
byId("earlier").addEventListener("click", () => go(-1));
byId("later").addEventListener("click", () => go(1));
byId("close").addEventListener("click", () => dialog.close());
dialog.addEventListener("close", () => {
  if (dialog.open) return;  // again, before this was heard
  byId("viewer").removeAttribute("srcdoc");
  history.replaceState(null, "", location.pathname + location.search);
  document.querySelector(`button[data-row="${shown}"]`)?.focus();
});
dialog.addEventListener("keydown", ({ key }) => {
  if (key === "p") go(-1);
  if (key === "n") go(1);
});
// Esc reaches the run, which has the focus, and not the dialog.
byId("viewer").addEventListener("load", () => {
  const inside = byId("viewer").contentDocument;
  inside?.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    dialog.close();
  });
  byId("viewer").focus();
});

// Arrow keys, from field to field.
const fields = [...document.querySelectorAll(".matrix tbody tr")].map((row) =>
  [...row.cells].slice(1).map((cell) => cell.querySelector("button")));
const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0],
                ArrowDown: [1, 0] };
document.addEventListener("keydown", (event) => {
  const step = steps[event.key];
  if (!step || dialog.open) return;
  let row = fields.findIndex((all) => all.includes(document.activeElement));
  if (row < 0) return;
  let column = fields[row].indexOf(document.activeElement);
  event.preventDefault();
  do {
    row += step[0];
    column += step[1];
    // Over what is empty, or has no run.
  } while (fields[row]?.[column]?.disabled ?? fields[row]?.[column] === null);
  fields[row]?.[column]?.focus();
});

for (const button of document.querySelectorAll("button[data-row]")) {
  button.disabled = !data.runs[button.dataset.row];
}
const asked = /^#row=(\d+)$/.exec(location.hash);
if (asked) show(Number(asked[1]));
