// SPDX-License-Identifier: MIT
//
// The run, unpacked (packed.cpp says how it was packed), and what can be asked
// about it. Everything here is data; nothing touches the page.
"use strict";

const PHASES = ["unvisited", "here", "waiting", "running", "success",
                "failure", "halted", "halting", "skipped"];
const PHASE_WORDS = {
  unvisited: "not visited",
  here: "the tick is here",
  waiting: "waiting for children",
  running: "running",
  success: "success",
  failure: "failure",
  halted: "halted",
  halting: "being halted",
  skipped: "skipped",
};
// Added to a phase that is of an earlier tick.
const STALE = 16;

class Run {
  constructor(packed) {
    for (const name of ["tree", "source", "ticks", "property", "formula",
                        "verdict", "why", "variables", "atoms", "loop", "back",
                        "lost", "trigger", "included"]) {
      this[name] = packed[name];
    }
    this.triggerWords = packed.trigger_words;
    this.endWords = packed.end_words;
    this.isNumber = packed.numbers.map(Boolean);
    // The lines of each file, by its name; the tree's own has none.
    this.files = new Map(Object.entries({ "": this.source, ...this.included })
      .map(([name, text]) => [name, text.replace(/\n$/, "").split("\n")]));
    this.packed = packed;
    this.readNodes();
    this.readStates();
  }

  get last() { return this.states.length - 1; }
  get hasLoop() { return this.loop !== undefined; }

  readNodes() {
    const bearers = new Map();
    for (const [, , name] of this.packed.nodes) {
      bearers.set(name, (bearers.get(name) || 0) + 1);
    }
    this.nodes = [];
    for (const packed of this.packed.nodes) {
      const [key, type, name, line, column, parent, file] = packed;
      const above = this.nodes[parent];
      const id = this.nodes.length;
      const node = {
        id, key: key || `${name}_btn${id}`, type, name, line, column, file,
        parent: above && parent,
        label: bearers.get(name) > 1 ? `${name}@${line}` : name,
        children: [], depth: above ? above.depth + 1 : 0, isTouched: false,
      };
      if (above) above.children.push(node.id);
      this.nodes.push(node);
    }
    // How many nodes are below: children come after their parents.
    for (const node of this.nodes) node.below = 0;
    for (let n = this.nodes.length - 1; n >= 0; --n) {
      const above = this.nodes[this.nodes[n].parent];
      if (above) above.below += this.nodes[n].below + 1;
    }
  }

  // Phases, values and atoms of all states side by side; locations and
  // statuses, which are seldom asked for, stay packed.
  readStates() {
    this.changed = [];
    this.states = [];
    this.phases = new Uint8Array();
    this.values = new Uint32Array();
    this.truths = new Uint8Array();
    this.unpack(this.packed.states);
  }

  // Pairs of a change, and how many begin with it.
  unpack(pairs) {
    for (let k = 0; k < pairs.length; k += 2) {
      for (let i = 0; i < pairs[k + 1]; ++i) {
        this.changed.push(this.packed.changes[pairs[k] + i]);
      }
    }
    const count = this.changed.length;
    this.phases = withRoom(this.phases, count * this.nodes.length);
    this.values = withRoom(this.values, count * this.variables.length);
    this.truths = withRoom(this.truths, count * this.atoms.length);
    while (this.states.length < count) this.unpackNext();
  }

  unpackNext() {
    const { nodes, variables, states, packed: { texts } } = this;
    const i = states.length;
    const [step, mover, phases, , event, chosen, , ticks, times, values,
           atoms] = this.changed[i];
    const before = states[i - 1];
    for (const [all, { length }] of [[this.phases, nodes],
                                     [this.values, variables],
                                     [this.truths, this.atoms]]) {
      if (before) all.copyWithin(i * length, (i - 1) * length, i * length);
    }
    for (const p of phases || []) {
      const phase = (p & 31) >> 1;
      this.phases[i * nodes.length + (p >> 5)] = phase | (p & 1) * STALE;
      if (phase > 0) nodes[p >> 5].isTouched = true;
    }
    for (let k = 0; k < (values || []).length; k += 2) {
      this.values[i * variables.length + values[k]] = values[k + 1];
    }
    for (const a of atoms || []) this.truths[i * this.atoms.length + a] ^= 1;
    const own = mover ? mover - 1 : undefined;
    states.push({ step: this.spelled(texts[step || 0], own), mover: own,
                  event: texts[event || 0], isChosen: Boolean(chosen),
                  times: times || 0, tick: (before?.tick || 0) + (ticks || 0),
                  time: (before?.time || 0) + (times || 0) });
  }

  // A text of a step or a location with the keys of nodes written out.
  spelled(text, own) {
    return text.replace(/~(~|[0-9a-z]*)/g, (_, reference) => {
      if (reference === "~") return "~";
      const node = reference === "" ? own : parseInt(reference, 36);
      return this.nodes[node].key;
    });
  }

  phase(step, node) { return this.phases[step * this.nodes.length + node]; }
  phaseName(step, node) { return PHASES[this.phase(step, node) % STALE]; }
  isStale(step, node) { return this.phase(step, node) >= STALE; }
  valueText(step, variable) {
    return this.packed.texts[this.values[step * this.variables.length +
                                         variable]];
  }
  isTrue(step, atom) {
    return this.truths[step * this.atoms.length + atom] === 1;
  }

  // Calls `visit(step, locations, statuses)` on every state up to the last one
  // that is wanted.
  replay(last, visit) {
    const { texts } = this.packed;
    const locations = this.nodes.map(() => "");
    const statuses = this.nodes.map(() => "");
    for (let i = 0; i <= last; ++i) {
      const change = this.changed[i];
      const moved = change[3] || [];
      for (let k = 0; k < moved.length; k += 2) {
        locations[moved[k]] = this.spelled(texts[moved[k + 1]], moved[k]);
      }
      const answered = change[6] || [];
      for (let k = 0; k < answered.length; k += 2) {
        statuses[answered[k]] = texts[answered[k + 1]];
      }
      visit(i, locations, statuses);
    }
  }

  // Where a choice is made, a variable or an atom changes, or the property is
  // asked or lost; and where the loop begins.
  isInteresting(i) {
    const differs = (all, width) => {
      for (let k = 0; k < width; ++k) {
        if (all[i * width + k] !== all[(i - 1) * width + k]) return true;
      }
      return false;
    };
    return i === 0 || i === this.last || this.states[i].isChosen ||
      i === this.lost || i === this.trigger || i === this.loop ||
      differs(this.values, this.variables.length) ||
      differs(this.truths, this.atoms.length);
  }

  // Where to begin reading: the last thing that happened before the property
  // was lost, or before the run ends or comes back.
  get tellingStep() {
    const end = this.lost === undefined ? this.last : this.lost;
    for (let i = end; i > 0; --i) {
      if (this.states[i].event) return i;
    }
    return end;
  }

  // "start_drone → success"
  eventText(step) { return prettyText(this.states[step].event); }

  // The step that leads to a state: from the one before it or, when the loop
  // has been gone round, from the last one.
  stepTo(state, round) {
    return round > 0 && state === this.loop
      ? { step: this.back.step, event: this.back.event,
          isChosen: this.back.chosen }
      : this.states[state];
  }

  // Every step in words: its event, or what the step is between the nodes.
  sentence(step, round = 0) {
    const { event, step: raw } = this.stepTo(step, round);
    const { mover, times } = this.states[step];
    if (event) return prettyText(event);
    if (step === 0) return "The run begins";
    if (mover === undefined) return times ? "Time passes" : prettyText(raw);
    const node = this.nodes[mover];
    const called = this.nodes.filter((other) =>
      other.parent === mover && this.entersHere(step, other.id));
    if (called.length > 0) {
      const names = called.map((other) => other.label).join(", ");
      return `${node.label} ticks ${names}`;
    }
    const now = this.phaseName(step, mover);
    const before = this.phaseName(step - 1, mover);
    if (now !== before && now === "halting") {
      return `${node.label} is being halted`;
    }
    const above = this.nodes[node.parent];
    if (now !== before && ["running", "success", "failure", "halted",
                           "skipped"].includes(now)) {
      const to = above ? ` to ${above.label}` : "";
      return now === "halted" ? `${node.label} is halted`
                              : `${node.label} returns ${now}${to}`;
    }
    if (/: start_ -> tick_node/.test(raw)) return `${node.label} begins`;
    const halt = this.nodes.filter((other) => other.parent === mover &&
      this.phaseName(step, other.id) === "halting" &&
      this.phaseName(step - 1, other.id) !== "halting");
    if (halt.length > 0) {
      return `${node.label} halts ${halt.map((o) => o.label).join(", ")}`;
    }
    return `${node.label} goes on`;
  }

  entersHere(step, node) {
    return this.phaseName(step, node) === "here" &&
           !["here", "waiting", "halting"].includes(
               this.phaseName(step - 1, node));
  }

  // What is to be said of the property in this state, if anything.
  remark(step) {
    const remarks = [];
    if (step === this.trigger) remarks.push(this.triggerWords);
    if (step === this.loop) remarks.push("from here the run repeats for ever");
    if (step === this.last) remarks.push(this.endWords);
    if (step === this.lost) {
      remarks.unshift(this.isViolated ? "lost here" : "shown here");
    }
    return remarks.filter(Boolean).join("; ");
  }

  get isViolated() { return this.verdict === "VIOLATED"; }

  // The node that moves, or that moved last.
  moverAt(step) {
    for (let i = step; i >= 0; --i) {
      if (this.states[i].mover !== undefined) return this.states[i].mover;
    }
    return undefined;
  }

  // The expression that a node stands for in the tree's file, or "".
  expression(node) {
    const lines = this.files.get(node.file || "");
    const text = (lines?.[node.line - 1] || "").slice(node.column - 1);
    if (/^Eval\b/.test(text)) return balanced(text.slice(4));
    const code = /^<?(?:\w*Condition|Script)\b[^>]*?\bcode="([^"]*)"/.exec(text);
    return code ? code[1] : "";
  }
}

// The numbers, with room for so many.
function withRoom(numbers, count) {
  if (count <= numbers.length) return numbers;
  const more = new numbers.constructor(Math.max(count, 2 * numbers.length));
  more.set(numbers);
  return more;
}

function prettyText(text) {
  return text.replaceAll(" -> ", " → ");
}

// The first parenthesised part of a text, on one line.
function balanced(text) {
  let depth = 0;
  for (let i = 0; i < text.length; ++i) {
    if (text[i] === "(") ++depth;
    if (text[i] === ")" && --depth <= 0) {
      return depth < 0 ? "" : text.slice(0, i + 1).trim();
    }
  }
  return "";
}
