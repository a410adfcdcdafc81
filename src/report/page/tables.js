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
