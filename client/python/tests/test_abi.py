# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""percuss/_abi.py and percuss/vocabulary.py against the public headers and the compiler.

The structs are read from the headers; a C program made of their names prints each size and offset.
"""

import dataclasses
import importlib.metadata
import os
import re
import subprocess
import tempfile
import unittest
from ctypes import CDLL, POINTER, Structure, c_char_p, c_double
from pathlib import Path
from typing import Any, cast

import numpy as np
from typing_extensions import TypeAliasType, TypeVar

import percuss
from percuss import _abi, _convert, _ensemble_abi, _measured_abi, _slow_abi, vocabulary
from percuss.slowscale import Application

SOURCE = Path(os.environ["PERCUSS_SOURCE"])
HEADERS = SOURCE / "client" / "include" / "percuss"
# the slow scale is a library of its own
LIBRARY = [header for header in sorted(HEADERS.glob("*.h")) if not header.name.startswith("slow")]
SLOW = sorted(HEADERS.glob("slow*.h"))
VOCABULARY = SOURCE / "idl" / "percuss" / "vocabulary.h"


def field_names(declarations: str) -> list[str]:
    """The names in `double a[3], *b; struct { ... } c;`, in order."""
    # a nested struct counts as one field
    flat = re.sub(r"struct\s*{[^}]*}", "struct", declarations)
    # a pointer to a function is called what stands in its first parentheses
    flat = re.sub(r"\w[^;]*?\(\*(\w+)\)\([^;]*\)", r"\1", flat)
    fields = []
    for declaration in filter(None, map(str.strip, flat.split(";"))):
        fields += [re.findall(r"\w+", re.sub(r"\[.*?\]", "", one))[-1] for one in declaration.split(",")]
    return fields


def public_structs(headers: list[Path] = LIBRARY) -> dict[str, list[str]]:
    """Every struct that the headers define, with its fields."""
    structs = {}
    for header in headers:
        code = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL)
        for name, body in re.findall(r"^struct (\w+) { *\n(.*?)^};", code, flags=re.DOTALL | re.MULTILINE):
            structs[name] = field_names(body)
    return structs


def compiled_layouts(structs: dict[str, list[str]]) -> dict[tuple[str, ...], list[int]]:
    """(struct,): [size]; (struct, field): [offset, size], as the compiler has them."""
    headers = ("percuss/local.h", "percuss/measured.h", "percuss/ensemble_share.h", "percuss/slowscale.h", "percuss/slow_link.h", "stdio.h")
    lines = [*(f"#include <{header}>" for header in headers), "int main(void) {"]
    for struct, fields in structs.items():
        lines.append(f'printf("{struct} : %zu\\n", sizeof(struct {struct}));')
        lines += [
            f'printf("{struct} {field} : %zu %zu\\n", offsetof(struct {struct}, {field}),'
            f" sizeof(((struct {struct} *)0)->{field}));"
            for field in fields
        ]
    lines += ["}", ""]
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "layouts"
        program.with_suffix(".c").write_text("\n".join(lines))
        include = [f"-I{HEADERS.parent}", f"-I{SOURCE / 'idl'}"]
        compiler = os.environ.get("CC", "cc")
        subprocess.run([compiler, *include, program.with_suffix(".c"), "-o", program], check=True)
        output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    pairs = (line.split(" : ") for line in output.splitlines())
    return {tuple(names.split()): [int(number) for number in numbers.split()] for names, numbers in pairs}


def our_layouts(structs: dict[str, type[Structure]] = _abi.STRUCTS) -> dict[tuple[str, ...], list[int]]:
    layouts: dict[tuple[str, ...], list[int]] = {}
    for struct, ours in structs.items():
        layouts[(struct,)] = [_size(ours)]
        for field in ours._fields_:
            descriptor = getattr(ours, field[0])
            layouts[(struct, field[0])] = [descriptor.offset, descriptor.size]
    return layouts


def _size(struct: type[Structure]) -> int:
    return len(bytes(struct()))


class Abi(unittest.TestCase):
    def test_layouts(self) -> None:
        structs = public_structs()
        all_ours = {**_abi.STRUCTS, **_ensemble_abi.STRUCTS, **_measured_abi.STRUCTS}
        self.assertEqual(structs, {name: [field[0] for field in ours._fields_] for name, ours in all_ours.items()})
        self.assertEqual(our_layouts(all_ours), compiled_layouts(structs))

    def test_slow_layouts(self) -> None:
        structs = public_structs(SLOW)
        del structs["percuss_slow_outcome"]  # of the equations alone, as the functions below
        ours = {name: [field[0] for field in struct._fields_] for name, struct in _slow_abi.STRUCTS.items()}
        self.assertEqual(structs, ours)
        self.assertEqual(our_layouts(_slow_abi.STRUCTS), compiled_layouts(structs))

    def test_slow_choices(self) -> None:
        code = (HEADERS / "slowscale.h").read_text()
        lists = re.search(r"enum percuss_slow_application {(.*?)}", code, flags=re.DOTALL)
        assert lists
        names = re.findall(r"PERCUSS_SLOW_(\w+)", lists[1])
        self.assertEqual([(one.name, one.value) for one in Application], list(zip(names, range(9))))

    def test_slow_functions(self) -> None:
        code = "".join(header.read_text() for header in SLOW)
        functions = set(re.findall(r"PERCUSS_API[^;(]*?\bpercuss_slow_(\w+)\(", code))
        declared = {name for name, _, _ in (*_slow_abi.FUNCTIONS, *_slow_abi.LINK_FUNCTIONS)}
        unused = {"compression", "poisson", "restitution", "gap_rate_after", "force_centre"}
        self.assertEqual(declared | unused, functions)

    def test_sub_impact_dtype(self) -> None:
        fields = percuss.SUB_IMPACT.fields
        assert fields is not None
        offsets = {name: [field[1], field[0].itemsize] for name, field in fields.items()}
        layouts = our_layouts()
        for name, *_ in _abi.SubImpact._fields_:
            self.assertEqual(offsets.pop(name), layouts["percuss_sub_impact", name])
        self.assertEqual(offsets, {})
        self.assertEqual([percuss.SUB_IMPACT.itemsize], layouts["percuss_sub_impact",])

    def test_choices(self) -> None:
        """Same names and numbers as in the lists of the C headers."""
        code = "".join(path.read_text() for path in (VOCABULARY, *(HEADERS / f"{one}.h" for one in ("result", "ensemble_request", "task"))))
        for choices in vocabulary.Choice.__subclasses__():
            if choices in (percuss.Support, Application):
                continue
            upper = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", choices.__name__).upper()
            match = re.search(rf"PERCUSS_{upper}_LIST\(X\)(.*?)\n[\n#]", code, flags=re.DOTALL)
            assert match, upper
            members = re.findall(r"X\((\w+),", match[1])
            self.assertEqual([(choice.name, choice.value) for choice in choices], list(zip(members, range(99))))
        supports = re.search(r"enum percuss_support {(.*?)}", (HEADERS / "server.h").read_text())
        assert supports
        self.assertEqual([f"PERCUSS_SUPPORT_{one.name}" for one in percuss.Support], re.findall(r"\w+", supports[1]))

    def test_limits(self) -> None:
        for name, number in re.findall(r"PERCUSS_((?:MAX_|ID_)\w+) = (\d+)", VOCABULARY.read_text()):
            self.assertEqual(getattr(vocabulary, name), int(number), name)

    def test_functions(self) -> None:
        """Every public function is declared, or is one that Python does without."""
        code = "".join(header.read_text() for header in LIBRARY)
        functions = set(re.findall(r"PERCUSS_API[^;(]*?\bpercuss_(\w+)\(", code))
        unused = {
            *(name for name in functions if name.endswith(("_name", "_default"))),
            *("request_init", "request_add_body", "request_add_contact", "body_find"),
            "client_create_secured",
            *("ensemble_request_init", "measured_count"),
        }
        declared = {name for name, _, _ in (
            *_abi._FUNCTIONS,
            *_abi.LOCAL_FUNCTIONS,
            *_ensemble_abi.FUNCTIONS,
            *_ensemble_abi.SHARE_FUNCTIONS,
            *_measured_abi.FUNCTIONS,
        )}
        self.assertEqual(declared | unused | {"version"}, functions)

    def test_force_centres(self) -> None:
        """To the bit as the C side of the slow scale has them."""
        library = CDLL(os.environ["PERCUSS_LIBRARY"].replace("libpercuss", "libpercuss-slowscale"))
        in_c = library.percuss_slow_force_centre
        in_c.argtypes, in_c.restype = [POINTER(_abi.SubImpact)], c_double
        subs = np.zeros(4, percuss.SUB_IMPACT)
        subs["start"] = [0.0, -3e-3, 1.0, 2.0]
        subs["compression_end"] = subs["start"] + [1e-4, 2e-4, 3e-4, 4e-4]
        subs["end"] = subs["compression_end"] + [1e-4, 5e-4, 1e-4, 0.0]
        subs["impulse"] = [0.02, 0.03, 0.01, 0.0]
        subs["compression_impulse"] = [0.01, 0.011, 0.009, 0.0]
        subs["peak_force"] = [170.0, 99.0, 50.0, 0.0]
        expected = [in_c(_abi.SubImpact.from_buffer_copy(one.tobytes())) for one in subs]
        self.assertEqual(percuss.force_centres(subs).tolist(), expected)
        self.assertEqual(expected[0], 1e-4)
        self.assertGreater(expected[1], subs["compression_end"][1])

    def test_arrays_by_any_name(self) -> None:
        """numpy 2.5 has NDArray as an alias, which is no class; members declared by it stay arrays."""
        scalar = TypeVar("scalar")
        alias: Any = TypeAliasType("alias", np.ndarray[Any, np.dtype[Any]], type_params=cast(Any, (scalar,)))
        kind: Any = dataclasses.make_dataclass("Kind", [("impulse", float), ("sub_impacts", alias[np.void])])
        subs = (_abi.SubImpact * 2)(_abi.SubImpact(start=0.0), _abi.SubImpact(start=0.5))
        source = _abi.ContactResult(impulse=3.0, sub_impacts_listed=2, sub_impacts=subs)
        found = _convert.read(source, kind)
        self.assertEqual(found.impulse, 3.0)
        self.assertEqual(found.sub_impacts["start"].tolist(), [0.0, 0.5])

    def test_unknown_choice(self) -> None:
        newer = percuss.Status(4711)
        self.assertEqual((newer, newer.name), (4711, "UNKNOWN_4711"))

    def test_version(self) -> None:
        self.assertEqual(importlib.metadata.version("percuss"), percuss.__version__)
        _abi.library.percuss_version.restype = c_char_p
        self.assertEqual(_abi.library.percuss_version().decode(), percuss.__version__)


if __name__ == "__main__":
    unittest.main()
