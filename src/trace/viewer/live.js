// SPDX-License-Identifier: MIT
//
// A run that goes on while it is looked at. btcheck sends what is new of it, as
// it is packed; who stands at the end of the run stays there, and who has gone
// back looks on in peace.

// A moment between two looks, in milliseconds; on a long run each takes longer,
// and no more than a third of the time is spent on them.
const LEAST_REST = 40;

// What btcheck tells of a run; `page` becomes "live", "lost" or "gone".
function listenTo(chapter, page, beginAnew, conclude) {
  const token = new URLSearchParams(location.search).get("token");
  const stream = new EventSource(`events?token=${token}&chapter=${chapter}`);
  stream.onopen = () => page.become("live");
  stream.onerror = () => page.become(
    stream.readyState === EventSource.CLOSED ? "gone" : "lost");
  stream.addEventListener("anew", () => { stream.close(); beginAnew(); });
  stream.addEventListener("end", ({ data }) => {
    stream.close();
    conclude(JSON.parse(data));
  });
  return stream;
}

class LiveViewer extends Viewer {
  constructor(run) {
    super(run);
    this.waiting = [];
    this.cost = 0;
    this.state = "live";
    this.makeParts();
    this.panels.push({ show: () => this.tellState() });
    this.jump(this.linkedStep() ?? run.last);
    if (run.packed.rules) this.judge(run.packed.rules);
    this.listenToRun(run.packed.live);
  }

  makeParts() {
    const follow = element("button", {
      type: "button", id: "follow",
      title: "stay at the end while the run goes on (End)" }, "follow");
    follow.addEventListener("click", () => this.follow());
    document.querySelector(".hint").before(
      follow, element("span", { id: "live", role: "status" }));
    const told = document.querySelector("#help p");
    told.textContent = told.textContent.replace(/Nothing leaves .*/s,
      "This page listens to btcheck on this machine, and to nothing else.");
    byId("verdict").className = "live";
  }

  // Where who follows stands. Between two ticks that is the end of the one: the
  // next has begun, waits for its time, and has nothing to show.
  get end() {
    const { states, nodes, last } = this.run;
    let at = last;
    while (this.state !== "ended" && at > 0 &&
           /: start_ -> tick_node/.test(states[at].step) &&
           nodes[states[at].mover].parent === undefined) --at;
    return at;
  }

  get isFollowing() { return this.step >= this.end; }

  jump(step) { super.jump(step === this.run.last ? this.end : step); }

  // While it follows, no step is meant.
  get hash() {
    return this.isFollowing && this.state !== "ended" ? "" : super.hash;
  }

  listenToRun(chapter) {
    this.stream = listenTo(chapter, this, () => this.beginAnew(),
                           (words) => this.conclude(words));
    const waitWith = (more) => {
      this.waiting.push(more);
      this.timeout ??= setTimeout(() => this.take(),
                                  Math.max(LEAST_REST, 2 * this.cost));
    };
    this.stream.onmessage = ({ data }) => waitWith(JSON.parse(data));
    // Told at once, and again when the state of it is there.
    this.stream.addEventListener("verdict", ({ data }) => {
      const rules = JSON.parse(data);
      this.judge(rules);
      waitWith({ rules });
    });
  }

  // What has come since the last look.
  take() {
    const begin = performance.now();
    const wasFollowing = this.isFollowing;
    clearTimeout(this.timeout);
    this.timeout = undefined;
    for (const more of this.waiting.splice(0)) {
      if (more.rules) this.judge(more.rules);
      else this.append(more);
    }
    this.events.grow();
    if (this.trial.field.value) this.trial.judge();
    else this.timeline.renew();
    this.showAgain(wasFollowing ? this.end : this.step);
    this.cost = performance.now() - begin;
  }

  append({ texts, changes, states }) {
    const { packed } = this.run;
    for (const text of texts) packed.texts.push(text);
    for (const change of changes) packed.changes.push(change);
    this.run.unpack(states);
  }

  // The rules that are asked of the run, each with its verdict so far; who
  // clicks one goes to the moment of it.
  judge(rules) {
    let list = document.getElementById("rules");
    if (!list) {
      list = element("ul", { id: "rules", "aria-label": "rules" });
      byId("now").after(list);
    }
    list.replaceChildren(...rules.map((rule) => {
      const isLost = rule.verdict === "VIOLATED" && !rule.expected;
      const sign = { OPEN: "running", VIOLATED: "failure",
                     SATISFIED: "success" }[rule.verdict] ?? "skipped";
      const button = element("button", { type: "button", title: rule.text });
      button.append(
        element("b", { class: isLost ? "bad" : rule.verdict.toLowerCase() },
                glyph(sign), rule.verdict),
        ` ${rule.name}`,
        element("small", {}, rule.moment,
                rule.expected ? " (expected violated)" : ""));
      button.disabled = rule.step === undefined;
      button.addEventListener("click", () =>
        this.jump(Math.min(rule.step, this.run.last)));
      return element("li", {}, button);
    }));
    const lost = rules.filter((rule) =>
      rule.verdict === "VIOLATED" && !rule.expected).length;
    if (lost > (this.lost ?? 0)) {
      byId("spoken").textContent =
        `${lost} of ${rules.length} rules violated`;
    }
    this.lost = lost;
  }

  showAgain(step) {
    this.step = -1;
    this.show(step);
  }

  follow() {
    if (this.state === "anew") location.reload();
    else this.jump(this.run.last);
  }

  // The run that is shown from now on begins later than this page does.
  beginAnew() {
    if (this.isFollowing) location.reload();
    else this.become("anew");
  }

  conclude(words) {
    if (this.waiting.length > 0) this.take();
    const wasFollowing = this.isFollowing;
    this.run.endWords = words;
    this.events.add(this.run.last, words, false, "remark");
    this.become("ended");
    this.showAgain(wasFollowing ? this.run.last : this.step);
  }

  become(state) {
    this.state = state;
    const verdict = byId("verdict");
    const isOver = state === "ended";
    verdict.classList.toggle("over", state !== "live");
    verdict.replaceChildren(glyph(isOver ? "halted" : "running"),
                            isOver ? "ENDED" : "LIVE");
    this.tellState();
  }

  tellState() {
    const behind = this.end - this.step;
    const back = `${behind} ${behind === 1 ? "step" : "steps"} back`;
    byId("follow").setAttribute("aria-pressed", String(this.isFollowing));
    byId("live").textContent = {
      live: this.isFollowing ? "following the run" : `${back}; it goes on`,
      ended: `the run is over${this.isFollowing ? "" : `; ${back}`}`,
      lost: "btcheck does not answer; trying again",
      gone: "btcheck no longer serves this run",
      anew: "the run goes on; follow shows its later part",
    }[this.state];
  }
}

// What is said of a page beside which btcheck goes on watching files.
const WATCHING = {
  live: "of the last check; the next save may change it",
  ended: "btcheck watches no longer",
  lost: "btcheck does not answer; trying again",
  gone: "btcheck watches no longer",
};

// Runs of a tree that somebody works on: each is over, and the next one takes
// its place.
class ReplacedViewer extends LiveViewer {
  constructor(run) {
    super(run);
    this.show(this.linkedStep() ?? run.tellingStep);
  }

  makeParts() {
    super.makeParts();
    byId("follow").remove();
    byId("verdict").className = this.run.isViolated ? "bad" : "good";
  }

  get end() { return this.run.last; }
  get hash() { return `#step=${this.step}`; }

  // A step of this run is none of the next.
  beginAnew() {
    location.replace(location.pathname + location.search);
  }

  conclude() { this.become("ended"); }

  become(state) {
    this.state = state;
    this.tellState();
  }

  tellState() { byId("live").textContent = WATCHING[this.state]; }
}

// In the place of a run: that nothing is wrong, or that there is no run of it.
class WithoutRun {
  constructor(run) {
    fillHeading(run);
    if (run.why) {
      byId("verdict").className = "bad";
      byId("verdict").replaceChildren(glyph("failure"), run.verdict);
    }
    byId("why-text").textContent = run.why;
    document.querySelector("main").hidden = true;
    document.querySelector(".actions").replaceChildren(
      element("span", { id: "live", role: "status" }));
    this.become("live");
    const reload = () => location.replace(location.pathname + location.search);
    listenTo(run.packed.live, this, reload, () => this.become("ended"));
  }

  become(state) { byId("live").textContent = WATCHING[state]; }
}

begin(class {
  constructor(run) {
    return new (!run.packed.replaced ? LiveViewer
      : run.nodes.length > 0 ? ReplacedViewer : WithoutRun)(run);
  }
});
