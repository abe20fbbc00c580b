# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Whether catalogues and settings in YAML are what their schemas say, by somebody else's validator.
usage: validate_yaml.py SCHEMA FILE...                 (prints those that are)
       validate_yaml.py --all SCHEMA SCHEMA SOURCE     (of catalogues, of settings: all shipped files and each example
                                                        of the documents; parts of a file without what a whole one must
                                                        have; exit code 1: one is not)"""
import json
import re
import sys
from pathlib import Path

import yaml
from jsonschema import Draft202012Validator


def with_names(value):
    """Keys as JSON has them: a material 6061 is a name."""
    if isinstance(value, dict):
        return {str(key): with_names(inner) for key, inner in value.items()}
    return [with_names(inner) for inner in value] if isinstance(value, list) else value


def load_schema(file):
    with open(file, encoding="utf-8") as text:
        schema = json.load(text)
    Draft202012Validator.check_schema(schema)
    return schema


def errors_of(schema, text):
    found = Draft202012Validator(schema).iter_errors(with_names(yaml.safe_load(text)))
    return ["/".join(map(str, error.absolute_path)) + ": " + error.message[:200] for error in found]


def examples(source):
    """Name, text, and whether it is a whole file."""
    for file in sorted(source.rglob("*.yaml")):
        if not file.relative_to(source).parts[0].startswith("build"):
            yield str(file), file.read_text(encoding="utf-8"), True
    for page in [source / "README.md", *sorted((source / "docs").rglob("*.md"))]:
        text = page.read_text(encoding="utf-8")
        for found in re.finditer(r"```yaml[^\n]*\n(.*?)```", text, re.S):
            yield str(page), found[1], False
        for found in re.finditer(r"cat > \S+\.yaml <<'?(\w+)'?\n(.*?)\n\1", text, re.S):
            yield str(page), found[2], True
    for page in sorted((source / "client" / "man").glob("*.[58]")):
        for found in re.finditer(r"\.Bd -literal[^\n]*\n(materials:.*?)\.Ed", page.read_text(encoding="utf-8"), re.S):
            yield str(page), found[1], True


def check_all(catalogue, settings, source):
    part = {**catalogue, "required": []}
    wrong, count = [], 0
    for name, text, whole in examples(source):
        top = with_names(yaml.safe_load(text)) or {}
        # bodies of settings are a folder's
        if set(top) <= set(settings["properties"]) and not isinstance(top.get("bodies"), dict):
            schema = settings
        elif set(top) & set(catalogue["properties"]):
            schema = catalogue if whole else part
        else:
            # an entry of bodies
            schema = {"additionalProperties": catalogue["properties"]["bodies"]["additionalProperties"],
                      "$defs": catalogue["$defs"]}
        wrong += [f"{name}: {error}" for error in errors_of(schema, text)]
        count += 1
    return wrong if count >= 13 else [*wrong, f"{count} examples: where are the others?"]


def main():
    if sys.argv[1] == "--all":
        wrong = check_all(load_schema(sys.argv[2]), load_schema(sys.argv[3]), Path(sys.argv[4]))
        print("\n".join(wrong), file=sys.stderr)
        return 1 if wrong else 0
    schema = load_schema(sys.argv[1])
    for file in sys.argv[2:]:
        if not errors_of(schema, Path(file).read_text(encoding="utf-8")):
            print(file)
    return 0


sys.exit(main())
