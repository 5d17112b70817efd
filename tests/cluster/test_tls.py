"""A scheduler and a worker with TLS: certificates of one CA are let in, others are not."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.runner import Outcome, run
from tests.cluster.processes import running

pytest.importorskip("distributed", reason="distributed is not installed")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="processes are killed by POSIX signals"),
    pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl is not installed"),
    # Sockets and loops of dask end with the process, not with the command.
    pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"),
]


def certificate(name: str, *signer: str) -> None:
    """A key and a certificate in the working folder, signed by itself or by a CA."""
    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", f"{name}.key")
    files = ("-subj", f"/CN={name}", "-addext", "subjectAltName=IP:127.0.0.1", "-out", f"{name}.pem", "-days", "2")
    command = ["openssl", "req", "-x509", *key, *files, *signer]
    subprocess.run(command, check=True, capture_output=True)


def test_certificates_of_one_ca_are_let_in(folder: Path) -> None:
    for name in ("ca", "other"):
        certificate(name)
    for name in ("node", "me"):
        certificate(name, "-CA", "ca.pem", "-CAkey", "ca.key")
    (folder / "decks").mkdir()
    for name, text in (("a", CLEAN), ("b", BAD_NUMBER)):
        (folder / "decks" / f"{name}.keyxm").write_text(text, encoding="utf-8")
    (folder / "logs").mkdir()
    options = ("--tls-ca-file", "ca.pem", "--tls-cert", "node.pem", "--tls-key", "node.key")
    with running(folder / "logs", 1, options=options) as cluster:
        assert cluster.address.startswith("tls://127.0.0.1:")

        def validated(address: str, *tls: str) -> Outcome:
            return run("validate", "decks", "--scheduler", address, *tls)

        def refused(address: str, *tls: str) -> str:
            done = validated(address, *tls)
            assert (done.code, done.out) == (2, "")
            return done.err.removeprefix(f"mudline: {address}: ")

        def files(ca: str, own: str) -> tuple[str, ...]:
            return ("--tls-ca", f"{ca}.pem", "--tls-cert", f"{own}.pem", "--tls-key", f"{own}.key")

        assert validated(cluster.address, *files("ca", "me")) == run("validate", "decks")
        untrusted = refused(cluster.address, *files("other", "me"))
        assert untrusted.startswith(
            "its certificate is not trusted (self-signed certificate in certificate chain): give "
        )
        stranger = refused(cluster.address, *files("ca", "other"))
        assert stranger.startswith("no TLS connection (")
        assert "give --tls-cert a certificate that the CA of the scheduler signed" in stranger
        assert refused(cluster.address) == "no certificates: give --tls-ca, --tls-cert and --tls-key\n"
        plain = refused(cluster.address.replace("tls", "tcp"))
        assert plain == "the scheduler closes the connection: give tls:// if it uses TLS\n"
        bad = refused(cluster.address, "--tls-ca", "ca.key", "--tls-cert", "me.pem", "--tls-key", "me.key")
        assert bad.startswith("the files of --tls-* cannot be used: ")
