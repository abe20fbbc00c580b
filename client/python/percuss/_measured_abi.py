# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The structs and functions of <percuss/measured.h>; tests/test_abi.py compares them with the compiler's."""

import ctypes
from ctypes import POINTER, c_bool, c_char, c_char_p, c_double, c_int, c_size_t, c_uint, c_uint64, c_void_p
from typing import Any

from . import _abi, _server_abi
from ._library import load
from .vocabulary import ID_SIZE

MAX_FITTED = 8
_QUANTITIES = 3


class Impact(ctypes.Structure):
    _fields_ = [
        ("speed", c_double),
        ("restitution", c_double),
        ("impulse", c_double),
        ("sub_impacts", c_double),
        ("first_impulse", c_double),
        ("first_duration", c_double),
        ("second_start", c_double),
        ("at", c_double),
        ("restitution_half_width", c_double),
    ]


class File(ctypes.Structure):
    _fields_ = [
        ("file", c_char_p),
        ("column_count", c_size_t),
        ("columns", POINTER(c_char_p)),
        ("uncertainty_count", c_size_t),
        ("uncertainties", POINTER(c_char_p)),
        ("scale", c_double),
        ("rate", c_double),
        ("gravity", c_double),
    ]


class Question(ctypes.Structure):
    _fields_ = [
        ("client", c_void_p),
        ("pair", _server_abi.Pair),
        ("options", _abi.Options),
        ("timeout", c_double),
        ("permutations", c_uint),
        ("seed", c_uint64),
        ("noise", c_double),
    ]


class Twin(ctypes.Structure):
    _fields_ = [("measured", Impact), ("simulated", Impact), ("status", c_uint), ("residual", c_double)]


class Distance(ctypes.Structure):
    _fields_ = [("value", c_double), ("p", c_double)]


class Comparison(ctypes.Structure):
    _fields_ = [
        ("measured_mean", c_double),
        ("measured_deviation", c_double),
        ("simulated_mean", c_double),
        ("simulated_deviation", c_double),
        ("residual_mean", c_double),
        ("residual_half_width", c_double),
        ("residual_rms", c_double),
        ("kolmogorov_smirnov", Distance),
        ("energy_distance", Distance),
        ("sub_impacts_known", c_size_t),
        ("sub_impacts_equal", c_size_t),
        ("impact_count", c_size_t),
        ("impacts", POINTER(Twin)),
        ("warning_count", c_size_t),
        ("warnings", POINTER(c_char_p)),
    ]


class Fitted(ctypes.Structure):
    _fields_ = [
        ("parameter", c_uint),
        ("body", c_char * ID_SIZE),
        ("start", c_double),
        ("value", c_double),
        ("low", c_double),
        ("high", c_double),
        ("determined", c_bool),
    ]


class Calibration(ctypes.Structure):
    _fields_ = [
        ("parameter_count", c_size_t),
        ("parameters", Fitted * MAX_FITTED),
        ("correlation", c_double * MAX_FITTED * MAX_FITTED),
        ("known", c_size_t * _QUANTITIES),
        ("used", c_size_t * _QUANTITIES),
        ("scatter", c_double * _QUANTITIES),
        ("impacts", c_size_t),
        ("freedom", c_double),
        ("warning_count", c_size_t),
        ("warnings", POINTER(c_char_p)),
    ]


# the C struct behind each class
STRUCTS: dict[str, type[ctypes.Structure]] = {
    "percuss_measured_impact": Impact,
    "percuss_measured_file": File,
    "percuss_measured_question": Question,
    "percuss_measured_twin": Twin,
    "percuss_measured_distance": Distance,
    "percuss_comparison": Comparison,
    "percuss_fitted": Fitted,
    "percuss_calibration": Calibration,
}

_Measured, _Body = c_void_p, POINTER(_server_abi.Body)

FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("measured_read", c_int, [c_char_p, c_size_t, POINTER(c_char_p), POINTER(_Measured)]),
    ("measured_read_file", c_int, [POINTER(File), POINTER(_Measured)]),
    ("measured_create", c_int, [c_size_t, POINTER(Impact), POINTER(_Measured)]),
    ("measured_note", c_char_p, [_Measured, c_size_t]),
    ("measured_free", None, [_Measured]),
    ("measured_question_default", Question, [c_void_p, _Body, _Body]),
    ("measured_compare", c_int, [_Measured, POINTER(Question), POINTER(Comparison)]),
    ("comparison_free", None, [POINTER(Comparison)]),
    ("measured_calibrate", c_int, [_Measured, POINTER(Question), POINTER(Calibration)]),
    ("calibration_free", None, [POINTER(Calibration)]),
    ("measured_error_text", c_char_p, []),
)
library = load("measured", version=False)
for _name, _result, _arguments in FUNCTIONS:
    _function = library[f"percuss_{_name}"]
    _function.restype = _result
    _function.argtypes = _arguments
    setattr(library, f"percuss_{_name}", _function)
