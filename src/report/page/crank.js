// The modes of a flexible crank on its bearings: its line at rest and moving, with a disc and a spoke at both ends, seen obliquely.
const crank = data.modes.crank;
if (crank) {
  const [width, height] = [900, 360], box = by("crank"), picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "chart", role: "img" }, box);
  const seen = ([x, y, z]) => [z + 0.4 * y, -x + 0.3 * y];
  const ends = [crank.places[0][2], crank.places[crank.places.length - 1][2]], reach = 0.08 * Math.abs(ends[1] - ends[0]), disc = crank.radius;
  const room = disc + reach, corners = ends.flatMap(z => [[-room, -room, z], [-room, room, z], [room, -room, z], [room, room, z]]).map(seen);
  const [left, right, top, bottom] = [Math.min(...corners.map(c => c[0])), Math.max(...corners.map(c => c[0])), Math.min(...corners.map(c => c[1])), Math.max(...corners.map(c => c[1]))];
  const scale = Math.min(width / (right - left), height / (bottom - top));
  const drawn = points => points.map(p => { const [h, v] = seen(p); return ((h - (left + right) / 2) * scale + width / 2).toFixed(1) + "," + ((v - (top + bottom) / 2) * scale + height / 2).toFixed(1); }).join(" ");
  const line = (colour, thick) => svg("polyline", { fill: "none", stroke: colour, "stroke-width": thick, "vector-effect": "non-scaling-stroke", "stroke-linejoin": "round" }, picture);
  // A point of the body of a node: what it moves by its translation and its small rotation.
  const moved = (node, arm, motion, much) => { const p = crank.places[node], [u, v, w, a, b, c] = motion[node]; return [p[0] + arm[0] + much * (u + b * arm[2] - c * arm[1]), p[1] + arm[1] + much * (v + c * arm[0] - a * arm[2]), p[2] + arm[2] + much * (w + a * arm[1] - b * arm[0])]; };
  const centre = [0, 0, 0], round = [...Array(33).keys()].map(i => [disc * Math.cos(i * Math.PI / 16), disc * Math.sin(i * Math.PI / 16), 0]);
  const parts = [crank.places.map((_, i) => [i, centre]), ...crank.discs.map(node => [[node, centre], ...round.map(arm => [node, arm])])];
  const rest = parts.map(() => line("var(--edge)", 1)), moving = parts.map(() => line("var(--c0)", 2));
  const put = (lines, motion, much) => parts.forEach((part, k) => lines[k].setAttribute("points", drawn(part.map(([node, arm]) => moved(node, arm, motion, much)))));
  const play = by("moving"), chosenMode = by("crankmode");
  let started = 0;
  const mode = () => crank.modes[Number(chosenMode.value)];
  const frame = time => { started ||= time; put(moving, mode().motion, reach * (play.checked ? Math.cos((time - started) * 2 * Math.PI / 2000) : 1)); if (play.checked) requestAnimationFrame(frame); };
  const showMode = () => { picture.setAttribute("aria-label", mode().name); if (!play.checked) frame(0); };
  crank.modes.forEach((m, i) => { const o = document.createElement("option"); o.value = i; o.textContent = m.name; chosenMode.append(o); });
  put(rest, crank.modes[0].motion, 0);
  play.checked = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  chosenMode.addEventListener("change", showMode);
  play.addEventListener("change", () => { started = 0; requestAnimationFrame(frame); });
  addEventListener("beforeprint", () => put(moving, mode().motion, reach));
  showMode();
  requestAnimationFrame(frame);
}
