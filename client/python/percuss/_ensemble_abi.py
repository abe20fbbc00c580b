# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The structs and functions of <percuss/ensemble.h> and <percuss/ensemble_share.h>; tests/test_abi.py compares them."""

import ctypes
from ctypes import CFUNCTYPE, POINTER, c_bool, c_char, c_char_p, c_double, c_int
from ctypes import c_size_t, c_uint, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

from . import _abi
from .vocabulary import ID_SIZE

_Id = c_char * ID_SIZE
_Octets = c_uint8 * 16
_Doubles, _Counts = POINTER(c_double), POINTER(c_uint64)
MAX_INPUTS, MAX_CORRELATIONS, MAX_QUANTILES = 64, 256, 64


class Input(ctypes.Structure):
    _fields_ = [
        ("name", _Id),
        ("body", _Id),
        ("distribution", c_uint),
        ("first", c_double),
        ("second", c_double),
        ("lower", c_double),
        ("upper", c_double),
        ("values", _Doubles),
        ("value_count", c_size_t),
    ]


class Correlation(ctypes.Structure):
    _fields_ = [("first", c_uint32), ("second", c_uint32), ("coefficient", c_double)]


class Request(ctypes.Structure):
    _fields_ = [
        ("sequence", c_uint64),
        ("scene", _abi.Request),
        ("input_count", c_size_t),
        ("inputs", Input * MAX_INPUTS),
        ("correlation_count", c_size_t),
        ("correlations", Correlation * MAX_CORRELATIONS),
        ("sampling", c_uint),
        ("samples", c_uint64),
        ("seed", c_uint64),
        ("half_width", c_double),
        ("quantile_half_width", c_double),
        ("quantile_count", c_size_t),
        ("quantiles", c_double * MAX_QUANTILES),
        ("bins", c_uint32),
        ("contact", c_uint32),
        ("list_samples", c_bool),
    ]


class Progress(ctypes.Structure):
    _fields_ = [
        ("done", c_uint64),
        ("samples", c_uint64),
        ("mean", c_double),
        ("standard_deviation", c_double),
        ("half_width", c_double),
    ]


class Statistic(ctypes.Structure):
    _fields_ = [
        ("quantity", c_char * 32),
        ("count", c_uint64),
        ("mean", c_double),
        ("mean_low", c_double),
        ("mean_high", c_double),
        ("standard_deviation", c_double),
        ("standard_deviation_low", c_double),
        ("standard_deviation_high", c_double),
        ("skewness", c_double),
        ("lowest", c_double),
        ("highest", c_double),
        ("quantile_count", c_size_t),
        ("probabilities", _Doubles),
        ("quantiles", _Doubles),
        ("quantiles_low", _Doubles),
        ("quantiles_high", _Doubles),
        ("bin_count", c_size_t),
        ("bin_edges", _Doubles),
        ("bin_counts", _Counts),
        ("curve_count", c_size_t),
        ("curve_values", _Doubles),
        ("curve_shares", _Doubles),
    ]


class InputPart(ctypes.Structure):
    _fields_ = [
        ("low", c_double),
        ("high", c_double),
        ("count", c_uint64),
        ("mean", c_double),
        ("standard_deviation", c_double),
        ("local", c_double),
        ("chaotic", c_bool),
    ]


class Sensitivity(ctypes.Structure):
    _fields_ = [
        ("input", _Id),
        ("body", _Id),
        ("first_order", c_double),
        ("first_order_low", c_double),
        ("first_order_high", c_double),
        ("noise", c_double),
        ("total", c_double),
        ("total_low", c_double),
        ("total_high", c_double),
        ("mean", c_double),
        ("standard_deviation", c_double),
        ("lowest", c_double),
        ("highest", c_double),
        ("resolution", c_double),
        ("quantity", c_char * 32),
        ("part_count", c_size_t),
        ("parts", POINTER(InputPart)),
    ]


class SigmaInterval(ctypes.Structure):
    _fields_ = [
        ("sigmas", c_double),
        ("low", c_double),
        ("high", c_double),
        ("covered", c_double),
        ("unphysical", c_double),
        ("quantile_low", c_double),
        ("quantile_high", c_double),
    ]


class BetaFit(ctypes.Structure):
    _fields_ = [
        ("low", c_double),
        ("high", c_double),
        ("alpha", c_double),
        ("beta", c_double),
        ("distance", c_double),
        ("p_value", c_double),
    ]


class Check(ctypes.Structure):
    _fields_ = [
        ("count", c_uint64),
        ("within", c_double),
        ("largest", c_double),
        ("mean_shift", c_double),
        ("mean_shift_half_width", c_double),
        ("standard_deviation_shift", c_double),
        ("quantile_shift", c_double),
        ("within_low", c_double),
        ("within_high", c_double),
        ("unmet", c_uint64),
    ]


class Reply(ctypes.Structure):
    _fields_ = [
        ("client", _Octets),
        ("sequence", c_uint64),
        ("server", _Octets),
        ("catalogue_revision", c_char * 64),
        ("version", c_char * 32),
        ("status", c_uint),
        ("message", c_char * 1024),
        ("complete", c_bool),
        ("samples", c_uint64),
        ("requested", c_uint64),
        ("refused", c_uint64),
        ("truncated", c_uint64),
        ("statistic_count", c_size_t),
        ("statistics", POINTER(Statistic)),
        ("count_length", c_size_t),
        ("sub_impact_counts", _Counts),
        ("significant_counts", _Counts),
        ("possible_low", c_double),
        ("possible_high", c_double),
        ("interval_count", c_size_t),
        ("intervals", POINTER(SigmaInterval)),
        ("beta", BetaFit),
        ("sensitivity_count", c_size_t),
        ("sensitivities", POINTER(Sensitivity)),
        ("tangential_sensitivity_count", c_size_t),
        ("tangential_sensitivities", POINTER(Sensitivity)),
        ("check", Check),
        ("cut", c_double),
        ("step_accuracy", c_double),
        ("pilots", c_uint32),
        ("agreeing", c_uint32),
        ("warning_count", c_size_t),
        ("warnings", POINTER(c_char_p)),
        ("timing", _abi.Timing),
        ("column_count", c_size_t),
        ("rows", _Doubles),
        ("storage", c_void_p),
    ]


class Range(ctypes.Structure):
    _fields_ = [("first", c_uint64), ("count", c_uint64), ("extras", c_bool), ("done", c_uint64)]


# the C struct behind each class
STRUCTS: dict[str, type[ctypes.Structure]] = {
    "percuss_input": Input,
    "percuss_correlation": Correlation,
    "percuss_ensemble_request": Request,
    "percuss_ensemble_progress": Progress,
    "percuss_statistic": Statistic,
    "percuss_input_part": InputPart,
    "percuss_sensitivity": Sensitivity,
    "percuss_sigma_interval": SigmaInterval,
    "percuss_beta_fit": BetaFit,
    "percuss_ensemble_check": Check,
    "percuss_ensemble_reply": Reply,
    "percuss_ensemble_range": Range,
}

PROGRESS = CFUNCTYPE(c_bool, c_void_p, POINTER(Progress))
SHARE = CFUNCTYPE(None, c_void_p, c_void_p, POINTER(Range))
_Client = c_void_p

FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("solve_ensemble", c_int, [_Client, POINTER(Request), c_double, PROGRESS, c_void_p, POINTER(Reply)]),
    ("ensemble_reply_free", None, [POINTER(Reply)]),
)
# of libpercuss-local
SHARE_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("ensemble_part_size", c_size_t, [POINTER(Range)]),
    ("ensemble_worker_create", c_int, [_Client, POINTER(Request), POINTER(c_void_p)]),
    ("ensemble_worker_free", None, [c_void_p]),
    ("ensemble_worker_solve", c_int, [c_void_p, POINTER(Range), c_void_p]),
    ("ensemble_take", c_int, [c_void_p, c_char_p, c_size_t]),
    ("solve_ensemble_shared", c_int, [_Client, POINTER(Request), SHARE, PROGRESS, c_void_p, POINTER(Reply)]),
)


def declare(library: ctypes.CDLL, functions: tuple[tuple[str, Any, list[Any]], ...]) -> None:
    """Tells ctypes the types of a library's functions."""
    for name, result, arguments in functions:
        function = library[f"percuss_{name}"]
        function.restype = result
        function.argtypes = arguments
        setattr(library, f"percuss_{name}", function)


declare(_abi.library, FUNCTIONS)
