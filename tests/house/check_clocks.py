# SPDX-License-Identifier: BSD-3-Clause
"""No source reads the time of day, which may jump: intervals are of steady clocks, and no result
hangs on when it was made."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIME_OF_DAY = re.compile(r"system_clock|high_resolution_clock|utc_clock|file_clock|gettimeofday|"
                         r"CLOCK_REALTIME|CLOCK_TAI|localtime|gmtime|strftime|std::time\s*\(|"
                         r"::time\s*\(|\btime\s*\(\s*(NULL|nullptr|0)\s*\)|wait_until|sleep_until")


def faults(root):
    for folder in ("src", "apps"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(path.read_text().splitlines(), start=1):
                if TIME_OF_DAY.search(line.split("//")[0]):
                    yield f"{path.relative_to(root)}:{number}: {line.strip()}"


class Clocks(unittest.TestCase):
    def test_project(self):
        self.assertGreater(len(list((ROOT / "src").rglob("*.cpp"))), 100)
        self.assertEqual(list(faults(ROOT)), [])

    def test_what_is_seen(self):
        for line in ("std::chrono::system_clock::now()", "time(nullptr)", "gettimeofday(&t, 0)",
                     "clock_gettime(CLOCK_REALTIME, &t)", "std::time(&t)"):
            self.assertRegex(line, TIME_OF_DAY)
        for line in ("is_due(time(step - 1))", "std::chrono::steady_clock::now()", "end_time(x)"):
            self.assertNotRegex(line, TIME_OF_DAY)


if __name__ == "__main__":
    unittest.main()
