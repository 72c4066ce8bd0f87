"""A server on this machine that says what a test wants, and remembers what it was asked."""

from __future__ import annotations

import json
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


def completion(content, finish="stop"):
    """A chat completion as vLLM sends it."""
    choice = {"index": 0, "message": {"role": "assistant", "content": content}, "finish_reason": finish}
    return json.dumps({"object": "chat.completion", "choices": [choice]}).encode()


def status(code, body=b"", **head):
    """A reply that is nothing but a status, its body and its head."""

    def answer(handler):
        handler.send_response(code)
        for name, value in head.items():
            handler.send_header(name.replace("_", "-"), value)
        handler.send_header("Content-Length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)

    return answer


class Served:
    """A server's address, and what it was asked.

    Attributes:
        url: of its API.
        asked: (path, head, table) of every request.
    """

    def __init__(self, port):
        self.url = f"http://127.0.0.1:{port}/v1"
        self.asked = []


@contextmanager
def serving(*replies):
    """Serve replies in turn, the last one for ever: bytes of a 200, or functions of the handler."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            served.asked.append((self.path, dict(self.headers), json.loads(body)))
            reply = replies[min(len(served.asked), len(replies)) - 1]
            (status(200, reply) if isinstance(reply, bytes) else reply)(self)

        def log_message(self, *_):
            pass

    class Server(ThreadingHTTPServer):
        def handle_error(self, request, client_address):
            """Nothing: a client that does not wait for the end is what some tests are about."""

    server = Server(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    served = Served(server.server_address[1])
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    try:
        yield served
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
