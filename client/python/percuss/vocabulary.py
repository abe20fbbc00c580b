# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The numbered choices of the wire. Numbers are those of the IDL and of <percuss/vocabulary.h>."""

from __future__ import annotations

import re
from enum import IntEnum
from typing import TypeVar

_Choice = TypeVar("_Choice", bound="Choice")
_NUMBER_FORMATS = ("b", "c", "d", "e", "E", "f", "F", "g", "G", "n", "o", "x", "X", "%")


class Id(bytes):
    """The 16 octets of a client or a server, shown as their 32 hexadecimal digits, which it may be made of, too."""

    def __new__(cls, value: bytes | str) -> "Id":
        digits = value if isinstance(value, str) else value.hex()
        if not re.fullmatch("[0-9a-fA-F]{32}", digits):
            raise ValueError(f"id: {value!r}: 16 octets, or 32 hexadecimal digits, are allowed")
        return super().__new__(cls, bytes.fromhex(digits))

    def __str__(self) -> str:
        return self.hex()

    def __repr__(self) -> str:
        return f"Id({self.hex()!r})"

    def __format__(self, spec: str) -> str:
        return format(self.hex(), spec)


def quantity_of(name: str) -> str:
    """Of a body's parameter or an uncertain input of that name."""
    kinds = {"speed": "speed", "young": "stress", "yield": "stress", "tangent": "stress"}
    return {**kinds, "radius": "length", "density": "density"}.get(name, "number")


class Choice(IntEnum):
    """A number with a name, which is also what it is shown as; one that a newer server sends gets the name
    UNKNOWN_<number>."""

    @classmethod
    def of(cls: type[_Choice], name: str | _Choice) -> _Choice:
        """The choice of a name as Python, JSON or the command line have it: CLOSED_FORM, closed-form."""
        if not isinstance(name, str):
            return cls(name)
        named = cls.__members__.get(name.upper().replace("-", "_"))
        if named is None:
            allowed = ", ".join(member.name for member in cls)
            raise ValueError(f"{cls.__name__}: {name!r}: one of {allowed} is allowed")
        return named

    @property
    def text(self) -> str:
        """The name as JSON and the command line have it where it is an option: closed-form."""
        return self.name.lower().replace("_", "-")

    def __repr__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    def __str__(self) -> str:
        return self.name

    def __format__(self, spec: str) -> str:
        """The name, but for a format that is one of numbers."""
        return format(int(self) if spec[-1:] in _NUMBER_FORMATS else self.name, spec)

    @classmethod
    def _missing_(cls: type[_Choice], value: object) -> "_Choice | None":
        if not isinstance(value, int) or value < 0:
            return None
        member = int.__new__(cls, value)
        member._name_ = f"UNKNOWN_{value}"
        member._value_ = value
        return member


class Status(Choice):
    """The server's judgement of a request."""

    OK = 0
    TRUNCATED = 1
    BAD_REQUEST = 2
    NOT_APPROACHING = 3
    UNKNOWN_BODY = 4
    UNSUPPORTED_GEOMETRY = 5
    UNKNOWN_STATE = 6
    BUSY = 7
    TIMEOUT = 8
    INTERNAL = 9


class EndReason(Choice):
    """Why the fast time scale ended."""

    NONE = 0
    """The request was refused."""
    SEPARATED = 1
    """Vibration can no longer cause a contact."""
    HANDED_BACK = 2
    """As SEPARATED, but the bodies are pressed together: they meet again on the slow time scale."""
    HORIZON = 3
    """The horizon came first."""
    IN_CONTACT = 4
    """The horizon came first, and the bodies touch."""
    LIMIT = 5
    """A limit of the solver came first."""


class ContactModel(Choice):
    """The local contact model."""

    AUTO = 0
    HERTZ = 1
    CLOSED_FORM = 2
    TABLE = 3
    CONCURRENT_FE = 4
    COMPLETE_FE = 5
    VISCOELASTIC = 6
    LAW = 7


class Method(Choice):
    """The integrator of the fast time scale."""

    MODAL = 0
    CVODE = 1


class Compliance(Choice):
    """The local compliance of a contact."""

    DEFAULT = 0
    """The catalogue's choice."""
    HALF_SPACE = 1
    MATCHED = 2


class Dents(Choice):
    """What happens to the dents of earlier impacts."""

    KEEP = 0
    IGNORE = 1


class Friction(Choice):
    """The law of the tangential forces where a coefficient of friction is stated."""

    MICRO_SLIP = 0
    PLAIN = 1
    NONE = 2
    """Coefficients are ignored."""


class FrictionState(Choice):
    """How a contact with friction slid."""

    NONE = 0
    """No friction."""
    STUCK = 1
    PARTLY = 2
    SLID = 3
    REVERSED = 4


class Parameter(Choice):
    """What a request may change of a body."""

    YOUNG = 0
    POISSON = 1
    DENSITY = 2
    YIELD = 3
    TANGENT = 4
    DAMPING = 5
    RADIUS = 6
    SCALE = 7

    @property
    def quantity(self) -> str:
        """Of its numbers: stress, density, length; number: without a unit."""
        return quantity_of(self.text)


class DelassusSource(Choice):
    """Whose Delassus matrix was used."""

    SERVICE = 0
    CLIENT = 1


class Support(Choice):
    """The support of a rod's or beam's end."""

    FREE = 0
    PINNED = 1
    CLAMPED = 2


class TaskKind(Choice):
    """What a server has to do."""

    REQUEST = 0
    BATCH = 1
    ENSEMBLE = 2
    TABLES = 3
    """A request for which contact tables are computed first."""
    MESH = 4
    """A mesh that is reduced."""


class Result(Choice):
    """How a call of the library ended."""

    OK = 0
    PENDING = 1
    TIMEOUT = 2
    NO_SERVER = 3
    INCOMPATIBLE = 4
    INVALID_ARGUMENT = 5
    WINDOW_FULL = 6
    UNKNOWN_SEQUENCE = 7
    NO_MEMORY = 8
    TRANSPORT = 9
    CANCELLED = 10


ID_SIZE = 64
"""Bytes of an id, token or specimen's name with its terminating zero."""
MAX_BODIES = 64
MAX_CONTACTS = 64
MAX_CONTACTS_OBLIQUE = 21
"""Contacts of a request with a matrix of their normals and tangents."""
MAX_DELASSUS = 4096
"""Numbers of a matrix."""
MAX_SUB_IMPACTS = 256
MAX_BATCH = 256
MAX_SITES = 32
MAX_RELAXATION = 8
