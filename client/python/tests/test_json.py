# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Request.from_json and Reply.to_json beside `percuss query --request FILE --json`: the same answers to the last
digit, the same refusals; and the example that answers over HTTP."""

import copy
import http.client
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path
from typing import Any

import percuss

SOURCE = Path(os.environ["PERCUSS_SOURCE"])
PROGRAM = Path(os.environ["PERCUSS_BUILD"]) / "bin" / "percuss"
CATALOGUE = SOURCE / "config" / "catalogue.yaml"
CLIENT = "00112233445566778899aabbccddeeff"

SPHERE = {"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]}
PLAIN: dict[str, Any] = {
    "bodies": [SPHERE, {"id": "al-beam"}],
    "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}],
}


def changed(path: str, value: Any) -> dict[str, Any]:
    """PLAIN with another value there: "bodies.0.elapsed"."""
    whole = copy.deepcopy(PLAIN)
    *before, last = path.split(".")
    at: Any = whole
    for name in before:
        at = at.setdefault(name, {}) if isinstance(at, dict) else at[int(name)]
    at[last] = value
    return whole


OBLIQUE = changed("contacts.0.friction", 0.2)
OBLIQUE["bodies"][0].update(velocity=[0.1, 0.05, -0.3], angular_velocity=[0, 20, 0])
GROUP: dict[str, Any] = {
    "bodies": [
        {**SPHERE, "position": [-0.2, 0, 0.025]},
        {**SPHERE, "position": [0.25, 0, 0.025], "velocity": [0, 0, -0.2]},
        {"id": "al-beam", "overrides": {"damping": 0.001, "young": 68e9}},
    ],
    "contacts": [{**PLAIN["contacts"][0], "a": i, "b": 2, "point": [x, 0, 0.010]} for i, x in enumerate((-0.2, 0.25))],
}
OPTIONS = changed(
    "options",
    {"tolerance": 1e-2, "horizon": 0.03, "contact_model": "hertz", "compliance": "half-space", "dents": "ignore"}
    | {"conditioning": True, "friction": "plain", "method": "modal", "deadline": 30, "trace": False},
)
ANSWERED = {
    "plain": PLAIN,
    "oblique": OBLIQUE,
    "group": GROUP,
    "matrix": {**PLAIN, "delassus": [[10.25]]},
    "flat": {**GROUP, "delassus": [12.0, -0.5, -0.5, 13.0]},
    "options": OPTIONS,
    "numbered": {**PLAIN, "sequence": 17},
    "leaves": changed("bodies.0.velocity", [0, 0, 0.3]),
    "unknown": changed("bodies.1.id", "al-bean"),
    "tolerance": changed("options.tolerance", 7),
    "nothing": {},
}
LONG = "x" * 64
# each is refused before anybody is asked
REFUSED: list[Any] = [
    [],
    {"body": []},
    {"bodies": 1},
    {"bodies": [{}] * 65},
    {"bodies": ["ball"]},
    {"contacts": [{}] * 65},
    *(changed(f"bodies.0.{name}", value) for name, value in (
        ("velocty", 1), ("velocity", 1), ("velocity", [1, 2]), ("velocity", [1, "2", 3]), ("velocity", [1, 2, True]),
        ("orientation", [1, 0, 0]), ("id", 3), ("id", LONG), ("id", "\u00e9" * 32), ("state", None), ("elapsed", "2ms"),
        ("elapsed", False), ("overrides", 1), ("overrides", {"yung": 1}), ("overrides", {"young": "68e9"}),
        ("line\nfeed", 1),
    )),
    *(changed(f"contacts.0.{name}", value) for name, value in (
        ("a", -1), ("a", 1.0), ("b", 2**32), ("b", "al-beam"), ("b", True), ("gap", None), ("tangents", []),
    )),
    *(changed(f"options.{name}", value) for name, value in (
        ("trace", 1), ("method", "newton"), ("method", 0), ("contact_model", "CLOSED_FORM"), ("tolerence", 1e-3),
        ("tolerance", []),
    )),
    *({**PLAIN, "delassus": value} for value in (1, [], [1, 2], [[1], [2]], [[1, 2]], ["a"], [["a"]], [None])),
    {**GROUP, "delassus": [[1, 2], 3]},
    {"contacts": [{}] * 22, "delassus": [[1]] * 66},
    *({**PLAIN, "sequence": value} for value in (0, 1.5, "1", -1)),
    {**PLAIN, "options": []},
    {**PLAIN, "bodies": {}},
]


def by_program(text: str, *arguments: str) -> "subprocess.CompletedProcess[str]":
    command = [str(PROGRAM), "query", "--local", "--catalogue", str(CATALOGUE), "--request", "-", "--json", *arguments]
    return subprocess.run(command, input=text, capture_output=True, text=True, timeout=60)


def untimed(reply: dict[str, Any]) -> str:
    """The text without what differs from one asking to the next: each digit counts, the order of members does not."""
    members = {name: one for name, one in reply.items() if name not in ("timing", "client", "server", "sequence")}
    return json.dumps(members, sort_keys=True)


class Json(unittest.TestCase):
    local: percuss.Local

    @classmethod
    def setUpClass(cls) -> None:
        cls.local = percuss.Local(CATALOGUE)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.local.close()

    def same(self, asked: dict[str, Any]) -> percuss.Reply:
        """Of the program and of Python, of the text, of the object, and of what to_json makes of it."""
        printed = by_program(json.dumps(asked))
        self.assertTrue(printed.stdout, printed.stderr)
        expected = json.loads(printed.stdout)
        request = percuss.Request.from_json(json.dumps(asked))
        self.assertEqual(request.sequence, asked.get("sequence", 0))
        reply = self.local.solve(request)
        self.assertEqual(untimed(reply.to_json()), untimed(expected))
        self.assertEqual(set(reply.to_json()), set(expected))
        self.assertEqual(percuss.Request.from_json(request.to_json()).to_json(), request.to_json())
        return reply

    def test_same_answers(self) -> None:
        statuses = set()
        for name, asked in ANSWERED.items():
            with self.subTest(name):
                statuses.add(self.same(asked).status.name)
        self.assertEqual(statuses, {"OK", "BAD_REQUEST", "NOT_APPROACHING", "UNKNOWN_BODY"})

    def test_again(self) -> None:
        """The state after one impact is where the next begins; what to_json writes is read by the program."""
        asked = percuss.Request.from_json(PLAIN)
        first = self.local.solve(asked).raise_for_status()
        asked.bodies[1].state, asked.bodies[1].elapsed = first.states_after[1].state, 1e-3
        asked.options.contact_model = percuss.ContactModel.HERTZ
        asked.delassus = [10.0]
        again = percuss.Request.from_json(json.dumps(asked.to_json()))
        self.assertEqual(again.bodies[1].state, asked.bodies[1].state)
        mine = self.local.solve(asked).raise_for_status().to_json()
        asked.sequence = 0
        read = self.local.solve(again).raise_for_status().to_json()
        self.assertEqual(mine["contacts"], read["contacts"])
        self.assertNotEqual(mine["contacts"], first.to_json()["contacts"])
        # a process of its own knows no token, and says so: it was read
        self.assertIn("UNKNOWN_STATE", by_program(json.dumps(again.to_json())).stdout)

    def test_same_refusals(self) -> None:
        for asked in REFUSED:
            with self.subTest(json.dumps(asked)[:120]):
                printed = by_program(json.dumps(asked))
                self.assertEqual(printed.returncode, 2, printed.stdout)
                expected = printed.stderr.strip().removeprefix("percuss: ").replace("options, client,", "options,")
                for given in (asked, json.dumps(asked)) if isinstance(asked, dict) else (json.dumps(asked),):
                    with self.assertRaises(ValueError) as raised:
                        percuss.Request.from_json(given)
                    self.assertEqual(str(raised.exception), expected)

    def test_what_is_no_json(self) -> None:
        """Both refuse; the words are those of the two parsers."""
        for text, word in (
            ('{"bodies": [}', "line 1"),
            ('{"bodies": [], "bodies": []}', "bodies: is there twice"),
            ('{"options": {"tolerance": NaN}}', "NaN"),
            ('{"options": {"tolerance": 1e999}}', "options.tolerance"),
            ('{"bodies": [{"id": "a\\u0000b"}]}', r"bodies\[0\].id"),
            ('{"bodies": [{"id": "\\ud800"}]}', r"bodies\[0\].id"),
            ("[" * 100000, "deep"),
        ):
            with self.subTest(text[:40]):
                self.assertEqual(by_program(text).returncode, 2)
                with self.assertRaisesRegex(ValueError, word):
                    percuss.Request.from_json(text)
        with self.assertRaisesRegex(ValueError, "client: .*percuss.connect"):
            percuss.Request.from_json({**PLAIN, "client": CLIENT})

    def test_same_members(self) -> None:
        """The reader knows the members of `percuss schema request`, no more and no fewer."""
        command = [str(PROGRAM), "schema", "request"]
        properties = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["properties"]
        mine = percuss.Request([percuss.BodyMotion("a")], [percuss.Contact(0, 0)], [1.0], sequence=1).to_json()
        self.assertEqual(list(mine), [name for name in properties if name != "client"])
        self.assertEqual(list(mine["options"]), list(properties["options"]["properties"]))
        for name in ("bodies", "contacts"):
            self.assertEqual(list(mine[name][0]), list(properties[name]["items"]["properties"]))

    def test_http(self) -> None:
        """The example: what the program prints, and its refusals with the codes of HTTP."""
        example = SOURCE / "client" / "python" / "examples" / "http_server.py"
        command = [sys.executable, str(example), "--catalogue", str(CATALOGUE), "--port", "0"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            try:
                assert server.stdout
                port = int(server.stdout.readline().split(":")[2].split("/")[0])

                def ask(body: str, path: str = "/solve", method: str = "POST") -> tuple[int, dict[str, Any]]:
                    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
                    connection.request(method, path, body)
                    answer = connection.getresponse()
                    said: dict[str, Any] = json.loads(answer.read())
                    connection.close()
                    return answer.status, said

                for asked in (PLAIN, ANSWERED["unknown"]):
                    code, reply = ask(json.dumps(asked))
                    self.assertEqual((code, untimed(reply)), (200, untimed(json.loads(by_program(json.dumps(asked)).stdout))))
                code, reply = ask(json.dumps(changed("bodies.0.velocity", [1, 2])))
                self.assertEqual((code, reply), (400, {"message": "bodies[0].velocity: 3 numbers are needed, not 2"}))
                code, reply = ask(json.dumps(changed("contacts.0.a", 64)))
                self.assertEqual((code, reply), (400, {"message": "contacts[0].a: 64: 0..63 is allowed"}))
                self.assertEqual(ask("{")[0], 400)
                self.assertEqual(ask(" " * (1 << 21))[0], 413)
                self.assertEqual(ask("", "/elsewhere")[0], 404)
                self.assertEqual(ask("", method="GET")[0], 405)
            finally:
                server.terminate()


if __name__ == "__main__":
    unittest.main()
