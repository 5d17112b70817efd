"""Which schedulers are refused, and what is said of workers that do not fit."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from mudline import __version__
from mudline.cluster import scheduler as module
from mudline.cluster.scheduler import ClusterError, Scheduler, connected
from tests.cli.runner import run

pytest.importorskip("distributed", reason="distributed is not installed")


@pytest.mark.parametrize(
    ("given", "insecure"),
    [
        ("tcp://127.0.0.1:8786", False),
        ("tcp://[::1]:8786", False),
        ("tcp://localhost:8786", False),
        ("tls://10.0.0.7:8786", False),
        ("tcp://10.0.0.7:8786", True),
        ("local", False),
        ("local:3", False),
    ],
)
def test_schedulers_that_are_used(given: str, insecure: bool) -> None:
    Scheduler(given, insecure=insecure).check()


ODD = (
    "tcp://127.0.0.1:1#@example.org:2",
    "tcp://127.0.0.1:1?x",
    "tcp://example.org:2@127.0.0.1:1",
    "tcp://127.0.0.1:1/",
    "TCP://127.0.0.1:1",
    "tcp://127.0.0.1 :1",
    "tcp://[::1:1",
)
"""What others may take apart in another way than we do."""


@pytest.mark.parametrize(
    "given",
    ["8786", "host:8786", "tcp://host", "tcp://:8786", "tcp://h:port", "ws://h:1", "local:0", "local:x", "", *ODD],
)
def test_what_is_no_address_is_refused(given: str) -> None:
    done = run("lint", "decks", "--scheduler", given, "--insecure")
    assert done.code == 2
    assert f"--scheduler {given}: expected tcp://HOST:PORT, tls://HOST:PORT or local[:WORKERS]" in done.err


@pytest.mark.parametrize(
    "host",
    [
        "10.0.0.7",
        "0.0.0." + "0",
        "127.1",
        "[::]",
        "example.org",
        "192.168.1.2",
        "localhost.example.org",
        "[2001:db8::1]",
    ],
)
@pytest.mark.parametrize("command", ["lint", "validate", "evaluate"])
def test_another_machine_without_tls_is_refused(command: str, host: str) -> None:
    done = run(command, "decks", "--scheduler", f"tcp://{host}:8786")
    assert done.code == 2
    assert f"--scheduler tcp://{host}:8786: without TLS, whoever reaches it can run code" in done.err
    assert "give tls://HOST:PORT with --tls-ca, --tls-cert and --tls-key, or --insecure" in done.err


def test_tls_options_that_do_not_fit_are_refused(folder: Path) -> None:
    (folder / "ca.pem").write_text("", encoding="utf-8")
    tls = ("--tls-ca", "ca.pem")
    assert "tcp:// has no TLS" in run("lint", "d", "--scheduler", "tcp://127.0.0.1:1", *tls).err
    assert "local is reached from this machine only" in run("lint", "d", "--scheduler", "local", *tls).err
    assert "--tls-key none.pem: no such file" in run("lint", "d", "--scheduler", "local", "--tls-key", "none.pem").err
    assert "are for --scheduler: give it too" in run("lint", "d", *tls).err


def test_certificates_are_those_given() -> None:
    given = Scheduler("tls://10.0.0.7:8786", "ca.pem", "cert.pem", "key.pem")
    security = cast("Any", module._security(given))
    assert (security.tls_ca_file, security.tls_client_cert, security.tls_client_key) == (
        "ca.pem",
        "cert.pem",
        "key.pem",
    )
    assert security.require_encryption
    assert module._security(Scheduler("tcp://127.0.0.1:1")) is None


@pytest.mark.parametrize("option", ["--fix", "--diff", "--watch"])
def test_what_changes_decks_here_is_refused(option: str) -> None:
    done = run("lint", "decks", option, "--scheduler", "local")
    assert f"{option} does not go with --scheduler" in done.err


@pytest.mark.parametrize(
    "words", [("lint", "d"), ("evaluate", "d"), ("index", "d", "-o", "a")], ids=lambda words: words[0]
)
def test_jobs_are_refused(words: tuple[str, ...]) -> None:
    done = run(*words, "--jobs", "2", "--scheduler", "local:2")
    assert done.code == 2
    assert "--jobs is for processes without --scheduler: leave it out, or give local:WORKERS" in done.err


def test_standard_input_and_folders_without_a_cluster_are_refused() -> None:
    assert "- is standard input, which workers cannot read" in run("validate", "-", "--scheduler", "local").err
    assert "-o is for --scheduler" in run("validate", "decks", "-o", "out").err
    assert "-o s3://b/out: a URL needs --scheduler" in run("evaluate", "decks", "-o", "s3://b/out").err


def test_a_scheduler_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "CONNECTING", 0.2)
    message = r"tcp://127.0.0.1:9: the scheduler does not answer: "
    with pytest.raises(ClusterError, match=message), connected(Scheduler("tcp://127.0.0.1:9")):
        pass


def client(found: dict[str, object]) -> SimpleNamespace:
    def answers(*_: object, on_error: str) -> dict[str, object]:
        assert on_error == "return"
        return found

    return SimpleNamespace(run=answers)


@pytest.mark.parametrize(
    ("found", "has"),
    [
        ({"tcp://a:1": __version__, "tcp://b:2": None}, "worker tcp://b:2 has no mudline that can be imported"),
        ({"tcp://b:2": ImportError("no numpy")}, "worker tcp://b:2 has no mudline that can be imported"),
        ({"tcp://a:1": "0.0.1", "tcp://b:2": "0.0.2"}, r"worker tcp://a:1 has mudline 0.0.1"),
    ],
)
def test_workers_of_another_version_are_named(found: dict[str, object], has: str) -> None:
    check: Callable[[object, Scheduler], None] = module._check_versions  # type: ignore[assignment]
    with pytest.raises(ClusterError, match=has) as raised:
        check(client(found), Scheduler("tcp://s:1"))
    assert f", this command {__version__}: install the same version" in str(raised.value)


def test_a_worker_that_ends_meanwhile_is_left_out() -> None:
    check: Callable[[object, Scheduler], None] = module._check_versions  # type: ignore[assignment]
    check(client({"tcp://a:1": __version__, "tcp://b:2": ConnectionResetError()}), Scheduler("tcp://s:1"))
    with pytest.raises(ClusterError, match="tcp://s:1: all workers ended when they were asked for their version"):
        check(client({"tcp://b:2": TimeoutError()}), Scheduler("tcp://s:1"))


def test_workers_of_this_version_fit() -> None:
    check: Callable[[object, Scheduler], None] = module._check_versions  # type: ignore[assignment]
    check(client({"tcp://a:1": __version__}), Scheduler("tcp://s:1"))
