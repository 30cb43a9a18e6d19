"""Builds the wheel of the Python package `reach`, as pip asks for it (PEP 517).

    wheel_of_reach.py FOLDER   puts what would be in it there, for cmake --install

A wheel is a zip file with three lists beside the modules. Built here rather than by setuptools, it
needs no package from the network and puts nothing into the tree; what is special about this one is
that lcm-gen makes the message bindings while it is built.
"""

import base64
import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
# The rest wants the tree.
MODULES = (
    "__init__", "bus", "client", "command_line", "event_log", "export", "learner", "log_stream",
    "mcap_file", "mcap_writer", "message_fields", "messages", "metrics", "protobuf", "record",
    "recording", "samples", "simulator", "table_files", "tables", "view", "words",
)  # fmt: skip
EXTRAS = {"mcap": ["mcap"], "parquet": ["pyarrow"], "rerun": ["rerun-sdk"]}
SCRIPTS = {"reach-export": "reach.export:main"}


def _full_version() -> str:
    """With the git revision."""
    command = [ROOT / "tools/dev/version.sh"]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def _version() -> str:
    return _full_version().split()[0]


def _pinned(name: str) -> str:
    return re.search(rf"^{name}==\S+", (ROOT / "requirements.txt").read_text(), re.MULTILINE)[0]


def _metadata() -> str:
    lines = [
        "Metadata-Version: 2.1", "Name: reach", f"Version: {_version()}",
        "Summary: reachd from Python: a client, and logs as numpy arrays",
        "License: MIT", "Requires-Python: >=3.11",
        *(f"Requires-Dist: {_pinned(name).replace('==', '>=')}" for name in ("lcm", "numpy")),
    ]  # fmt: skip
    for extra, packages in EXTRAS.items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {package}; extra == "{extra}"' for package in packages]
    return "\n".join(lines) + "\n"


def _bindings(folder: Path) -> dict[str, bytes]:
    types = sorted((ROOT / "lcmtypes").rglob("*.lcm"))
    command = ["lcm-gen", "-p", "--ppath", folder, "--package-prefix", "reach_lcm", *types]
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        raise SystemExit("reach: lcm-gen is missing: apt-get install liblcm-bin") from None
    files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.py")}
    files["reach_lcm/__init__.py"] = files.get("reach_lcm/__init__.py", b"")
    return files | {f"reach/{path.relative_to(ROOT)}": path.read_bytes() for path in types}


def _content() -> dict[str, bytes]:
    files = {f"reach/{name}.py": (ROOT / f"tools/reach/{name}.py").read_bytes() for name in MODULES}
    constant = f'"""The version, with the git revision."""\n\nVERSION = "{_full_version()}"\n'
    files["reach/version.py"] = constant.encode()
    with tempfile.TemporaryDirectory() as folder:
        files |= _bindings(Path(folder))
    info = f"reach-{_version()}.dist-info"
    scripts = "".join(f"{name} = {entry}\n" for name, entry in SCRIPTS.items())
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = b"Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    files[f"{info}/entry_points.txt"] = f"[console_scripts]\n{scripts}".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    return files


def _record(files: dict[str, bytes], own_name: str) -> bytes:
    rows = []
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    return "".join([*rows, f"{own_name},,\n"]).encode()


def _files() -> dict[str, bytes]:
    files = _content()
    own_name = f"reach-{_version()}.dist-info/RECORD"
    return files | {own_name: _record(files, own_name)}


def put_into(folder: Path) -> None:
    """In place of what is there."""
    shutil.rmtree(folder, ignore_errors=True)
    for name, data in _files().items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    """Called by pip."""
    name = f"reach-{_version()}-py3-none-any.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in _files().items():
            wheel.writestr(path, data)
    return name


def build_sdist(sdist_directory, config_settings=None) -> str:
    raise NotImplementedError("reach is built from the project's tree alone")


if __name__ == "__main__":
    put_into(Path(sys.argv[1]))
