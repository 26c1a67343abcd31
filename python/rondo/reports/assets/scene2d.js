// SPDX-License-Identifier: BSD-3-Clause
// A body in the plane on a canvas: ground, rim, cells in colours, edges, forces.
"use strict";

rondo.Scene2d = class {
  constructor(viewer) {
    this.viewer = viewer;
    this.zoom = 1;
    this.shift = [0, 0];  // m, by which the middle of the view is off
    this.box = this.#wholeBox();
  }

  // What all moments need: of the whole way, and of one moment about the first frame.
  #wholeBox() {
    const v = this.viewer, ends = [[Infinity, Infinity, -Infinity, -Infinity], [Infinity, Infinity, -Infinity, -Infinity]];
    const every = Math.max(1, Math.floor(v.count / 40));
    for (let k = 0; k < v.count; k = Math.min(k + every, k === v.count - 1 ? v.count : v.count - 1)) {
      const places = v.places(k, true), [cx, cy] = v.origin(k);
      for (let n = 0; n < v.nodes; ++n) {
        const x = places[2 * n], y = places[2 * n + 1];
        for (const [end, ox, oy] of [[ends[0], 0, 0], [ends[1], cx, 0]]) {
          if (x - ox < end[0]) end[0] = x - ox;
          if (y - oy < end[1]) end[1] = y - oy;
          if (x - ox > end[2]) end[2] = x - ox;
          if (y - oy > end[3]) end[3] = y - oy;
        }
      }
    }
    return {stay: ends[0], follow: ends[1]};
  }

  shape() {  // height over width
    const b = this.viewer.following ? this.box.follow : this.box.stay;
    return (b[3] - b[1]) * this.#room() / Math.max(1.08 * (b[2] - b[0]), 1e-9);
  }

  // Of the height: with forces from below or ground more of it beneath.
  #room() { return this.viewer.data.ground ? 1.3 : 1.12; }

  drag(dx, dy) {
    this.shift[0] -= dx / this.scale;
    this.shift[1] += dy / this.scale;
  }

  reset() {
    this.zoom = 1;
    this.shift = [0, 0];
  }

  draw(context, width, height, k) {
    const v = this.viewer, b = v.following ? this.box.follow : this.box.stay;
    const size = [b[2] - b[0], b[3] - b[1]];
    this.scale = this.zoom * Math.min(width / (1.08 * size[0]), height / (this.#room() * size[1]));
    const middle = [(b[0] + b[2]) / 2 + (v.following ? v.origin(k)[0] : 0) + this.shift[0],
                    (b[1] + b[3]) / 2 + this.shift[1] - 0.5 * (this.#room() - 1.08) * size[1]];
    this.x = (x) => width / 2 + (x - middle[0]) * this.scale;
    this.y = (y) => height / 2 - (y - middle[1]) * this.scale;
    const places = v.places(k);
    this.#ground(context, width, height);
    this.#rim(context, k);
    this.#cells(context, places, k);
    this.#edges(context, places);
    if (v.showForces) this.#forces(context, places, k);
  }

  #ground(context, width, height) {
    const ground = this.viewer.data.ground;
    if (!ground) return;
    const line = ground.line, down = height + 20;
    context.beginPath();
    line.forEach(([x, y], n) => n ? context.lineTo(this.x(x), this.y(y)) : context.moveTo(this.x(x), this.y(y)));
    context.lineWidth = 1.5;
    context.strokeStyle = rondo.colour("line");
    context.stroke();
    context.lineTo(this.x(line[line.length - 1][0]), Math.max(down, this.y(line[line.length - 1][1])));
    context.lineTo(this.x(line[0][0]), Math.max(down, this.y(line[0][1])));
    context.closePath();
    context.fillStyle = rondo.colour("ground");
    context.fill();
    this.#marks(context, width);
  }

  // Strokes on the ground, so that a view that follows is seen to move.
  #marks(context, width) {
    const line = this.viewer.data.ground.line;
    const step = 10 ** Math.ceil(Math.log10(60 / this.scale));
    context.fillStyle = rondo.colour("soft");
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    let beyond = -Infinity;
    for (let n = 1; n < line.length; ++n) {
      const [[x0, y0], [x1, y1]] = [line[n - 1], line[n]];
      if (x1 - x0 < 1e-9) continue;
      for (let m = Math.ceil(x0 / step); m * step <= x1; ++m) {
        const x = m * step, y = y0 + (y1 - y0) * (x - x0) / (x1 - x0), px = this.x(x);
        if (px < -30 || px > width + 30 || px < beyond) continue;
        beyond = px + 45;
        context.fillRect(px - 0.5, this.y(y), 1, 6);
        context.fillText(String(Number(x.toPrecision(6))).replace("-", "−") + " m", px, this.y(y) + 18);
      }
    }
  }

  #rim(context, k) {
    const v = this.viewer, radius = v.data.mesh.rim;
    if (!radius) return;
    const [cx, cy] = v.origin(k), angle = v.angle(k);
    context.beginPath();
    context.arc(this.x(cx), this.y(cy), radius * this.scale, 0, 2 * Math.PI);
    context.fillStyle = rondo.colour("rim");
    context.fill();
    context.beginPath();
    for (let spoke = 0; spoke < 3; ++spoke) {
      const a = angle - Math.PI / 2 + spoke * 2 * Math.PI / 3;
      context.moveTo(this.x(cx), this.y(cy));
      context.lineTo(this.x(cx + radius * Math.cos(a)), this.y(cy + radius * Math.sin(a)));
    }
    context.lineWidth = 1;
    context.strokeStyle = rondo.colour("soft");
    context.stroke();
  }

  #cells(context, places, k) {
    const v = this.viewer, shades = v.shades(k), cells = v.cells, count = cells.length / 4;
    const steps = v.scaleColours.length, lists = Array.from({length: steps}, () => []);
    for (let c = 0; c < count; ++c) lists[shades[c]].push(c);
    context.lineJoin = "round";
    lists.forEach((list, shade) => {
      if (!list.length) return;
      context.beginPath();
      for (const c of list) {
        for (let corner = 0; corner < 4; ++corner) {
          const n = cells[4 * c + corner], x = this.x(places[2 * n]), y = this.y(places[2 * n + 1]);
          if (corner) context.lineTo(x, y); else context.moveTo(x, y);
        }
        context.closePath();
      }
      context.fillStyle = v.scaleColours[shade];
      context.fill();
      context.lineWidth = v.showMesh ? 0.6 : 0.8;
      context.strokeStyle = v.showMesh ? "rgba(60, 60, 60, 0.7)" : v.scaleColours[shade];
      context.stroke();
    });
  }

  #edges(context, places) {
    context.beginPath();
    for (const line of this.viewer.edges)
      line.forEach((n, at) => {
        const x = this.x(places[2 * n]), y = this.y(places[2 * n + 1]);
        if (at) context.lineTo(x, y); else context.moveTo(x, y);
      });
    context.lineWidth = 1.1;
    context.strokeStyle = rondo.colour("line");
    context.stroke();
  }

  // Of the ground on the body: each arrow ends at its node.
  #forces(context, places, k) {
    const v = this.viewer, longest = 0.22 * (this.box.follow[3] - this.box.follow[1]) * this.scale / Math.sqrt(this.zoom);
    v.eachForce(k, (n, f) => {
      const factor = longest / v.data.forces.largest;
      const x = this.x(places[2 * n]), y = this.y(places[2 * n + 1]);
      rondo.arrow(context, x - f[0] * factor, y + f[1] * factor, x, y);
    });
  }
};

// A blue arrow with a seam that parts it from any colour beneath.
rondo.arrow = (context, x0, y0, x1, y1) => {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 0.5) return;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length], head = Math.min(7, 0.6 * length);
  for (const [wide, colour] of [[3.6, rondo.colour("card")], [1.8, rondo.colour("force")]]) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.moveTo(x1 - head * (ux - 0.5 * uy), y1 - head * (uy + 0.5 * ux));
    context.lineTo(x1, y1);
    context.lineTo(x1 - head * (ux + 0.5 * uy), y1 - head * (uy - 0.5 * ux));
    context.lineWidth = wide;
    context.strokeStyle = colour;
    context.stroke();
  }
};
