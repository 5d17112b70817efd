"""A cluster of two workers on loopback, started once for the tests of a module, and one object store for all."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.cluster.processes import Processes, running

STORE = {"AWS_ACCESS_KEY_ID": "testing", "AWS_SECRET_ACCESS_KEY": "testing", "AWS_DEFAULT_REGION": "us-east-1"}
"""What every client of S3 wants to know."""


@pytest.fixture(scope="session")
def store() -> Iterator[str]:
    """The address of an S3 service of this process, one for all tests: clients that know it are kept."""
    server = pytest.importorskip("moto.server", reason="moto is not installed").ThreadedMotoServer(
        ip_address="127.0.0.1", port=0, verbose=False
    )
    with pytest.MonkeyPatch.context() as patch:
        for name, value in STORE.items():
            patch.setenv(name, value)
        server.start()
        host, port = server.get_host_and_port()
        patch.setenv("AWS_ENDPOINT_URL", f"http://{host}:{port}")
        yield f"http://{host}:{port}"
        server.stop()


@pytest.fixture(scope="module")
def processes(store: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Processes]:
    """A scheduler with two workers, which know the object store."""
    with running(tmp_path_factory.mktemp("cluster"), 2, {"AWS_ENDPOINT_URL": store}) as found:
        yield found


@pytest.fixture
def cluster(processes: Processes) -> Processes:
    """The scheduler with two workers, also after a test that has ended one of them."""
    if processes.scheduler is None or processes.scheduler.poll() is not None:
        processes.end()
        processes.start_scheduler()
    processes.start_workers(2)
    return processes


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, the current one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("MUDLINE_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path
