/* The socket to the console's server: messages, requests with answers, and reconnection. */

const SILENCE = 5000, WAITS = [300, 1000, 2000, 4000];

export class Link {
  /* hear(message or ArrayBuffer) for what arrives; state("open" | "lost" | "refused") for the link itself. */
  constructor(hear, state) {
    this.hear = hear; this.state = state; this.asked = new Map(); this.next = 1; this.tries = 0; this.heard = 0;
    setInterval(() => this.watch(), 1000);
    this.open();
  }

  get isOpen() { return this.socket.readyState === WebSocket.OPEN; }

  open() {
    const socket = this.socket = new WebSocket(`${location.protocol.replace("http", "ws")}//${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => { this.tries = 0; this.heard = performance.now(); this.state("open"); };
    socket.onmessage = event => { if (socket === this.socket) this.take(event.data); };
    socket.onclose = () => { if (socket === this.socket) this.lost(); };
  }

  take(data) {
    this.heard = performance.now();
    if (typeof data !== "string") { this.hear(data); return; }
    const message = JSON.parse(data);
    if (message.kind !== "answer") { this.hear(message); return; }
    const settle = this.asked.get(message.id);
    this.asked.delete(message.id);
    if (settle) settle(message);
  }

  lost() {
    for (const settle of this.asked.values()) settle({ ok: false, message: "the link was lost before the answer" });
    this.asked.clear();
    this.state("lost");
    setTimeout(() => this.again(), WAITS[Math.min(this.tries++, WAITS.length - 1)]);
  }

  /* A server that answers but refuses the page has been started anew with another address. */
  async again() {
    try { if ((await fetch("/", { cache: "no-store" })).status === 403) this.state("refused"); } catch { /* not there yet */ }
    this.open();
  }

  watch() {
    if (!this.isOpen || performance.now() - this.heard < SILENCE) return;
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
