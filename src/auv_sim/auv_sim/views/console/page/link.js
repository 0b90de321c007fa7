/* The socket to the console's server: messages, requests with answers, and reconnection. */

/* Of the messages; a server that speaks another one needs the page that it serves. */
export const PROTOCOL = 1;
const SILENCE = 5000, WAITS = [300, 1000, 2000, 4000];

export class Link {
  /* hear(message or ArrayBuffer) for what arrives; state("open" | "lost" | "refused" | "outdated") for the link. */
  constructor(hear, state) {
    this.hear = hear; this.state = state; this.asked = new Map(); this.next = 1; this.tries = 0; this.heard = 0;
    setInterval(() => this.watch(), 1000);
    this.open();
  }

  /* Whether a request may be sent. Before the hello of a new server its vehicles may have other numbers. */
  get isOpen() { return this.greeted && this.socket.readyState === WebSocket.OPEN; }

  open() {
    const socket = this.socket = new WebSocket(`${location.protocol.replace("http", "ws")}//${location.host}/socket`);
    this.greeted = false; this.heard = performance.now();
    socket.binaryType = "arraybuffer";
    socket.onmessage = event => { if (socket === this.socket) this.take(event.data); };
    socket.onclose = () => { if (socket === this.socket) this.lost(); };
  }

  take(data) {
    this.heard = performance.now();
    const message = typeof data === "string" ? JSON.parse(data) : data;
    if (message.kind === "hello") this.greet(message.protocol);
    if (!this.greeted) return;
    if (message.kind !== "answer") { this.hear(message); return; }
    const settle = this.asked.get(message.id);
    this.asked.delete(message.id);
    if (settle) settle(message);
  }

  greet(protocol) {
    this.tries = 0; this.greeted = protocol === PROTOCOL;
    this.state(this.greeted ? "open" : "outdated");
  }

  lost() {
    this.greeted = false;
    for (const settle of this.asked.values()) settle({ ok: false, message: "the link was lost before the answer" });
    this.asked.clear();
    this.state("lost");
    setTimeout(() => this.again(), WAITS[Math.min(this.tries++, WAITS.length - 1)]);
  }

  /* A server that answers but refuses the page has been started anew with another address. */
  async again() {
    let status = 0;
    try { status = (await fetch("/", { cache: "no-store", signal: AbortSignal.timeout(4000) })).status; } catch { /* not there yet */ }
    if (status !== 403) { this.open(); return; }
    this.state("refused");
    setTimeout(() => this.again(), 4000);
  }

  /* Give up a socket that is silent, or whose server does not let it in. */
  watch() {
    if (this.socket.readyState > WebSocket.OPEN || performance.now() - this.heard < SILENCE) return;
    const socket = this.socket;
    this.socket = { readyState: WebSocket.CLOSED };
    socket.close();
    this.lost();
  }

  /* Request something; the answer {ok, message, ...} comes in every case, after `seconds` at the latest. */
  ask(what, fields = {}, seconds = 5) {
    if (!this.isOpen) return Promise.resolve({ ok: false, message: "no link: nothing was sent" });
    const id = this.next++;
    return new Promise(resolve => {
      const late = setTimeout(() => this.asked.get(id)?.({ ok: false, message: `no answer within ${seconds} s` }), seconds * 1000);
      this.asked.set(id, answer => { clearTimeout(late); this.asked.delete(id); resolve(answer); });
      this.socket.send(JSON.stringify({ id, do: what, ...fields }));
    });
  }
}
