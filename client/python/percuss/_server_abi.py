# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The structs of <percuss/server.h> and <percuss/specimen.h>; tests/test_abi.py compares them with the compiler's."""

import ctypes
from ctypes import POINTER, c_bool, c_char, c_char_p, c_double, c_size_t
from ctypes import c_uint, c_uint8, c_uint32, c_uint64

from .vocabulary import ID_SIZE, MAX_RELAXATION, MAX_SITES, Parameter

_Id = c_char * ID_SIZE
_Octets = c_uint8 * 16
_Vector = c_double * 3


class Site(ctypes.Structure):
    _fields_ = [("name", _Id), ("point", _Vector), ("normal", _Vector)]


class RelaxationTerm(ctypes.Structure):
    _fields_ = [("share", c_double), ("time", c_double)]


class Body(ctypes.Structure):
    _fields_ = [
        ("id", _Id),
        ("shape", c_char * 32),
        ("material", _Id),
        ("mass", c_double),
        ("description", c_char * 256),
        ("half_extents", _Vector),
        ("radius", c_double),
        ("tip_radius", c_double),
        ("supports", c_uint * 2),
        ("parameters", c_double * len(Parameter)),
        ("inertia", _Vector),
        ("products", _Vector),
        ("site_count", c_size_t),
        ("sites", Site * MAX_SITES),
        ("loss_factor", c_double),
        ("loss_frequency", c_double),
        ("relaxation_count", c_size_t),
        ("relaxation", RelaxationTerm * MAX_RELAXATION),
        ("rate_reference", c_double),
        ("rate_exponent", c_double),
        ("rate_coefficient", c_double),
    ]


class ContactLaw(ctypes.Structure):
    _fields_ = [
        ("name", _Id),
        ("kind", c_char * 32),
        ("stiffness", c_double),
        ("exponent", c_double),
        ("hysteresis", c_double),
        ("dissipation", c_double),
        ("deviation", c_double),
        ("points", c_char * 256),
        ("point_count", c_uint32),
        ("max_indentation", c_double),
        ("max_force", c_double),
        ("unloading", c_char * 256),
        ("residual_indentation", c_double),
    ]


class MaterialPair(ctypes.Structure):
    _fields_ = [
        ("material_a", _Id),
        ("material_b", _Id),
        ("friction", c_double),
        ("friction_deviation", c_double),
        ("law", ContactLaw),
    ]


class BodyList(ctypes.Structure):
    _fields_ = [
        ("count", c_size_t),
        ("bodies", POINTER(Body)),
        ("pair_count", c_size_t),
        ("pairs", POINTER(MaterialPair)),
        ("catalogue_revision", c_char * 64),
    ]


class Task(ctypes.Structure):
    _fields_ = [
        ("client", _Octets),
        ("sequence", c_uint64),
        ("kind", c_uint),
        ("running", c_bool),
        ("age", c_double),
        ("done", c_double),
    ]


class Server(ctypes.Structure):
    _fields_ = [
        ("server", _Octets),
        ("version", c_char * 32),
        ("catalogue_revision", c_char * 64),
        ("catalogue", c_char * 256),
        ("host", c_char * 64),
        ("process", c_uint32),
        ("state", c_char * 32),
        ("workers", c_uint32),
        ("bodies", c_uint32),
        ("queue_length", c_uint32),
        ("queue_capacity", c_uint32),
        ("answered", c_uint64),
        ("refused", c_uint64),
        ("uptime", c_double),
        ("activity", c_char * 256),
        ("progress", c_double),
        ("specimens", c_uint32),
        ("task_count", c_size_t),
        ("tasks", POINTER(Task)),
        ("all_tasks", c_uint32),
    ]


class Dent(ctypes.Structure):
    _fields_ = [
        ("point", c_double * 3),
        ("size", c_double),
        ("max_indentation", c_double),
        ("max_force", c_double),
        ("residual_indentation", c_double),
        ("contact_radius", c_double),
    ]


class Specimen(ctypes.Structure):
    _fields_ = [
        ("name", _Id),
        ("body", _Id),
        ("impacts", c_uint64),
        ("dent_count", c_size_t),
        ("dents", POINTER(Dent)),
    ]


class SpecimenList(ctypes.Structure):
    _fields_ = [("count", c_size_t), ("specimens", POINTER(Specimen))]


class ServerList(ctypes.Structure):
    _fields_ = [("count", c_size_t), ("servers", POINTER(Server))]


class Pair(ctypes.Structure):
    _fields_ = [
        ("a", POINTER(Body)),
        ("b", POINTER(Body)),
        ("speed", c_double),
        ("at_a", c_double),
        ("at_b", c_double),
        ("site_a", c_char_p),
        ("site_b", c_char_p),
        ("angle", c_double),
        ("spin", c_double),
        ("friction", c_double),
    ]


# the C struct behind each class
STRUCTS: dict[str, type[ctypes.Structure]] = {
    "percuss_body": Body,
    "percuss_site": Site,
    "percuss_relaxation_term": RelaxationTerm,
    "percuss_contact_law": ContactLaw,
    "percuss_material_pair": MaterialPair,
    "percuss_body_list": BodyList,
    "percuss_task": Task,
    "percuss_server": Server,
    "percuss_server_list": ServerList,
    "percuss_pair": Pair,
    "percuss_dent": Dent,
    "percuss_specimen": Specimen,
    "percuss_specimen_list": SpecimenList,
}
