"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#3a8fc4", "#000000", "#7a3db8"];
const dashes = ["", "6 3", "2 2", "8 3 2 3"];
const names = data.designs.map(d => d.name);
const style = name => { const i = names.indexOf(name); return { colour: colours[i % colours.length], dash: dashes[Math.floor(i / colours.length) % dashes.length] }; };
const chosen = new Set(data.chosen);
const svg = (tag, attributes, parent) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const k in attributes) e.setAttribute(k, attributes[k]); if (parent) parent.appendChild(e); return e; };
const short = x => x === null || x === undefined ? "–" : x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(4)));

function ticks(low, high, log, most = 6) {
  if (log) { const list = []; for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); e++) for (const m of high / low > 1e3 ? [1] : [1, 2, 5]) { const v = m * 10 ** e; if (v >= low && v <= high) list.push(v); } return list; }
  const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(m => m * power).find(s => s >= raw), list = [];
  for (let i = Math.ceil(low / step); i * step <= high * (1 + 1e-12); i++) list.push(i * step);
  return list;
}

// A chart of curves or points: hover tells values, a drag zooms, a double click or Escape shows all.
class Chart {
  constructor(id, horizontal, vertical) {
    this.box = document.getElementById(id);
    if (!this.box) return;
    Object.assign(this, { horizontal, vertical, view: null, log: false, series: [] });
    this.width = Math.min(900, Math.max(340, this.box.clientWidth || 900)); this.right = this.width - 30;
    this.svg = svg("svg", { viewBox: `0 0 ${this.width} 400`, class: "chart", role: "img", tabindex: 0, "aria-label": vertical }, this.box);
    this.legend = document.createElement("p"); this.legend.className = "legend"; this.box.appendChild(this.legend);
    this.read = document.createElement("p"); this.read.className = "read"; this.box.appendChild(this.read);
    this.svg.addEventListener("pointermove", e => this.hover(e));
    this.svg.addEventListener("pointerdown", e => { this.from = this.at(e)[0]; });
    this.svg.addEventListener("pointerup", e => { const to = this.at(e)[0]; if (this.from !== undefined && Math.abs(to - this.from) > 12) { this.view = [this.value(Math.min(to, this.from)), this.value(Math.max(to, this.from))]; this.draw(); } this.from = undefined; });
    this.svg.addEventListener("dblclick", () => { this.view = null; this.draw(); });
    this.svg.addEventListener("keydown", e => { if (e.key === "Escape") { this.view = null; this.draw(); } else if (e.key === "ArrowRight" || e.key === "ArrowLeft") { this.cursor = Math.min(this.right, Math.max(70, (this.cursor || 70) + (e.key === "ArrowRight" ? 8 : -8))); this.tell(this.cursor, 200); e.preventDefault(); } });
  }
  at(e) { const r = this.svg.getBoundingClientRect(); return [(e.clientX - r.left) * this.width / r.width, (e.clientY - r.top) * 400 / r.height]; }
  value(px) { return this.x0 + (px - 70) / (this.right - 70) * (this.x1 - this.x0); }
  px(x) { return 70 + (this.right - 70) * (x - this.x0) / (this.x1 - this.x0); }
  py(y) { const f = this.log ? Math.log(y / this.y0) / Math.log(this.y1 / this.y0) : (y - this.y0) / (this.y1 - this.y0); return 350 - 330 * f; }
  show(series, vertical) { this.series = series; if (vertical) this.vertical = vertical; this.draw(); }
  // What each curve is; given designs on a front tell their names themselves.
  tellSeries() {
    this.legend.replaceChildren(...this.series.filter(s => s.line || !s.points).map(s => {
      const item = document.createElement("span"), mark = svg("svg", { viewBox: "0 0 28 8", width: 28, height: 8, "aria-hidden": true }, item);
      svg("line", { x1: 0, x2: 28, y1: 4, y2: 4, stroke: s.colour, "stroke-width": 2.5, "stroke-dasharray": s.dash || "" }, mark);
      item.append(" " + s.name);
      return item;
    }));
  }
  draw() {
    if (!this.box) return;
    this.svg.replaceChildren();
    this.tellSeries();
    const xs = this.series.flatMap(s => s.x); if (!xs.length) return;
    [this.x0, this.x1] = this.view || [Math.min(...xs), Math.max(...xs)];
    if (this.x0 === this.x1) this.x1 += 1;
    const ys = this.series.flatMap(s => s.y.filter((y, i) => y !== null && s.x[i] >= this.x0 && s.x[i] <= this.x1 && (!this.log || y > 0)));
    if (!ys.length) return;
    this.y1 = Math.max(...ys) * 1.05 || 1; this.y0 = this.log ? Math.max(Math.min(...ys) * 0.9, this.y1 * 1e-6) : Math.min(0, ...ys);
    for (const x of ticks(this.x0, this.x1, false, this.width < 600 ? 3 : 6)) { svg("line", { x1: this.px(x), x2: this.px(x), y1: 20, y2: 350, stroke: "#e3e7eb" }, this.svg); svg("text", { x: this.px(x), y: 367, "text-anchor": "middle" }, this.svg).textContent = short(x); }
    for (const y of ticks(this.y0, this.y1, this.log)) { svg("line", { x1: 70, x2: this.right, y1: this.py(y), y2: this.py(y), stroke: "#e3e7eb" }, this.svg); svg("text", { x: 64, y: this.py(y) + 4, "text-anchor": "end" }, this.svg).textContent = short(y); }
    svg("text", { x: (70 + this.right) / 2, y: 392, "text-anchor": "middle" }, this.svg).textContent = this.horizontal;
    svg("text", { x: 14, y: 185, "text-anchor": "middle", transform: "rotate(-90 14 185)" }, this.svg).textContent = this.vertical;
    const clip = svg("clipPath", { id: this.box.id + "-clip" }, svg("defs", {}, this.svg)); svg("rect", { x: 70, y: 10, width: this.right - 70, height: 340 }, clip);
    const inner = svg("g", { "clip-path": "url(#" + this.box.id + "-clip)" }, this.svg);
    for (const s of this.series) {
      if (s.points) { s.x.forEach((x, i) => { const c = svg("circle", { cx: this.px(x), cy: this.py(s.y[i]), r: s.size || 4, fill: s.hollow && s.hollow[i] ? "#fff" : s.colour, stroke: s.colour, "stroke-width": 1.5 }, inner); if (s.click) { c.style.cursor = "pointer"; c.addEventListener("click", () => s.click(i)); } }); if (!s.line) continue; }
      let path = "", pen = false;
      s.x.forEach((x, i) => { const y = s.y[i]; if (y === null || this.log && y <= 0) { pen = false; return; } path += (pen ? "L" : "M") + this.px(x).toFixed(2) + " " + this.py(y).toFixed(2); pen = true; });
      svg("path", { d: path, fill: "none", stroke: s.colour, "stroke-width": 1.8, "stroke-dasharray": s.dash || "" }, inner);
    }
    this.mark = svg("line", { y1: 20, y2: 350, stroke: "#57606a", "stroke-dasharray": "3 3", visibility: "hidden" }, this.svg);
  }
  hover(e) { const [px, py] = this.at(e); this.tell(px, py); }
  tell(px, py) {
    if (!this.mark || px < 70 || px > this.right) return;
    const points = this.series.find(s => s.points && s.tell);
    if (points) {
      let best = null;
      for (const s of this.series.filter(s => s.tell)) s.x.forEach((x, i) => { const d = Math.hypot(this.px(x) - px, this.py(s.y[i]) - py); if (!best || d < best.d) best = { d, s, i }; });
      this.read.textContent = best ? best.s.tell(best.i) : "";
      return;
    }
    const x = this.value(px);
    this.mark.setAttribute("x1", px); this.mark.setAttribute("x2", px); this.mark.setAttribute("visibility", "visible");
    const near = s => s.x.reduce((b, v, i) => Math.abs(v - x) < Math.abs(s.x[b] - x) ? i : b, 0);
    this.read.textContent = this.series.length ? short(this.series[0].x[near(this.series[0])]) + " rpm: " + this.series.map(s => s.name + " " + short(s.y[near(s)])).join(", ") : "";
  }
}

const response = new Chart("response", "speed, rpm", "");
const margin = new Chart("margin", "speed, rpm", "safety factor");
const front = new Chart("front", data.front ? data.front.x : "", data.front ? data.front.y : "");
const by = id => document.getElementById(id);

function showResponse() {
  const quantity = by("quantity").value, order = by("order").value, first = data.quantities[0].name;
  by("order").disabled = quantity !== first;
  const list = [];
  for (const name of names.filter(n => chosen.has(n))) {
    const own = data.sweeps[name] && data.sweeps[name][quantity];
    if (!own) continue;
    const y = order === "all" || quantity !== first ? own.total : own.orders[Number(order)];
    list.push({ name, x: data.speeds, y, ...style(name) });
  }
  const label = data.quantities.find(q => q.name === quantity).label + (order !== "all" && quantity === first ? ", order " + data.orders[Number(order)] : "");
  response.log = by("log").checked;
  response.show(list, label);
}
function showMargin() {
  if (!margin.box) return;
  const criterion = by("criterion").value;
  margin.show(names.filter(n => chosen.has(n) && data.margins[n]).map(name => ({ name, x: data.speeds, y: data.margins[name][criterion], ...style(name) })));
}
function showFront() {
  if (!front.box) return;
  const list = data.front.fronts.map((f, i) => ({ name: f.name, x: f.x, y: f.y, points: true, line: true, size: 3, hollow: f.dominated, colour: colours[i % colours.length], dash: dashes[1], tell: k => f.name + ": " + f.told[k], click: k => { by("picked").textContent = f.name + ": " + f.told[k]; } }));
  for (const d of data.designs.filter(d => d.front)) list.push({ name: d.name, x: [d.front[0]], y: [d.front[1]], points: true, size: chosen.has(d.name) ? 8 : 5, colour: style(d.name).colour, hollow: [!chosen.has(d.name)], tell: () => d.name + ": " + d.told, click: () => toggle(d.name) });
  front.show(list);
}
function showRows() {
  for (const row of document.querySelectorAll("tr[data-design]")) { const on = chosen.has(row.dataset.design); row.classList.toggle("chosen", on); const box = row.querySelector("input"); if (box) box.checked = on; }
}
function show() { showRows(); showResponse(); showMargin(); showFront(); }
function toggle(name) { if (chosen.has(name)) chosen.delete(name); else chosen.add(name); show(); }

for (const row of document.querySelectorAll("tr[data-design]")) {
  const box = row.querySelector("input");
  if (!box) continue;
  row.querySelector(".swatch").style.background = style(row.dataset.design).colour;
  box.addEventListener("change", () => toggle(row.dataset.design));
}
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
for (const id of ["quantity", "order", "log"]) by(id).addEventListener("change", showResponse);
if (by("criterion")) by("criterion").addEventListener("change", showMargin);
show();
