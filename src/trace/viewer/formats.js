// SPDX-License-Identifier: MIT
//
// The run as it leaves the page again: the ITF file it was made from, byte for
// byte (src/trace/run/itf.cpp), and the text that a terminal would show.

// A JSON object; written by hand because the keys keep their order, whatever
// they are called.
function jsonRecord(keys, values) {
  return "{" + keys.map((key, i) =>
    `${JSON.stringify(key)}:${JSON.stringify(values[i])}`).join(",") + "}";
}

function jsonObject(entries) {
  return "{" + entries.filter(([, value]) => value !== undefined)
    .map(([key, value]) => `${JSON.stringify(key)}:${value}`).join(",") + "}";
}

function itfText(run) {
  const json = JSON.stringify;
  const nodes = run.nodes.map((node) => json({
    id: node.id, key: node.key, type: node.type, name: node.name,
    line: node.line, column: node.column, file: node.file,
    parent: node.parent,
  }));
  const about = jsonObject([
    ["format", json("ITF")],
    ["format-description",
     json("https://apalache-mc.org/docs/adr/015adr-trace.html")],
    ["tool", json("btcheck")],
    ["tree", json(run.tree)],
    ["ticks", json(run.ticks)],
    ["property", json(run.property)],
    ["formula", json(run.formula)],
    ["verdict", json(run.verdict)],
    ["why", json(run.why)],
    ["atoms", json(run.atoms)],
    ["source", json(run.source)],
    ["nodes", `[${nodes.join(",")}]`],
    ["included", json(run.included)],
    ["lost", json(run.lost)],
    ["trigger", json(run.trigger)],
    ["trigger_words", json(run.triggerWords)],
    ["end_words", json(run.endWords)],
  ]);
  const head = jsonObject([
    ["#meta", about],
    ["params", "[]"],
    ["vars", json(["time", "tick", "step", "event", "chosen", "status",
                   "location", "phase", "variables", "atoms"])],
    ["loop", json(run.loop)],
  ]);
  return `${head.slice(0, -1)},\n"states":[\n${itfStates(run)}\n]}\n`;
}

function itfStates(run) {
  const json = JSON.stringify;
  const keys = run.nodes.map((node) => node.key);
  const lines = [];
  run.replay(run.last, (i, locations, statuses) => {
    const state = run.states[i];
    const about = jsonObject([
      ["index", i],
      ["mover", json(keys[state.mover])],
      ["stale", json(keys.filter((_, n) => run.isStale(i, n)))],
      ["back", run.hasLoop && i === run.last ? json(run.back) : undefined],
    ]);
    const values = run.variables.map((_, v) =>
      run.isNumber[v] ? Number(run.valueText(i, v)) : run.valueText(i, v));
    lines.push(jsonObject([
      ["#meta", about],
      ["time", state.time],
      ["tick", state.tick],
      ["step", json(state.step)],
      ["event", json(state.event)],
      ["chosen", state.isChosen],
      ["status", jsonRecord(keys, statuses)],
      ["location", jsonRecord(keys, locations)],
      ["phase", jsonRecord(keys, keys.map((_, n) => run.phaseName(i, n)))],
      ["variables", jsonRecord(run.variables, values)],
      ["atoms", json(run.atoms.map((_, a) => run.isTrue(i, a)))],
    ]));
  });
  return lines.join(",\n");
}

// What `btcheck trace FILE --to text` prints (src/trace/formats/text.cpp).
function plainText(run) {
  const lines = [`${run.tree}: ${run.verdict}  ${run.property}`];
  if (run.formula !== run.property) lines.push(`  ${run.formula}`);
  if (run.why) lines.push(`  why: ${run.why}`);
  lines.push("", ...eventLines(run));
  if (run.endWords) lines.push(`    -- ${run.endWords}`);
  return lines.join("\n") + "\n";
}

function eventLines(run) {
  const unit = run.ticks === "root" ? "tick" : "time";
  const most = 400;
  const lines = [];
  let time = 0;
  let told = 0;
  let isNewTime = true;
  const tell = (text) => {
    const heading = !isNewTime ? "" : time > 0 ? `${unit} ${time}` : "start";
    isNewTime = false;
    return `    ${heading.padEnd(8)} ${text}`;
  };
  const mark = (text) => {
    lines.push(`    -- ${text}`);
    isNewTime = true;
  };
  const count = run.hasLoop ? run.last + 1 : run.last;
  for (let i = 0; i < count; ++i) {
    if (i === run.trigger) lines.push(tell(`-- ${run.triggerWords}`));
    if (i === run.loop) mark("the loop begins");
    const step = i < run.last ? run.states[i + 1] : run.stepTo(run.loop, 1);
    if (i < run.last ? step.times : run.back.elapsed) {
      ++time;
      isNewTime = true;
    }
    if (!step.event || told++ >= most) continue;
    const line = tell(step.event);
    lines.push(step.isChosen ? `${line} `.padEnd(62) + "chosen" : line);
  }
  if (told > most) mark(`${told - most} more steps`);
  if (run.trigger === count) lines.push(tell(`-- ${run.triggerWords}`));
  if (run.hasLoop) mark(silentLoop(run));
  return lines;
}

function silentLoop(run) {
  const steps = run.states.slice(run.loop + 1).map((state) => state.step);
  return [...steps, run.back.step].some((step) => step !== "time passes")
    ? "this repeats for ever"
    : "the run stays here for ever while time passes";
}

function fileStem(run) {
  const file = run.tree.replace(/^.*[/\\]/, "").replace(/\.[^.]*$/, "");
  return `${file}.${run.property}`.replace(/[^\w.-]+/g, "_");
}
