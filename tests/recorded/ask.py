# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Asks saved scenes of the percussd in a domain, or in this process, and prints every reply to the last bit, one JSON object a line.

usage: ask.py catalogue FOLDER: prints one catalogue of the bodies of all scenes
       ask.py DOMAIN FOLDER: asks every blow of every scene (later ones strike the bodies as they were
       left), then the first blows once more in batches, and some refusals
       ask.py SETTINGS FOLDER: the same in this process, with that file of settings
"""

import dataclasses
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ASKED_IN_OTHER_WAYS = {7: {"conditioning": True}, 11: {"dents": "ignore"}, 13: {"compliance": "matched"}}
"""Options of every so many-th scene."""

VOLATILE = ("client", "server", "sequence", "timing", "version")


def scene_numbers(folder: Path) -> list[int]:
    return sorted(int(path.stem.split("-")[1]) for path in folder.glob("scene-*.yaml"))


def named(number: int, body: str) -> str:
    return f"s{number}-{body}"


def catalogue(folder: Path) -> str:
    """The catalogues of all scenes as one: materials and bodies are given the scene's number."""
    sections: dict[str, list[str]] = {"materials": [], "bodies": []}
    for number in scene_numbers(folder):
        section = ""
        for line in (folder / f"scene-{number}.yaml").read_text().splitlines():
            if not line.startswith("  "):
                section = line.split(":")[0]
                continue
            line = re.sub(r"^  (of-)?", lambda m: f"  {m[1] or ''}s{number}-", line)
            sections[section].append(re.sub(r"material: of-", f"material: of-s{number}-", line))
    text = "".join(f"{name}:\n" + "\n".join(lines) + "\n" for name, lines in sections.items())
    return text + "contact: {compliance: half-space}\n"


def plain(value: Any) -> Any:
    """What JSON can say, with all bits of every number."""
    if dataclasses.is_dataclass(value):
        members = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return {name: plain(member) for name, member in members.items() if name not in VOLATILE}
    if getattr(getattr(value, "dtype", None), "names", None):
        return {name: plain(value[name]) for name in value.dtype.names}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (tuple, list)):
        return [plain(one) for one in value]
    return value


def show(title: str, reply: Any) -> None:
    print(json.dumps({"asked": title, **plain(reply)}), flush=True)


def request(percuss: Any, number: int, asked: dict[str, Any]) -> Any:
    """The request of a JSON file."""
    options = asked["options"]
    for every, other in ASKED_IN_OTHER_WAYS.items():
        if number % every == 0:
            options = {**options, **other}
    # a table of its own for each pair would take minutes; the family of tables is asked
    if options["contact_model"] == "table":
        options["contact_model"] = "auto"
    for name, kind in (
        ("contact_model", percuss.ContactModel),
        ("compliance", percuss.Compliance),
        ("dents", percuss.Dents),
    ):
        options[name] = kind[options[name].upper().replace("-", "_")]
    bodies = [percuss.BodyMotion(**{**body, "id": named(number, body["id"])}) for body in asked["bodies"]]
    contacts = [percuss.Contact(**contact) for contact in asked["contacts"]]
    return percuss.Request(bodies, contacts, options=percuss.Options(**options))


def blows(percuss: Any, folder: Path, number: int) -> Iterator[Any]:
    count = len(list(folder.glob(f"scene-{number}-*.json")))
    for blow in range(1, count + 1):
        yield request(percuss, number, json.loads((folder / f"scene-{number}-{blow}.json").read_text()))


def ask_scenes(percuss: Any, client: Any, folder: Path) -> list[Any]:
    """Asks all; returns the first blows."""
    first = []
    for number in scene_numbers(folder):
        states: dict[str, str] = {}
        for blow, question in enumerate(blows(percuss, folder, number)):
            if blow == 0:
                first.append(question)
            for body in question.bodies:
                body.state = states.get(body.id, "")
            reply = client.solve(question, timeout=120.0)
            show(f"scene {number} blow {blow}", reply)
            if reply.status not in (percuss.Status.OK, percuss.Status.TRUNCATED):
                break
            states = {after.id: after.state for after in reply.states_after}
    return first


def ask_with_own_mass(percuss: Any, client: Any, question: Any, title: str) -> None:
    """A simulator's own W: the diagonal of the service's, doubled."""
    reply = client.solve(question, timeout=120.0)
    count = len(reply.contacts)
    question.delassus = [
        [2.0 * reply.contacts[i].inverse_effective_mass if i == j else 0.0 for j in range(count)]
        for i in range(count)
    ]
    if count:
        show(title, client.solve(question, timeout=120.0))
    question.delassus = None


def ask_refused(percuss: Any, client: Any, question: Any) -> None:
    """One number out of its range at a time."""
    nan = float("nan")
    wrong = [
        (question.options, "tolerance", [-1.0, 1e-13, 2.0, nan]),
        (question.options, "horizon", [-1.0, 11.0, 1e-10, nan]),
        (question.options, "deadline", [-1.0, 2e9, nan]),
        (question.contacts[0], "gap", [2e6, -2e6, 5e3, nan]),
        (question.contacts[0], "gap_acceleration", [2e9, nan]),
        (question.contacts[0], "normal", [(0.0, 0.0, 0.0), (nan, 0.0, 1.0)]),
        (question.contacts[0], "point", [(1e7, 0.0, 0.0), (5.0, 5.0, 5.0)]),
        (question.contacts[0], "b", [0, 60]),
        (question.bodies[0], "velocity", [(1e7, 0.0, 0.0), (2e4, 0.0, 0.0), (nan, 0.0, 0.0)]),
        (question.bodies[0], "orientation", [(2.0, 0.0, 0.0, 0.0)]),
        (question.bodies[0], "elapsed", [-1.0]),
        (question.bodies[0], "id", ["", "nobody", "\x01"]),
        (question.bodies[0], "state", ["0" * 32]),
        (question.bodies[0], "overrides", [{percuss.Parameter.YOUNG: -1.0}]),
        (question, "delassus", [[[-1.0]], [[nan]]]),
        (question, "bodies", [[]]),
        (question, "contacts", [[]]),
    ]
    for owner, name, values in wrong:
        kept = getattr(owner, name)
        for value in values:
            setattr(owner, name, value)
            if name != "contacts" or value:
                show(f"{name} {value}", client.solve(question, timeout=120.0))
        setattr(owner, name, kept)


def main() -> None:
    folder = Path(sys.argv[2])
    if sys.argv[1] == "catalogue":
        print(catalogue(folder), end="")
        return
    import percuss

    whom = sys.argv[1]
    with percuss.connect(int(whom)) if whom.isdigit() else percuss.Local(settings=whom) as client:
        first = ask_scenes(percuss, client, folder)
        for begin in range(0, len(first), 24):
            replies = client.solve_batch(first[begin : begin + 24], timeout=300.0)
            for i, reply in enumerate(replies):
                show(f"batch {begin} {i}", reply)
        single = [question for question in first if len(question.contacts) == 1]
        for i, question in enumerate(single[:40:4]):
            ask_with_own_mass(percuss, client, question, f"own mass {i}")
        ask_refused(percuss, client, single[1])


if __name__ == "__main__":
    main()
