// SPDX-License-Identifier: BSD-3-Clause
// Curves and maps of a sweep, their axes chosen by the reader.
"use strict";

rondo.Sweep = class {
  static async make(place) {
    const sweep = new rondo.Sweep();
    await sweep.read(rondo.data(place.dataset.source));
    sweep.build(place);
    return sweep;
  }

  async read(data) {
    this.data = data;
    this.columns = {};
    for (const [name, column] of Object.entries(data.columns))
      this.columns[name] = {...column, numbers: column.values ? Array.from(await rondo.unpack(column.values)) : null};
    this.kind = "curves";
    ({x: this.x, y: this.y, by: this.by} = data);
    this.rest = {};
    for (const name of data.varied) {
      const levels = this.#levels(name);  // of curves over slip, as the pictures have it: the rest at its middle
      this.rest[name] = data.middle && name !== this.by && !this.#leads(name) ? levels[levels.length >> 1] : "";
    }
  }

  #levels(name) {
    const column = this.columns[name];
    return [...new Set(column.numbers ?? column.texts)].sort((a, b) => a < b ? -1 : a > b ? 1 : 0);
  }

  #value(name, n) {
    const column = this.columns[name];
    return column.numbers ? column.numbers[n] : column.texts[n];
  }

  #title(name) {
    const {label, unit} = this.columns[name];
    return rondo.plain(unit && unit !== "–" ? `${label} (${unit})` : label);
  }

  build(place) {
    this.options = rondo.element("div", {class: "row options"});
    this.plot = rondo.element("div", {class: "plot-sweep", role: "img", "aria-label": "The members over the axes chosen"});
    this.words = rondo.element("p", {class: "hint"});
    place.append(this.options, this.plot, this.words);
    this.#controls();
    this.draw();
    rondo.dark.addEventListener("change", () => this.draw());
  }

  #controls() {
    const all = Object.keys(this.columns), numbers = all.filter((name) => this.columns[name].numbers);
    const names = (list) => list.map((name) => [name, this.columns[name].label + (this.columns[name].label === name ? "" : ` (${name})`)]);
    const choose = (words, list, key) => rondo.select(words, list, this[key], (value) => {
      this[key] = value;
      this.#controls();
      this.draw();
    }).label;
    const varied = this.data.varied;
    this.options.replaceChildren(
      choose("Show", [["curves", "curves"], ["map", "map in colours"]], "kind"),
      choose("across", names(all), "x"),
      choose(this.kind === "map" ? "colour" : "up", names(numbers), "y"),
      choose(this.kind === "map" ? "up" : "a curve for each", this.kind === "map" ? names(all) : [["", "– nothing"], ...names(varied)], "by"));
    for (const name of varied) {
      if (name === this.by || name === this.x) continue;
      const levels = this.#levels(name);
      if (levels.length > 60 || this.#leads(name)) continue;
      this.options.append(rondo.select(`${this.columns[name].label} =`,
        [["", "all"], ...levels.map((level) => [level, typeof level === "number" ? rondo.number(level, 4) : level])],
        this.rest[name], (value) => { this.rest[name] = value; this.draw(); }).label);
    }
  }

  // Whether a parameter is what moves along the curve: x is a figure, and this one has most values.
  #leads(name) {
    if (this.columns[this.x].kind !== "figure") return false;
    const others = this.data.varied.filter((other) => other !== this.by);
    return others.every((other) => this.#levels(other).length <= this.#levels(name).length);
  }

  #chosen() {
    const chosen = [];
    for (let n = 0; n < this.data.runs.length; ++n) {
      const fits = this.data.varied.every((name) => this.rest[name] === "" || name === this.by || name === this.x ||
                                          String(this.#value(name, n)) === String(this.rest[name]));
      if (fits) chosen.push(n);
    }
    return chosen;
  }

  draw() {
    if (this.kind === "map" && !this.by) this.by = this.data.varied.find((name) => name !== this.x) ?? this.x;
    const chosen = this.#chosen(), traces = this.kind === "map" ? [this.#map(chosen)] : this.#curves(chosen);
    const up = this.kind === "map" ? this.by : this.y;
    const layout = rondo.layout(this.#title(this.x), this.#title(up), {legend: this.kind === "curves" && Boolean(this.by)});
    if (this.kind === "curves" && this.by) layout.legend.title = {text: this.#title(this.by) + "  "};
    layout.height = 460;
    this.words.textContent = `${chosen.length} members are shown. A point tells which run it is.`;
    return Plotly.react(this.plot, traces, layout, rondo.settings);
  }

  #texts(list) { return list.map((n) => "run " + this.data.runs[n]); }

  // A curve for each value of `by` and of all else that differs but along it.
  #curves(chosen) {
    const groups = new Map();
    const along = this.data.varied.filter((name) => name !== this.by && name !== this.x && this.#leads(name)).slice(0, 1);
    for (const n of chosen) {
      const key = this.data.varied.filter((name) => name !== this.x && !along.includes(name) && name !== this.by)
        .map((name) => this.#value(name, n));
      const level = this.by ? this.#value(this.by, n) : "";
      const id = JSON.stringify([level, ...key]);
      if (!groups.has(id)) groups.set(id, {level, list: []});
      groups.get(id).list.push(n);
    }
    const sorted = [...groups.values()].sort((a, b) => a.level < b.level ? -1 : a.level > b.level ? 1 : 0);
    const levels = [...new Set(sorted.map((group) => group.level))], shown = new Set();
    return sorted.map(({level, list}) => {
      list.sort((a, b) => this.#value(this.x, a) < this.#value(this.x, b) ? -1 : 1);
      const first = !shown.has(level);
      shown.add(level);
      return {type: "scatter", mode: "lines+markers", marker: {size: 5}, line: rondo.line(levels.indexOf(level)),
              name: rondo.plain(typeof level === "number" ? rondo.number(level, 4) : level), legendgroup: String(level),
              showlegend: first, x: list.map((n) => this.#value(this.x, n)), y: list.map((n) => this.#value(this.y, n)),
              text: this.#texts(list), hovertemplate: "%{x:.5g}, %{y:.5g} (%{text})<extra></extra>"};
    });
  }

  #map(chosen) {
    const colours = rondo.colours.sequential, values = chosen.map((n) => this.#value(this.y, n));
    return {type: "scatter", mode: "markers", x: chosen.map((n) => this.#value(this.x, n)),
            y: chosen.map((n) => this.#value(this.by, n)), text: this.#texts(chosen),
            customdata: values, hovertemplate: "%{x:.5g}, %{y:.5g}: %{customdata:.5g} (%{text})<extra></extra>",
            marker: {symbol: "square", size: chosen.length > 200 ? 12 : 18, color: values, line: {width: 0.5, color: rondo.colour("line")},
                     colorscale: colours.map((colour, n) => [n / (colours.length - 1), colour]),
                     colorbar: {title: {text: this.#title(this.y), side: "right"}, thickness: 14, outlinewidth: 0}}};
  }
};

rondo.sweeps = [];
for (const place of document.querySelectorAll(".sweep"))
  rondo.Sweep.make(place).then((sweep) => rondo.sweeps.push(sweep), (reason) => rondo.refuse(place, reason.message));
