// SPDX-License-Identifier: BSD-3-Clause
// A body that moves: its numbers, its controls, playing. How it is drawn: scene2d.js, scene3d.js.
"use strict";

rondo.PHASES = 48;  // pictures of a swing of a mode

rondo.Viewer = class {
  static async make(place) {
    const viewer = new rondo.Viewer();
    await viewer.read(rondo.data(place.dataset.source));
    viewer.build(place);
    return viewer;
  }

  async read(data) {
    this.data = data;
    this.dimensions = data.dimensions;
    this.coordinates = await rondo.unpack(data.mesh.coordinates);
    this.nodes = data.mesh.coordinates.shape[0];
    this.cells = await rondo.unpack(data.mesh.cells);
    this.edges = await Promise.all(data.mesh.edges.map(rondo.unpack));
    this.frame = await rondo.unpack(data.frame);
    this.motion = await rondo.unpack(data.motion);
    this.displacement = await rondo.unpack(data.displacement);
    this.fields = [];
    for (const field of data.fields) this.fields.push(await rondo.unpack(field));
    if (data.forces && data.forces.largest > 0) {
      this.forceNodes = await rondo.unpack(data.forces.nodes);
      this.forceVectors = await rondo.unpack(data.forces.vectors);
      this.forceStart = [0];
      for (const count of await rondo.unpack(data.forces.counts))
        this.forceStart.push(this.forceStart[this.forceStart.length - 1] + count);
    }
    this.count = data.modes ? rondo.PHASES : data.labels.length;
    [this.k, this.mode, this.field, this.factor] = [0, 0, -1, 1];
    this.following = data.follow;
    this.showForces = Boolean(this.forceNodes);
    this.showMesh = false;
    this.wholeRange = true;
    this.ranges = new Map();
    this.playing = false;
    this.speed = 1;
  }

  // Numbers of a moment

  snapshot(k) { return this.data.modes ? this.mode : k; }

  #motionOf(k, frame) {
    const frames = this.data.middle.length;
    return 4 * ((this.data.modes ? 0 : k) * frames + frame);
  }

  // Of the bodies: that of the rim, or the mean of free ones.
  origin(k) {
    const frames = this.data.mesh.rim ? 1 : this.data.middle.length, mean = [0, 0, 0];
    for (let frame = 0; frame < frames; ++frame)
      for (let c = 0; c < 3; ++c) mean[c] += this.motion[this.#motionOf(k, frame) + c] / frames;
    return mean;
  }

  angle(k) { return this.motion[this.#motionOf(k, 0) + 3]; }

  // (nodes x dimensions) m, fixed frame. `plain`: for the extent of the view.
  places(k, plain = false) {
    const d = this.dimensions, from = this.snapshot(k) * this.nodes * d;
    let factor = this.data.displacement.scale * (plain ? 1 : this.factor);
    if (this.data.modes) factor *= this.data.amplitude * (plain ? 1 : Math.sin(2 * Math.PI * k / rondo.PHASES));
    if (!this.made) this.made = new Float32Array(this.nodes * d);
    const turns = this.data.middle.map((middle, frame) => {
      const at = this.#motionOf(k, frame);
      return [Math.cos(this.motion[at + 3]), Math.sin(this.motion[at + 3]), middle, at];
    });
    for (let n = 0; n < this.nodes; ++n) {
      const [cos, sin, middle, at] = turns[this.frame[n]], m = d * n;
      const x = this.coordinates[m] - middle[0] + factor * this.displacement[from + m];
      const y = this.coordinates[m + 1] - middle[1] + factor * this.displacement[from + m + 1];
      this.made[m] = this.motion[at] + cos * x - sin * y;
      this.made[m + 1] = this.motion[at + 1] + sin * x + cos * y;
      if (d === 3)
        this.made[m + 2] = this.motion[at + 2] + this.coordinates[m + 2] + factor * this.displacement[from + m + 2];
    }
    return this.made;
  }

  #nodal(k) {
    const s = this.snapshot(k), values = new Float32Array(this.nodes);
    if (this.field >= 0) {
      const field = this.data.fields[this.field], numbers = this.fields[this.field];
      for (let n = 0; n < this.nodes; ++n) values[n] = field.low + field.scale * numbers[s * this.nodes + n];
      return values;
    }
    const d = this.dimensions, from = s * this.nodes * d, scale = this.data.displacement.scale * this.data.displacement.factor;
    for (let n = 0; n < this.nodes; ++n) {
      let sum = 0;
      for (let c = 0; c < d; ++c) sum += this.displacement[from + d * n + c] ** 2;
      values[n] = scale * Math.sqrt(sum);
    }
    return values;
  }

  #means(k) {
    const values = this.#nodal(k), means = new Float32Array(this.cells.length / 4);
    for (let c = 0; c < means.length; ++c) {
      const [p, q, r, s] = this.cells.subarray(4 * c, 4 * c + 4), three = values[p] + values[q] + values[r];
      means[c] = r === s ? three / 3 : 0.25 * (three + values[s]);  // a triangle has its last corner twice
    }
    return means;
  }

  // What the colours go from and to: as in the pictures, from 0, or the same on both sides of it.
  range(k) {
    const key = this.field + "/" + (this.data.modes ? this.mode : "");
    let top = this.wholeRange ? this.ranges.get(key) : undefined;
    if (top === undefined) {
      top = 0;
      const moments = !this.wholeRange || this.data.modes ? [k] : Array.from({length: this.count}, (_, n) => n);
      for (const moment of moments) for (const value of this.#means(moment)) top = Math.max(top, Math.abs(value));
      if (this.wholeRange) this.ranges.set(key, top);
    }
    const signed = this.field >= 0 && this.data.fields[this.field].signed;
    return [signed ? -top : 0, top, signed];
  }

  // (cells) numbers of colours.
  shades(k) {
    const [low, high, signed] = this.range(k), means = this.#means(k);
    this.scaleColours = rondo.colours[signed ? "diverging" : "sequential"];
    const last = this.scaleColours.length - 1, span = high - low || 1, from = high ? low : signed ? -0.5 : 0, shades = new Uint8Array(means.length);
    for (let c = 0; c < means.length; ++c)
      shades[c] = Math.min(last, Math.max(0, Math.round(last * (means[c] - from) / span)));
    return shades;
  }

  eachForce(k, visit) {
    for (let f = this.forceStart[k]; f < this.forceStart[k + 1]; ++f)
      visit(this.forceNodes[f], this.forceVectors.subarray(3 * f, 3 * f + 3));
  }

  // The controls

  build(place) {
    this.place = place;
    this.canvas = rondo.element("canvas", {role: "img", tabindex: "0", "aria-label": place.getAttribute("aria-label") +
      ". Space plays, arrow keys step" + (this.dimensions === 3 ? ", dragging turns it" : "")});
    this.canvas.style.touchAction = this.dimensions === 3 ? "none" : "pan-y";
    this.button = rondo.element("button", {type: "button", class: "play"});
    this.slider = rondo.element("input", {type: "range", min: "0", max: String(this.count - 1), value: "0",
                                          "aria-label": this.data.modes ? "Phase of the swing" : "Moment"});
    this.time = rondo.element("output", {class: "time"});
    this.bar = rondo.element("div", {class: "colourbar"});
    place.append(this.canvas, rondo.element("div", {class: "row transport"}, this.button, this.slider, this.time),
                 this.bar, this.#options());
    this.#listen();
    this.scene = this.dimensions === 3 ? new rondo.Scene3d(this) : new rondo.Scene2d(this);
    this.#said();
    new ResizeObserver(() => this.resize()).observe(place);
    rondo.dark.addEventListener("change", () => this.draw());
    this.resize();
  }

  #options() {
    const row = rondo.element("div", {class: "row options"});
    const add = (...parts) => row.append(...parts);
    if (this.data.modes)
      add(rondo.select("Mode", this.data.labels.map((label, n) => [n, label]), 0, (value) => {
        this.mode = Number(value);
        this.draw();
      }).label);
    else
      add(rondo.select("Colour", [[-1, this.data.displacement.name], ...this.data.fields.map((f, n) => [n, f.name])], -1,
                       (value) => { this.field = Number(value); this.draw(); }).label,
          rondo.select("from 0 to the largest of", [["whole", "all moments"], ["now", "this moment"]], "whole",
                       (value) => { this.wholeRange = value === "whole"; this.draw(); }).label);
    add(rondo.select(this.data.modes ? "Size ×" : "Deformation ×",
                     (this.data.modes ? [0.5, 1, 2, 4] : [0, 1, 2, 5, 10, 50, 200]).map((f) => [f, f]), 1,
                     (value) => { this.factor = Number(value); this.draw(); }).label,
        rondo.select("Speed ×", [0.1, 0.25, 0.5, 1, 2, 4].map((f) => [f, f]), 1,
                     (value) => { this.speed = Number(value); this.#said(); }).label);
    if (!this.data.modes && this.count > 1)
      add(rondo.checkbox("view follows the body", this.following, (on) => { this.following = on; this.resize(); }));
    if (this.forceNodes)
      add(rondo.checkbox("forces of contact", true, (on) => { this.showForces = on; this.draw(); }));
    add(rondo.checkbox("mesh", false, (on) => { this.showMesh = on; this.draw(); }));
    const zoom = rondo.element("span", {class: "zoom", role: "group", "aria-label": "View"});
    for (const [text, words, act] of [["−", "smaller", () => this.#zoom(1 / 1.5)], ["+", "larger", () => this.#zoom(1.5)],
                                      ["whole", "whole view", () => { this.scene.reset(); this.#touch(); this.draw(); }]]) {
      const button = rondo.element("button", {type: "button", "aria-label": words}, text);
      button.addEventListener("click", act);
      zoom.append(button);
    }
    add(zoom);
    this.words = rondo.element("p", {class: "hint"});
    row.append(this.words);
    return row;
  }

  #zoom(factor) {
    this.scene.zoom = Math.min(60, Math.max(0.3, this.scene.zoom * factor));
    this.#touch();
    this.draw();
  }

  #touch() {  // a plane picture that is not enlarged lets a finger scroll the page
    if (this.dimensions === 2) this.canvas.style.touchAction = this.scene.zoom > 1 ? "none" : "pan-y";
  }

  #said() {
    const {span, kind} = this.data.wait, turn = this.dimensions === 3 ? " Drag to turn it." : " + and dragging show details.";
    const slower = span > 0 ? this.#seconds() / span : 0;
    const how = {crush: "Played over the increments of the load.", inflation: "Played while air, spin and mounting grow.",
                 modes: "A mode has no size of its own: it swings by a tenth of the radius.",
                 pass: "One sector's pass, over and over: the next sector then takes the place of this one.",
                 motion: slower >= 1 ? `Played ${rondo.number(slower, 2)} times slower than it happens.`
                                     : `Played ${rondo.number(1 / (slower || 1), 2)} times faster than it happens.`};
    const arrows = this.forceNodes ? ` The longest arrow is ${rondo.scaled(this.data.forces.largest, this.data.forces.unit)} at a node.` : "";
    this.words.textContent = how[kind] + arrows + turn;
  }

  #seconds() {
    return (this.data.modes ? 2 : Math.min(8, Math.max(2, this.count / 24))) / this.speed;
  }

  #listen() {
    this.button.addEventListener("click", () => this.play(!this.playing));
    this.slider.addEventListener("input", () => { this.play(false); this.show(Number(this.slider.value)); });
    this.canvas.addEventListener("keydown", (event) => {
      const steps = {ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10, Home: -this.count, End: this.count};
      if (event.key === " ") this.play(!this.playing);
      else if (event.key in steps) {
        this.play(false);
        this.show(Math.min(this.count - 1, Math.max(0, this.k + steps[event.key])));
      } else return;
      event.preventDefault();
    });
    let from = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!from || (event.pointerType === "touch" && this.canvas.style.touchAction !== "none")) return;
      this.scene.drag(event.clientX - from[0], event.clientY - from[1]);
      from = [event.clientX, event.clientY];
      this.draw();
    });
    for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, () => { from = null; });
  }

  play(on) {
    this.playing = on && this.count > 1;
    this.begun = null;
    this.#button();
    if (this.playing) requestAnimationFrame((now) => this.#tick(now));
  }

  #button() {
    this.button.textContent = this.playing ? "❚❚ Pause" : "▶ Play";
    this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }

  #tick(now) {
    if (!this.playing) return;
    if (this.begun === null || this.paced !== this.speed)
      [this.begun, this.paced] = [now - 1000 * this.#seconds() * this.k / this.count, this.speed];
    const k = Math.floor((now - this.begun) / (1000 * this.#seconds()) * this.count) % this.count;
    if (k !== this.k) this.show(k);
    requestAnimationFrame((later) => this.#tick(later));
  }

  show(k) {
    this.k = k;
    this.slider.value = String(k);
    this.draw();
  }

  resize() {
    const width = this.place.clientWidth, most = Math.max(220, 0.7 * window.innerHeight);
    if (!width) return;
    const height = Math.round(Math.min(most, Math.max(180, width * Math.max(0.3, this.scene.shape()))));
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.height = height + "px";
    [this.width, this.height, this.ratio] = [width, height, ratio];
    this.draw();
  }

  draw() {
    if (!this.scene || !this.width) return;
    const context = this.canvas.getContext("2d");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.scene.draw(context, this.width, this.height, this.k);
    const text = this.data.modes ? `phase ${Math.round(360 * this.k / this.count)}°` : this.data.labels[this.k];
    this.time.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
    if (!this.button.textContent) this.#button();
    this.#colourbar();
  }

  #colourbar() {
    const [low, high] = this.range(this.k), of = this.field < 0 ? this.data.displacement : this.data.fields[this.field];
    const text = `${low ? rondo.number(low) : 0}|${rondo.number(high)} ${of.unit}|${of.name}|${this.scaleColours[0]}`;
    if (text === this.barText) return;
    this.barText = text;
    const strip = rondo.element("span", {class: "strip"});
    strip.style.background = `linear-gradient(to right, ${this.scaleColours.join(", ")})`;
    this.bar.replaceChildren(rondo.element("span", {class: "what"}, of.name), rondo.element("span", {}, text.split("|")[0]),
                             strip, rondo.element("span", {}, text.split("|")[1]));
  }
};

rondo.viewers = [];
for (const place of document.querySelectorAll(".viewer"))
  rondo.Viewer.make(place).then((viewer) => rondo.viewers.push(viewer), (reason) => rondo.refuse(place, reason.message));
