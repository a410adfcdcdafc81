const data = JSON.parse(document.getElementById("data").textContent);
const colours = [0, 1, 2, 3, 4, 5, 6, 7].map(i => "var(--c" + i + ")");
const dashes = ["", "6 3", "2 2", "8 3 2 3"];
const names = data.designs.map(d => d.name);
const style = name => { const i = names.indexOf(name); return { colour: colours[i % colours.length], dash: dashes[Math.floor(i / colours.length) % dashes.length] }; };
const chosen = new Set(data.chosen);
const svg = (tag, attributes, parent) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const k in attributes) if (String(attributes[k]).startsWith("var(")) e.style.setProperty(k, attributes[k]); else e.setAttribute(k, attributes[k]); if (parent) parent.appendChild(e); return e; };
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
  show(series, vertical, unit) { this.series = series; this.unit = unit; if (vertical) { this.vertical = vertical; this.svg.setAttribute("aria-label", vertical); } this.draw(); }
  // What each curve is; given designs on a front tell their names themselves.
  tellSeries() {
    this.legend.replaceChildren(...this.series.filter(s => !s.quiet && (s.line || !s.points)).map(s => {
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
    // points need room on all sides
    const room = this.x1 - this.x0; if (this.room && !this.view) { this.x0 -= 0.04 * room; this.x1 += 0.04 * room; }
    const ys = this.series.flatMap(s => s.y.filter((y, i) => y !== null && s.x[i] >= this.x0 && s.x[i] <= this.x1 && (!this.log || y > 0)));
    if (!ys.length) return;
    this.y1 = Math.max(...ys) * 1.05 || 1; this.y0 = this.log ? Math.max(Math.min(...ys) * 0.9, this.y1 * 1e-6) : Math.min(0, ...ys);
    const least = Math.min(...ys); if (this.room && least > 0.3 * this.y1) this.y0 = least - 0.08 * (this.y1 - least);
    if (this.stations) {
      const step = Math.ceil(this.stations.length / (this.width < 600 ? 8 : 16));
      this.stations.forEach((name, i) => { if (i % step) return; const x = this.px(i + 1); svg("line", { x1: x, x2: x, y1: 20, y2: 350, stroke: "var(--grid)" }, this.svg); svg("text", { x, y: 364, "text-anchor": "end", transform: "rotate(-25 " + x + " 364)" }, this.svg).textContent = name.length > 15 ? name.slice(0, 14) + "…" : name; });
    } else for (const x of ticks(this.x0, this.x1, false, this.width < 600 ? 3 : 6)) { svg("line", { x1: this.px(x), x2: this.px(x), y1: 20, y2: 350, stroke: "var(--grid)" }, this.svg); svg("text", { x: this.px(x), y: 367, "text-anchor": "middle" }, this.svg).textContent = short(x); }
    for (const y of ticks(this.y0, this.y1, this.log)) { svg("line", { x1: 70, x2: this.right, y1: this.py(y), y2: this.py(y), stroke: "var(--grid)" }, this.svg); svg("text", { x: 64, y: this.py(y) + 4, "text-anchor": "end" }, this.svg).textContent = short(y); }
    svg("text", { x: (70 + this.right) / 2, y: 392, "text-anchor": "middle" }, this.svg).textContent = this.horizontal;
    svg("text", { x: 14, y: 185, "text-anchor": "middle", transform: "rotate(-90 14 185)" }, this.svg).textContent = this.vertical;
    if (this.band) { const [a, b] = this.band.map(x => Math.min(this.right, Math.max(70, this.px(x)))); svg("rect", { x: a, width: b - a, y: 20, height: 330, fill: "var(--c0)", opacity: 0.07 }, this.svg); }
    const clip = svg("clipPath", { id: this.box.id + "-clip" }, svg("defs", {}, this.svg)); const dot = this.stations ? 5 : 0; svg("rect", { x: 70 - dot, y: 10, width: this.right - 70 + 2 * dot, height: 340 + dot }, clip);
    const inner = svg("g", { "clip-path": "url(#" + this.box.id + "-clip)" }, this.svg);
    const ends = [];
    for (const s of this.series) {
      if (s.points) { s.x.forEach((x, i) => { const c = svg("circle", { cx: this.px(x), cy: this.py(s.y[i]), r: s.size || 4, fill: s.hollow && s.hollow[i] ? "var(--back)" : s.colour, stroke: s.colour, "stroke-width": 1.5 }, inner); if (s.click) { c.style.cursor = "pointer"; c.addEventListener("click", () => s.click(i)); } }); if (!s.line) continue; }
      let path = "", pen = false;
      s.x.forEach((x, i) => { const y = s.y[i]; if (y === null || this.log && y <= 0) { pen = false; return; } path += (pen ? "L" : "M") + this.px(x).toFixed(2) + " " + this.py(y).toFixed(2); pen = true; });
      svg("path", { d: path, fill: "none", stroke: s.colour, "stroke-width": s.thin ? 0.8 : 1.8, "stroke-dasharray": s.dash || "" }, inner);
      const last = s.x.length - 1, ex = this.px(s.x[last]), ey = this.py(s.y[last]);
      // labels that would cover another are left out
      const free = s.end && ex > 70 && ex <= this.right + 1 && ey >= 10 && ey <= 351 && !ends.some(([x, y]) => Math.abs(x - ex) < 8 + 7 * s.end.length && Math.abs(y - ey) < 12);
      if (free) ends.push([ex, ey]);
      if (free) svg("text", { x: ex + 3, y: ey + 3 }, this.svg).textContent = s.end;
    }
    this.mark = svg("line", { y1: 20, y2: 350, stroke: "var(--soft)", "stroke-dasharray": "3 3", visibility: "hidden" }, this.svg);
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
    this.read.textContent = this.series.length ? short(this.series[0].x[near(this.series[0])]) + " rpm: " + this.series.map(s => s.name + " " + short(s.y[near(s)]) + (this.unit ? " " + this.unit : "")).join(", ") : "";
  }
}

const response = new Chart("response", "speed, rpm", "");
const margin = new Chart("margin", "speed, rpm", "safety factor");
const campbell = new Chart("campbell", "speed, rpm", "frequency, Hz");
const shape = new Chart("shape", "", "relative angle");
shape.stations = data.modes.stations;
const front = new Chart("front", "", "");
front.room = true;
const by = id => document.getElementById(id);
// The unit that the reader has chosen in place of one of the tables, and the factor to it.
const chosenUnit = unit => unit === "°" && by("radians").checked ? ["rad", Math.PI / 180] : [unit, 1];

function showResponse() {
  const quantity = by("quantity").value, order = by("order").value, first = data.quantities[0].name;
  by("order").disabled = quantity !== first;
  const known = data.quantities.find(q => q.name === quantity), [unit, factor] = chosenUnit(known.unit), list = [];
  for (const name of names.filter(n => chosen.has(n))) {
    const own = data.sweeps[name] && data.sweeps[name][quantity];
    if (!own) continue;
    const y = order === "all" || quantity !== first ? own.total : own.orders[Number(order)];
    list.push({ name, x: data.speeds, y: y.map(v => v === null ? null : v * factor), ...style(name) });
  }
  const label = known.label + ", " + unit + (order !== "all" && quantity === first ? ", order " + data.orders[Number(order)] : "");
  response.log = by("log").checked;
  response.show(list, label, unit);
}
function showMargin() {
  if (!margin.box) return;
  const criterion = by("criterion").value;
  margin.show(names.filter(n => chosen.has(n) && data.margins[n]).map(name => ({ name, x: data.speeds, y: data.margins[name][criterion], ...style(name) })));
}
function showFront() {
  if (!front.box) return;
  const f = data.fronts[Number(by("fronts").value)];
  const turned = axis => { const of = axis.match(/, (°)$/), [unit, factor] = chosenUnit(of ? of[1] : ""); return [of ? axis.slice(0, -1) + unit : axis, v => v * factor]; };
  const [horizontal, right] = turned(f.x), [vertical, up] = turned(f.y);
  front.horizontal = horizontal; front.vertical = vertical;
  const list = f.fronts.map((g, i) => ({ name: g.name, x: g.x.map(right), y: g.y.map(up), points: true, line: true, size: 3, hollow: g.dominated, colour: colours[i % colours.length], dash: dashes[1], tell: k => g.name + ": " + g.told[k], click: k => { by("picked").textContent = g.name + ": " + g.told[k]; } }));
  // designs far out would hide what the front tells
  const far = [list.flatMap(s => s.x), list.flatMap(s => s.y)].map(v => 2 * Math.max(...v) - Math.min(...v));
  for (const d of data.designs.filter(d => f.designs[d.name])) {
    const [x, y] = f.designs[d.name], at = [right(x), up(y)];
    if (at[0] <= far[0] && at[1] <= far[1]) list.push({ name: d.name, x: [at[0]], y: [at[1]], points: true, size: chosen.has(d.name) ? 8 : 5, colour: style(d.name).colour, hollow: [!chosen.has(d.name)], tell: () => d.name + ": " + d.told, click: () => toggle(d.name) });
  }
  front.show(list);
}
// Order lines, natural frequencies of the chain and of the chosen designs, and where they meet.
function showCampbell() {
  const modes = data.modes, low = Math.min(...data.speeds), high = Math.max(...data.speeds), right = 1.03 * high;
  const reached = Math.max(0, ...modes.orders.map(o => o.hz_per_rpm)) * high;
  const systems = [{ name: modes.alone, frequencies: modes.chain, colour: "var(--soft)", dash: "" }];
  for (const name of names.filter(n => chosen.has(n) && modes.designs[n])) systems.push({ name, frequencies: modes.designs[name], ...style(name) });
  for (const s of systems) s.frequencies = s.frequencies.filter(f => f <= reached);
  const top = 1.05 * Math.max(...systems.flatMap(s => s.frequencies), modes.chain[0] || 1), list = [];
  for (const o of modes.orders) { const end = Math.min(right, top / o.hz_per_rpm); list.push({ name: "order " + o.name, quiet: true, thin: true, end: o.name, x: [0, end], y: [0, end * o.hz_per_rpm], colour: "var(--edge)" }); }
  for (const s of systems) {
    s.frequencies.forEach((f, i) => list.push({ name: s.name, quiet: i > 0, x: [0, right], y: [f, f], colour: s.colour, dash: s.dash }));
    const met = modes.orders.flatMap(o => s.frequencies.map((f, mode) => ({ order: o.name, f, mode, speed: f / o.hz_per_rpm }))).filter(m => m.speed >= low && m.speed <= high);
    list.push({ name: s.name, quiet: true, points: true, size: 4, colour: s.colour, x: met.map(m => m.speed), y: met.map(m => m.f), tell: i => s.name + ": order " + met[i].order + " meets " + short(met[i].f) + " Hz at " + short(met[i].speed) + " rpm", click: i => { if (s === systems[0] && shape.box && met[i].mode < modes.shapes.length) { by("mode").value = met[i].mode; showShape(); } } });
  }
  campbell.band = [low, high];
  campbell.show(list);
}
function showShape() {
  const mode = shape.box && data.modes.shapes[Number(by("mode").value)];
  if (!mode) return;
  shape.show([{ name: short(mode.hz) + " Hz", points: true, line: data.modes.row, x: mode.angles.map((_, i) => i + 1), y: mode.angles, colour: "var(--soft)", tell: i => data.modes.stations[i] + ": " + short(mode.angles[i]) }]);
}
// Columns of angles in the unit chosen.
function showUnits() {
  for (const head of document.querySelectorAll("table.sorts th")) {
    const button = head.querySelector("button"), own = head.dataset.own || button.textContent, of = own.match(/, (°)$/);
    if (!of) continue;
    head.dataset.own = own;
    const [unit, factor] = chosenUnit(of[1]);
    button.textContent = own.slice(0, -of[1].length) + unit;
    for (const row of head.closest("table").tBodies[0].rows) {
      const cell = row.cells[head.cellIndex];
      if (cell.dataset.own === undefined) cell.dataset.own = cell.textContent;
      cell.textContent = factor === 1 ? cell.dataset.own : cell.dataset.own.replace(/[0-9]+(\.[0-9]+)?(e[+-]?[0-9]+)?/g, v => short(Number(v) * factor));
    }
  }
  showResponse(); showFront();
}
function showRows() {
  for (const row of document.querySelectorAll("tr[data-design]")) { const on = chosen.has(row.dataset.design); row.classList.toggle("chosen", on); const box = row.querySelector("input"); if (box) box.checked = on; }
}
function show() { showRows(); showResponse(); showMargin(); showFront(); showCampbell(); }
function toggle(name) { if (chosen.has(name)) chosen.delete(name); else chosen.add(name); show(); }

for (const row of document.querySelectorAll("tr[data-design]")) {
  const box = row.querySelector("input");
  if (!box) continue;
  row.querySelector(".swatch").style.background = style(row.dataset.design).colour;
  box.addEventListener("change", () => toggle(row.dataset.design));
}
for (const id of ["quantity", "order", "log"]) by(id).addEventListener("change", showResponse);
by("radians").addEventListener("change", showUnits);
if (shape.box) data.modes.shapes.forEach((s, i) => { const o = document.createElement("option"); o.value = i; o.textContent = (i + 1) + ": " + short(s.hz) + " Hz"; by("mode").append(o); });
if (shape.box) by("mode").addEventListener("change", showShape);
data.fronts.forEach((f, i) => { const o = document.createElement("option"); o.value = i; o.textContent = f.title; by("fronts").append(o); });
if (front.box) by("fronts").addEventListener("change", showFront);
if (by("criterion")) by("criterion").addEventListener("change", showMargin);
show();
showShape();
