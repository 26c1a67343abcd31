// SPDX-License-Identifier: BSD-3-Clause
// The surface of a wheel in three dimensions: parallel projection, far faces first, turned by dragging.
"use strict";

rondo.Scene3d = class {
  constructor(viewer) {
    this.viewer = viewer;
    this.radius = 0;
    const c = viewer.coordinates;
    for (let n = 0; n < viewer.nodes; ++n)
      this.radius = Math.max(this.radius, Math.hypot(c[3 * n], c[3 * n + 1], c[3 * n + 2]));
    let far = 0;
    for (let k = 0; k < viewer.count; ++k) far = Math.max(far, Math.abs(viewer.origin(k)[0] - viewer.origin(0)[0]));
    this.path = far;
    this.reset();
  }

  shape() { return 0.72; }

  reset() {
    [this.azimuth, this.elevation, this.zoom] = [0.6, 0.3, 1];
  }

  drag(dx, dy) {
    this.azimuth -= 0.01 * dx;
    this.elevation = Math.min(1.5, Math.max(-1.5, this.elevation + 0.01 * dy));
  }

  // Rows: to the right, upwards, towards the eye (z > 0 is the right side of the wheel).
  #axes() {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation),
                              Math.sin(this.elevation)];
    return [[ca, 0, -sa], [-se * sa, ce, -se * ca], [ce * sa, se, ce * ca]];
  }

  draw(context, width, height, k) {
    const v = this.viewer, axes = this.#axes(), first = v.origin(0), now = v.origin(k);
    const center = v.following ? now : [first[0] + (v.origin(v.count - 1)[0] - first[0]) / 2, first[1], first[2]];
    const across = 2.6 * this.radius + (v.following ? 0 : this.path);
    this.scale = this.zoom * Math.min(width / across, height / (2.6 * this.radius));
    const project = (x, y, z) => {
      const [a, b, c] = [x - center[0], y - center[1], z - center[2]];
      const seen = axes.map((axis) => axis[0] * a + axis[1] * b + axis[2] * c);
      return [width / 2 + this.scale * seen[0], 0.46 * height - this.scale * seen[1], seen[2]];
    };
    const below = this.elevation < 0;
    if (!below) this.#ground(context, project, center, false);
    this.#faces(context, project, axes, k);
    if (below) this.#ground(context, project, center, true);
    if (v.showForces) this.#forces(context, project, axes, k);
  }

  #ground(context, project, center, through) {
    const ground = this.viewer.data.ground;
    if (!ground) return;
    const [t1, n, t2] = ground.axes, reach = 1.6 * this.radius + (this.viewer.following ? 0 : this.path / 2);
    const line = this.#near(ground.line, center[0] - reach, center[0] + reach);
    const place = ([x, y], z) => project(...[0, 1, 2].map((c) => x * t1[c] + y * n[c] + z * t2[c]));
    for (let s = 1; s < line.length; ++s) {
      const corners = [place(line[s - 1], ground.from), place(line[s], ground.from),
                       place(line[s], ground.to), place(line[s - 1], ground.to)];
      this.#polygon(context, corners);
      context.globalAlpha = through ? 0.35 : 1;
      context.fillStyle = rondo.colour("ground");
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 0.7;
      context.strokeStyle = rondo.colour("soft");
      context.stroke();
    }
    this.#marks(context, line, place, ground);
  }

  #marks(context, line, place, ground) {
    const step = 0.1;
    context.beginPath();
    for (let s = 1; s < line.length; ++s) {
      const [[x0, y0], [x1, y1]] = [line[s - 1], line[s]];
      if (x1 - x0 < 1e-6) continue;
      for (let m = Math.ceil(x0 / step); m * step < x1; ++m) {
        const y = y0 + (y1 - y0) * (m * step - x0) / (x1 - x0);
        const [a, b] = [place([m * step, y], ground.from), place([m * step, y], ground.to)];
        context.moveTo(a[0], a[1]);
        context.lineTo(b[0], b[1]);
      }
    }
    context.globalAlpha = 0.4;
    context.stroke();
    context.globalAlpha = 1;
  }

  #near(line, from, to) {
    const cut = [];
    for (let s = 1; s < line.length; ++s) {
      let [[x0, y0], [x1, y1]] = [line[s - 1], line[s]];
      if (Math.max(x0, x1) < from || Math.min(x0, x1) > to) continue;
      const at = (x) => y0 + (y1 - y0) * (x - x0) / (x1 - x0 || 1);
      const start = x0 < from ? [from, at(from)] : [x0, y0], end = x1 > to ? [to, at(to)] : [x1, y1];
      if (!cut.length) cut.push(start);
      cut.push(end);
    }
    return cut;
  }

  #polygon(context, corners) {
    context.beginPath();
    corners.forEach(([x, y], n) => n ? context.lineTo(x, y) : context.moveTo(x, y));
    context.closePath();
  }

  #faces(context, project, axes, k) {
    const v = this.viewer, places = v.places(k), shades = v.shades(k), cells = v.cells;
    if (!this.seen) this.seen = new Float32Array(3 * v.nodes);
    const seen = this.seen;
    for (let n = 0; n < v.nodes; ++n) seen.set(project(places[3 * n], places[3 * n + 1], places[3 * n + 2]), 3 * n);
    const order = [];
    for (let f = 0; f < cells.length / 4; ++f) {
      const [a, b, c, d] = [0, 1, 2, 3].map((corner) => 3 * cells[4 * f + corner]);
      // Corners go round counter-clockwise as seen from outside; down is positive on a canvas.
      const turn = (seen[c] - seen[a]) * (seen[d + 1] - seen[b + 1]) - (seen[c + 1] - seen[a + 1]) * (seen[d] - seen[b]);
      if (turn < 0) order.push([seen[a + 2] + seen[b + 2] + seen[c + 2] + seen[d + 2], f]);
    }
    order.sort((one, other) => one[0] - other[0]);
    context.lineJoin = "round";
    for (const [, f] of order) {
      context.beginPath();
      for (let corner = 0; corner < 4; ++corner) {
        const n = 3 * cells[4 * f + corner];
        if (corner) context.lineTo(seen[n], seen[n + 1]); else context.moveTo(seen[n], seen[n + 1]);
      }
      context.closePath();
      const colour = this.#lit(v.scaleColours[shades[f]], this.#light(places, cells, f));
      context.fillStyle = colour;
      context.fill();
      context.lineWidth = v.showMesh ? 0.5 : 0.7;
      context.strokeStyle = v.showMesh ? "rgba(60, 60, 60, 0.6)" : colour;
      context.stroke();
    }
  }

  // How much of the light a face gets, in sixteenths; the light comes from the right, above, the side.
  #light(places, cells, f) {
    const at = (corner) => 3 * cells[4 * f + corner], side = (a, b) => [0, 1, 2].map((c) => places[b + c] - places[a + c]);
    const [p, q] = [side(at(0), at(2)), side(at(1), at(3))];
    const n = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    const toward = (0.35 * n[0] + 0.85 * n[1] + 0.4 * n[2]) / (Math.hypot(...n) || 1);
    return Math.round(16 * (0.84 + 0.16 * Math.max(0, toward)));
  }

  #lit(colour, light) {
    const key = colour + light;
    if (!this.kept) this.kept = new Map();
    if (!this.kept.has(key)) {
      const parts = [1, 3, 5].map((from) => Math.round(parseInt(colour.slice(from, from + 2), 16) * light / 16));
      this.kept.set(key, `rgb(${parts.join(",")})`);
    }
    return this.kept.get(key);
  }

  #forces(context, project, axes, k) {
    const v = this.viewer, places = v.places(k), factor = 0.35 * this.radius / v.data.forces.largest;
    v.eachForce(k, (n, f) => {
      const p = [places[3 * n], places[3 * n + 1], places[3 * n + 2]];
      const end = project(...p), start = project(...p.map((x, c) => x - factor * f[c]));
      rondo.arrow(context, start[0], start[1], end[0], end[1]);
    });
  }
};
