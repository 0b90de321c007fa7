"""The page's link to the server under node: every request has an end, and a page that is refused says so."""

from __future__ import annotations

from auv_sim.views.console.record.wire_messages import PROTOCOL
from node_page import evaluate, needs_node

pytestmark = needs_node
#: A browser's socket and fetch: a handshake that is answered with 403 closes the socket.
_BROWSER = """
    globalThis.location = { protocol: 'http:', host: 'here' };
    globalThis.status = 200; globalThis.sockets = []; globalThis.sent = [];
    globalThis.WebSocket = class { static CONNECTING = 0; static OPEN = 1; static CLOSED = 3; readyState = 0;
      constructor() {
        sockets.push(this); globalThis.socket = this;
        if (status === 403) setTimeout(() => { this.readyState = 3; this.onclose(); });
      }
      send(text) { sent.push(JSON.parse(text)); } close() { this.readyState = 3; }
      says(message) { this.onmessage({ data: JSON.stringify(message) }); } };
    globalThis.fetch = async () => ({ status });
    const { Link } = await import('link'), states = [], heard = [];
    const link = new Link(message => heard.push(message.kind), state => states.push(state));
    const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));
"""


def test_every_request_has_an_end() -> None:
    found = evaluate(f"""{_BROWSER}
        socket.readyState = 1; socket.says({{ kind: 'hello', protocol: 1 }});
        const first = link.ask('hold'), late = link.ask('abort', {{}}, 0.05), gone = link.ask('start');
        socket.says({{ kind: 'answer', id: 1, ok: true, message: 'holding' }});
        out = [await first, await late];
        status = 403; socket.readyState = 3; socket.onclose();
        out.push(await gone, await link.ask('abort'));
        await pause(500);
        out.push(states, sockets.length);
    """)
    assert [answer["message"] for answer in found[:4]] == [
        "holding", "no answer within 0.05 s", "the link was lost before the answer",
        "no link: nothing was sent",
    ]  # fmt: skip
    assert [answer["ok"] for answer in found[:4]] == [True, False, False, False]
    # A page that is refused says so until it is let in.
    assert found[4:] == [["open", "lost", "refused"], 1]


def test_nothing_is_sent_before_the_hello_nor_to_another_protocol() -> None:
    found = evaluate(f"""{_BROWSER}
        socket.readyState = 1; socket.onopen?.();
        out = [(await link.ask('abort')).message];
        socket.says({{ kind: 'hello', protocol: 2 }}); socket.says({{ kind: 'tick' }});
        out.push((await link.ask('abort')).message, [...heard], [...states]);
        socket.says({{ kind: 'hello', protocol: PROTOCOL }}); link.ask('abort');
        out.push(heard, states, sent.map(one => one.do));
    """.replace("const { Link }", "const { Link, PROTOCOL }"))  # fmt: skip
    refused = "no link: nothing was sent"
    assert found == [refused, refused, [], ["outdated"], ["hello"], ["outdated", "open"], ["abort"]]
    assert evaluate("import { PROTOCOL } from 'link'; out = PROTOCOL") == PROTOCOL


def test_a_socket_that_never_opens_is_given_up() -> None:
    found = evaluate(f"""
        let now = 0; performance.now = () => now;
        {_BROWSER}
        now = 4900; link.watch(); out = [[...states]];
        now = 5100; link.watch(); await pause(400);
        out.push(states, sockets.map(one => one.readyState));
    """)
    assert found == [[], ["lost"], [3, 0]]
