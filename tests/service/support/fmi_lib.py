# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""What the stories of both FMUs need: an instance of one, and what percuss says of the same impact."""

import json
import subprocess

import fmpy
from fmpy.simulation import instantiate_fmu


def close(what, value, wanted, tolerance):
    """Relative, or absolute where zero is wanted."""
    assert abs(value - wanted) <= tolerance * (abs(wanted) or 1.0), f"{what}: {value!r}, not {wanted!r}"


def query(percuss, speed, *arguments):
    """The reply of percuss query --local at that speed as an object."""
    command = [percuss, "query", "--local", "--json", "--speed", repr(float(speed)), *arguments]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def ask(percuss, request):
    """The reply to a whole request, both as objects."""
    command = [percuss, "query", "--local", "--json", "--request", "-"]
    asked = subprocess.run(command, check=True, input=json.dumps(request), capture_output=True, text=True)
    return json.loads(asked.stdout)


class Unpacked:
    """An FMU on disk, of which instances are made."""

    def __init__(self, file):
        self.folder = fmpy.extract(file)
        self.description = fmpy.read_model_description(file)
        self.references = {v.name: v for v in self.description.modelVariables}
        self.said = []

    def log(self, environment, status, category, message):
        self.said.append(message.decode() if isinstance(message, bytes) else message)

    def instance(self, kind="CoSimulation", event_mode=False, early_return=False, start=None):
        """One that is initialized."""
        fmu = instantiate_fmu(self.folder, self.description, kind, logger=self.log, event_mode_used=event_mode,
                              early_return_allowed=early_return)
        self.set(fmu, start or {})
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        return fmu

    def set(self, fmu, values):
        for name, value in values.items():
            variable = self.references[name]
            getattr(fmu, "set" + variable.type)([variable.valueReference], [value])

    def get(self, fmu, *names):
        values = []
        for name in names:
            variable = self.references[name]
            values += getattr(fmu, "get" + variable.type)([variable.valueReference])
        return values if len(names) > 1 else values[0]

    def refused(self, words, call, *arguments, **named):
        """The call fails, and the importer was told these words."""
        self.said.clear()
        try:
            call(*arguments, **named)
        except Exception:
            assert any(words in text for text in self.said), f"not told '{words}': {self.said}"
            return
        raise AssertionError(f"not refused: {words}")
