# SPDX-License-Identifier: BSD-3-Clause
"""What the packages hold and say, without installing them:
    look_at_debs.py FOLDER-OF-PACKAGES BUILD SOURCE"""
import pathlib
import re
import subprocess
import sys
import tempfile

FOLDER, BUILD, SOURCE = (pathlib.Path(given).resolve() for given in sys.argv[1:])
VERSION = re.search(r"^project\(rondo VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
PLACES = {"rondo": ("bin/", "lib/python3/dist-packages/rondo/", "lib/rondo/", "share/rondo/", "share/doc/rondo/",
                    "share/man/", "share/bash-completion/completions/rondo"),
          "rondo-dev": ("include/rondo/", "lib/librondo_", "lib/cmake/rondo/", "share/doc/rondo-dev/")}
WANTED = {"rondo": ("bin/rondo", "bin/rondo-mesh-reader", "lib/python3/dist-packages/rondo/__init__.py",
                    "lib/python3/dist-packages/rondo/bin/rondo", "lib/python3/dist-packages/rondo/reports/assets/plotly-basic.min.js",
                    "share/rondo/cases/ledge-smooth.toml",
                    "share/man/man1/rondo.1.gz", "share/man/man1/rondo-run.1.gz", "share/man/man5/rondo-case.5.gz",
                    "share/bash-completion/completions/rondo", "share/doc/rondo/copyright",
                    "share/doc/rondo/changelog.gz", "share/doc/rondo/NEWS.gz", "share/doc/rondo/docs/cases.md"),
          "rondo-dev": ("include/rondo/case/case.hpp", "lib/cmake/rondo/rondo-config.cmake", "lib/librondo_study_sweep.a",
                        "share/doc/rondo-dev/copyright", "share/doc/rondo-dev/changelog.gz")}
NEEDED = {"rondo": ("libc6", "libhdf5", "libgmsh", "libopenmpi", "python3 (>= 3.", "python3-numpy", "python3-h5py",
                    "python3-matplotlib", "python3-pil"),
          "rondo-dev": (f"rondo (= {VERSION})", "libeigen3-dev", "libhdf5-dev")}
MODES = {"drwxr-xr-x", "-rw-r--r--", "-rwxr-xr-x", "lrwxrwxrwx"}
faults = []


def check(right, said):
    if not right:
        faults.append(said)


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def look_at_list(name, deb):
    files = set()
    for line in run("dpkg-deb", "-c", deb).splitlines():
        mode, owner, _, _, _, path = line.split(None, 5)
        check(mode in MODES, f"{name}: {line}: mode")
        check(owner == "root/root", f"{name}: {line}: owner")
        path = path.split(" -> ")[0].removeprefix("./")
        if mode[0] == "d":
            continue
        files.add(path)
        check(path.removeprefix("usr/").startswith(PLACES[name]), f"{name}: {path}: not a place of this package")
        check("__pycache__" not in path, f"{name}: {path}: is made by the installation")
    for wanted in WANTED[name]:
        check(f"usr/{wanted}" in files, f"{name}: no usr/{wanted}")
    return files


def look_for_build(name, deb):
    """No file names a folder of the build or of the sources."""
    with tempfile.TemporaryDirectory() as folder:
        run("dpkg-deb", "-x", deb, folder)
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.is_symlink():
                check(path.resolve().exists() and pathlib.Path(folder) in path.resolve().parents,
                      f"{name}: {path.relative_to(folder)}: leads nowhere")
            elif path.is_file():
                data = path.read_bytes()
                for place in {BUILD, SOURCE}:
                    check(bytes(place) + b"/" not in data, f"{name}: {path.relative_to(folder)}: names {place}")


def look_at_control(name, deb):
    def field(key):
        return run("dpkg-deb", "-f", deb, key).strip()

    check((field("Package"), field("Version")) == (name, VERSION), f"{name}: {field('Package')} {field('Version')}")
    check(deb.name == f"{name}_{VERSION}_{field('Architecture')}.deb", f"{name}: is called {deb.name}")
    depends = field("Depends").split(", ")
    for needed in NEEDED[name]:
        check(any(one.startswith(needed) for one in depends), f"{name}: does not depend on {needed}: {depends}")
    check("md5sums" in run("dpkg-deb", "-I", deb), f"{name}: no md5sums")


debs = {path.name.split("_")[0]: path for path in FOLDER.glob("*.deb")}
check(set(debs) == set(PLACES), f"packages: {sorted(debs)}")
listed = {}
for name, deb in debs.items():
    listed[name] = look_at_list(name, deb)
    look_for_build(name, deb)
    look_at_control(name, deb)
both = set.intersection(*listed.values())
check(not both, f"in both packages: {both}")
print("\n".join(faults) or f"{len(debs)} packages, {sum(map(len, listed.values()))} files: as they should be")
sys.exit(1 if faults else 0)
