/* Small helpers for the document. */

export const $ = id => document.getElementById(id);

/* An element with properties (class, text, or any attribute) and children. */
export function el(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "text") made.textContent = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/* Set the words of an element, if they are others. */
export function write(element, text) { if (element.textContent !== text) element.textContent = text; }

/* Replace the children of an element, if what they are made from has changed. */
export function renew(element, content, make) {
  const key = JSON.stringify(content);
  if (element.made === key) return;
  element.made = key;
  element.replaceChildren(...content.map(make));
}

/* Show one child for each item: `key` names it, `make` builds it once, `show` writes what may change.
   A child that stays is not replaced: a press on it still becomes a click, and it keeps the focus. */
export function keep(element, items, key, make, show) {
  const there = new Map([...element.children].map(child => [child.dataset.key, child]));
  const children = items.map(item => {
    const name = key(item), child = there.get(name) || make(item);
    there.delete(name); child.dataset.key = name; show(child, item);
    return child;
  });
  for (const gone of there.values()) gone.remove();
  children.forEach((child, at) => { if (element.children[at] !== child) element.insertBefore(child, element.children[at] || null); });
}

/* Seconds as 0:07, 12:34 or 1:02:03. */
export function clock(seconds) {
  if (!Number.isFinite(seconds)) return "–";
  const s = Math.max(0, Math.floor(seconds)), two = v => String(v).padStart(2, "0"), h = Math.floor(s / 3600);
  return (h ? `${h}:${two(Math.floor(s / 60) % 60)}` : `${Math.floor(s / 60)}`) + `:${two(s % 60)}`;
}

/* A choice that the browser keeps; nothing breaks where it keeps none. */
export const kept = {
  get(name) { try { return localStorage.getItem(name); } catch { return null; } },
  set(name, value) { try { localStorage.setItem(name, value); } catch { /* not kept */ } },
};
