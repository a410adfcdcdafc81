// A plot of any two columns.
{
  const data = JSON.parse(document.getElementById("data").textContent), names = Object.keys(data.columns), byId = id => document.getElementById(id);
  const put = (select, list, chosen) => { for (const name of list) { const o = document.createElement("option"); o.textContent = name; select.append(o); } if (chosen !== undefined) select.value = chosen; };
  const across = byId("across"), up = byId("up"), of = byId("of"), designs = [...new Set(data.design)].filter(d => d);
  put(across, names, data.across ?? names[0]); put(up, names, names.includes(data.up) ? data.up : names[0]); put(of, ["all", ...designs]);
  const ns = "http://www.w3.org/2000/svg", W = 960, H = 420, L = 80, R = 20, T = 15, B = 45;
  const make = (tag, attributes, text) => { const e = document.createElementNS(ns, tag); for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v); if (text !== undefined) e.textContent = text; return e; };
  const short = x => Number(x.toPrecision(4)).toString();
  const ticks = (a, b) => { const raw = (b - a) / 6, ten = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(k => k * ten).find(s => s >= raw); const list = []; for (let i = Math.ceil(a / step); i * step <= b + 1e-9 * step; i++) list.push(i * step); return list; };
  const draw = () => {
    const x = data.columns[across.value], y = data.columns[up.value];
    const rows = x.map((_, i) => i).filter(i => x[i] !== null && y[i] !== null && (of.value === "all" || data.design[i] === of.value));
    byId("drawn").textContent = `${rows.length} points of ${data.rows} rows`;
    const box = byId("scatter"); box.replaceChildren();
    if (!rows.length) return;
    const range = list => { let a = Math.min(...list), b = Math.max(...list); if (!(b > a)) { const d = Math.abs(a) || 1; a -= d / 10; b += d / 10; } const m = (b - a) * .03; return [a - m, b + m]; };
    const [x0, x1] = range(rows.map(i => x[i])), [y0, y1] = range(rows.map(i => y[i]));
    const px = v => L + (v - x0) / (x1 - x0) * (W - L - R), py = v => H - B - (v - y0) / (y1 - y0) * (H - T - B);
    const svg = make("svg", { viewBox: `0 0 ${W} ${H}`, class: "chart", role: "img", "aria-label": `${up.value} over ${across.value}` });
    for (const t of ticks(x0, x1)) svg.append(make("line", { x1: px(t), x2: px(t), y1: T, y2: H - B, stroke: "var(--grid)" }), make("text", { x: px(t), y: H - B + 16, "text-anchor": "middle" }, short(t)));
    for (const t of ticks(y0, y1)) svg.append(make("line", { x1: L, x2: W - R, y1: py(t), y2: py(t), stroke: "var(--grid)" }), make("text", { x: L - 6, y: py(t) + 4, "text-anchor": "end" }, short(t)));
    svg.append(make("text", { x: (L + W - R) / 2, y: H - 8, "text-anchor": "middle" }, across.value), make("text", { x: 14, y: (T + H - B) / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${(T + H - B) / 2})` }, up.value));
    for (const i of rows) {
      const c = make("circle", { cx: px(x[i]), cy: py(y[i]), r: 2.5, fill: `var(--c${Math.max(0, designs.indexOf(data.design[i])) % 8})`, "fill-opacity": .7 });
      c.addEventListener("pointerenter", () => { byId("read").textContent = `${data.design[i]}: ` + names.filter(n => data.columns[n][i] !== null).map(n => `${n} ${short(data.columns[n][i])}`).join("; "); });
      svg.append(c);
    }
    box.append(svg);
    const legend = document.createElement("div"); legend.className = "legend";
    for (const [k, d] of designs.entries()) { const s = document.createElement("span"), w = document.createElement("span"); w.className = "swatch"; w.style.background = `var(--c${k % 8})`; s.append(w, d); legend.append(s); }
    box.append(legend);
  };
  for (const s of [across, up, of]) s.addEventListener("change", draw);
  draw();
}
