# SPDX-License-Identifier: BSD-3-Clause
"""The layer check holds on the project, and sees a back edge when there is one."""
import pathlib
import re
import tempfile
import unittest

import check_layers

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Layers(unittest.TestCase):
    def test_project(self):
        self.assertEqual(list(check_layers.faults(ROOT)), [])

    def test_a_back_edge_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for module, text in [("core", '#include "rondo/mesh/mesh.hpp"\n'),
                                 ("contact", "#include <hdf5.h>\n"),
                                 ("mesh", '#include "rondo/core/vec2.hpp"\n')]:
                path = root / "src/rondo" / module
                path.mkdir(parents=True)
                (path / "a.hpp").write_text(text)
            found = list(check_layers.faults(root))
            self.assertEqual(len(found), 2, found)
            self.assertIn("core may not see mesh", found[1])

    def test_sub_rooms_have_layers_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in [("contact/law.hpp", '#include "rondo/contact/coupled/rows.hpp"\n'),
                               ("contact/coupled/rows.hpp", '#include "rondo/contact/law.hpp"\n'),
                               ("io/csv.cpp", "#include <hdf5.h>\n")]:
                path = root / "src/rondo" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            found = list(check_layers.faults(root))
            self.assertEqual(len(found), 2, found)
            self.assertIn("contact may not see contact/coupled", found[0])
            self.assertIn("only io/h5 may", found[1])

    def test_a_folder_that_is_full_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            module = pathlib.Path(folder) / "src/rondo/core"
            module.mkdir(parents=True)
            for k in range(check_layers.MOST_FILES + 1):
                (module / f"a{k}.hpp").write_text("")
            found = list(check_layers.faults(pathlib.Path(folder)))
            self.assertEqual(len(found), 1, found)
            self.assertIn(f"holds {check_layers.MOST_FILES + 1} files", found[0])

    def test_no_sources_is_a_fault(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(check_layers.faults(pathlib.Path(folder)))), 1)

    def test_what_public_headers_include_is_public(self):
        """That each then compiles with what is installed, house_install sees."""
        text = (ROOT / "cmake" / "public_headers.cmake").read_text()
        public = set(re.findall(r"[a-z0-9_/]+\.hpp", text))
        self.assertGreater(len(public), 40)
        for header in sorted(public - {"core/version.hpp"}):  # which CMake makes
            included = check_layers.INCLUDE.findall((ROOT / "src/rondo" / header).read_text())
            ours = {name.removeprefix("rondo/") for name in included if name.startswith("rondo/")}
            self.assertEqual(ours - public, set(), f"{header}; cmake/public_headers.cmake")

    def test_what_public_headers_name_is_public(self):
        """A class that a public header declares and leaves to another header, which a program that gets or gives
        one of that class needs: but for those that are only handed on, or are of another library."""
        handed_on = {"Analysis", "CaseValues", "Hyperelasticity", "XXH3_state_s"}
        public = set(re.findall(r"[a-z0-9_/]+\.hpp", (ROOT / "cmake" / "public_headers.cmake").read_text()))
        texts = {name: (ROOT / "src/rondo" / name).read_text() for name in public - {"core/version.hpp"}}
        declared = {name for text in texts.values() for name in re.findall(r"^ *(?:class|struct) (\w+);", text, re.M)}
        defined = {name for text in texts.values()
                   for name in re.findall(r"^ *(?:class|struct) (\w+)\b[^;{]*\{", text, re.M)}
        self.assertEqual(declared - defined, handed_on)


if __name__ == "__main__":
    unittest.main()
