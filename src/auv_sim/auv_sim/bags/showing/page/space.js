"use strict";
/* The view in three dimensions: path and track between surface and bottom. It shares the page's time. */
(() => {
  const S = D.space, COUNT = 24, MOST = 5000;
  const card = document.createElement("div"); card.className = "card";
  const modes = S.colours.map((c, k) => `<option value="${k}">${esc(c.label)}</option>`).join("");
  card.innerHTML = `<div class="head"><strong>In three dimensions</strong><span id="spacekeys"></span></div>
    <canvas id="space" tabindex="0" role="img" aria-label="path and track in three dimensions"></canvas>
    <div class="tools"><label>colour <select id="spacecolour">${modes}<option value="-1">none</option></select></label>
      <label>depths <select id="spacestretch">${[1, 2, 5, 10, 20].map(k => `<option value="${k}">\u00d7 ${k}</option>`).join("")}</select></label>
      <button id="spaceabove">from above</button><button id="spaceside">from the side</button><button id="spaceall">all</button></div>
    <p class="hint">Drag: turn. Shift and drag: move. Wheel: zoom. Double click: all. Click: the nearest moment.
      Keys, once the view is selected: arrows turn, + and \u2212 zoom, t from above, s from the side, v depths, c colour, 0 all.</p>`;
  $("track").closest(".card").before(card);
  const canvas = $("space"), line3 = p => p && { x: decode(p.x), y: decode(p.y), z: decode(p.z) };
  const way = line3(S.path), bottom = line3(S.bottom), Z = C.depth;
  const mesh = S.mesh && { ...S.mesh, z: decode(S.mesh.z) };
  const finite = v => Array.from(v).filter(Number.isFinite);
  const span = (...lists) => lists.flatMap(finite).reduce((m, u) => [Math.min(m[0], u), Math.max(m[1], u)], [Infinity, -Infinity]);
  const step = Math.max(1, Math.ceil(N / MOST)), thin = v => Float32Array.from({ length: Math.ceil(N / step) }, (_, k) => v[k * step]);
  const box = { n: span(way ? way.x : [], thin(TX)), e: span(way ? way.y : [], thin(TY)), d: span([0], way ? way.z : [], thin(Z), bottom ? bottom.z : [], mesh ? mesh.z : []) };
  const size = key => box[key][1] - box[key][0], larger = Math.max(size("n"), size("e"));
  for (const key of ["n", "e"]) { const pad = Math.max(2, 0.04 * size(key), 0.5 * (0.35 * larger - size(key))); box[key] = [box[key][0] - pad, box[key][1] + pad]; }
  box.d[1] = Math.max(box.d[1] * 1.05, box.d[0] + 1);
  /* The longer side lies across the picture. */
  const extent = Math.hypot(size("n"), size("e")), fresh = () => ({ heading: size("n") > size("e") ? 5.2 : 0.5, tilt: 0.42, stretch: stretchFor(extent, box.d[1]), zoom: 1, right: 0, up: 0 });
  let view = fresh(), mode = 0, ranges = S.colours.map(c => colourRange(C[c.name], c.signed)), shown = null;
  $("spacestretch").value = view.stretch;
  const mix = (a, b, t) => a.map((v, k) => Math.round(v + (b[k] - v) * t)), ramp = (stops, t) => { const at = t * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(at)); return `rgb(${mix(stops[k], stops[k + 1], at - k)})`; };
  const ONE = [[43, 108, 176], [42, 157, 111], [224, 169, 26], [200, 55, 74]], TWO = [[43, 108, 176], [150, 190, 220], [165, 165, 165], [235, 170, 130], [200, 55, 74]];
  const colour = k => ramp(S.colours[mode].signed ? TWO : ONE, k / (COUNT - 1));

  function scene(w, h) {
    const middle = [(box.n[0] + box.n[1]) / 2, (box.e[0] + box.e[1]) / 2, (box.d[0] + box.d[1]) / 2], corners = [];
    for (const n of box.n) for (const e of box.e) for (const d of box.d) corners.push(project(view, n - middle[0], e - middle[1], d - middle[2]));
    const wide = Math.max(...corners.map(c => Math.abs(c[0]))), tall = Math.max(...corners.map(c => Math.abs(c[1])));
    const scale = Math.min((w - 150) / (2 * wide), (h - 120) / (2 * tall)) * view.zoom;
    const at = (n, e, d) => { const p = project(view, n - middle[0], e - middle[1], d - middle[2]); return [w / 2 + 25 + (p[0] - view.right) * scale, h / 2 + 5 - (p[1] - view.up) * scale, p[2]]; };
    return { at, scale };
  }
  function stroke(g, at, xs, ys, zs, n, color, width, dash = []) {
    g.strokeStyle = color; g.lineWidth = width; g.lineJoin = g.lineCap = "round"; g.setLineDash(dash); g.beginPath(); let pen = false;
    for (let k = 0; k < n; k++) { const z = zs.length ? zs[k] : zs; if (!Number.isFinite(xs[k]) || !Number.isFinite(z)) { pen = false; continue; }
      const [x, y] = at(xs[k], ys[k], z); pen ? g.lineTo(x, y) : g.moveTo(x, y); pen = true; }
    g.stroke(); g.setLineDash([]);
  }
  const segment = (g, at, a, b) => { const p = at(...a), q = at(...b); g.beginPath(); g.moveTo(p[0], p[1]); g.lineTo(q[0], q[1]); g.stroke(); };
  function plane(g, at, depth, fill, edge, grid) {
    const [n0, n1] = box.n, [e0, e1] = box.e, ring = [[n0, e0], [n0, e1], [n1, e1], [n1, e0]].map(([n, e]) => at(n, e, depth));
    g.beginPath(); ring.forEach((p, k) => k ? g.lineTo(p[0], p[1]) : g.moveTo(p[0], p[1])); g.closePath();
    if (fill) { g.globalAlpha = 0.08; g.fillStyle = fill; g.fill(); g.globalAlpha = 1; }
    g.strokeStyle = edge; g.lineWidth = 1; g.stroke();
    if (!grid) return;
    for (const n of ticks(n0, n1, 6)[0]) if (n > n0 && n < n1) segment(g, at, [n, e0, depth], [n, e1, depth]);
    for (const e of ticks(e0, e1, 6)[0]) if (e > e0 && e < e1) segment(g, at, [n0, e, depth], [n1, e, depth]);
  }
  function scales(g, at) {
    /* Depth at the vertical edge that is farthest to the left; north and east at the edges of the floor nearest to the viewer. */
    const floor = box.d[1], edges = box.n.flatMap(n => box.e.map(e => [n, e])), left = edges.reduce((a, b) => at(...b, floor)[0] < at(...a, floor)[0] ? b : a);
    g.fillStyle = css("muted"); g.strokeStyle = css("line"); g.lineWidth = 1; segment(g, at, [...left, 0], [...left, floor]);
    const [ds, dd] = ticks(0, floor, 5); g.textAlign = "right"; g.textBaseline = "middle"; let last = Infinity;
    for (const d of ds) { const p = at(...left, d); if (Math.abs(p[1] - last) < 11) continue; last = p[1]; g.fillText(d.toFixed(dd), p[0] - 7, p[1]); g.beginPath(); g.moveTo(p[0] - 4, p[1]); g.lineTo(p[0], p[1]); g.stroke(); }
    const deepest = at(...left, floor); g.fillText("depth (m)", deepest[0] - 7, deepest[1] + 14);
    if (Math.sin(view.tilt) < 0.05) return;
    const near = k => { const a = at(box.n[0], (box.e[0] + box.e[1]) / 2, floor), b = at(box.n[1], (box.e[0] + box.e[1]) / 2, floor), c = at((box.n[0] + box.n[1]) / 2, box.e[0], floor), d = at((box.n[0] + box.n[1]) / 2, box.e[1], floor);
      return k === "n" ? (c[1] > d[1] ? box.e[0] : box.e[1]) : (a[1] > b[1] ? box.n[0] : box.n[1]); };
    g.textAlign = "center"; g.textBaseline = "top";
    const [ns, nd] = ticks(...box.n, 5), [es, ed] = ticks(...box.e, 5), e = near("n"), n = near("e");
    const along = (values, digits, place, name) => { let taken = [-1e9, -1e9]; const words = values.map(v => [place(v), v.toFixed(digits)]);
      for (const [p, text] of words) { if (Math.hypot(p[0] - taken[0], p[1] - taken[1]) < 34) continue; taken = p; g.fillText(text, p[0], p[1] + 6); }
      const mid = words[Math.floor(words.length / 2)]; if (mid) g.fillText(name, mid[0][0], mid[0][1] + 20); };
    along(ns.filter(v => v > box.n[0] && v < box.n[1]), nd, v => at(v, e, floor), "north (m)"); along(es.filter(v => v > box.e[0] && v < box.e[1]), ed, v => at(n, v, floor), "east (m)");
  }
  function drawBottom(g, at) {
    g.strokeStyle = css("brown"); g.lineWidth = 1;
    if (mesh) { g.globalAlpha = 0.45; const { n, e, z } = mesh, rows = n.length, columns = e.length;
      for (let i = 0; i < rows; i++) stroke(g, at, Array(columns).fill(n[i]), e, z.slice(i * columns, (i + 1) * columns), columns, css("brown"), 1);
      for (let j = 0; j < columns; j++) stroke(g, at, n, Array(rows).fill(e[j]), Float32Array.from(n, (_, i) => z[i * columns + j]), rows, css("brown"), 1);
      g.globalAlpha = 1; }
    if (bottom) stroke(g, at, bottom.x, bottom.y, bottom.z, bottom.x.length, css("brown"), 2.5);
  }
  function drawTrackIn(g, at) {
    const range = mode < 0 ? null : ranges[mode];
    if (!range) { stroke(g, at, TX, TY, Z, N, css("blue"), 2); return; }
    const values = C[S.colours[mode].name], parts = Array.from({ length: COUNT + 1 }, () => []); let before = null;
    for (let k = 0; k < N; k += step) { if (!Number.isFinite(TX[k]) || !Number.isFinite(Z[k])) { before = null; continue; }
      const p = at(TX[k], TY[k], Z[k]); let worst = values[k];
      for (let j = k + 1; j < Math.min(N, k + step); j++) if (!(Math.abs(values[j]) <= Math.abs(worst))) worst = values[j];
      if (before) parts[colourOf(worst, range, COUNT) + 1].push(before, p); before = p; }
    g.lineWidth = 2.6; g.lineCap = "round";
    parts.forEach((points, k) => { if (!points.length) return; g.strokeStyle = k ? colour(k - 1) : css("muted"); g.beginPath();
      for (let j = 0; j < points.length; j += 2) { g.moveTo(points[j][0], points[j][1]); g.lineTo(points[j + 1][0], points[j + 1][1]); } g.stroke(); });
  }
  function legend(g, range) {
    const c = S.colours[mode], x = 14, y = 10, w = 150; g.fillStyle = css("card"); g.globalAlpha = 0.8; g.fillRect(0, 0, 230, 52); g.globalAlpha = 1; for (let k = 0; k < COUNT; k++) { g.fillStyle = colour(k); g.fillRect(x + k * w / COUNT, y, w / COUNT + 0.6, 8); }
    g.fillStyle = css("muted"); g.textBaseline = "top"; g.textAlign = "left"; g.fillText(c.signed ? fmt(range.low, 3) : "0", x, y + 12);
    g.textAlign = "right"; g.fillText(fmt(range.high, 3) + " " + c.unit, x + w, y + 12); g.textAlign = "left"; g.fillText(`${c.label}, largest ${fmt(range.largest, 2)} ${c.unit}`, x, y + 26);
  }
  function marks(g, at) {
    const known = []; for (let k = 0; k < N; k++) if (Number.isFinite(TX[k]) && Number.isFinite(Z[k])) known.push(k);
    if (!known.length) return;
    const word = (k, text, color) => { const [x, y] = at(TX[k], TY[k], Z[k]); g.fillStyle = css(color); g.strokeStyle = css("card"); g.lineWidth = 1.5; g.beginPath();
      if (text === "start") { g.moveTo(x, y - 7); g.lineTo(x + 7, y + 6); g.lineTo(x - 7, y + 6); g.closePath(); } else g.rect(x - 5, y - 5, 10, 10); g.fill(); g.stroke();
      g.fillStyle = css("ink"); g.textAlign = "left"; g.textBaseline = "bottom"; g.fillText(text, x + 9, y - 4); };
    word(known[0], "start", "green"); word(known[known.length - 1], "end", "red");
    const now = row(cursor); if (!Number.isFinite(TX[now]) || !Number.isFinite(Z[now])) return;
    const chi = (C.track_psi || C.psi)[now] * Math.PI / 180, pitch = ((C.track_theta || C.theta || [])[now] || 0) * Math.PI / 180, here = [TX[now], TY[now], Z[now]];
    g.strokeStyle = css("orange"); g.lineWidth = 1; g.setLineDash([3, 3]); segment(g, at, here, [here[0], here[1], 0]); g.setLineDash([]);
    /* The hull in pixels: its direction is that of the drawn path, so depths are stretched in it, too. */
    const p = at(...here), q = at(here[0] + Math.cos(chi) * Math.cos(pitch), here[1] + Math.sin(chi) * Math.cos(pitch), here[2] - Math.sin(pitch)), size = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
    const u = [(q[0] - p[0]) / size, (q[1] - p[1]) / size], l = 18 * Math.min(1, Math.max(0.25, size / shown.scale)), point = (a, b) => [p[0] + a * u[0] - b * u[1], p[1] + a * u[1] + b * u[0]];
    g.fillStyle = css("orange"); g.strokeStyle = css("card"); g.lineWidth = 1.5; g.beginPath(); [point(l, 0), point(-0.7 * l, 6), point(-0.35 * l, 0), point(-0.7 * l, -6)].forEach((c, k) => k ? g.lineTo(...c) : g.moveTo(...c)); g.closePath(); g.fill(); g.stroke();
    g.fillStyle = css("ink"); g.textAlign = "left"; g.textBaseline = "top"; g.fillText(`${fmt(Z[now], 1)} m deep`, p[0] + 12, p[1] + 8);
  }
  function compass(g, w, h) {
    const o = project(view, 0, 0, 0), x = w - 40, y = 40; g.textBaseline = "middle"; g.textAlign = "center"; g.lineWidth = 1.6;
    for (const [name, n, e, d, color] of [["N", 1, 0, 0, "ink"], ["E", 0, 1, 0, "muted"]]) { const p = project(view, n, e, d), dx = 22 * (p[0] - o[0]), dy = -22 * (p[1] - o[1]); g.strokeStyle = g.fillStyle = css(color); g.beginPath(); g.moveTo(x, y); g.lineTo(x + dx, y + dy); g.stroke(); if (Math.hypot(dx, dy) > 4) g.fillText(name, x + 1.45 * dx, y + 1.45 * dy); }
    const degrees = Math.round(view.heading * 180 / Math.PI) % 360, tilt = Math.round(view.tilt * 180 / Math.PI);
    g.fillStyle = css("muted"); g.textAlign = "right"; g.textBaseline = "bottom"; g.fillText(`towards ${String((degrees + 360) % 360).padStart(3, "0")}\u00b0, ${Math.abs(tilt)}\u00b0 from ${tilt < 0 ? "below" : "above"}, depths \u00d7 ${view.stretch}`, w - 10, h - 6);
  }
  function drawSpace() {
    const [g, w, h] = sized(canvas); shown = scene(w, h); const { at } = shown;
    g.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    const fromAbove = view.tilt >= 0, surface = () => plane(g, at, 0, css("blue"), css("blue"), false), floor = () => plane(g, at, box.d[1], null, css("grid"), !mesh);
    if (fromAbove) { floor(); drawBottom(g, at); } else surface();
    scales(g, at);
    if (way) { const n = way.x.length; g.globalAlpha = 0.5; stroke(g, at, way.x, way.y, box.d[1], mesh ? 0 : n, css("path"), 2); g.globalAlpha = 1;
      g.strokeStyle = css("path"); g.lineWidth = 1; g.globalAlpha = 0.5; for (let k = 0; k < n; k += Math.max(1, Math.round(n / 60))) segment(g, at, [way.x[k], way.y[k], way.z[k]], [way.x[k], way.y[k], 0]); g.globalAlpha = 1;
      stroke(g, at, way.x, way.y, way.z, n, css("path"), 6); }
    drawTrackIn(g, at); if (fromAbove) surface(); else { floor(); drawBottom(g, at); }
    marks(g, at); compass(g, w, h); const range = mode < 0 ? null : ranges[mode];
    const s = box.n.flatMap(n => box.e.map(e => at(n, e, 0))).reduce((a, b) => b[2] > a[2] ? b : a); g.fillStyle = css("blue"); g.textAlign = "center"; g.textBaseline = "bottom"; g.fillText("surface", s[0], s[1] - 3); if (range) legend(g, range);
  }
  const turn = (dh, dt) => { view.heading = (view.heading + dh + 2 * Math.PI) % (2 * Math.PI); view.tilt = Math.max(-0.5, Math.min(Math.PI / 2, view.tilt + dt)); drawSpace(); };
  const zoom = f => { view.zoom = Math.max(0.3, Math.min(200, view.zoom * f)); drawSpace(); };
  const stretch = k => { view.stretch = k; $("spacestretch").value = k; drawSpace(); }, paint = k => { mode = k; $("spacecolour").value = k; drawSpace(); };
  const above = () => { view.heading = 0; view.tilt = Math.PI / 2; drawSpace(); }, side = () => { view.tilt = 0; drawSpace(); }, all = () => { view = fresh(); $("spacestretch").value = view.stretch; drawSpace(); };
  let grip = null, moved = false;
  canvas.addEventListener("pointerdown", e => { grip = [e.offsetX, e.offsetY]; moved = false; canvas.focus({ preventScroll: true }); canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointermove", e => { if (!grip) return; const dx = e.offsetX - grip[0], dy = e.offsetY - grip[1]; if (!moved && Math.abs(dx) + Math.abs(dy) < 3) return; moved = true; grip = [e.offsetX, e.offsetY];
    if (e.shiftKey || e.buttons > 1) { view.right -= dx / shown.scale; view.up += dy / shown.scale; drawSpace(); } else turn(dx * 0.008, dy * 0.008); });
  canvas.addEventListener("pointerup", e => { if (grip && !moved) { let best = -1, d = Infinity;
      for (let k = 0; k < N; k += step) { if (!Number.isFinite(TX[k]) || !Number.isFinite(Z[k])) continue; const p = shown.at(TX[k], TY[k], Z[k]), q = (p[0] - e.offsetX) ** 2 + (p[1] - e.offsetY) ** 2; if (q < d) { d = q; best = k; } }
      if (best >= 0 && d < 900) setCursor(T[best]); } grip = null; });
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("wheel", e => { e.preventDefault(); zoom(Math.exp(-e.deltaY * 0.0012)); }, { passive: false });
  canvas.addEventListener("dblclick", all);
  const keys = { ArrowLeft: () => turn(-0.09, 0), ArrowRight: () => turn(0.09, 0), ArrowUp: () => turn(0, 0.07), ArrowDown: () => turn(0, -0.07), "+": () => zoom(1.2), "=": () => zoom(1.2), "-": () => zoom(1 / 1.2), "0": all, t: above, s: side,
    v: () => { const steps = [1, 2, 5, 10, 20]; stretch(steps[(steps.indexOf(view.stretch) + 1) % steps.length]); }, c: () => paint(mode + 1 < S.colours.length ? mode + 1 : -1) };
  canvas.addEventListener("keydown", e => { const act = keys[e.key]; if (act && !e.ctrlKey && !e.metaKey && !e.altKey) { e.preventDefault(); e.stopPropagation(); act(); } });
  $("spacecolour").onchange = e => paint(Number(e.target.value)); $("spacestretch").onchange = e => stretch(Number(e.target.value));
  $("spaceabove").onclick = above; $("spaceside").onclick = side; $("spaceall").onclick = all;
  const key = (name, text) => ` <span class="key"><i style="background:var(--${name})"></i>${text}</span>`;
  $("spacekeys").innerHTML = (way ? key("path", "path") : "") + key("blue", "surface") + (bottom || mesh ? key("brown", bottom && mesh ? "bottom: measured and of the sea file" : bottom ? "bottom, measured" : "bottom of the sea file") : "");
  also.push(drawSpace); draw();
})();
