// SPDX-License-Identifier: BSD-3-Clause
// Tables that are sorted by a click on a column's name. What has no number stands last.
"use strict";

for (const table of document.querySelectorAll("table.sortable")) {
  const heads = [...table.querySelectorAll("thead th")];
  const value = (row, column) => {
    const cell = row.cells[column];
    return "value" in cell.dataset ? Number(cell.dataset.value) : cell.textContent;
  };
  const compare = (a, b) => {
    if (typeof a !== "number" || typeof b !== "number") return String(a).localeCompare(String(b), "en");
    if (Number.isNaN(a) || Number.isNaN(b)) return 0;
    return a - b;
  };
  heads.forEach((head, column) => head.querySelector("button").addEventListener("click", () => {
    const up = head.getAttribute("aria-sort") !== "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const rows = [...table.tBodies[0].rows];
    rows.sort((one, other) => {
      const [a, b] = [value(one, column), value(other, column)];
      const lacks = Number(Number.isNaN(a)) - Number(Number.isNaN(b));
      return lacks || (up ? 1 : -1) * compare(a, b);
    });
    table.tBodies[0].append(...rows);
  }));
}
