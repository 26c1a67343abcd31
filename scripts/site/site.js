// SPDX-License-Identifier: BSD-3-Clause
// Draws the equations.
document.querySelectorAll(".arithmatex").forEach(function (element) {
  const text = element.textContent.trim();
  const display = text.startsWith("\\[");
  katex.render(text.slice(2, -2), element, { displayMode: display, throwOnError: false });
});
