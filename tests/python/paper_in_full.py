# SPDX-License-Identifier: BSD-3-Clause
"""The study of the paper in full: its table against numbers written here, so that no bound of the
study itself can be widened unseen (docs/paper.md, docs/validation.md). Some 20 s, 1.2 GB of disk;
by hand: RONDO=... PYTHONPATH=python python3 -m pytest tests/python/paper_in_full.py"""
import pytest
from studies import paper, table

OURS = {  # what the full study gives, and by how much another compiler may move it
    "damped-closed-form": (1.593712e-4, 1e-9),
    "undamped-swing": (0.994, 0.004), "undamped-tangential": (4.949e-5, 2e-8),
    "printed-creates": (0.0768, 0.0008),
    "printed-blows-up": (21.3, 2.0),
    "turn-smooth-force-y": (189757, 10), "turn-smooth-force-x": (-20725, 10),
    "turn-treaded-force-y": (172113, 10), "turn-treaded-force-x": (-19601, 10),
    "smooth-stationary": (0.00437, 5e-5),
    "treaded-frequency": (318.3, 0.2),
    "friction-0.0-force-y": (189414, 10),
    "friction-0.2-force-y": (189680, 10), "friction-0.2-force-x": (-18244.6, 5),
    "friction-0.4-force-y": (189871, 10), "friction-0.4-force-x": (-21893.6, 5),
    "friction-0.6-force-y": (190008, 10), "friction-0.6-force-x": (-23084.3, 5),
}
AT_MOST = {  # exact identities: whatever the study allows itself
    "spin-up-ledger": 1e-13, "rolling-ledger": 1e-13, "contact-law": 1e-14, "shear-in-cone": 1e-15,
    "friction-0.0-force-x": 0.0, "orthonormality": 1e-13, "error-identity": 1e-14,
}
COUNTS = {  # modes that leave 1e-2, 1e-4, 1e-6 of the energy
    "turn-smooth-velocity-rotating": (75, 417, 584),
    "turn-treaded-velocity-rotating": (125, 492, 597),
    "turn-smooth-velocity-rectified": (2, 8, 55),
    "turn-treaded-velocity-rectified": (6, 13, 77),
    "turn-smooth-displacement-rotating": (20, 45, 192),
    "turn-treaded-displacement-rotating": (21, 69, 253),
    "turn-smooth-displacement-rectified": (1, 1, 4),
    "turn-treaded-displacement-rectified": (1, 3, 9),
    "crush-smooth-displacement-rotating": (1, 2, 5),
}
AS_CRUSH = {  # rolling rectified, crush
    "smooth-displacement-as-crush": (1, 2), "smooth-contact-as-crush": (3, 7),
    "treaded-displacement-as-crush": (3, 3), "treaded-contact-as-crush": (7, 8),
}


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    folder = tmp_path_factory.mktemp("paper")
    done = paper("-o", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "68 of 68 as expected" in done.stdout
    return table(folder)


def test_the_numbers_are_those_of_the_docs(rows):
    for name, (ours, allowed) in OURS.items():
        assert rows[name]["ours"] == pytest.approx(ours, abs=allowed), name
    for name, bound in AT_MOST.items():
        assert rows[name]["ours"] <= bound, name


def test_the_numbers_of_modes(rows):
    for name, counts in COUNTS.items():
        for share, count in zip(("1e-02", "1e-04", "1e-06"), counts):
            # Where the spectrum is flat a mode more or less is round-off.
            assert rows[f"{name}-{share}"]["ours"] == pytest.approx(
                count, abs=0 if count < 50 else 1), f"{name} {share}"
    for name, counts in AS_CRUSH.items():
        assert (rows[name]["ours"], rows[name]["expected"]) == counts, name
