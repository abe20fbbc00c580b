# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What a monitoring system makes of the daemon's metrics, by the parsers of Prometheus' own Python client.

usage: metrics.py FILE value NAME [LABEL=VALUE...]      prints it
       metrics.py FILE known DASHBOARD RULES            every metric that they name is there
"""
import json
import re
import sys

from prometheus_client import openmetrics, parser
import prometheus_client.openmetrics.parser

text = open(sys.argv[1], encoding="utf-8").read()
families = list(openmetrics.parser.text_string_to_metric_families(text))
# the collector of text files reads the older format, in which the end is a comment
older = {sample.name for family in parser.text_string_to_metric_families(text) for sample in family.samples}
samples = [sample for family in families for sample in family.samples]
names = {sample.name for sample in samples}
assert older == names, older ^ names
assert all(family.documentation for family in families)

if sys.argv[2] == "value":
    labels = dict(argument.split("=") for argument in sys.argv[4:])
    found = [s.value for s in samples if s.name == sys.argv[3] and labels.items() <= s.labels.items()]
    assert found, f"no {sys.argv[3]} {labels}"
    print(f"{sum(found):g}")
else:
    queries = [t["expr"] for panel in json.load(open(sys.argv[3]))["panels"] for t in panel["targets"]]
    queries += re.findall(r"expr: (.*)", open(sys.argv[4]).read())
    asked = {name for query in queries for name in re.findall(r"\b(?:percuss|process)_\w+", query)}
    assert len(asked) > 15 and asked <= names, asked - names
    # and what is counted is shown
    shown = {re.sub("_(bucket|sum|count)$", "", name) for name in asked}
    assert {re.sub("_(bucket|sum|count)$", "", name) for name in names} <= shown, names - asked
