// SPDX-License-Identifier: MIT
//
// Where the reader is in the run, and every way to get elsewhere.

const STRIDES = ["step", "tick", "change"];

class Viewer {
  constructor(run) {
    this.run = run;
    this.step = -1;
    // How often the loop has been gone round.
    this.round = 0;
    this.stride = "change";
    this.selected = undefined;
    const jump = (step) => this.jump(step);
    const select = (node) => {
      this.select(node);
      this.tell(node);
    };
    fillHeading(run);
    fillLegend();
    fillReason(run, select);
    this.tree = new TreePicture(run, select);
    this.timeline = new Timeline(run, jump, select);
    this.events = new EventPanel(run, jump);
    this.trial = new TrialPanel(run, this.timeline);
    this.panels = [new NowPanel(run), new VariablePanel(run), this.events,
                   this.trial];
    this.source = new SourcePanel(run, select);
    this.listen();
    this.show(this.linkedStep() ?? run.tellingStep);
    this.tree.fit();
  }

  // The step that the address asks for.
  linkedStep() {
    const found = /^#step=(\d+)$/.exec(location.hash);
    return found ? Math.min(this.run.last, Number(found[1])) : undefined;
  }

  show(step, round = this.round) {
    if (step === this.step && round === this.round) return;
    this.step = step;
    this.round = this.run.hasLoop && step >= this.run.loop ? round : 0;
    this.tree.show(step);
    this.timeline.show(step);
    for (const panel of this.panels) panel.show(step, this.round);
    this.source.show(step, this.selected ?? this.run.moverAt(step));
    this.tree.follow(!this.timer && !prefersStillness());
    byId("back").disabled = step === 0;
    byId("forward").disabled = step === this.run.last && !this.run.hasLoop;
    this.announceSoon();
  }

  // A jump by hand ends playing.
  jump(step) {
    this.pause();
    this.show(Math.min(this.run.last, Math.max(0, step)), 0);
  }

  // The next state worth a stop; none beyond the end. Round the loop, if there
  // is one: [state, rounds].
  next(stride, by) {
    const { run } = this;
    let at = this.step;
    let round = this.round;
    do {
      at += by;
      if (at > run.last && run.hasLoop) {
        at = run.loop;
        ++round;
      } else if (by < 0 && at === run.loop - 1 && round > 0) {
        at = run.last;
        --round;
      }
      if (at < 0 || at > run.last) return undefined;
      if (at === this.step) break;
    } while (!this.isStop(at, stride));
    return [at, round];
  }

  isStop(step, stride) {
    const { states, last } = this.run;
    switch (stride) {
      // The end of a tick, where every answer of it is fresh.
      case "tick":
        return step === 0 || step === last ||
               states[step].tick !== states[step + 1].tick;
      case "change": return this.run.isInteresting(step);
      default: return true;
    }
  }

  go(stride, by) {
    const found = this.next(stride, by);
    if (found) this.show(...found);
    return found !== undefined;
  }

  play() {
    if (this.timer) return this.pause();
    if (this.step === this.run.last && !this.run.hasLoop) this.show(0);
    this.setPlaying(true);
    const advance = () => {
      if (!this.go(this.stride, 1)) return this.pause();
      this.timer = setTimeout(advance, this.rest());
    };
    this.timer = setTimeout(advance, 60);
  }

  // How long to rest on a state, in milliseconds: long where something happens.
  rest() {
    if (this.stride !== "step") return 1000;
    if (this.run.isInteresting(this.step)) return 800;
    return this.run.states[this.step].event ? 450 : 90;
  }

  pause() {
    clearTimeout(this.timer);
    this.setPlaying(false);
    this.announceSoon();
  }

  setPlaying(isPlaying) {
    if (!isPlaying) this.timer = undefined;
    const button = byId("play");
    button.classList.toggle("playing", isPlaying);
    button.setAttribute("aria-label", isPlaying ? "pause" : "play");
    button.title = isPlaying ? "pause (space)" : "play (space)";
  }

  setStride(stride) {
    this.stride = stride;
    for (const name of STRIDES) {
      byId(`by-${name}`).setAttribute("aria-pressed", String(name === stride));
    }
  }

  // A node to be watched instead of the one that moves, or none.
  select(node) {
    this.selected = node;
    this.tree.select(this.selected);
    this.source.show(this.step, node ?? this.run.moverAt(this.step));
    if (this.selected !== undefined) this.tree.follow(true);
  }

  // Whoever shows this page in a window of its own, an editor for instance,
  // hears which node was chosen by hand: an event `btcheck-node` of the window
  // with { file, line, column }. `file` is "" for the tree's own one.
  tell(node) {
    const { file = "", line, column } = this.run.nodes[node] ?? {};
    const detail = { file, line, column };
    if (line) dispatchEvent(new CustomEvent("btcheck-node", { detail }));
  }

  // And may choose one, by a message { btcheck: "select", file, line } to the
  // window: of several nodes on a line the first, none where it has none.
  hear({ data }) {
    if (data?.btcheck !== "select") return;
    const { nodesOf } = this.source;
    this.select(nodesOf.get(this.source.lineAt(data))?.[0]);
  }

  get hash() { return `#step=${this.step}`; }

  // The address and the voice follow when the reader rests: browsers refuse
  // more than some hundred changes of the address in half a minute.
  announceSoon() {
    clearTimeout(this.announcing);
    if (this.timer) return;
    this.announcing = setTimeout(() => {
      const hash = this.hash;
      // A page within another one, in a notebook, has no address of its own.
      const hasAddress = location.protocol !== "about:";
      if (hasAddress && location.hash !== hash) {
        history.replaceState(null, "", hash);
      }
      const { isChosen } = this.run.stepTo(this.step, this.round);
      const { tick } = this.run.states[this.step];
      const remark = this.run.remark(this.step);
      byId("spoken").textContent = `Step ${this.step}, tick ${tick}: ` +
        this.run.sentence(this.step, this.round) +
        (isChosen ? ", chosen" : "") +
        (remark ? `; ${remark}` : "");
    }, 200);
  }

  listen() {
    const click = (id, action) => byId(id).addEventListener("click", action);
    click("back", () => { this.pause(); this.go(this.stride, -1); });
    click("forward", () => { this.pause(); this.go(this.stride, 1); });
    click("play", () => this.play());
    click("to-start", () => this.jump(0));
    click("to-end", () => this.jump(this.run.last));
    for (const name of STRIDES) {
      click(`by-${name}`, () => this.setStride(name));
    }
    click("zoom-in", () => this.tree.zoom(1.25));
    click("zoom-out", () => this.tree.zoom(0.8));
    click("zoom-fit", () => this.tree.fitAll());
    click("layout", () => this.toggleLayout());
    click("fold-all", () => this.toggleAll());
    click("copy", () => this.copy());
    click("download", () => this.download());
    click("theme", toggleTheme);
    click("help-open", () => byId("help").showModal());
    click("help-close", () => byId("help").close());
    click("choices-only", () => this.toggleChoices());
    byId("fold-all").hidden = this.tree.folded.size === 0;
    this.nameLayout();
    addEventListener("keydown", (event) => this.key(event));
    addEventListener("message", (event) => this.hear(event));
    addEventListener("hashchange", () => {
      const step = this.linkedStep();
      if (step !== undefined) this.jump(step);
    });
    this.listenToDivider();
    this.listenToPrinter();
  }

  // The lanes are as high as the reader wants them.
  listenToDivider() {
    const divider = byId("divider");
    const timeline = byId("timeline");
    const set = (height) => {
      const most = innerHeight - 240;
      timeline.style.height = `${Math.max(120, Math.min(most, height))}px`;
      timeline.style.maxHeight = "none";
    };
    divider.addEventListener("pointerdown", (event) => {
      divider.setPointerCapture(event.pointerId);
      divider.onpointermove = (moved) => set(
        timeline.getBoundingClientRect().bottom - moved.clientY);
    });
    divider.addEventListener("pointerup", () => {
      divider.onpointermove = null;
    });
    divider.addEventListener("keydown", (event) => {
      const by = { ArrowUp: 20, ArrowDown: -20 }[event.key];
      if (by) set(timeline.offsetHeight + by);
    });
  }

  toggleAll() {
    const isFolded = this.tree.toggleAll();
    byId("fold-all").textContent = isFolded ? "unfold all" : "fold unvisited";
  }

  toggleLayout() {
    this.tree.toggleLayout();
    this.nameLayout();
  }

  nameLayout() {
    byId("layout").textContent = this.tree.isOutline ? "tree" : "outline";
  }

  toggleChoices() {
    const button = byId("choices-only");
    const isOnly = byId("event-list").classList.toggle("only-choices");
    button.setAttribute("aria-pressed", String(isOnly));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (byId("help").open) return;
    const focused = document.activeElement;
    if (focused.id === "trial-text") {
      if (event.key === "Escape") focused.blur();
      return;
    }
    const inTree = this.tree.nodeOf(focused) >= 0;
    const inEvents = byId("event-list").contains(focused);
    if (focused.tagName === "BUTTON" &&
        (event.key === "Enter" || event.key === " " && !inEvents)) return;
    const action = (inTree && this.treeKeys()[event.key]) ||
                   (inEvents && this.eventKeys()[event.key]) ||
                   this.keys(event.shiftKey)[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  treeKeys() {
    return {
      ArrowDown: () => this.tree.focusNext(1),
      ArrowUp: () => this.tree.focusNext(-1),
      Enter: () => this.tree.toggleFold(
        this.tree.nodeOf(document.activeElement)),
    };
  }

  eventKeys() {
    const to = (by) => () => this.jump(this.events.neighbour(by, this.step));
    return { ArrowDown: to(1), ArrowUp: to(-1) };
  }

  keys(isShifted) {
    const by = (stride, way) => () => {
      this.pause();
      this.go(stride, way);
    };
    const to = (step) => () => { if (step !== undefined) this.jump(step); };
    return {
      ArrowRight: by(isShifted ? "tick" : "step", 1),
      ArrowLeft: by(isShifted ? "tick" : "step", -1),
      PageDown: by("tick", 1),
      PageUp: by("tick", -1),
      n: by("change", 1),
      p: by("change", -1),
      Home: to(0),
      End: to(this.run.last),
      l: to(this.run.loop),
      x: to(this.run.lost),
      a: to(this.run.trigger),
      " ": () => this.play(),
      1: () => this.setStride("step"),
      2: () => this.setStride("tick"),
      3: () => this.setStride("change"),
      f: () => this.tree.fitAll(),
      o: () => this.toggleLayout(),
      e: () => this.toggleAll(),
      "+": () => this.tree.zoom(1.25),
      "-": () => this.tree.zoom(0.8),
      d: toggleTheme,
      c: () => this.copy(),
      t: () => byId("trial-text").focus(),
      Escape: () => this.select(undefined),
      "?": () => byId("help").showModal(),
    };
  }

  async copy() {
    const text = plainText(this.run);
    const button = byId("copy");
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      // Where pages from disk may not write.
      copyBySelection(text);
    }
    button.textContent = "copied";
    setTimeout(() => { button.textContent = "copy text"; }, 1500);
  }

  download() {
    const file = new Blob([itfText(this.run)], { type: "application/json" });
    const link = element("a", { href: URL.createObjectURL(file),
                                download: `${fileStem(this.run)}.itf.json` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  // On paper the tree is seen whole.
  listenToPrinter() {
    addEventListener("beforeprint", () => {
      this.scaleBefore = this.tree.scale;
      this.tree.fitPaper(980);
      this.timeline.draw(860);
    });
    addEventListener("afterprint", () => {
      this.tree.scale = this.scaleBefore;
      this.tree.rescale();
      this.timeline.draw();
    });
  }
}

function copyBySelection(text) {
  const area = element("textarea", { class: "unseen" });
  area.value = text;
  document.body.append(area);
  area.select();
  document.execCommand("copy");
  area.remove();
}

function prefersStillness() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

// Light or dark as the system is, until someone says otherwise.
function setTheme(isDark) {
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
  byId("theme").setAttribute("aria-label",
                             isDark ? "light colours" : "dark colours");
}

function toggleTheme() {
  setTheme(document.documentElement.dataset.theme !== "dark");
}

// With a viewer of this class; html.cpp says which.
function begin(Kind) {
  const isDark = matchMedia("(prefers-color-scheme: dark)");
  setTheme(isDark.matches);
  isDark.addEventListener("change", () => setTheme(isDark.matches));
  new Kind(new Run(JSON.parse(byId("run").textContent)));
  document.body.classList.add("ready");
}
