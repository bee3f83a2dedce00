// SPDX-License-Identifier: MIT
//
// The lanes of a run that is too long for the width: a window of it. Above them
// the slider has all of the run: how much happens where, and which part the
// window is. In pages of long runs, and of such as go on.

// A step has so many pixels at least where all are shown, and in a window.
const LEAST_CELL = 0.5;
const WINDOW_CELL = 3;
// Steps that are counted at once for the overview.
const CHUNK = 64;

// The lanes of all runs on the page.
Timeline = class extends Timeline {
  renew() {
    if (!this.whole) {
      this.whole = this.run;
      this.first = 0;
      this.density = [];
      const scale = this.slider.parentElement;
      scale.insertAdjacentHTML(
        "afterbegin", `<svg id="overview" height="16" aria-hidden="true"/>`);
      this.about = scale.previousElementSibling;
      this.about.id = "shown-ticks";
    }
    this.run = this.whole;
    super.renew();
  }

  // Which lanes there are does not depend on the window.
  makeLanes() {
    this.segmentsOf = () => [];
    super.makeLanes();
    delete this.segmentsOf;
  }

  get isWindow() { return this.run !== this.whole; }
  isShown(step) {
    return step >= this.first && step < this.first + this.run.states.length;
  }

  draw(width = this.plot.clientWidth) {
    if (width === 0) return;
    this.place(width);
    for (const lane of this.lanes) lane.segments = this.segmentsOf(lane);
    super.draw(width);
    this.drawOverview();
  }

  // The window: the present step is in it, behind that there is a quarter of it
  // if the run has so much.
  place(width) {
    const { whole } = this;
    const all = whole.states.length;
    const step = this.step ?? 0;
    const count = Math.max(20, Math.floor(width / WINDOW_CELL));
    if (all * LEAST_CELL <= width || count >= all) {
      this.first = 0;
      this.run = whole;
      return;
    }
    const isInside = step >= this.first && step < this.first + count;
    if (!isInside) this.first = step - Math.floor(count * 0.75);
    this.first = Math.max(0, Math.min(this.first, all - count));
    this.run = part(whole, this.first, count);
  }

  // Steps are those of the whole run, whoever asks.
  show(step) {
    this.step = step;
    if (this.width && !this.isShown(step)) return this.draw(this.width);
    super.show(step - this.first);
    this.step = step;
    this.slider.value = step;
  }
  stepAt(event) { return super.stepAt(event) + this.first; }
  spoken(lane, step) { return super.spoken(lane, step - this.first); }
  valueOf(lane, step) {
    return lane.truths ? lane.truths[step + this.first]
                       : super.valueOf(lane, step);
  }

  // The first tick of a window may have begun before it.
  tickStarts() {
    const cut = this.isWindow ? [[0, this.run.states[0].tick]] : [];
    return [...cut, ...super.tickStarts()];
  }

  placeSlider() {
    const { cell } = this;
    this.cell = this.width / this.whole.states.length;
    super.placeSlider();
    this.cell = cell;
  }

  drawOverview() {
    const { run, whole, isWindow } = this;
    const overview = byId("overview");
    overview.parentElement.classList.toggle("windowed", isWindow);
    this.about.textContent = "";
    if (!isWindow) return;
    const { states } = whole;
    const part = this.width / states.length;
    const bars = this.densities(Math.floor(this.width / 3));
    const most = Math.max(...bars, 1);
    const wide = this.width / bars.length;
    const path = bars.map((count, i) => {
      const height = (12 * count / most).toFixed(1);
      return `M${(i * wide).toFixed(1)} 15v-${height}h2v${height}z`;
    });
    const moments = [["trigger", whole.trigger], ["lost", whole.lost]]
      .filter(([, step]) => step !== undefined)
      .map(([kind, step]) => `<path class="moment ${kind}${this.good}" ` +
           `d="M${(step + 0.5) * part} 0V16"/>`);
    const window = Math.max(6, run.states.length * part);
    const left = Math.min(this.first * part, this.width - window);
    overview.setAttribute("width", this.width);
    overview.innerHTML = `<path class="much" d="${path.join("")}"/>` +
      moments.join("") + `<rect class="window" x="${left}" y="0.5" ` +
      `width="${window}" height="15" rx="3"/>`;
    const [from, to] = [run.states[0].tick, run.states[run.last].tick];
    this.about.textContent = `${from === to ? "tick" : `ticks ${from} to`} ` +
      `${to} of ${states[whole.last].tick}`;
  }

  // How many steps worth a stop there are, from left to right. Those of a chunk
  // that is full are counted once.
  densities(most) {
    const { whole, density } = this;
    const all = whole.states.length;
    const worth = (from, end) => {
      let count = 0;
      for (let i = from; i < end; ++i) count += +whole.isInteresting(i);
      return count;
    };
    while ((density.length + 1) * CHUNK <= all) {
      const from = density.length * CHUNK;
      density.push(worth(from, from + CHUNK));
    }
    const chunks = [...density, worth(density.length * CHUNK, all)];
    const bars = Array(Math.max(1, Math.min(most, chunks.length))).fill(0);
    chunks.forEach((count, i) => {
      bars[Math.floor(i * bars.length / chunks.length)] += count;
    });
    return bars;
  }
};

// A part of a run as a run: what is asked of its states is counted from there.
function part(run, first, count) {
  const shown = Object.create(run);
  const end = first + count;
  shown.states = run.states.slice(first, end);
  shown.phases = run.phases.subarray(first * run.nodes.length);
  shown.values = run.values.subarray(first * run.variables.length);
  shown.truths = run.truths.subarray(first * run.atoms.length);
  for (const moment of ["lost", "trigger"]) {
    if (run[moment] !== undefined) shown[moment] = run[moment] - first;
  }
  if (run.hasLoop) {
    shown.loop = run.loop < end ? Math.max(0, run.loop - first) : undefined;
  }
  shown.remark = (step) => run.remark(step + first);
  shown.sentence = (step) => run.sentence(step + first);
  return shown;
}
