# SPDX-License-Identifier: BSD-3-Clause
"""The study of the paper in full: its exact identities against bounds written here, so that no bound of
the study itself can be widened unseen, and every number of docs/paper.md that it makes. Some 20 s, 1.3 GB
of disk; by hand: RONDO=... PYTHONPATH=python python3 -m pytest tests/python/paper_in_full.py"""
import paper_page
import pytest
from studies import paper, table

AT_MOST = {  # exact identities: whatever the study allows itself
    "spin-up-ledger": 1e-13, "rolling-ledger": 1e-13, "contact-law": 1e-14, "shear-in-cone": 1e-15,
    "friction-0.0-force-x": 0.0, "orthonormality": 1e-13, "error-identity": 1e-14,
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("paper")
    done = paper("-o", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_exact_identities(folder):
    rows = table(folder)
    for name, bound in AT_MOST.items():
        assert rows[name]["ours"] <= bound, name


def test_the_numbers_of_the_page_are_those_of_the_study(folder):
    assert paper_page.stale(paper_page.Study(folder)) == []
