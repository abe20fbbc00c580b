# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""JSON over HTTP for programs that speak nothing else: Flask and waitress before a daemon, or before nobody.

    pip install './client/python[http]'
    python http_server.py                                 # asks a daemon
    python http_server.py --catalogue catalogue.yaml      # solves in this process
    curl --data @request.json http://127.0.0.1:8421/solve

POST /solve takes what `percuss query --request FILE --json` takes, and gives what that prints; their schemas are printed
by `percuss schema request` and `reply`. A refusal by the server is an answer (200) whose `status` and `message` say
why. What is no request is 400 with {"message": ...} that names the member; no daemon 503; no answer in time 504. It
listens on loopback alone and asks nobody who he is: before others may reach it, put a proxy with TLS and passwords
between.
"""

from __future__ import annotations

import argparse
from typing import Any

import flask
import waitress
from werkzeug.exceptions import HTTPException

import percuss

LARGEST = 1 << 20  # bytes of a request; 64 bodies, 64 contacts and their matrix are a fifth of that


def application(client: percuss.Client, timeout: float = 60.0) -> flask.Flask:
    app = flask.Flask("percuss")
    app.config["MAX_CONTENT_LENGTH"] = LARGEST
    app.json.sort_keys = False  # type: ignore[attr-defined]

    @app.post("/solve")
    def solve() -> dict[str, Any]:
        # of every content type: curl --data says that it is a form
        request = percuss.Request.from_json(flask.request.get_data())
        return client.solve(request, timeout).to_json()

    @app.errorhandler(Exception)
    def fail(error: Exception) -> tuple[dict[str, str], int]:
        if isinstance(error, HTTPException):  # another path or method, too many bytes
            return {"message": error.description or error.name}, error.code or 500
        codes = {ValueError: 400, percuss.InvalidArgument: 400, percuss.NoServer: 503, percuss.AnswerTimeout: 504}
        code = next((code for kind, code in codes.items() if isinstance(error, kind)), 500)
        return {"message": str(error)}, code

    return app


def main() -> None:
    parser = argparse.ArgumentParser(description="JSON over HTTP on loopback")
    parser.add_argument("--catalogue", help="solve in this process with these bodies; without it a daemon is asked")
    parser.add_argument("--port", type=int, default=8421)
    options = parser.parse_args()
    with percuss.Local(options.catalogue) if options.catalogue else percuss.connect() as client:
        server: Any = waitress.create_server(application(client), host="127.0.0.1", port=options.port)
        print(f"http://127.0.0.1:{server.effective_port}/solve", flush=True)
        server.run()


if __name__ == "__main__":
    main()
