/* Parameters in flight: gains first, safety limits in a list of their own with a confirmation. */
import { $, el, write } from "./dom.js";
import { flights } from "./flights.js";
import { answered } from "./commands.js";
import { shows, typed } from "./typed.js";

/* of: namespace of the vehicle whose parameters are listed. */
let ask = null, nodes = [], of = null, asking = false;

/* ask: the link's. */
export function gains(asks) { ask = asks; }

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b), isNumber = p => ["double", "int"].includes(p.type);

/* Ask for the parameters of the vehicle that is shown; nodes may come later than the page. */
export async function listGains(again = false) {
  const { namespace } = flights;
  if (asking || !again && of === namespace && nodes.length) return;
  asking = true;
  const answer = await ask("parameters", namespace, {}, 10);
  asking = false;
  if (namespace !== flights.namespace) { listGains(); return; }
  if (!answer.ok) { write($("gains-note"), answer.message); return; }
  nodes = answer.nodes; of = namespace;
  write($("gains-note"), nodes.length ? "" : "No node answers yet.");
  build();
}

function range(p) {
  const low = p.minimum ?? null, high = p.maximum ?? null;
  if (low === null && high === null) return "";
  return `${low === null ? "" : shows(low)} … ${high === null ? "" : shows(high)}`;
}

/* A name that may be broken after its dots and underscores. */
const broken = name => name.split(/(?<=[._])/).flatMap((part, k) => k ? [el("wbr"), part] : [part]);

/* A row: name, value, unit; the default and a button back where it differs. */
function row(namespace, node, p) {
  const id = `p-${node}-${p.name}`, same_as = p.default !== undefined && p.default !== null;
  const bool = p.type === "bool";
  const input = bool ? el("select", { id, disabled: p.read_only }, el("option", { text: "true" }), el("option", { text: "false" }))
    : el("input", { id, type: "text", inputmode: isNumber(p) ? "decimal" : null, readonly: p.read_only, autocomplete: "off", spellcheck: "false" });
  const back = el("button", { type: "button", class: "back", text: "back", "aria-label": `${p.name} back to its default` });
  const said = el("p", { class: "said", role: "status" }), confirm = el("div", { class: "confirm", hidden: true });
  const box = el("div", { class: "gain", "data-name": p.name }, el("label", { for: id, title: p.doc || "" }, ...broken(p.name)), input,
    el("span", { class: "unit", text: p.unit === "-" ? "" : p.unit || "" }), back, el("p", { class: "doc", text: [p.doc, range(p)].filter(Boolean).join("; ") }), confirm, said);
  p.show = () => {
    input.value = shows(p.value);
    const differs = same_as && !same(p.value, p.default);
    box.classList.toggle("changed", differs);
    back.hidden = !differs || p.read_only;
    back.title = same_as ? `default ${shows(p.default)}` : "";
  };
  const send = async value => {
    confirm.hidden = true;
    const answer = await ask("set", namespace, { node, name: p.name, value });
    said.className = `said ${answer.ok ? "ok" : "bad"}`;
    said.textContent = answer.message || (answer.ok ? `set to ${shows(value)}` : "refused");
    answered(p.name, { ...answer, message: said.textContent });
    if (answer.ok) p.value = value;
    p.show();
  };
  const change = value => {
    if (Number.isNaN(value)) { said.className = "said bad"; said.textContent = `found ${input.value}, expected a number`; p.show(); return; }
    if (same(value, p.value)) return;
    if (!p.safety) { send(value); return; }
    confirm.replaceChildren(el("span", { text: `Set the safety limit ${p.name} from ${shows(p.value)} to ${shows(value)}?` }),
      el("button", { type: "button", class: "yes", text: "Set it", onclick: () => send(value) }),
      el("button", { type: "button", text: "Keep", onclick: () => { confirm.hidden = true; p.show(); } }));
    confirm.hidden = false;
  };
  input.addEventListener("change", () => change(typed(p.type, input.value)));
  input.addEventListener("keydown", e => { if (e.key === "Escape") p.show(); });
  back.addEventListener("click", () => change(p.default));
  p.show();
  return box;
}

function build() {
  const live = [], limits = [];
  for (const { node, parameters } of nodes) {
    const fit = parameters.filter(p => !p.read_only);
    const [first, second] = [fit.filter(p => !p.safety), fit.filter(p => p.safety)];
    if (first.length) live.push(el("h3", { text: node }), ...first.map(p => row(of, node, p)));
    if (second.length) limits.push(el("h3", { text: node }), ...second.map(p => row(of, node, p)));
  }
  $("gains").replaceChildren(...live);
  $("limits").replaceChildren(...limits);
  $("limits-box").hidden = !limits.length;
  search();
}

/* A value that was changed elsewhere. */
export function parameterChanged(m) {
  if (flights.vehicles[m.vehicle]?.namespace !== of) return;
  const p = nodes.find(one => one.node === m.node)?.parameters.find(one => one.name === m.name);
  if (!p || !p.show) return;
  p.value = m.value;
  if (document.activeElement?.id !== `p-${m.node}-${m.name}`) p.show();
}

function search() {
  const word = $("gain-search").value.trim().toLowerCase(), only = $("only-changed").checked;
  for (const box of document.querySelectorAll(".gain")) {
    box.hidden = !box.dataset.name.toLowerCase().includes(word) || only && !box.classList.contains("changed");
  }
  for (const head of document.querySelectorAll("#gains h3, #limits h3")) {
    let next = head.nextElementSibling, any = false;
    for (; next && next.className.startsWith("gain"); next = next.nextElementSibling) any ||= !next.hidden;
    head.hidden = !any;
  }
}
$("gain-search").addEventListener("input", search);
$("only-changed").addEventListener("change", search);
$("gains-again").addEventListener("click", () => listGains(true));
$("save-gains").addEventListener("click", async () => {
  const answer = await ask("parameter_file", flights.namespace, {}, 10);
  if (!answer.ok) { answered("Parameter file", answer); return; }
  const link = el("a", { href: URL.createObjectURL(new Blob([answer.text], { type: "application/yaml" })), download: "console.yaml" });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  answered("Parameter file", { ok: true, message: "saved as console.yaml" });
});
document.addEventListener("vehicle", () => {
  nodes = []; of = null; build(); write($("gains-note"), "Reading …");
  if (!$("tab-gains").hidden) listGains();
});
