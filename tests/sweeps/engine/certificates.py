"""An authority and a certificate for loopback, made for a test."""

from __future__ import annotations

import datetime
import ipaddress
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID


def write_certificates(folder: Path, authority: str = "authority") -> dict[str, Path]:
    """Files ``ca``, ``cert`` and ``key`` in PEM; each call makes another authority."""
    folder.mkdir(exist_ok=True)
    ca_key, key = ec.generate_private_key(ec.SECP256R1()), ec.generate_private_key(ec.SECP256R1())
    ca_name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, authority)])
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "localhost")])
    now = datetime.datetime.now(tz=datetime.UTC)

    def certificate(subject: x509.Name, public: ec.EllipticCurvePublicKey, *, of_authority: bool) -> x509.Certificate:
        loopback = x509.SubjectAlternativeName(
            [x509.DNSName("localhost"), x509.IPAddress(ipaddress.ip_address("127.0.0.1"))]
        )
        builder = (
            x509.CertificateBuilder()
            .subject_name(subject)
            .issuer_name(ca_name)
            .public_key(public)
            .serial_number(x509.random_serial_number())
            .not_valid_before(now - datetime.timedelta(days=1))
            .not_valid_after(now + datetime.timedelta(days=1))
            .add_extension(x509.BasicConstraints(ca=of_authority, path_length=None), critical=True)
        )
        return (builder if of_authority else builder.add_extension(loopback, critical=False)).sign(
            ca_key, hashes.SHA256()
        )

    pem = serialization.Encoding.PEM
    contents = {
        "ca": certificate(ca_name, ca_key.public_key(), of_authority=True).public_bytes(pem),
        "cert": certificate(name, key.public_key(), of_authority=False).public_bytes(pem),
        "key": key.private_bytes(pem, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()),
    }
    files = {kind: folder / f"{kind}.pem" for kind in contents}
    for kind, content in contents.items():
        files[kind].write_bytes(content)
    return files
