# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a JSON file is what a schema says, by somebody else's validator. Of what is printed the schema
allows members that newer versions add; here none is.
usage: validate.py SCHEMA FILE    (exit code 1: it is not)"""
import json
import sys

from jsonschema import Draft202012Validator


def close(schema):
    """Allows no members but those named."""
    if isinstance(schema, dict):
        if "properties" in schema:
            schema.setdefault("additionalProperties", False)
        for inner in schema.values():
            close(inner)
    if isinstance(schema, list):
        for inner in schema:
            close(inner)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        schema = json.load(file)
    with open(sys.argv[2], encoding="utf-8") as file:
        value = json.load(file)
    Draft202012Validator.check_schema(schema)
    close(schema)
    errors = list(Draft202012Validator(schema).iter_errors(value))
    for error in errors:
        print("/".join(str(step) for step in error.absolute_path) + ": " + error.message[:200], file=sys.stderr)
    return 1 if errors else 0


sys.exit(main())
