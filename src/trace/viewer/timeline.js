// SPDX-License-Identifier: MIT
//
// The whole run at a glance: steps from left to right, and one lane for each
// choice, atom, variable and leaf. Drawn once, in pixels, whenever the width
// changes; going through the run only moves the playhead.

class Timeline {
  // `onJump(step)` hears of clicks and drags, `onSelect(node)` of labels.
  constructor(run, onJump, onSelect) {
    this.run = run;
    this.onJump = onJump;
    this.onSelect = onSelect;
    this.box = byId("lanes");
    this.labels = byId("lane-labels");
    this.plot = byId("plot");
    this.picture = byId("lane-picture");
    this.ruler = byId("ruler");
    this.slider = byId("slider");
    this.head = byId("playhead");
    this.tip = byId("tip");
    this.good = run.isViolated ? "" : " good";
    this.renew();
    this.listen();
  }

  // A lane for what the reader tries, below the atoms; none without truths.
  setTrial(label, truths) {
    if (!this.trial && !truths) return;
    this.trial = truths && { label, truths };
    this.renew();
  }

  // All lanes, of the run as it is now.
  renew() {
    this.slider.max = this.run.last;
    this.mover = undefined;
    this.makeLanes();
    this.labels.replaceChildren();
    this.makeLabels();
    this.draw();
  }

  makeLanes() {
    const { run } = this;
    const lanes = [];
    if (run.states.some((state) => state.isChosen)) {
      lanes.push({ kind: "choices", label: "choices" });
    }
    if (run.lost !== undefined || run.trigger !== undefined) {
      lanes.push({ kind: "property", label: run.property });
    }
    run.atoms.forEach((label, atom) => {
      lanes.push({ kind: "atom", label, atom });
    });
    if (this.trial) lanes.push({ kind: "atom", ...this.trial });
    run.variables.forEach((label, variable) => {
      lanes.push({ kind: "variable", label, variable });
    });
    const leaves = run.nodes.filter((node) => node.children.length === 0);
    for (const node of leaves) {
      if (node.isTouched) {
        lanes.push({ kind: "leaf", label: node.label, node: node.id });
      }
    }
    this.resting = leaves.filter((node) => !node.isTouched);
    lanes.forEach((lane, i) => {
      lane.isFirst = i > 0 && lanes[i - 1].kind !== lane.kind;
      lane.segments = this.segmentsOf(lane);
    });
    this.lanes = lanes;
  }

  // What the lane shows in a state, as one value that can be compared.
  valueOf(lane, step) {
    const { run } = this;
    switch (lane.kind) {
      case "atom":
        return lane.truths ? lane.truths[step]
                           : run.isTrue(step, lane.atom) ? 1 : 0;
      case "variable": return run.valueText(step, lane.variable);
      case "leaf": return run.phase(step, lane.node);
      case "property": return this.propertyAt(step);
      default: return step;
    }
  }

  propertyAt(step) {
    const { lost, trigger } = this.run;
    if (lost !== undefined && step >= lost) return "lost";
    return trigger !== undefined && step >= trigger ? "asked" : "";
  }

  // Stretches of states that look alike: [first, end, value].
  segmentsOf(lane) {
    if (lane.kind === "choices") {
      return this.run.states.flatMap((state, i) =>
        state.isChosen ? [[i, i + 1, 1]] : []);
    }
    const segments = [];
    for (let i = 0; i <= this.run.last; ++i) {
      const value = this.valueOf(lane, i);
      const open = segments[segments.length - 1];
      if (open && open[2] === value) {
        open[1] = i + 1;
      } else {
        segments.push([i, i + 1, value]);
      }
    }
    return segments;
  }

  makeLabels() {
    for (const lane of this.lanes) {
      const label = element("div", {
        class: `lane-label ${lane.kind}${lane.truths ? " trial" : ""}` +
               `${lane.isFirst ? " first" : ""}`,
        title: lane.label,
      }, ...this.labelParts(lane));
      if (lane.node !== undefined) {
        label.addEventListener("click", () => this.onSelect(lane.node));
      }
      lane.element = label;
      this.labels.append(label);
    }
    const many = this.resting.length;
    const names = this.resting.map((node) => node.label).join(", ");
    byId("resting").textContent = many === 0 ? ""
      : `${many} ${many === 1 ? "leaf is" : "leaves are"} never visited: ` +
        `${names}`;
  }

  // Where there is no room for a name, its number is still seen.
  labelParts(lane) {
    const [name, number] = lane.node === undefined
      ? [lane.label, ""] : nameParts(this.run.nodes[lane.node]);
    const parts = [element("bdi", {}, name)];
    if (number) parts.push(element("small", {}, number));
    return parts;
  }

  x(step) { return step * this.cell; }

  draw(width = this.plot.clientWidth) {
    if (width === 0) return;
    this.width = width;
    this.cell = width / this.run.states.length;
    this.laneHeight = this.lanes[0]?.element.offsetHeight || 18;
    const height = this.lanes.length * this.laneHeight;
    this.picture.setAttribute("width", width);
    this.picture.setAttribute("height", height);
    this.picture.innerHTML = this.loopShade(height) + this.grid(height) +
      this.lanes.map((lane, row) => this.drawLane(lane, row)).join("") +
      this.moments(height);
    this.drawRuler();
    this.placeSlider();
    this.show(this.step ?? 0);
  }

  loopShade(height) {
    if (!this.run.hasLoop) return "";
    const x = this.x(this.run.loop);
    return `<rect class="loop" x="${x}" y="0" width="${this.width - x}" ` +
           `height="${height}"/>`;
  }

  // Where ticks begin.
  tickStarts() {
    const starts = [];
    this.run.states.forEach((state, i) => {
      if (i > 0 && state.tick > this.run.states[i - 1].tick) {
        starts.push([i, state.tick]);
      }
    });
    return starts;
  }

  grid(height) {
    const starts = this.tickStarts();
    if (starts.length * 4 > this.width) return "";
    const path = starts.map(([i]) => `M${this.x(i).toFixed(1)} 0V${height}`);
    return `<path class="grid" d="${path.join("")}"/>`;
  }

  // Lines through all lanes where the property is asked for, and lost.
  moments(height) {
    return [["trigger", this.run.trigger], ["lost", this.run.lost]]
      .filter(([, step]) => step !== undefined)
      .map(([kind, step]) =>
        `<path class="moment ${kind}${this.good}" d="M${this.x(step + 0.5)} 0V${height}"/>`)
      .join("");
  }

  drawLane(lane, row) {
    const top = row * this.laneHeight;
    const draw = { choices: this.drawChoices, property: this.drawProperty,
                   atom: this.drawAtom, variable: this.drawVariable,
                   leaf: this.drawLeaf }[lane.kind];
    const rule = lane.isFirst
      ? `<path class="rule" d="M0 ${top + 0.5}H${this.width}"/>` : "";
    return rule + draw.call(this, lane, top);
  }

  bar(from, end, top, inset, least = 1) {
    const x = this.x(from).toFixed(2);
    const width = Math.max(least, this.x(end) - this.x(from)).toFixed(2);
    const height = this.laneHeight - 2 * inset;
    return `M${x} ${top + inset}h${width}v${height}h-${width}z`;
  }

  line(top) {
    const y = top + this.laneHeight / 2;
    return `<path class="base" d="M0 ${y}H${this.width}"/>`;
  }

  drawChoices(lane, top) {
    const y = top + this.laneHeight / 2;
    const marks = lane.segments.map(([from]) =>
      `M${this.x(from + 0.5).toFixed(1)} ${y - 4.5}l4.5 4.5-4.5 4.5-4.5-4.5z`);
    return this.line(top) + `<path class="choice" d="${marks.join("")}"/>`;
  }

  drawAtom(lane, top) {
    const bars = lane.segments.filter(([, , value]) => value)
      .map(([from, end]) => this.bar(from, end, top, 4, 3));
    return this.line(top) + `<path class="atom${lane.truths ? " trial" : ""}" d="${bars.join("")}"/>`;
  }

  // A text in the stretch, if there is room.
  caption(words, from, end, top, kind) {
    const room = this.x(end) - this.x(from) - 6;
    if (words === "" || room < words.length * 6.2) return "";
    const y = top + this.laneHeight / 2 + 3.7;
    return `<text class="${kind}" x="${this.x(from) + 5}" y="${y}">` +
           `${markup(words)}</text>`;
  }

  drawProperty(lane, top) {
    const words = { asked: this.run.triggerWords,
                    lost: this.run.isViolated ? "lost" : "shown" };
    return this.line(top) + lane.segments.map(([from, end, value]) =>
      value === "" ? "" :
      `<path class="${value}${this.good}" d="${this.bar(from, end, top, 3)}"/>` +
      this.caption(words[value], from, end, top, `on-${value}`)).join("");
  }

  drawVariable(lane, top) {
    return lane.segments.map(([from, end, value], i) => {
      const kind = i % 2 ? "value odd" : "value";
      return `<path class="${kind}" d="${this.bar(from, end, top, 2)}"/>` +
             this.caption(value, from, end, top, "on-value");
    }).join("");
  }

  drawLeaf(lane, top) {
    const bars = new Map();
    let signs = "";
    let open = { phase: 0, from: 0, end: 0 };
    const close = () => {
      const room = this.x(open.end) - this.x(open.from);
      if (open.phase > 0 && room >= 13) {
        const y = top + (this.laneHeight - 9) / 2;
        signs += `<use class="sign-${PHASES[open.phase]}" ` +
          `href="#glyph-${PHASES[open.phase]}" width="9" height="9" ` +
          `x="${(this.x(open.from) + 2.5).toFixed(1)}" y="${y}"/>`;
      }
    };
    for (const [from, end, value] of lane.segments) {
      const phase = value % STALE;
      if (phase !== open.phase) {
        close();
        open = { phase, from, end };
      }
      open.end = end;
      if (phase === 0) continue;
      const inset = phase <= 2 || phase === 7 ? 1.5 : 3;
      const path = this.bar(from, end, top, inset);
      bars.set(value, (bars.get(value) || "") + path);
    }
    close();
    return this.line(top) + [...bars].map(([value, path]) => {
      const stale = value >= STALE ? " stale" : "";
      const name = PHASES[value % STALE];
      const fill = `<path class="bar ${name}${stale}" ` +
                   `d="${path}"/>`;
      return name === "failure"
        ? `${fill}<path class="hatched${stale}" d="${path}"/>` : fill;
    }).join("") + signs;
  }

  drawRuler() {
    const { run } = this;
    const starts = this.tickStarts();
    if (run.hasLoop && !starts.some(([i]) => i === run.loop)) {
      starts.push([run.loop]);
      starts.sort(([a], [b]) => a - b);
    }
    const words = (tick) => this.cell * run.states.length / starts.length > 52
      ? `tick ${tick}` : `${tick}`;
    let free = 0;
    let marks = "";
    if (run.hasLoop) {
      const x = this.x(run.loop);
      marks += `<rect class="loop" x="${x}" y="0" width="${this.width - x}" ` +
               `height="18"/>`;
    }
    const forever = "repeats for ever";
    for (const [i, tick] of starts) {
      const x = this.x(i);
      const isLoop = i === run.loop;
      const text = !isLoop ? words(tick) : tick === undefined ? forever
                           : `${words(tick)} · ${forever}`;
      const end = x + text.length * 6.6 + 10;
      const hitsLoop = i < run.loop && end > this.x(run.loop);
      if (x < free || hitsLoop || end > this.width + 14) continue;
      marks += `<text x="${(x + 3).toFixed(1)}" y="12">${text}</text>`;
      free = end;
    }
    this.ruler.setAttribute("width", this.width);
    this.ruler.innerHTML = marks;
  }

  // The middle of the thumb goes with the middle of the step.
  placeSlider() {
    const thumb = 16;
    this.slider.style.marginLeft = `${this.cell / 2 - thumb / 2}px`;
    this.slider.style.width = `${this.width - this.cell + thumb}px`;
  }

  show(step) {
    this.step = step;
    this.slider.value = step;
    const width = Math.max(2, this.cell);
    const x = this.x(step + 0.5) - width / 2;
    this.head.style.width = `${width}px`;
    this.head.style.transform = `translateX(${x}px)`;
    const { mover } = this.run.states[step];
    if (mover === this.mover) return;
    for (const lane of this.lanes) {
      if (lane.node === undefined) continue;
      lane.element.classList.toggle("mover", lane.node === mover);
    }
    this.mover = mover;
  }

  stepAt(event) {
    const x = event.clientX - this.plot.getBoundingClientRect().left;
    const step = Math.floor(x / this.cell);
    return Math.min(this.run.last, Math.max(0, step));
  }

  listen() {
    let isDown = false;
    this.plot.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      isDown = true;
      this.plot.setPointerCapture(event.pointerId);
      this.onJump(this.stepAt(event));
    });
    this.plot.addEventListener("pointermove", (event) => {
      if (isDown) this.onJump(this.stepAt(event));
      this.explain(event);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      this.plot.addEventListener(end, () => { isDown = false; });
    }
    this.plot.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    this.slider.addEventListener("input", () => {
      this.onJump(Number(this.slider.value));
    });
    let width = this.width;
    new ResizeObserver(() => {
      if (this.plot.clientWidth === width) return;
      width = this.plot.clientWidth;
      this.draw();
    }).observe(this.plot);
  }

  // What lies under the mouse.
  explain(event) {
    const box = this.plot.getBoundingClientRect();
    const lane = this.lanes[Math.floor((event.clientY - box.top) /
                                       this.laneHeight)];
    this.tip.hidden = event.pointerType !== "mouse" || !lane;
    if (this.tip.hidden) return;
    const step = this.stepAt(event);
    this.tip.textContent = `${lane.label}: ${this.spoken(lane, step)} ` +
                           `(step ${step})`;
    const left = Math.min(event.clientX + 12,
                          innerWidth - this.tip.offsetWidth - 8);
    this.tip.style.left = `${left}px`;
    this.tip.style.top = `${event.clientY - 34}px`;
  }

  spoken(lane, step) {
    const value = this.valueOf(lane, step);
    switch (lane.kind) {
      case "atom": return value ? "true" : "false";
      case "leaf": return PHASE_WORDS[PHASES[value % STALE]] +
                          (value >= STALE ? ", from an earlier tick" : "");
      case "property": return this.run.remark(step) || value || "not asked yet";
      case "choices": return this.run.sentence(step);
      default: return value;
    }
  }
}

// Text as markup.
function markup(text) {
  return text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
}
