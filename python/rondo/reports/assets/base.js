// SPDX-License-Identifier: BSD-3-Clause
// What all parts of the page share: data, colours of the theme, small elements.
"use strict";

rondo.dark = window.matchMedia("(prefers-color-scheme: dark)");

rondo.data = (name) => JSON.parse(document.getElementById("data-" + name).textContent);

rondo.colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

rondo.TYPES = {int16: Int16Array, uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array,
               float32: Float32Array};

// The numbers of an array that encoding.py has packed.
rondo.unpack = async (packed) => {
  const Type = rondo.TYPES[packed.type];
  const count = packed.shape.reduce((a, b) => a * b, 1);
  const raw = Uint8Array.from(atob(packed.data), (letter) => letter.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("deflate"));
  const apart = new Uint8Array(await new Response(stream).arrayBuffer());
  const size = Type.BYTES_PER_ELEMENT, bytes = new Uint8Array(count * size);
  for (let b = 0; b < size; ++b)
    for (let k = 0, from = b * count; k < count; ++k) bytes[k * size + b] = apart[from + k];
  const values = new Type(bytes.buffer);
  if (packed.differences) {
    const row = count / packed.shape[0];
    for (let k = row; k < count; ++k) values[k] += values[k - row];  // wraps round as it did before
  }
  return values;
};

rondo.element = (tag, attributes = {}, ...inside) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null) made.setAttribute(name, value);
  }
  made.append(...inside);
  return made;
};

rondo.select = (words, choices, chosen, change) => {
  const box = rondo.element("select");
  for (const [value, text] of choices) {
    const option = rondo.element("option", {value}, text);
    option.selected = String(value) === String(chosen);
    box.append(option);
  }
  box.addEventListener("change", () => change(box.value));
  return {box, label: rondo.element("label", {}, words + " ", box)};
};

rondo.checkbox = (words, checked, change) => {
  const box = rondo.element("input", {type: "checkbox", checked});
  box.addEventListener("change", () => change(box.checked));
  return rondo.element("label", {}, box, " " + words);
};

// A number to read, as encoding.number has it.
rondo.number = (value, digits = 3) => {
  const size = Math.abs(value);
  if (size && (size < 1e-3 || size >= 1e6)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    const raised = [...exponent.replace("+", "")].map((sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]);
    return (Number(mantissa) + "·10" + raised.join("")).replace("-", "−");
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
};

rondo.scaled = (value, unit) => {
  const [factor, prefix] = value >= 1e6 ? [1e-6, "M"] : value >= 1e3 ? [1e-3, "k"] : [1, ""];
  return `${rondo.number(value * factor)} ${prefix}${unit}`;
};

// The browser is to blame only where it lacks what numbers are unpacked with.
rondo.refuse = (place, reason) => {
  const why = "DecompressionStream" in window ? "This cannot be shown: " + reason + ". Please report it: this is a fault of rondo."
    : "This cannot be shown: a browser of 2023 or later is needed (Firefox 113, Chrome or Edge 80, Safari 16.4).";
  place.append(rondo.element("p", {class: "note"}, why));
};
