/* The choice and the text of a mission, with the plan check's lines before it is sent. */
import { $, el, kept, write } from "./dom.js";
import { flights, shown } from "./flights.js";
import { showDraft } from "./chart.js";
import { answered } from "./commands.js";
import { paints } from "./painting.js";

let ask = null, checked = null, list = null, asking = false, busy = false;
const text = $("mission-text"), choice = $("mission-choice"), lines = $("check-lines");

/* ask: the link's. */
export function missions(asks) { ask = asks; }

const fields = more => ({ vehicle: flights.chosen, ...more });

/* Ask for the missions once the tab is open; a server that is not ready is asked again. */
export async function listMissions() {
  if (list || asking) return;
  asking = true;
  const answer = await ask("missions", fields());
  asking = false;
  if (!answer.ok) { answered("Missions", answer); return; }
  list = answer.missions;
  choice.replaceChildren(el("option", { value: "", text: "choose a mission …" }),
    ...list.map(m => el("option", { value: m.name, text: m.name, title: m.description || "" })));
}

choice.addEventListener("change", async () => {
  if (!choice.value) return;
  const about = list.find(m => m.name === choice.value), answer = await ask("mission_text", fields({ name: choice.value }));
  write($("mission-about"), about && about.description || "");
  if (!answer.ok) { answered("Mission", answer); return; }
  text.value = answer.text;
  changed();
});

function show(answer) {
  const found = answer.lines && answer.lines.length ? answer.lines : [answer.message || (answer.ok ? "the plan check has nothing to say" : "refused")];
  lines.replaceChildren(...found.map(line => el("li", { text: line, class: /^(refused|warning|notice)/.exec(line)?.[1] })));
  lines.className = answer.ok ? "ok" : "bad";
}

function changed() {
  checked = null; showDraft(null); lines.className = "";
  lines.replaceChildren(el("li", { text: text.value.trim() ? "Not checked yet." : "Choose a mission or write one." }));
  buttons();
}

function buttons() {
  const v = shown(), flying = v && v.tick && v.tick.state === "running";
  $("check").disabled = busy || !text.value.trim();
  $("load").disabled = busy || checked === null || checked !== text.value;
  $("load").title = $("load").disabled ? "Check the text first" : "";
  write($("load-note"), flying ? "Guidance takes a mission while idle, complete, aborted or on hold." : "");
}

$("check").addEventListener("click", async () => {
  const of = text.value;
  busy = true; buttons();
  const answer = await ask("check", fields({ text: of }), 30);
  busy = false;
  if (text.value === of) {
    checked = answer.ok ? of : null;
    show(answer); showDraft(answer.ok && answer.course ? answer.course : null);
  }
  buttons();
});

$("load").addEventListener("click", async () => {
  const at = $("start-at").value.trim();
  busy = true; buttons();
  const answer = await ask("load", fields({ text: text.value, ...(at ? { start_at: at } : {}) }), 30);
  busy = false;
  show({ ...answer, lines: [answer.message || (answer.ok ? "loaded" : "refused")] });
  answered("Load", answer);
  if (answer.ok) { showDraft(null); kept.set("console-mission", text.value); }
  buttons();
});

text.addEventListener("input", changed);
text.addEventListener("keydown", e => {
  if (e.key === "Enter" && e.ctrlKey && !$("check").disabled) { e.preventDefault(); $("check").click(); }
});
const before = kept.get("console-mission");
if (before) text.value = before;
changed();
paints(buttons);
