# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The structs and functions of <percuss/percuss.h>; tests/test_abi.py compares them with the compiler's."""

import ctypes
from ctypes import CFUNCTYPE, POINTER, c_bool, c_char, c_char_p, c_double, c_int, c_size_t
from ctypes import c_uint, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

from . import _server_abi
from ._library import load
from .vocabulary import ID_SIZE, MAX_BODIES, MAX_CONTACTS, Parameter

_Id = c_char * ID_SIZE
_Octets = c_uint8 * 16
_Vector = c_double * 3
_Pair = c_double * 2


class ClientConfig(ctypes.Structure):
    _fields_ = [
        ("domain", c_uint32),
        ("id", _Octets),
        ("first_sequence", c_uint64),
        ("window", c_uint),
        ("server", c_char * 33),
    ]


class LocalConfig(ctypes.Structure):
    _fields_ = [
        ("settings", c_char_p),
        ("catalogue", c_char_p),
        ("id", _Octets),
        ("first_sequence", c_uint64),
        ("threads", c_uint),
    ]


class Override(ctypes.Structure):
    _fields_ = [("parameter", c_uint), ("value", c_double)]


class BodyMotion(ctypes.Structure):
    _fields_ = [
        ("id", _Id),
        ("position", _Vector),
        ("orientation", c_double * 4),
        ("velocity", _Vector),
        ("angular_velocity", _Vector),
        ("state", _Id),
        ("elapsed", c_double),
        ("specimen", _Id),
        ("override_count", c_uint32),
        ("overrides", Override * len(Parameter)),
    ]


class Contact(ctypes.Structure):
    _fields_ = [
        ("a", c_uint32),
        ("b", c_uint32),
        ("point", _Vector),
        ("normal", _Vector),
        ("gap", c_double),
        ("gap_acceleration", c_double),
        ("friction", c_double),
        ("tangent", _Vector),
    ]


class Options(ctypes.Structure):
    _fields_ = [
        ("tolerance", c_double),
        ("horizon", c_double),
        ("contact_model", c_uint),
        ("method", c_uint),
        ("compliance", c_uint),
        ("dents", c_uint),
        ("conditioning", c_bool),
        ("trace", c_bool),
        ("deadline", c_double),
        ("friction", c_uint),
    ]


class Request(ctypes.Structure):
    _fields_ = [
        ("sequence", c_uint64),
        ("body_count", c_size_t),
        ("contact_count", c_size_t),
        ("bodies", BodyMotion * MAX_BODIES),
        ("contacts", Contact * MAX_CONTACTS),
        ("delassus", POINTER(c_double)),
        ("options", Options),
        ("delassus_rows", c_size_t),
    ]


class SubImpact(ctypes.Structure):
    _fields_ = [
        ("start", c_double),
        ("compression_end", c_double),
        ("end", c_double),
        ("impulse", c_double),
        ("compression_impulse", c_double),
        ("peak_force", c_double),
        ("max_indentation", c_double),
        ("gap_rate_before", c_double),
        ("gap_rate_after", c_double),
        ("negligible", c_bool),
        ("impulse_tangential", _Pair),
        ("slip_before", _Pair),
        ("slip_after", _Pair),
        ("friction_state", c_uint),
    ]


class ContactResult(ctypes.Structure):
    _fields_ = [
        ("impulse", c_double),
        ("impulse_vector", _Vector),
        ("impulse_compression", c_double),
        ("restitution", c_double),
        ("inverse_effective_mass", c_double),
        ("end_time", c_double),
        ("sub_impact_count", c_uint32),
        ("sub_impacts_listed", c_uint32),
        ("sub_impacts", POINTER(SubImpact)),
        ("impulse_error", c_double),
        ("friction", c_double),
        ("tangent", _Vector),
        ("impulse_tangential", _Pair),
        ("impulse_tangential_error", c_double),
        ("slip_before", _Pair),
        ("slip_after", _Pair),
        ("tangential_restitution", c_double),
        ("restitution_kinematic", c_double),
        ("restitution_energetic", c_double),
        ("friction_state", c_uint),
    ]


class BodyVelocity(ctypes.Structure):
    _fields_ = [
        ("id", _Id),
        ("velocity", _Vector),
        ("angular_velocity", _Vector),
        ("velocity_error", c_double),
        ("angular_velocity_error", c_double),
    ]


class BodyState(ctypes.Structure):
    _fields_ = [("id", _Id), ("state", _Id)]


class BodyEnergy(ctypes.Structure):
    _fields_ = [("id", _Id), ("energy", c_double)]


class Energy(ctypes.Structure):
    _fields_ = [
        ("available", c_double),
        ("rigid_after", c_double),
        ("vibration_count", c_size_t),
        ("vibration", POINTER(BodyEnergy)),
        ("damping", c_double),
        ("plastic", c_double),
        ("stored", c_double),
        ("closure", c_double),
        ("friction", c_double),
    ]


class ErrorEstimate(ctypes.Structure):
    _fields_ = [
        ("restitution_time", c_double),
        ("restitution_modes", c_double),
        ("impulse_time", c_double),
        ("impulse_modes", c_double),
        ("restitution_by_speed", c_double),
        ("tolerance_met", c_bool),
        ("restitution_model", c_double),
        ("restitution_total", c_double),
        ("total_met", c_bool),
        ("restitution_yield", c_double),
        ("impulse_tangential_by_speed", _Pair),
    ]


class BodyModel(ctypes.Structure):
    _fields_ = [
        ("id", _Id),
        ("modes", c_uint32),
        ("rigid", c_bool),
        ("theory", c_char * 32),
        ("shear_factor", c_double),
    ]


class Model(ctypes.Structure):
    _fields_ = [
        ("body_count", c_size_t),
        ("bodies", POINTER(BodyModel)),
        ("contact_model", c_uint),
        ("compliance", c_uint),
        ("method", c_uint),
        ("reason", c_char * 512),
        ("omitted_error", c_double),
    ]


class Timing(ctypes.Structure):
    _fields_ = [("queue", c_double), ("solve", c_double)]


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
        ("end_reason", c_uint),
        ("window", c_double),
        ("contact_count", c_size_t),
        ("contacts", POINTER(ContactResult)),
        ("delassus_source", c_uint),
        ("velocity_after_count", c_size_t),
        ("velocity_after", POINTER(BodyVelocity)),
        ("states_after_count", c_size_t),
        ("states_after", POINTER(BodyState)),
        ("energy", Energy),
        ("error", ErrorEstimate),
        ("model", Model),
        ("time_shift", c_double),
        ("warning_count", c_size_t),
        ("warnings", POINTER(c_char_p)),
        ("timing", Timing),
        ("storage", c_void_p),
    ]


class ContactTrace(ctypes.Structure):
    _fields_ = [
        ("count", c_size_t),
        ("time", POINTER(c_double)),
        ("force", POINTER(c_double)),
        ("indentation", POINTER(c_double)),
        ("gap", POINTER(c_double)),
        ("gap_rate", POINTER(c_double)),
        ("displacement_a", POINTER(c_double)),
        ("velocity_a", POINTER(c_double)),
        ("displacement_b", POINTER(c_double)),
        ("velocity_b", POINTER(c_double)),
        ("force_tangential_1", POINTER(c_double)),
        ("force_tangential_2", POINTER(c_double)),
        ("slip_1", POINTER(c_double)),
        ("slip_2", POINTER(c_double)),
    ]


class Trace(ctypes.Structure):
    _fields_ = [("contact_count", c_size_t), ("contacts", POINTER(ContactTrace))]


# the C struct behind each class
STRUCTS: dict[str, type[ctypes.Structure]] = {
    "percuss_client_config": ClientConfig,
    "percuss_local_config": LocalConfig,
    "percuss_body_motion": BodyMotion,
    "percuss_contact": Contact,
    "percuss_options": Options,
    "percuss_request": Request,
    "percuss_sub_impact": SubImpact,
    "percuss_contact_result": ContactResult,
    "percuss_body_velocity": BodyVelocity,
    "percuss_body_state": BodyState,
    "percuss_body_energy": BodyEnergy,
    "percuss_energy": Energy,
    "percuss_error_estimate": ErrorEstimate,
    "percuss_body_model": BodyModel,
    "percuss_model": Model,
    "percuss_timing": Timing,
    "percuss_reply": Reply,
    "percuss_override": Override,
    "percuss_contact_trace": ContactTrace,
    "percuss_trace": Trace,
    **_server_abi.STRUCTS,
}

library = load()
_Client = c_void_p

WARNING_SIZE = 512
WATCH = CFUNCTYPE(c_bool, c_void_p)
_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("client_config_default", ClientConfig, []),
    ("client_create", c_int, [POINTER(ClientConfig), POINTER(_Client)]),
    ("client_create_in", c_int, [POINTER(ClientConfig), c_char_p, c_char_p, POINTER(_Client)]),
    ("client_free", None, [_Client]),
    ("client_connect", c_int, [_Client, c_double]),
    ("client_id", None, [_Client, _Octets]),
    ("client_server", c_bool, [_Client, _Octets]),
    ("client_observes", c_bool, [_Client]),
    ("client_warning", c_bool, [_Client, c_char_p]),
    ("client_watch", None, [_Client, WATCH, c_void_p]),
    ("solve", c_int, [_Client, POINTER(Request), c_double, POINTER(Reply)]),
    ("solve_traced", c_int, [_Client, POINTER(Request), c_double, POINTER(Reply), POINTER(Trace)]),
    ("trace_free", None, [POINTER(Trace)]),
    ("submit", c_int, [_Client, POINTER(Request), POINTER(c_uint64)]),
    ("wait", c_int, [_Client, c_uint64, c_double, POINTER(Reply)]),
    ("poll", c_int, [_Client, c_uint64, POINTER(Reply)]),
    ("cancel", c_int, [_Client, c_uint64]),
    ("solve_batch", c_int, [_Client, POINTER(Request), c_size_t, c_double, POINTER(Reply)]),
    ("ping", c_int, [_Client, c_double, POINTER(c_double)]),
    ("servers", c_int, [_Client, c_double, POINTER(_server_abi.ServerList)]),
    ("bodies", c_int, [_Client, c_double, POINTER(_server_abi.BodyList)]),
    ("specimens", c_int, [_Client, c_double, POINTER(_server_abi.SpecimenList)]),
    ("clear_specimen", c_int, [_Client, c_char_p, c_double]),
    ("specimen_list_free", None, [POINTER(_server_abi.SpecimenList)]),
    ("reply_free", None, [POINTER(Reply)]),
    ("body_list_free", None, [POINTER(_server_abi.BodyList)]),
    ("server_list_free", None, [POINTER(_server_abi.ServerList)]),
    ("contact_pair", c_int, [POINTER(_server_abi.Pair), POINTER(Request)]),
    ("quantity_parse", c_int, [c_char_p, c_char_p, POINTER(c_double)]),
    ("result_text", c_char_p, [c_int]),
    ("error_text", c_char_p, []),
)
# of libpercuss-local, see local.py
LOCAL_FUNCTIONS: tuple[tuple[str, Any, list[Any]], ...] = (
    ("local_open", c_int, [POINTER(LocalConfig), POINTER(_Client)]),
    ("error_text", c_char_p, []),
)
for _name, _result, _arguments in _FUNCTIONS:
    _function = library[f"percuss_{_name}"]
    _function.restype = _result
    _function.argtypes = _arguments
    setattr(library, f"percuss_{_name}", _function)
