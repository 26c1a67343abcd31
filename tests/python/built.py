# SPDX-License-Identifier: BSD-3-Clause
"""What the build that is tested was configured with."""
import re


def cached(build, name):
    found = re.search(rf"^{name}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found[1] if found else ""
