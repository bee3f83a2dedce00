// SPDX-License-Identifier: MIT
//
// An expression that the reader tries on the run: atoms of the rule language
// over nodes and variables, with and, or, not and parentheses.

const NODE_WORDS = ["ticked", "success", "failure", "running", "halted",
                    "skipped", "done", "active"];

// What is wrong with an expression, in words.
class Refusal extends Error {}

// In which states it holds, as 0 and 1.
function tried(run, text) {
  const words = text.match(
    /"[^"]*"|[\p{L}_][\p{L}\p{N}_]*(@\d+)?|-?\d+(\.\d+)?|=>|[=~!<>]=|&&|\|\||\S/gu) || [];
  let at = 0;
  const refuse = (why) => { throw new Refusal(why); };
  const took = (...some) => some.includes(words[at]) && ++at;
  const need = (what) =>
    (words[at++] ?? refuse(`${what} is missing`)).replace(/^"|"$/g, "");

  const joined = (part, word, sign, join) => () => {
    let left = part();
    while (took(word, sign)) {
      const [a, b] = [left, part()];
      left = (s) => join(a(s), b(s));
    }
    return left;
  };
  const not = () => {
    if (took("not", "!")) {
      const inner = not();
      return (s) => !inner(s);
    }
    if (!took("(")) return atom();
    const inner = all();
    return took(")") ? inner : refuse("`)` is missing");
  };
  const both = joined(not, "and", "&&", (a, b) => a && b);
  const either = joined(both, "or", "||", (a, b) => a || b);
  const all = joined(either, "=>", "=>", (a, b) => !a || b);

  // A comparison of what is read in a state.
  const compared = (read, name, isNumber) => {
    const value = () => {
      const word = need(`a value of \`${name}\``);
      if (isNumber && !(+word === +word)) {
        refuse(`\`${name}\` is a number, \`${word}\` is none`);
      }
      return isNumber ? +word : word;
    };
    if (isNumber && took("in")) {
      const least = value();
      if (!took(".") || !took(".")) refuse("write `in 0..3`");
      const most = value();
      return (s) => read(s) >= least && read(s) <= most;
    }
    const sign = need(`a comparison, \`${name} == …\`,`);
    if (!/^([=!~<>]=|[=<>])$/.test(sign)) {
      refuse(`\`${sign}\` is no comparison: write ==`);
    }
    if (/[<>]/.test(sign) && !isNumber) {
      refuse(`\`${name}\` has no order: write == or !=`);
    }
    const wanted = value();
    return (s) => {
      const a = read(s);
      return (a === wanted ? /^=|.=/ : a < wanted ? /[<!~]/ : /[>!~]/)
        .test(a === wanted ? sign.replace(/[!~]=/, "") : sign);
    };
  };

  const atom = () => {
    const name = need("an atom, such as `land.running`,");
    const variable = run.variables.indexOf(name);
    if (words[at] !== "." && variable >= 0) {
      const isNumber = run.isNumber[variable];
      const read = (i) => run.valueText(i, variable);
      return compared(({ i }) => isNumber ? +read(i) : read(i), name, isNumber);
    }
    const [plain, line] = name.split("@");
    const found = run.nodes.filter((n) => n.key === name ||
      name === "root" && n.parent === undefined ||
      n.name === plain && (!line || n.line === +line));
    if (!found[0]) {
      const near = [...run.variables, ...run.nodes.map((n) => n.label)].find(
        (one) => one[0] === name[0] && Math.abs(one.length - name.length) < 2);
      refuse(`no node or variable is called \`${name}\`` +
             (near ? `: did you mean \`${near}\`?` : ""));
    }
    const [{ id, label }] = found;
    if (found[1]) {
      refuse(`\`${name}\` may be ${found.map((n) => n.label).join(", ")}`);
    }
    if (!took(".")) refuse(`\`${name}\` is a node: write \`${name}.ticked\``);
    const word = need(`a word behind \`${label}.\``);
    if (word === "status") {
      return compared(({ statuses }) => statuses[id], `${name}.status`);
    }
    if (!NODE_WORDS.includes(word)) {
      refuse(`\`.${word}\` is not known here: ${NODE_WORDS.join(", ")}, status`);
    }
    if (word === "active") {
      return ({ i }) => /here|ting|run/.test(run.phaseName(i, id));
    }
    const location = word === "ticked" ? "tick_node" : word;
    return ({ locations }) => locations[id] === location;
  };

  const holds = all();
  if (at < words.length) refuse(`\`${words[at]}\` is one word too many`);
  const truths = [];
  run.replay(run.last, (i, locations, statuses) => {
    truths.push(+holds({ i, locations, statuses }));
  });
  return truths;
}

// The field, what came of it in words, and the lane.
class TrialPanel {
  constructor(run, timeline) {
    this.run = run;
    this.timeline = timeline;
    this.field = byId("trial-text");
    this.field.addEventListener("input", () => {
      this.judge();
      this.show(this.step);
    });
  }

  // The whole run, as it is now.
  judge() {
    const text = this.field.value.trim();
    this.complaint = this.truths = undefined;
    try {
      if (text) this.truths = tried(this.run, text);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this.complaint = error.message;
    }
    this.field.setAttribute("aria-invalid", Boolean(this.complaint));
    this.timeline.setTrial(text, this.truths);
  }

  show(step) {
    this.step = step;
    const { truths } = this;
    byId("trial-said").textContent = truths
      ? `${truths[step] > 0} here, true in ${truths.filter(Boolean).length} ` +
        `of ${truths.length} states`
      : this.complaint || "";
  }
}
