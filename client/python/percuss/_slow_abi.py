# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The structs and functions of <percuss/slowscale.h> and <percuss/slow_link.h>, as _abi.py has those of percuss.h."""

import ctypes
from ctypes import CFUNCTYPE, POINTER, c_bool, c_char_p, c_double, c_int
from ctypes import c_size_t, c_uint, c_uint32, c_uint64, c_void_p
from typing import Any

from ._abi import BodyMotion, Options, Reply, Request
from ._abi import library as _percuss
from ._library import load

_Vector = c_double * 3


class Contact(ctypes.Structure):
    _fields_ = [
        ("a", c_uint32),
        ("b", c_uint32),
        ("feature", c_uint32),
        ("point", _Vector),
        ("normal", _Vector),
        ("gap", c_double),
        ("gap_acceleration", c_double),
        ("friction", c_double),
        ("tangent", _Vector),
    ]


class Inertia(ctypes.Structure):
    _fields_ = [("mass", c_double), ("moments", _Vector)]


class View(ctypes.Structure):
    _fields_ = [
        ("count", c_size_t),
        ("contacts", POINTER(Contact)),
        ("gap_rate", POINTER(c_double)),
        ("delassus", POINTER(c_double)),
        ("bodies", POINTER(BodyMotion)),
    ]


Probe = CFUNCTYPE(c_bool, c_void_p, POINTER(View))
Apply = CFUNCTYPE(c_bool, c_void_p, POINTER(Contact), c_double)
ApplyVector = CFUNCTYPE(c_bool, c_void_p, POINTER(Contact), POINTER(c_double))
Now = CFUNCTYPE(c_double, c_void_p)
Oblique = CFUNCTYPE(c_bool, c_void_p, c_size_t, POINTER(Contact), POINTER(c_double))
Push = CFUNCTYPE(c_bool, c_void_p, c_uint32, POINTER(c_double), POINTER(c_double))


class Engine(ctypes.Structure):
    _fields_ = [
        ("context", c_void_p),
        ("probe", Probe),
        ("apply", Apply),
        ("now", Now),
        ("push", Push),
        ("apply_vector", ApplyVector),
        ("oblique", Oblique),
    ]


class Service(ctypes.Structure):
    _fields_ = [
        ("context", c_void_p),
        ("solve", CFUNCTYPE(c_int, c_void_p, POINTER(Request), POINTER(Reply))),
        ("release", CFUNCTYPE(None, POINTER(Reply))),
        ("problem", CFUNCTYPE(c_char_p, c_void_p)),
    ]


class Report(ctypes.Structure):
    _fields_ = [
        ("time", c_double),
        ("count", c_size_t),
        ("contacts", POINTER(Contact)),
        ("gap_rate", POINTER(c_double)),
        ("delassus", POINTER(c_double)),
        ("impulse", POINTER(c_double)),
        ("restitution", POINTER(c_double)),
        ("reply", POINTER(Reply)),
        ("message", c_char_p),
        ("declared", c_uint64),
    ]


ReportFunction = CFUNCTYPE(None, c_void_p, POINTER(Report))


class Body(ctypes.Structure):
    _fields_ = [("id", c_char_p), ("fixed", c_bool), ("free", c_bool)]


class Config(ctypes.Structure):
    _fields_ = [
        ("body_count", c_size_t),
        ("bodies", POINTER(Body)),
        ("engine", Engine),
        ("service", Service),
        ("options", Options),
        ("application", c_uint),
        ("restitution", c_double),
        ("rest_speed", c_double),
        ("group_gap", c_double),
        ("report", ReportFunction),
        ("report_context", c_void_p),
        ("fall_back", c_bool),
        ("move", Apply),
        ("move_vector", ApplyVector),
        ("velocity_lag", c_double),
    ]


class Counts(ctypes.Structure):
    _fields_ = [(name, c_uint64) for name in ("impacts", "requests", "repeated", "preempted", "declared")]


class Link(ctypes.Structure):
    _fields_ = [("client", c_void_p), ("timeout", c_double), ("reconnect", c_double), ("connected", c_bool)]


# the C struct behind each class
STRUCTS: dict[str, type[ctypes.Structure]] = {
    "percuss_slow_contact": Contact,
    "percuss_slow_inertia": Inertia,
    "percuss_slow_view": View,
    "percuss_slow_engine": Engine,
    "percuss_slow_service": Service,
    "percuss_slow_report": Report,
    "percuss_slow_body": Body,
    "percuss_slow_config": Config,
    "percuss_slow_counts": Counts,
    "percuss_slow_link": Link,
}

library = load("slowscale", version=False)
_Slow = c_void_p
_Doubles = POINTER(c_double)
_Bodies, _Inertias = POINTER(BodyMotion), POINTER(Inertia)

FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("gap_rates", None, [_Bodies, c_size_t, POINTER(Contact), _Doubles]),
    ("free_delassus", None, [_Bodies, _Inertias, c_size_t, POINTER(Contact), _Doubles]),
    ("free_oblique", None, [_Bodies, _Inertias, c_size_t, POINTER(Contact), _Doubles]),
    ("tangents", None, [POINTER(Contact), _Doubles, _Doubles]),
    ("free_apply", None, [_Bodies, _Inertias, POINTER(Contact), c_double]),
    ("free_move", None, [_Bodies, _Inertias, POINTER(Contact), c_double]),
    ("free_apply_vector", None, [_Bodies, _Inertias, POINTER(Contact), _Doubles]),
    ("free_move_vector", None, [_Bodies, _Inertias, POINTER(Contact), _Doubles]),
    ("config_default", Config, []),
    ("create", c_int, [POINTER(Config), POINTER(_Slow)]),
    ("free", None, [_Slow]),
    ("due", c_bool, [_Slow, c_size_t, POINTER(Contact)]),
    ("next", c_double, [_Slow]),
    ("advance", c_int, [_Slow, c_size_t, POINTER(Contact)]),
    ("rests", c_bool, [_Slow, c_uint32, c_uint32, c_uint32]),
    ("counts", Counts, [_Slow]),
    ("error_text", c_char_p, []),
)
# of libpercuss
LINK_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("link_default", Link, [c_void_p]),
    ("link_service", Service, [POINTER(Link)]),
)
for _library, _functions in ((library, FUNCTIONS), (_percuss, LINK_FUNCTIONS)):
    for _name, _result, _arguments in _functions:
        _function = _library[f"percuss_slow_{_name}"]
        _function.restype = _result
        _function.argtypes = _arguments
        setattr(_library, f"percuss_slow_{_name}", _function)
