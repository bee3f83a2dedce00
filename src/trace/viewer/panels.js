// SPDX-License-Identifier: MIT
//
// What is told in words beside the pictures: the heading, the present step, the
// variables, all that happened, and the tree's file.

function byId(id) { return document.getElementById(id); }

function fillHeading(run) {
  const verdict = byId("verdict");
  verdict.classList.add(run.isViolated ? "bad" : "good");
  verdict.append(glyph(run.isViolated ? "failure" : "success"), run.verdict);
  byId("property").textContent = run.property;
  byId("file").textContent = run.tree;
  byId("formula").textContent = run.formula;
  byId("formula").title = run.formula;
  byId("formula").hidden = run.formula === "" || run.formula === run.property;
  byId("why").hidden = run.why === "";
}

function fillLegend() {
  const words = { here: "tick here", waiting: "waiting",
                  running: "running", success: "success", failure: "failure",
                  skipped: "skipped",
                  halting: "halting", halted: "halted",
                  unvisited: "not visited", stale: "earlier tick" };
  for (const [name, text] of Object.entries(words)) {
    const phase = name === "stale" ? "success" : name;
    byId("legend").append(element("li", { "data-phase": phase, class: name },
                                  glyph(phase), text));
  }
}

// The sentence; the nodes that it names can be clicked.
function fillReason(run, onSelect) {
  const named = new Map(run.nodes.map((node) => [node.label, node.id]));
  for (const part of run.why.split(/([\w@.]*\w)/)) {
    const node = named.get(part);
    if (node === undefined) {
      byId("why-text").append(part);
      continue;
    }
    const name = element("a", { role: "button", tabindex: "0" }, part);
    name.addEventListener("click", () => onSelect(node));
    name.addEventListener("keydown", (event) => {
      if (event.key === "Enter") onSelect(node);
    });
    byId("why-text").append(name);
  }
}

class NowPanel {
  constructor(run) { this.run = run; }

  show(step, round) {
    const { run } = this;
    const state = run.states[step];
    const parts = [`step ${step} of ${run.last}`];
    if (state.tick > 0) parts.push(`tick ${state.tick}`);
    if (state.time > 0 && state.time !== state.tick) {
      parts.push(`time ${state.time}`);
    }
    if (run.hasLoop && step >= run.loop) {
      parts.push(round > 0 ? `loop, round ${round + 1}` : "loop");
    }
    byId("where").textContent = parts.join(" · ");
    const sentence = byId("sentence");
    const taken = run.stepTo(step, round);
    sentence.textContent = run.sentence(step, round);
    sentence.classList.toggle("inner", taken.event === "" && step > 0);
    byId("chosen").hidden = !taken.isChosen;
    const remark = run.remark(step);
    byId("remark").hidden = remark === "";
    byId("remark").textContent = remark;
    byId("remark").classList.toggle("bad", step === run.lost && run.isViolated);
    byId("inner").hidden = taken.step === "start";
    byId("raw").textContent = taken.step === "start" ? "" : taken.step;
  }
}

class VariablePanel {
  constructor(run) {
    this.run = run;
    this.rows = [...run.variables.keys()].map((v) => this.addRow(
      byId("variable-rows"), run.variables[v]));
    this.atoms = [...run.atoms.keys()].map((a) => this.addRow(
      byId("atom-rows"), run.atoms[a]));
    byId("variables").hidden = run.variables.length === 0;
    byId("atoms").hidden = run.atoms.length === 0;
  }

  addRow(table, name) {
    const value = element("td");
    const row = element("tr", {}, element("th", { scope: "row" },
      element("bdi", {}, name)), value);
    table.append(row);
    return { row, value };
  }

  show(step) {
    const { run } = this;
    const before = Math.max(0, step - 1);
    this.rows.forEach(({ row, value }, v) => {
      this.fill(row, value, run.valueText(before, v), run.valueText(step, v));
    });
    this.atoms.forEach(({ row, value }, a) => {
      const words = (i) => run.isTrue(i, a) ? "true" : "false";
      this.fill(row, value, words(before), words(step));
      row.classList.toggle("true", run.isTrue(step, a));
    });
  }

  // "Good → Low" where it has just changed.
  fill(row, cell, before, now) {
    const isChanged = before !== now;
    row.classList.toggle("changed", isChanged);
    cell.replaceChildren(...(isChanged
      ? [element("s", {}, before), " → ", element("strong", {}, now)] : [now]));
  }
}

class EventPanel {
  constructor(run, onJump) {
    this.run = run;
    this.items = [];
    this.list = byId("event-list");
    this.told = 0;
    this.choices = 0;
    this.tick = 0;
    this.isLoopTold = !run.hasLoop;
    this.grow();
    if (run.hasLoop) {
      const event = run.back.event ? `${prettyText(run.back.event)}, ` : "";
      this.mark("loop", `↻ ${event}back to step ${run.loop}`);
    }
    this.list.addEventListener("click", (event) => {
      const item = event.target.closest("[data-step]");
      if (item) onJump(Number(item.dataset.step));
    });
  }

  mark(kind, words) {
    this.list.append(element("li", { class: `${kind}-mark` }, words));
  }

  // What the states tell that are not in the list yet.
  grow() {
    const { run } = this;
    for (; this.told <= run.last; ++this.told) {
      const i = this.told;
      const state = run.states[i];
      if (state.isChosen) ++this.choices;
      const remark = i === run.loop ? "" : run.remark(i);
      if (!state.event && !remark && !(i === run.loop)) continue;
      if (!this.isLoopTold && i >= run.loop) {
        this.mark("loop", "↻ from here on for ever");
        this.isLoopTold = true;
      }
      if (state.tick !== this.tick) {
        this.tick = state.tick;
        this.mark("tick", `tick ${state.tick}`);
      }
      if (state.event) this.add(i, run.eventText(i), state.isChosen);
      if (remark) this.add(i, remark, false, "remark");
    }
    const { choices } = this;
    const words = choices === 1 ? "choice" : "choices";
    const count = byId("choice-count");
    count.textContent = choices === 0 ? "" : `◆ ${choices} ${words}`;
    count.title = "of the environment";
    byId("choices-only").hidden = choices === 0;
  }

  add(step, words, isChosen, kind = "") {
    const button = element("button", { type: "button", "data-step": step,
                                       tabindex: "-1" });
    const mark = element("i", { "aria-hidden": "true" }, isChosen ? "◆" : "");
    button.append(mark, element("bdi", {}, words),
                  element("small", {}, String(step)));
    if (isChosen) {
      button.append(element("span", { class: "unseen" }, ", chosen"));
    }
    const item = element("li", { class: isChosen ? "choice" : kind }, button);
    this.list.append(item);
    this.items.push({ step, item });
  }

  // The step of the event before or after.
  neighbour(by, step) {
    const steps = this.items.map((entry) => entry.step);
    const found = by > 0 ? steps.find((at) => at > step)
                         : steps.reverse().find((at) => at < step);
    return found ?? step;
  }

  show(step) {
    let current;
    for (const entry of this.items) {
      if (entry.step > step) break;
      current = entry;
    }
    const isHere = current && current.step === step;
    this.current?.item.classList.remove("current", "past");
    current?.item.classList.add(isHere ? "current" : "past");
    if (current === this.current) return;
    this.current = current;
    const item = current ? current.item : this.list.firstElementChild;
    if (item) keepInSight(this.list, item);
  }
}

// All files of the tree, one below the other, those it includes with their name.
class SourcePanel {
  constructor(run, onSelect) {
    this.run = run;
    this.box = byId("source-lines");
    byId("source").hidden = run.source === "";
    // The element of a line, by file and number; its nodes, by element.
    this.lineOf = new Map();
    this.nodesOf = new Map();
    for (const [file, lines] of run.files) this.addFile(file, lines);
    for (const node of run.nodes) {
      const line = this.lineAt(node);
      if (!line) continue;
      if (!this.nodesOf.has(line)) this.nodesOf.set(line, []);
      this.nodesOf.get(line).push(node.id);
      line.classList.add("has-node");
    }
    this.box.addEventListener("click", (event) => {
      const nodes = this.nodesOf.get(event.target.closest("li"));
      if (nodes) onSelect(nodes[0]);
    });
  }

  addFile(file, lines) {
    if (file) this.box.append(element("li", { class: "file" }, file));
    lines.forEach((text, i) => {
      const line = element("li", {}, element("i", { "aria-hidden": "true" }),
                           element("code", {}, text || " "));
      this.lineOf.set(`${file}:${i + 1}`, line);
      this.box.append(line);
    });
  }

  lineAt(node) {
    return node && this.lineOf.get(`${node.file || ""}:${node.line}`);
  }

  // Each line with a node has that node's colour; the line of `node` is lit.
  show(step, node) {
    const { run } = this;
    for (const [{ firstChild: mark }, nodes] of this.nodesOf) {
      const phase = run.phaseName(step, nodes[0]);
      if (mark.dataset.phase !== phase) mark.dataset.phase = phase;
      mark.classList.toggle("stale", run.isStale(step, nodes[0]));
    }
    this.showNode(step, node);
    const line = this.lineAt(run.nodes[node]);
    if (line === this.current) return;
    this.current?.classList.remove("current");
    this.current?.removeAttribute("aria-current");
    line?.classList.add("current");
    line?.setAttribute("aria-current", "true");
    this.current = line;
    if (line) keepInSight(this.box, line, 0.4);
  }

  showNode(step, node) {
    const box = byId("node-about");
    if (node === undefined) {
      box.textContent = "";
      return;
    }
    const about = this.run.nodes[node];
    let found;
    this.run.replay(step, (i, locations, statuses) => {
      if (i === step) found = [locations[node], statuses[node]];
    });
    const stale = this.run.isStale(step, node) ? ", from an earlier tick" : "";
    const type = about.name.startsWith(about.type) ? "" : ` ${about.type}`;
    box.replaceChildren(
      element("strong", {}, element("bdi", {}, about.label)),
      `${type}, ${about.file ? `${about.file}, ` : ""}line ${about.line}: `,
      PHASE_WORDS[this.run.phaseName(step, node)] + stale,
      element("span", { title: "where its automaton is, and what it " +
                               "answered last" },
              ` (at ${found[0]}, status ${found[1]})`));
  }
}

// Scrolls a pane, and nothing but the pane, which is positioned.
function keepInSight(pane, item, where = 0.5) {
  const top = item.offsetTop;
  const isSeen = top >= pane.scrollTop + 4 &&
    top + item.offsetHeight <= pane.scrollTop + pane.clientHeight - 4;
  if (!isSeen) pane.scrollTop = top - pane.clientHeight * where;
}
