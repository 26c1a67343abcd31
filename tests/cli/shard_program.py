# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of sweeps in shards share: the shards, their tables against the undivided sweep's."""
import json
import sys

from program import PROGRAM, ROOT, run
from sweep_program import STUDY, SweepTest

sys.path.insert(0, str(ROOT / "python"))
TABLES = ("results.csv", "sweep.h5")
LATIN = """schema = 1
base = "case.toml"
set = ["analysis.solver=latin-pgd"]
[[vary]]
key = "disk.mesh.radial"
values = [4, 3]
[[vary]]
key = "ground.friction"
values = [0.3, 0.1, 0.5, 0.7]
"""


class ShardTest(SweepTest):
    def expect(self, text=STUDY, code=0):
        """Of the undivided sweep, beside."""
        self.whole = self.folder / "whole"
        done = run("sweep", self.study(text), "-o", self.whole, "--quiet")
        self.assertEqual(done.returncode, code, done.stderr)

    def command(self, *extra, text=STUDY):
        return [PROGRAM, "sweep", str(self.study(text)), "-o", str(self.out), *extra]

    def shard(self, number, count, *extra, text=STUDY, code=0):
        return self.sweep("--shard", f"{number}/{count}", *extra, text=text, code=code)

    def collect(self, text=STUDY, code=0):
        return self.sweep("--collect", text=text, code=code)

    def rows(self, number, count):
        return json.loads((self.out / "shards" / f"{number:04d}-of-{count:04d}" / "rows.json").read_text())

    def runs_of(self, number, count):
        return [row["run"] for row in self.rows(number, count)["rows"]]

    def same(self):
        for name in TABLES:
            self.assertEqual((self.out / name).read_bytes(), (self.whole / name).read_bytes(), name)
        said = [json.loads((path / "sweep.json").read_text()) for path in (self.out, self.whole)]
        for j in said:
            self.assertGreaterEqual(j.pop("wall_s"), 0.0)
        self.assertEqual(*said)

    def all_shards(self, count, text=STUDY, order=None, codes=None):
        for number in order or range(1, count + 1):
            self.shard(number, count, text=text, code=(codes or {}).get(number, 0))
