# SPDX-License-Identifier: BSD-3-Clause
"""clang-tidy over the sources named on stdin, several at once; called by scripts/lint.sh.

    tidy.py BUILD STAMPS SECONDS      BUILD: has compile_commands.json; SECONDS: 0, or when to stop

Most of the time goes to the headers of other libraries, so that sources are looked at in batches,
as one text. A batch that is not clean (names of two files may clash there) is halved, down to
single files, whose findings count. What was clean is stamped: a hash of the file, of all that it
includes of ours, of its flags and of the checks. A header is looked at with the source of its name,
or else with the first that includes it. After SECONDS no further source is begun; how many are left
is said.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
BATCH = 16
ROOT = pathlib.Path.cwd()


class Sources:
    """Every compiled source with its flags, and what it includes."""

    def __init__(self, build):
        self.flags = {}
        self.known = {}
        self.folders = [ROOT / "src", build / "generated"]
        for entry in json.loads((build / "compile_commands.json").read_text()):
            path = pathlib.Path(entry["file"])
            if path.is_relative_to(ROOT) and not path.is_relative_to(build):
                words = shlex.split(entry["command"])
                begin = next(i for i, word in enumerate(words) if word.startswith("-"))
                end = words.index("-o")
                self.flags[path] = words[begin:end]

    def included(self, path):
        if path not in self.known:
            found = []
            for name in INCLUDE.findall(path.read_text()):
                places = [folder / name for folder in [path.parent, *self.folders]]
                found += [place for place in places if place.is_file()][:1]
            self.known[path] = found
        return self.known[path]

    def closure(self, path):
        reached, ahead = {path}, [path]
        while ahead:
            for other in self.included(ahead.pop()):
                if other not in reached:
                    reached.add(other)
                    ahead.append(other)
        return sorted(reached)

    def stamp(self, path, checks):
        text = hashlib.sha256(checks)
        text.update("\n".join(self.flags[path]).replace(str(ROOT), "").encode())
        for other in self.closure(path):
            text.update(hashlib.sha256(other.read_bytes()).digest())
        return text.hexdigest()

    def of_header(self, header):
        users = [path for path in sorted(self.flags) if header in self.closure(path)]
        return ([path for path in users if path.stem == header.stem] + users)[:1]


def to_look_at(sources, names):
    paths = [ROOT / name for name in names]
    if any(path.name == ".clang-tidy" for path in paths):
        return sorted(sources.flags)
    chosen = {path for path in paths if path in sources.flags}
    for path in paths:
        if path.suffix == ".hpp" and not any(path in sources.closure(one) for one in chosen):
            chosen.update(sources.of_header(path))
    return sorted(chosen)


def batches(sources, paths, size):
    alike = {}
    for path in paths:
        alike.setdefault((path.relative_to(ROOT).parts[:3], *sources.flags[path]), []).append(path)
    for group in alike.values():
        yield from (group[i:i + size] for i in range(0, len(group), size))


def look(flags, paths, folder):
    """clang-tidy's text where it found anything in these files, taken as one."""
    text = paths[0]
    if len(paths) > 1:
        name = hashlib.sha256("".join(map(str, paths)).encode()).hexdigest()[:16]
        text = folder / f"{name}.cpp"
        text.write_text("".join(f'#include "{path}"\n' for path in paths))
    # It takes and gives back much memory: a third of its time would be the kernel's.
    keep = dict.fromkeys(("MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_THRESHOLD_"), "4000000000")
    done = subprocess.run(["clang-tidy", "--quiet", str(text), "--", *flags], text=True,
                          capture_output=True, env=os.environ | keep)
    if len(paths) > 1:
        text.unlink()
    return done.stdout + done.stderr if done.returncode else ""


def clean(sources, paths, folder, checks):
    """True where all are clean; prints what is found else."""
    found = look(sources.flags[paths[0]], paths, folder)
    if found and len(paths) > 1:
        half = len(paths) // 2
        return all([clean(sources, part, folder, checks) for part in (paths[:half], paths[half:])])
    if found:
        print(found, flush=True)
        return False
    for path in paths:
        (folder / sources.stamp(path, checks)).touch()
    return True


def main():
    build, folder, seconds = (*map(pathlib.Path, sys.argv[1:3]), float(sys.argv[3]))
    build = ROOT / build
    folder = ROOT / folder
    folder.mkdir(parents=True, exist_ok=True)
    sources = Sources(build)
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout
    checks = version + (ROOT / ".clang-tidy").read_bytes()
    paths = to_look_at(sources, sys.stdin.read().split())
    new = [path for path in paths if not (folder / sources.stamp(path, checks)).exists()]
    new.sort(key=lambda path: -path.stat().st_mtime if seconds else 0)
    begin, left = time.monotonic(), []

    def one(batch):
        if seconds and time.monotonic() - begin > seconds:
            left.extend(batch)
            return True
        return clean(sources, batch, folder, checks)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        good = all(list(pool.map(one, batches(sources, new, 1 if seconds else BATCH))))
    print(f"clang-tidy: {len(paths)} sources, {len(paths) - len(new)} of them known to be clean")
    if left:
        print(f"clang-tidy: {len(left)} sources not looked at after {seconds:.0f} s: "
              "bash scripts/lint.sh")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
