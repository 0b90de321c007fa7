/* The values of parameters as text and back. No document. */

const list = text => text.trim() ? text.split(",").map(one => one.trim()) : [];

/* The server's types of parameters: name -> value of a text; NaN where a number is expected and not found. */
export const TYPES = {
  double: text => text ? Number(text) : NaN, int: text => text ? Number(text) : NaN, bool: text => text === "true",
  string: text => text, strings: list,
};

/* A parameter's value from what was entered. */
export const typed = (type, text) => (TYPES[type] || TYPES.string)(text.trim());

/* A parameter's value as text. */
export const shows = v => Array.isArray(v) ? v.join(", ") : typeof v === "number" ? String(Number(v.toPrecision(9))) : String(v);
