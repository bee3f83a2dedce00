// SPDX-License-Identifier: MIT
//
// A run that goes on while it is looked at. btcheck sends what is new of it, as
// it is packed; who stands at the end of the run stays there, and who has gone
// back looks on in peace.

// A moment between two looks, in milliseconds; on a long run each takes longer,
// and no more than a third of the time is spent on them.
const LEAST_REST = 40;

class LiveViewer extends Viewer {
  constructor(run) {
    super(run);
    this.waiting = [];
    this.cost = 0;
    this.state = "live";
    this.makeParts();
    this.panels.push({ show: () => this.tellState() });
    this.jump(this.linkedStep() ?? run.last);
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
    const token = new URLSearchParams(location.search).get("token");
    this.stream = new EventSource(`/events?token=${token}&chapter=${chapter}`);
    this.stream.onmessage = ({ data }) => {
      this.waiting.push(JSON.parse(data));
      this.timeout ??= setTimeout(() => this.take(),
                                  Math.max(LEAST_REST, 2 * this.cost));
    };
    this.stream.onopen = () => this.become("live");
    this.stream.onerror = () => this.become(
      this.stream.readyState === EventSource.CLOSED ? "gone" : "lost");
    this.stream.addEventListener("anew", () => this.beginAnew());
    this.stream.addEventListener("end", ({ data }) =>
      this.conclude(JSON.parse(data)));
  }

  // What has come since the last look.
  take() {
    const begin = performance.now();
    const wasFollowing = this.isFollowing;
    clearTimeout(this.timeout);
    this.timeout = undefined;
    for (const more of this.waiting.splice(0)) this.append(more);
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
    this.stream.close();
    if (this.isFollowing) location.reload();
    else this.become("anew");
  }

  conclude(words) {
    this.stream.close();
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

begin(LiveViewer);
