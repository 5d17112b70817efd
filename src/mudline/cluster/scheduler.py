"""The scheduler of a run: which may be used, how it is reached or started, and whether its workers fit.

A scheduler runs whatever code it is sent, and so do its workers: one that others can reach needs TLS.
"""

from __future__ import annotations

import logging
import re
import ssl
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from typing import TYPE_CHECKING

from mudline import __version__

if TYPE_CHECKING:
    from distributed import Client, LocalCluster
    from distributed.security import Security

CONNECTING = 10.0
"""Seconds to wait for a scheduler, and for its first worker."""

_LOCAL = "local"
_ADDRESS = re.compile(r"(?P<protocol>tcp|tls)://(?P<host>\[[0-9A-Fa-f:.]+\]|[A-Za-z0-9._-]+):(?P<port>[0-9]{1,5})")
"""Strict: what dask takes apart in another way would not be checked."""
_FORMS = "tcp://HOST:PORT, tls://HOST:PORT or local[:WORKERS]"


class ClusterError(Exception):
    """The cluster cannot be used, or no longer; the message says what it is and what to do."""


@dataclass(frozen=True, slots=True)
class Scheduler:
    """Where the scheduler is: an address, or `local[:WORKERS]` for one that is started with its workers for a run.

    The files of TLS are those of dask: the certificates that are trusted, the own certificate, and its key.
    """

    given: str
    tls_ca: str | None = None
    tls_cert: str | None = None
    tls_key: str | None = None
    insecure: bool = False

    @property
    def local_workers(self) -> int | None:
        """The number of workers to start, 0 for one for each processor; None for a scheduler that runs already."""
        if self.given == _LOCAL:
            return 0
        name, _, count = self.given.partition(":")
        return int(count) if name == _LOCAL and count.isdecimal() and int(count) > 0 else None

    def check(self) -> None:
        """Raise ValueError for an address that is none, and for one that is not safe to use."""
        tls = {"--tls-ca": self.tls_ca, "--tls-cert": self.tls_cert, "--tls-key": self.tls_key}
        for option, path in tls.items():
            if path is not None and not Path(path).is_file():
                raise ValueError(f"{option} {path}: no such file")
        if self.local_workers is not None:
            if any(tls.values()):
                raise ValueError("--tls-* are for a scheduler at an address: local is reached from this machine only")
            return
        protocol, host = self._parts()
        if protocol == "tls":
            return
        if any(tls.values()):
            raise ValueError(f"--scheduler {self.given}: tcp:// has no TLS: give tls:// with --tls-*")
        if not (self.insecure or _is_loopback(host)):
            raise ValueError(
                f"--scheduler {self.given}: without TLS, whoever reaches it can run code on it and on this machine: "
                "give tls://HOST:PORT with --tls-ca, --tls-cert and --tls-key, or --insecure on a trusted network"
            )

    def _parts(self) -> tuple[str, str]:
        """Protocol and host."""
        found = _ADDRESS.fullmatch(self.given)
        if found is None or not 0 < int(found["port"]) < 1 << 16:
            raise ValueError(f"--scheduler {self.given}: expected {_FORMS}")
        return found["protocol"], found["host"].strip("[]")


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:  # a name, whoever it belongs to
        return False


# ------------------------------------------------------------------------------------------------------- connecting


@contextmanager
def connected(scheduler: Scheduler) -> Iterator[Client]:
    """A client of the scheduler, whose workers are there and have this version of mudline; raises ClusterError.

    A local scheduler and its workers end with the block.
    """
    try:
        from distributed import Client  # noqa: PLC0415 - few runs use a cluster
    except ImportError as error:
        raise ClusterError("--scheduler needs dask.distributed: pip install 'mudline[cluster]'") from error
    for name in ("distributed", "tornado", "asyncio"):  # what goes wrong is reported once, by the command
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with _address(scheduler) as (address, security):
        try:
            client = Client(address, security=security, timeout=CONNECTING, set_as_default=False)
        except (OSError, TimeoutError, ValueError, RuntimeError, TypeError) as error:
            raise ClusterError(f"{scheduler.given}: {_why(error)}") from error
        try:
            _wait_for_workers(client, scheduler)
            _check_versions(client, scheduler)
            yield client
        finally:
            client.close(timeout=2)


@contextmanager
def _address(scheduler: Scheduler) -> Iterator[tuple[str | LocalCluster, Security | None]]:
    count = scheduler.local_workers
    if count is None:
        security = _security(scheduler)
        if security is not None:
            _check_certificates(security, scheduler)
        yield scheduler.given, security
        return
    from distributed import LocalCluster  # noqa: PLC0415 - few runs use a cluster

    with LocalCluster(
        n_workers=count or None,
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        worker_dashboard_address=None,
        silence_logs=logging.CRITICAL,
    ) as cluster:
        yield cluster, None


def _security(scheduler: Scheduler) -> Security | None:
    """The certificates of the command line, else those of dask's configuration."""
    if not scheduler.given.startswith("tls://"):
        return None
    from distributed.security import Security  # noqa: PLC0415 - as above

    given = {
        "tls_ca_file": scheduler.tls_ca,
        "tls_client_cert": scheduler.tls_cert,
        "tls_client_key": scheduler.tls_key,
    }
    return Security(require_encryption=True, **{name: path for name, path in given.items() if path is not None})


def _check_certificates(security: Security, scheduler: Scheduler) -> None:
    """Raise ClusterError where there are no certificates, or none that can be used."""
    try:
        context = security.get_connection_args("client").get("ssl_context")
    except OSError as error:
        message = f"{scheduler.given}: the files of --tls-* cannot be used: {error.strerror or error}"
        raise ClusterError(message) from error
    if context is None:
        raise ClusterError(f"{scheduler.given}: no certificates: give --tls-ca, --tls-cert and --tls-key")


def _why(error: BaseException) -> str:
    """Why there is no connection, and what to do."""
    text = " ".join(str(error).split())[:200]
    cause: BaseException | None = error
    while cause is not None and not isinstance(cause, ssl.SSLCertVerificationError):
        cause = cause.__cause__ or cause.__context__
    if cause is not None:
        return f"its certificate is not trusted ({cause.verify_message}): give --tls-ca the CA that signed it"
    found = re.search(r"\[SSL: (\w+)\]", text)
    if found or "<TLS (closed)" in text:  # by the scheduler, whose reason may come too late
        how = found[1] if found else "closed"
        return f"no TLS connection ({how}): give --tls-cert a certificate that the CA of the scheduler signed"
    if "ConnectionResetError" in text:
        return "the scheduler closes the connection: give tls:// if it uses TLS"
    return f"the scheduler does not answer: {text}"


def workers_of(client: Client) -> dict[str, int]:
    """The threads of each worker by its address."""
    found: dict[str, int] = client.nthreads()
    return found


def _wait_for_workers(client: Client, scheduler: Scheduler) -> None:
    try:
        client.wait_for_workers(1, timeout=CONNECTING)
    except TimeoutError as error:
        message = f"{scheduler.given}: the scheduler has no worker: start one with dask worker {scheduler.given}"
        raise ClusterError(message) from error


def _check_versions(client: Client, scheduler: Scheduler) -> None:
    """Refuse workers of another version, by a function of the standard library, which they all have.

    A worker that ends meanwhile is left out: what it would do is done by the others.
    """
    import pydoc  # noqa: PLC0415 - few runs use a cluster

    versions = client.run(pydoc.locate, "mudline.__version__", on_error="return")
    present = {worker: found for worker, found in sorted(versions.items()) if not isinstance(found, OSError)}
    if not present:
        message = f"{scheduler.given}: all workers ended when they were asked for their version: see their logs"
        raise ClusterError(message)
    wrong = {worker: found for worker, found in present.items() if found != __version__}
    for worker, found in wrong.items():
        has = f"mudline {found}" if isinstance(found, str) else "no mudline that can be imported"
        more = f" ({len(wrong) - 1} more workers do not fit)" if len(wrong) > 1 else ""
        raise ClusterError(f"worker {worker} has {has}, this command {__version__}: install the same version{more}")
