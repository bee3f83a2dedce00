// SPDX-License-Identifier: MIT
//
// The tree, drawn. One row for each leaf and a parent in the middle of its
// children: two nodes then never share both a row and a column, whatever the
// tree, so nothing overlaps. Where the window is narrow, an outline: one row
// for each node. Subtrees that the run leaves alone are folded. CONTROL_SIGNS,
// a sign for each type of control node, is put before this script (html.cpp).

const SVG = "http://www.w3.org/2000/svg";

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function svgElement(tag, attributes = {}) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) {
    made.setAttribute(name, value);
  }
  return made;
}

// The sign of a phase; `point` at another one to change it.
function glyph(name) {
  const svg = svgElement("svg", { class: "glyph", viewBox: "0 0 12 12",
                                  "aria-hidden": "true" });
  svg.append(svgElement("use", { href: `#glyph-${name}` }));
  return svg;
}

// A name whose line number, if it ends in one, stands back.
function nameParts(node) {
  const mark = `@${node.line}`;
  const number = `${node.line}`;
  if (node.label.endsWith(mark)) return [node.label.slice(0, -mark.length), mark];
  return node.name === node.type + number ? [node.type, number]
                                          : [node.label, ""];
}

class TreePicture {
  // `onSelect(node)` hears of clicks.
  constructor(run, onSelect) {
    this.run = run;
    this.onSelect = onSelect;
    this.viewport = byId("viewport");
    this.stage = byId("stage");
    this.sizer = byId("sizer");
    this.edges = byId("edges");
    this.folded = this.untouched();
    this.scale = 1;
    this.isOutline = this.viewport.clientWidth < 620;
    this.step = -1;
    this.makeNodes();
    this.layOut();
    this.fit();
    this.listen();
  }

  // The topmost inner nodes that the run never comes to.
  untouched() {
    const folded = new Set();
    for (const node of this.run.nodes) {
      const above = this.run.nodes[node.parent];
      if (!node.isTouched && above && above.isTouched &&
          node.children.length > 0) {
        folded.add(node.id);
      }
    }
    return folded;
  }

  makeNodes() {
    this.boxes = this.run.nodes.map((node) => this.makeBox(node));
    this.lines = this.run.nodes.map((node) => {
      const line = svgElement("path", {});
      if (node.parent !== undefined) this.edges.append(line);
      return line;
    });
    this.stage.append(...this.boxes);
    this.focused = 0;
    this.boxes[0].setAttribute("tabindex", "0");
    this.widths = this.boxes.map((box) => Math.ceil(box.offsetWidth));
    this.rowHeight = Math.ceil(this.boxes[0].offsetHeight) + 6;
  }

  makeBox(node) {
    const isLeaf = node.children.length === 0;
    const box = element("div", {
      class: isLeaf ? "node leaf" : "node", role: "treeitem", tabindex: "-1",
      id: `node-${node.id}`, "data-key": node.key, "data-phase": "unvisited",
      "aria-level": node.depth + 1,
    });
    const sign = CONTROL_SIGNS[node.type];
    const [name, number] = nameParts(node);
    const text = element("span", { class: "name" }, element("bdi", {}, name));
    if (number) text.append(element("small", {}, number));
    const expression = this.run.expression(node);
    if (expression) text.append(element("code", {}, expression));
    box.append(glyph("unvisited"));
    if (sign) box.append(element("i", { "aria-hidden": "true" }, sign));
    box.append(text);
    if (!isLeaf) {
      box.append(element("span", { class: "fold", "aria-hidden": "true" }));
    }
    return box;
  }

  // In pre-order, without what is folded away.
  visible() {
    const hidden = new Uint8Array(this.run.nodes.length);
    return this.run.nodes.filter((node) => {
      const above = node.parent;
      if (above !== undefined && (hidden[above] || this.folded.has(above))) {
        hidden[node.id] = 1;
      }
      return !hidden[node.id];
    });
  }

  layOut() {
    this.shown = this.visible();
    const place = this.isOutline ? this.outline() : this.sideways();
    this.places = place;
    let width = 0;
    let height = 0;
    const isShown = new Set(this.shown.map((node) => node.id));
    for (const node of this.run.nodes) {
      const box = this.boxes[node.id];
      box.hidden = !isShown.has(node.id);
      if (box.hidden) {
        this.lines[node.id].setAttribute("d", "");
        continue;
      }
      const { x, y } = place[node.id];
      box.style.transform = `translate(${x}px,${y}px)`;
      width = Math.max(width, x + this.widths[node.id]);
      height = Math.max(height, y + this.rowHeight);
      this.lines[node.id].setAttribute("d", this.edgePath(node, place));
      this.labelFold(node, box);
    }
    this.stage.classList.toggle("outline", this.isOutline);
    this.width = width + 16;
    this.height = height + 10;
    this.edges.setAttribute("width", this.width);
    this.edges.setAttribute("height", this.height);
    this.rescale();
  }

  labelFold(node, box) {
    if (node.children.length === 0) return;
    const isFolded = this.folded.has(node.id);
    const button = box.querySelector(".fold");
    button.textContent = isFolded ? `+${node.below}` : "–";
    button.title = isFolded ? `unfold ${node.below} nodes` : "fold";
    box.setAttribute("aria-expanded", String(!isFolded));
    box.classList.toggle("folded", isFolded);
  }

  sideways() {
    const place = {};
    let row = 0;
    for (const node of this.shown) {
      const above = place[node.parent];
      const x = above ? above.x + this.widths[node.parent] + 26 : 12;
      const isEnd = node.children.length === 0 || this.folded.has(node.id);
      place[node.id] = { x, y: isEnd ? 8 + row++ * this.rowHeight : 0, isEnd };
    }
    for (const node of [...this.shown].reverse()) {
      const at = place[node.id];
      if (at.isEnd) continue;
      const first = place[node.children[0]];
      const last = place[node.children[node.children.length - 1]];
      at.y = Math.round((first.y + last.y) / 2);
    }
    return place;
  }

  outline() {
    const place = {};
    this.shown.forEach((node, row) => {
      place[node.id] = { x: 10 + node.depth * 18, y: 8 + row * this.rowHeight };
    });
    return place;
  }

  edgePath(node, place) {
    const above = place[node.parent];
    if (!above) return "";
    const at = place[node.id];
    const middle = (this.rowHeight - 6) / 2;
    const y = at.y + middle;
    if (this.isOutline) {
      const x = above.x + 9;
      return `M${x} ${above.y + middle * 2}V${y - 5}q0 5 5 5H${at.x}`;
    }
    const x = above.x + this.widths[node.parent];
    const from = above.y + middle;
    if (from === y) return `M${x} ${y}H${at.x}`;
    const half = x + 13;
    return `M${x} ${from}C${half} ${from} ${half} ${y} ${at.x} ${y}`;
  }

  rescale() {
    this.stage.style.transform = `scale(${this.scale})`;
    this.sizer.style.width = `${Math.ceil(this.width * this.scale)}px`;
    this.sizer.style.height = `${Math.ceil(this.height * this.scale)}px`;
  }

  // As large as it can be and yet be seen whole; but never too small to read.
  fit(width = this.viewport.clientWidth, least = 0.78) {
    const height = this.viewport.clientHeight;
    const fitting = height / this.height;
    const wanted = fitting >= least ? Math.min(1.15, fitting) : 1;
    this.scale = Math.max(least, Math.min(wanted, width / this.width));
    this.rescale();
    this.follow(false);
  }

  fitAll() { this.fit(undefined, 0.2); }

  // Without regard to the window.
  fitPaper(width) {
    this.scale = Math.min(1, width / this.width);
    this.rescale();
  }

  zoom(factor, x = this.viewport.clientWidth / 2,
       y = this.viewport.clientHeight / 2) {
    const before = this.scale;
    this.scale = Math.min(2.5, Math.max(0.25, before * factor));
    const grown = this.scale / before;
    const left = (this.viewport.scrollLeft + x) * grown - x;
    const top = (this.viewport.scrollTop + y) * grown - y;
    this.rescale();
    this.viewport.scrollTo(left, top);
  }

  show(step) {
    const { run } = this;
    for (let n = 0; n < run.nodes.length; ++n) {
      const now = run.phase(step, n);
      if (this.step >= 0 && run.phase(this.step, n) === now) continue;
      const box = this.boxes[n];
      const name = PHASES[now % STALE];
      box.dataset.phase = name;
      box.classList.toggle("stale", now >= STALE);
      box.firstChild.firstChild.setAttribute("href", `#glyph-${name}`);
      const isOn = name === "here" || name === "waiting" || name === "halting";
      this.lines[n].classList.toggle("on", isOn);
      box.setAttribute("aria-label", this.spoken(n, step));
    }
    this.step = step;
    const { mover } = run.states[step];
    if (mover !== this.mover) {
      this.boxes[this.mover]?.classList.remove("mover");
      this.boxes[mover]?.classList.add("mover");
      this.mover = mover;
    }
  }

  spoken(n, step) {
    const node = this.run.nodes[n];
    const stale = this.run.isStale(step, n) ? ", from an earlier tick" : "";
    const words = PHASE_WORDS[this.run.phaseName(step, n)];
    const type = node.name.startsWith(node.type) ? "" : `, ${node.type}`;
    return `${node.label}${type}: ${words}${stale}`;
  }

  select(node) {
    this.boxes[this.selected]?.classList.remove("selected");
    this.boxes[this.selected]?.removeAttribute("aria-selected");
    this.selected = node;
    this.boxes[node]?.classList.add("selected");
    this.boxes[node]?.setAttribute("aria-selected", "true");
  }

  // The node, or where it is folded away, the one that hides it.
  standIn(node) {
    let found = node;
    for (let n = node; n !== undefined; n = this.run.nodes[n].parent) {
      if (this.folded.has(n) && n !== node) found = n;
    }
    return found;
  }

  // Brings the node that moves into sight.
  follow(isSmooth) {
    const node = this.selected ?? this.mover;
    if (node === undefined || !this.places) return;
    const shown = this.standIn(node);
    const { x, y } = this.places[shown];
    const port = this.viewport;
    const edge = 28;
    const span = (from, size, start, extent) => {
      if (from < start + edge) return Math.max(0, from - edge);
      if (from + size > start + extent - edge) {
        return from + size + edge - extent;
      }
      return start;
    };
    const left = span(x * this.scale, this.widths[shown] * this.scale,
                      port.scrollLeft, port.clientWidth);
    const top = span(y * this.scale, this.rowHeight * this.scale,
                     port.scrollTop, port.clientHeight);
    if (left === port.scrollLeft && top === port.scrollTop) return;
    port.scrollTo({ left, top, behavior: isSmooth ? "smooth" : "auto" });
  }

  toggleFold(node) {
    if (this.run.nodes[node].children.length === 0) return;
    if (!this.folded.delete(node)) this.folded.add(node);
    this.layOut();
  }

  // Everything, or what the run leaves alone out of the way again.
  toggleAll() {
    this.folded = this.folded.size > 0 ? new Set() : this.untouched();
    this.layOut();
    this.fit();
    return this.folded.size > 0;
  }

  toggleLayout() {
    this.isOutline = !this.isOutline;
    this.layOut();
    this.fit();
  }

  nodeOf(target) {
    const box = target.closest(".node");
    return box ? this.boxes.indexOf(box) : -1;
  }

  listen() {
    this.stage.addEventListener("click", (event) => {
      const node = this.nodeOf(event.target);
      if (node < 0) return;
      if (event.target.closest(".fold")) {
        this.toggleFold(node);
      } else {
        this.onSelect(node === this.selected ? undefined : node);
      }
    });
    this.stage.addEventListener("dblclick", (event) => {
      const node = this.nodeOf(event.target);
      if (node >= 0) this.toggleFold(node);
    });
    this.viewport.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const box = this.viewport.getBoundingClientRect();
      this.zoom(Math.exp(-event.deltaY / 300), event.clientX - box.left,
                event.clientY - box.top);
    }, { passive: false });
    this.listenToDrags();
  }

  // The ground can be dragged; fingers scroll by themselves.
  listenToDrags() {
    let from;
    this.viewport.addEventListener("pointerdown", (event) => {
      if (event.pointerType !== "mouse" || event.button !== 0) return;
      if (event.target.closest(".node")) return;
      const isBar = event.target === this.viewport &&
        (event.offsetX >= this.viewport.clientWidth ||
         event.offsetY >= this.viewport.clientHeight);
      if (isBar) return;
      from = { x: event.clientX + this.viewport.scrollLeft,
               y: event.clientY + this.viewport.scrollTop };
      this.viewport.setPointerCapture(event.pointerId);
    });
    this.viewport.addEventListener("pointermove", (event) => {
      if (!from) return;
      this.viewport.scrollTo(from.x - event.clientX, from.y - event.clientY);
    });
    const stop = () => { from = undefined; };
    this.viewport.addEventListener("pointerup", stop);
    this.viewport.addEventListener("pointercancel", stop);
  }

  // Moves the keyboard's focus among the nodes that are shown.
  focusNext(by) {
    const focused = this.nodeOf(document.activeElement);
    const at = this.shown.findIndex((node) => node.id === focused);
    const to = Math.min(this.shown.length - 1, Math.max(0, at + by));
    this.focus(this.shown[to].id);
  }

  focus(node) {
    this.boxes[this.focused]?.setAttribute("tabindex", "-1");
    this.focused = node;
    this.boxes[node].setAttribute("tabindex", "0");
    this.boxes[node].focus({ preventScroll: true });
    this.onSelect(node);
  }
}
