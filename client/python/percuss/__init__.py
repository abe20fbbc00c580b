# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Ask a percussd what an impact does::

    import percuss

    with percuss.connect() as client:
        question = percuss.contact_pair("steel-sphere", "al-beam", speed="300mm/s", client=client)
        reply = client.solve(question).raise_for_status()
        print(reply.contacts[0].restitution, reply.contacts[0].sub_impacts["impulse"])

Without a daemon, the solver in this process: `with percuss.Local() as client:`, the rest is the same.

SI units throughout. A call that fails raises a CallError; a refusal by the server is an answer whose
status and message say why. No compiled part: it loads libpercuss, from PERCUSS_LIBRARY if that is set,
else where the system's loader looks, else from a build folder of the source tree that it lies in.
"""

from ._library import VERSION as __version__
from .client import Client, connect
from .ensembles import Correlation, Distribution, Ensemble, EnsembleReply, Input, Progress, Sampling, ensemble
from .errors import (
    AnswerTimeout,
    CallError,
    Cancelled,
    Incompatible,
    InvalidArgument,
    NoServer,
    PercussError,
    Refused,
    TransportError,
    UnknownName,
    UnknownSequence,
    WindowFull,
)
from .local import Local
from .reply import (
    SUB_IMPACT,
    BodyEnergy,
    BodyModel,
    BodyState,
    BodyVelocity,
    ContactResult,
    Energy,
    ErrorEstimate,
    Model,
    Reply,
    Timing,
    force_centres,
    to_dataframe,
)
from .request import BodyMotion, Contact, Options, Request
from .server import Bodies, Body, ContactLaw, Dent, MaterialPair, RelaxationTerm, Server, Site, Specimen, Specimens, Task
from .server import contact_pair
from .sweeps import Curve, Sweep, sweep
from .traces import ContactTrace, Trace, trace
from .vocabulary import (
    MAX_BATCH,
    MAX_BODIES,
    MAX_CONTACTS,
    MAX_CONTACTS_OBLIQUE,
    MAX_SUB_IMPACTS,
    Compliance,
    ContactModel,
    DelassusSource,
    Dents,
    EndReason,
    Friction,
    FrictionState,
    Id,
    Method,
    Parameter,
    Result,
    Status,
    Support,
    TaskKind,
)

__all__ = [
    "MAX_BATCH",
    "MAX_BODIES",
    "MAX_CONTACTS",
    "MAX_CONTACTS_OBLIQUE",
    "MAX_SUB_IMPACTS",
    "SUB_IMPACT",
    "AnswerTimeout",
    "Bodies",
    "Body",
    "BodyEnergy",
    "BodyModel",
    "BodyMotion",
    "BodyState",
    "BodyVelocity",
    "CallError",
    "Cancelled",
    "Client",
    "Compliance",
    "Contact",
    "ContactLaw",
    "ContactModel",
    "ContactResult",
    "ContactTrace",
    "Correlation",
    "Curve",
    "DelassusSource",
    "Dent",
    "Dents",
    "Distribution",
    "EndReason",
    "Energy",
    "Ensemble",
    "EnsembleReply",
    "ErrorEstimate",
    "Friction",
    "FrictionState",
    "Id",
    "Incompatible",
    "Input",
    "InvalidArgument",
    "Local",
    "MaterialPair",
    "Method",
    "Model",
    "NoServer",
    "Options",
    "Parameter",
    "PercussError",
    "Progress",
    "Refused",
    "RelaxationTerm",
    "Reply",
    "Request",
    "Result",
    "Sampling",
    "Server",
    "Site",
    "Specimen",
    "Specimens",
    "Status",
    "Support",
    "Sweep",
    "Task",
    "TaskKind",
    "Timing",
    "Trace",
    "TransportError",
    "UnknownName",
    "UnknownSequence",
    "WindowFull",
    "__version__",
    "connect",
    "contact_pair",
    "ensemble",
    "force_centres",
    "sweep",
    "to_dataframe",
    "trace",
]
