"use strict";
// Heads of tables sort; what is typed beside a table leaves the rows that hold it.
for (const table of document.querySelectorAll("table.sorts")) table.querySelectorAll("th").forEach((head, column) => {
  const button = document.createElement("button"); button.textContent = head.textContent; head.replaceChildren(button);
  button.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending", rows = [...table.tBodies[0].rows], key = r => r.cells[column].textContent.trim();
    table.querySelectorAll("th").forEach(h => h.removeAttribute("aria-sort")); head.setAttribute("aria-sort", down ? "descending" : "ascending");
    rows.sort((a, b) => { const x = parseFloat(key(a)), y = parseFloat(key(b)), c = isNaN(x) || isNaN(y) ? (isNaN(x) ? 1 : 0) - (isNaN(y) ? 1 : 0) || key(a).localeCompare(key(b)) : x - y; return down ? -c : c; });
    table.tBodies[0].append(...rows);
  });
});
for (const filter of document.querySelectorAll("input[type=search]")) filter.addEventListener("input", () => { for (const row of document.getElementById(filter.dataset.of).tBodies[0].rows) row.hidden = !row.textContent.toLowerCase().includes(filter.value.toLowerCase()); });
// Lengths in inches where the reader wants them: in columns of millimetres, and in what was printed.
{
  const texts = [...document.querySelectorAll("pre")].filter(p => /[0-9] mm(?![²³a-z])/.test(p.textContent));
  const heads = [...document.querySelectorAll("table.sorts th")].filter(h => /(_|, )mm$/.test(h.textContent));
  const inches = (text, of) => text.replace(of, (_, v) => Number((v / 25.4).toPrecision(4)) + (of.source.includes("mm") ? " in" : ""));
  const number = /^(-?[0-9]+(?:\.[0-9]+)?(?:e[+-]?[0-9]+)?)$/;
  const at = (table, name) => [...table.querySelectorAll("th")].findIndex(h => h.textContent === name);
  const rows = [...document.querySelectorAll("table.sorts")].flatMap(t => { const unit = at(t, "unit"), value = at(t, "value"); return unit < 0 || value < 0 ? [] : [...t.tBodies[0].rows].map(r => [r.cells[unit], r.cells[value]]).filter(r => r[0].textContent === "mm"); });
  if (texts.length + heads.length + rows.length) {
    const label = document.createElement("label"), box = document.createElement("input");
    box.type = "checkbox"; box.id = "inches"; label.append(box, " lengths in inches");
    document.querySelector("h1").after(label);
    const put = (e, own) => { if (e.dataset.metric === undefined) e.dataset.metric = e.textContent; e.textContent = box.checked ? own(e.dataset.metric) : e.dataset.metric; };
    box.addEventListener("change", () => {
      for (const [unit, value] of rows) { put(unit, () => "in"); put(value, text => inches(text, number)); }
      for (const p of texts) put(p, text => inches(text, /([0-9]+(?:\.[0-9]+)?) mm(?![²³a-z])/g));
      for (const h of heads) { put(h.querySelector("button"), text => text.replace(/mm$/, "in")); for (const row of h.closest("table").tBodies[0].rows) put(row.cells[h.cellIndex], text => inches(text, number)); }
    });
  }
}
