# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of the members of what `percuss` reads and prints as JSON, from the schemas that it prints.
usage: members.py PERCUSS"""
import json
import subprocess
import sys

KINDS = [
    ("request", "A request", "what `percuss query --request FILE` reads"),
    ("reply", "A reply", "what `percuss query --json` prints"),
    ("ensemble", "An ensemble's report", "what `percuss ensemble --json` prints"),
    ("sweep", "A sweep", "what `percuss sweep --json` prints"),
    ("compare", "A comparison", "what `percuss compare --json` prints"),
    ("calibrate", "A calibration", "what `percuss calibrate --json` prints"),
    ("export", "Parameters of another simulator", "what `percuss export --json` prints"),
    ("bodies", "The server's bodies", "what `percuss bodies --json` prints"),
    ("remarks", "Remarks on them", "what `percuss bodies --check --json` prints"),
    ("dents", "Specimens", "what `percuss dents --json` prints"),
    ("status", "Servers", "what `percuss status --json` prints"),
    ("ping", "Round trips", "what `percuss ping --json` prints"),
    ("doctor", "Findings", "what `percuss doctor --json` prints"),
    ("query", "Several answers", "what `percuss query --json` prints to several speeds or contact models"),
]


def span(schema):
    """The range of a number."""
    if "minimum" not in schema and "maximum" not in schema:
        return ""
    low, high = schema.get("minimum"), schema.get("maximum")
    if high is None:
        return f", at least {low:.10g}"
    return f", {low:.10g} to {high:.10g}"


def kind_of(schema):
    """The type in words."""
    if "enum" in schema:
        return ", ".join(f"`{word}`" for word in schema["enum"])
    words = schema["type"]
    if isinstance(words, list):
        return " or ".join(words)
    if words == "array":
        items = schema["items"]
        count = f" of {schema['minItems']}" if "minItems" in schema else ""
        most = f" of at most {schema['maxItems']}" if "maxItems" in schema and not count else ""
        of = "objects" if items["type"] == "object" else kind_of(items)
        return f"list{count}{most}: {of}"
    if "anyOf" in schema:
        return words + ", 0 or" + span(schema["anyOf"][1])[1:]
    if words == "string" and "pattern" in schema:
        return "32 hexadecimal digits"
    if words == "string" and "maxLength" in schema:
        return f"string of at most {schema['maxLength']} bytes"
    return words + span(schema)


def rows(schema, before):
    """One row a member, those of objects under their whole names."""
    for name, member in schema["properties"].items():
        print(f"| `{before}{name}` | {kind_of(member)} | {member.get('description', '')} |")
        inner = member["items"] if member["type"] == "array" else member
        if inner.get("title"):
            continue
        if inner["type"] == "object":
            rows(inner, f"{before}{name}{'[]' if member['type'] == 'array' else ''}.")


def main():
    schemas = {
        kind: json.loads(subprocess.run([sys.argv[1], "schema", kind], check=True, capture_output=True).stdout)
        for kind, _, _ in KINDS
    }
    for kind, heading, what in KINDS:
        schema = schemas[kind]
        print(f"\n## {heading}\n\n`percuss schema {kind}`: {what}.\n\n| member | type | |\n|---|---|---|")
        rows(without_replies(schema, kind), "")


def without_replies(schema, kind):
    """A sweep's points hold whole replies, which have a table of their own, and its curves points."""
    if kind == "sweep":
        point = schema["properties"]["points"]["items"]
        point["properties"]["reply"]["title"] = "reply"
        schema["properties"]["curves"]["items"]["properties"]["points"]["items"]["title"] = "points"
    if kind == "query":
        schema["properties"]["answers"]["items"]["properties"]["reply"]["title"] = "reply"
    return schema


main()
