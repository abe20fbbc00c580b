# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""The client."""

from __future__ import annotations

import ctypes
import os
import warnings
from collections.abc import Sequence
from types import TracebackType

from . import _abi, _server_abi, request, server
from ._convert import read
from ._signals import Signals, listening
from .errors import CallError, check
from .reply import Reply
from .request import Request
from .server import Bodies, Server, Specimen, Specimens
from .vocabulary import Id, Result

_library = _abi.library


class Client:
    """A client of the percussd in a DDS domain; `connect` makes one that is connected.

    Timeouts are seconds from the call, >= 0, math.inf allowed. A signal's handler runs within some tenths of a
    second; where it raises, as that of Ctrl-C does, the call ends with that exception and the server gives up what was
    asked (but `wait`: it stays outstanding). Methods may be called from several threads at once, except that
    `close` must be the last; one outstanding request is waited for by one thread. Without CYCLONEDDS_URI in the
    environment it talks to this machine only.
    """

    # set by the first call in the main thread
    _signals: Signals | None = None

    def __init__(
        self,
        domain: int | None = None,
        id: bytes | str | None = None,
        first_sequence: int = 1,
        window: int = 256,
        server: str | bytes | None = None,
        security: str | os.PathLike[str] | None = None,
        partition: str | None = None,
    ) -> None:
        """domain: 0..230; None: what PERCUSS_DOMAIN in the environment says, or else 0. id: 16 octets,
        or their hexadecimal digits, not all zero; None: random; a kept one lets a restarted client repeat requests. first_sequence: of
        the first request, > 0; a kept id goes on where it stopped. window: most outstanding requests,
        1..1024. server: the id of the server to stay with (Server.server), or hexadecimal digits with which
        it begins, or "least-loaded": the one with least to do; empty: any; None: what
        PERCUSS_SERVER in the environment says, or else any. security: the folder of the identity to ask a
        secured server with; None: what PERCUSS_SECURITY says, or else none. partition: percussd's setting;
        empty: the servers that are in none; None: what PERCUSS_PARTITION says, or else none."""
        self._handle = ctypes.c_void_p()
        given = bytes(16) if id is None else Id(id)
        if id is not None and not any(given):
            raise ValueError(f"id: {id!r}: not all of its 16 octets may be zero")
        for name, number, most in (
            ("domain", domain or 0, 230),
            ("first_sequence", first_sequence, 2**64 - 1),
            ("window", window, 1024),
        ):
            # ctypes would cut off high bits; the library checks the rest
            if not 0 <= number <= most:
                raise ValueError(f"{name}: {number}: up to {most} is allowed")
        octets = (ctypes.c_uint8 * 16)(*given)
        if isinstance(server, bytes):
            server = Id(server).hex()
        if server is not None and len(server) > 32:
            raise ValueError(f"server: {server!r}: up to 32 hexadecimal digits are allowed")
        default = _library.percuss_client_config_default()
        config = _abi.ClientConfig(
            default.domain if domain is None else domain,
            octets,
            first_sequence,
            window,
            default.server if server is None else server.lower().encode(),
        )
        folder = None if security is None else os.fsencode(security)
        among = None if partition is None else partition.encode()
        check(
            _library.percuss_client_create_in(
                ctypes.byref(config), among, folder, ctypes.byref(self._handle)
            )
        )
        remark = self.warning
        if remark:
            warnings.warn(remark, stacklevel=2)

    def close(self) -> None:
        """Forgets what is outstanding and leaves the domain; may be called again."""
        handle, self._handle = self._handle, ctypes.c_void_p()
        _library.percuss_client_free(handle)

    def __enter__(self) -> "Client":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def __del__(self) -> None:
        # without a handle when __init__ was given something impossible
        if getattr(self, "_handle", None):
            self.close()

    @property
    def _open(self) -> ctypes.c_void_p:
        if not self._handle:
            raise ValueError("the client is closed")
        if self._signals is None:
            self._listen()
        return self._handle

    def _listen(self) -> None:
        self._signals = listening()
        if self._signals is not None:
            _library.percuss_client_watch(self._handle, self._signals.function, None)

    def _settle(self) -> None:
        """Raises what a signal's handler raised while a call waited."""
        if self._signals is not None:
            self._signals.settle()

    def _check(self, code: int) -> None:
        self._settle()
        check(code)

    def _take(self, code: int, answer: _abi.Reply) -> Reply:
        """Copies a C reply, if the call has brought one, and frees it."""
        try:
            self._check(code)
            return read(answer, Reply)
        finally:
            _library.percuss_reply_free(ctypes.byref(answer))

    @property
    def id(self) -> Id:
        """The client's 16 octets: those configured or drawn."""
        octets = (ctypes.c_uint8 * 16)()
        _library.percuss_client_id(self._open, octets)
        return Id(bytes(octets))

    @property
    def server(self) -> Id | None:
        """The id of the server that the client stays with; None before the first one."""
        octets = (ctypes.c_uint8 * 16)()
        return Id(bytes(octets)) if _library.percuss_client_server(self._open, octets) else None

    @property
    def observes(self) -> bool:
        """Whether the permissions of its identity let it only see what servers announce: it cannot be connected."""
        return bool(_library.percuss_client_observes(self._open))

    @property
    def warning(self) -> str | None:
        """That its identity ends within 30 days, or has ended meanwhile; None: it does not, or there is none."""
        text = ctypes.create_string_buffer(_abi.WARNING_SIZE)
        return os.fsdecode(text.value) if _library.percuss_client_warning(self._handle, text) else None

    def connect(self, timeout: float = 3.0) -> None:
        """Waits until a server answers and stays with it; of several found within a moment, with the one
        that has been up longest or the one that was named. NoServer: none within the time; AnswerTimeout: one is there
        but has not answered; InvalidArgument: several have ids that begin as named; Incompatible: one is
        there but a quality of service does not fit. When that server goes, what waits for it raises
        NoServer. To be called again then, and after a restart; what was outstanding is lost then and
        may be submitted again as it was."""
        self._check(_library.percuss_client_connect(self._open, timeout))

    def solve(self, question: Request, timeout: float = 10.0) -> Reply:
        """Asks and waits. A refusal is an answer: see Reply.status. AnswerTimeout: the server gives it up, unless
        the question had a sequence of its own: asked again it is then answered once."""
        asked = _abi.Request()
        kept = request.fill(question, asked)
        answer = _abi.Reply()
        code: int = _library.percuss_solve(self._open, ctypes.byref(asked), timeout, ctypes.byref(answer))
        del kept
        return self._take(code, answer)

    def submit(self, question: Request) -> int:
        """Sends a request and returns its sequence. WindowFull until replies are collected or cancelled.
        Sending a sequence that is outstanding repeats it."""
        asked = _abi.Request()
        kept = request.fill(question, asked)
        sequence = ctypes.c_uint64()
        check(
            _library.percuss_submit(self._open, ctypes.byref(asked), ctypes.byref(sequence))
        )
        del kept
        return sequence.value

    def wait(self, sequence: int = 0, timeout: float = 10.0) -> Reply:
        """Waits for the reply of that sequence, or with 0 for any (Reply.sequence says which). After
        AnswerTimeout it stays outstanding. UnknownSequence: never sent, collected, cancelled or waited for
        by another thread; with 0: nothing is outstanding."""
        answer = _abi.Reply()
        code: int = _library.percuss_wait(self._open, sequence, timeout, ctypes.byref(answer))
        return self._take(code, answer)

    def poll(self, sequence: int = 0) -> Reply | None:
        """As `wait`, without waiting: None if the reply is not there."""
        answer = _abi.Reply()
        code: int = _library.percuss_poll(self._open, sequence, ctypes.byref(answer))
        if code == Result.PENDING:
            return None
        return self._take(code, answer)

    def cancel(self, sequence: int) -> None:
        """Forgets an outstanding request; its reply is dropped, and the server gives it up."""
        check(_library.percuss_cancel(self._open, sequence))

    def solve_batch(self, questions: Sequence[Request], timeout: float = 10.0) -> list[Reply]:
        """Asks 1..256 questions in one sample and waits for all; replies in the order of the questions,
        whose sequences are drawn by the client. A batch refused as a whole gives every reply that status.
        Lists up to 16 sub-impacts a contact."""
        count = len(questions)
        asked = (_abi.Request * count)()
        kept = [request.fill(question, asked[i]) for i, question in enumerate(questions)]
        answers = (_abi.Reply * count)()
        code: int = _library.percuss_solve_batch(self._open, asked, count, timeout, answers)
        del kept
        try:
            self._check(code)
            return [read(answer, Reply) for answer in answers]
        finally:
            for answer in answers:
                _library.percuss_reply_free(ctypes.byref(answer))

    def ping(self, timeout: float = 1.0) -> float:
        """Sends an empty request and returns the time until it is answered, s."""
        round_trip = ctypes.c_double()
        self._check(_library.percuss_ping(self._open, timeout, ctypes.byref(round_trip)))
        return round_trip.value

    def servers(self, timeout: float = 3.0) -> list[Server]:
        """The servers of the domain, longest up first; need not be connected. Waits until the connected server, or else
        any, has announced itself."""
        found = _server_abi.ServerList()
        check(_library.percuss_servers(self._open, timeout, ctypes.byref(found)))
        try:
            return [read(one, Server) for one in found.servers[: found.count]]
        finally:
            _library.percuss_server_list_free(ctypes.byref(found))

    def bodies(self, timeout: float = 3.0) -> Bodies:
        """The catalogue of the connected server by id, sorted: a dict whose KeyError lists what there is."""
        found = _server_abi.BodyList()
        check(_library.percuss_bodies(self._open, timeout, ctypes.byref(found)))
        try:
            bodies = Bodies((one.id, one) for one in map(server.read_body, found.bodies[: found.count]))
            bodies.pairs = tuple(map(server.read_pair, found.pairs[: found.pair_count]))
            bodies.catalogue_revision = found.catalogue_revision.decode()
        finally:
            _library.percuss_body_list_free(ctypes.byref(found))
        return bodies

    def specimens(self, timeout: float = 3.0) -> Specimens:
        """The specimens that the connected server keeps, by name, sorted."""
        found = _server_abi.SpecimenList()
        check(_library.percuss_specimens(self._open, timeout, ctypes.byref(found)))
        try:
            specimens = [read(one, Specimen) for one in found.specimens[: found.count]]
        finally:
            _library.percuss_specimen_list_free(ctypes.byref(found))
        return Specimens((specimen.name, specimen) for specimen in specimens)

    def clear_specimen(self, name: str, timeout: float = 3.0) -> None:
        """Has the server forget a specimen, its dents and which body it is. InvalidArgument: it keeps
        none of that name."""
        check(_library.percuss_clear_specimen(self._open, name.encode(), timeout))


def connect(
    domain: int | None = None,
    timeout: float = 3.0,
    id: bytes | str | None = None,
    first_sequence: int = 1,
    window: int = 256,
    server: str | bytes | None = None,
    security: str | os.PathLike[str] | None = None,
    partition: str | None = None,
) -> Client:
    """A connected client, to be used in a `with` statement; see Client and Client.connect."""
    client = Client(domain, id, first_sequence, window, server, security, partition)
    try:
        client.connect(timeout)
    except CallError:
        client.close()
        raise
    return client
