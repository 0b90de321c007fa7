/* The choice and the text of a mission, with the plan check's lines before it is sent. */
import { $, el, kept, write } from "./dom.js";
import { flights, shown } from "./flights.js";
import { showDraft } from "./chart.js";
import { answered } from "./commands.js";
import { paints } from "./painting.js";

/* checked: the text that has passed, and the namespace of the vehicle that it has passed for. */
let ask = null, checked = null, list = null, asking = false, busy = false;
const text = $("mission-text"), choice = $("mission-choice"), lines = $("check-lines");

/* ask: the link's. */
export function missions(asks) { ask = asks; }

/* Ask for the missions once the tab is open; a server that is not ready is asked again. */
export async function listMissions() {
  if (list || asking) return;
  asking = true;
  const answer = await ask("missions", flights.namespace);
  asking = false;
  if (!answer.ok) { answered("Missions", answer); return; }
  list = answer.missions;
  choice.replaceChildren(el("option", { value: "", text: "choose a mission …" }),
    ...list.map(m => el("option", { value: m.name, text: m.name, title: m.description || "" })));
}

choice.addEventListener("change", async () => {
  if (!choice.value) return;
  const about = list.find(m => m.name === choice.value), answer = await ask("mission_text", flights.namespace, { name: choice.value });
  write($("mission-about"), about && about.description || "");
  if (!answer.ok) { answered("Mission", answer); return; }
  text.value = answer.text;
  changed();
});

function show(answer) {
  const found = answer.lines && answer.lines.length ? answer.lines : [answer.message || (answer.ok ? "the plan check reports nothing" : "refused")];
  lines.replaceChildren(...found.map(line => el("li", { text: line, class: /^(refused|warning|notice)/.exec(line)?.[1] })));
  lines.className = answer.ok ? "ok" : "bad";
}

function changed() {
  checked = null; showDraft(null); lines.className = "";
  lines.replaceChildren(el("li", { text: text.value.trim() ? "Not checked yet." : "Choose a mission or write one." }));
  buttons();
}

const passed = () => checked !== null && checked.text === text.value && checked.namespace === flights.namespace;

function buttons() {
  const v = shown(), flying = v && v.tick && v.tick.state === "running", may = Boolean(flights.hello && flights.hello.may_command);
  const view = flights.hello && !may ? "This page may look, not command" : "";
  $("check").disabled = busy || !may || !text.value.trim();
  $("check").title = view || "Ctrl+Enter";
  $("load").disabled = busy || !may || !passed();
  $("load").title = view || ($("load").disabled ? "Check the text first" : "");
  write($("load-note"), flying ? "Guidance takes a mission while idle, complete, aborted or on hold." : "");
}

$("check").addEventListener("click", async () => {
  const of = { text: text.value, namespace: flights.namespace };
  busy = true; buttons();
  const answer = await ask("check", of.namespace, { text: of.text }, 30);
  busy = false;
  if (text.value === of.text && flights.namespace === of.namespace) {
    checked = answer.ok ? of : null;
    show(answer); showDraft(answer.ok && answer.course ? answer.course : null);
  }
  buttons();
});

$("load").addEventListener("click", async () => {
  if (!passed()) { buttons(); return; }
  const at = $("start-at").value.trim(), of = checked;
  busy = true; buttons();
  const answer = await ask("load", of.namespace, { text: of.text, ...(at ? { start_at: at } : {}) }, 30);
  busy = false;
  answered("Load", answer);
  if (answer.ok) kept.set("console-mission", of.text);
  if (flights.namespace === of.namespace) {
    show({ ...answer, lines: [answer.message || (answer.ok ? "loaded" : "refused")] });
    if (answer.ok) showDraft(null);
  }
  buttons();
});

text.addEventListener("input", changed);
document.addEventListener("vehicle", changed);
text.addEventListener("keydown", e => {
  if (e.key === "Enter" && e.ctrlKey && !$("check").disabled) { e.preventDefault(); $("check").click(); }
});
const before = kept.get("console-mission");
if (before) text.value = before;
changed();
paints(buttons);
