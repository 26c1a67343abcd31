# SPDX-License-Identifier: BSD-3-Clause
"""Every number of docs/paper.md has its place in paper_page.py: a study makes it, and paper_in_full.py
compares it with a fresh one, or it is given. How numbers of the page are read and compared."""
import paper_page
import pytest
from paper_page import STUDY, Piece, Value, number_of, page_text, stale, unplaced


def test_every_number_of_the_page_has_its_place():
    assert unplaced(page_text()) == []


def test_every_place_has_its_values():
    for piece in STUDY:
        assert piece.text.count("#") == len(piece.values), piece.text


def test_a_number_without_a_place_is_told():
    told = unplaced(page_text() + " It takes 17.5 modes.")
    assert len(told) == 1 and "It takes 17.5 modes" in told[0]
    assert "0 times on the page" in "".join(unplaced(page_text().replace("modes in the end", "modes")))


def test_a_stale_number_is_told(monkeypatch):
    monkeypatch.setattr(paper_page, "page_text", lambda: "It takes 12 and 1.6·10⁻¹⁰ of 2.8·10⁻¹⁵.")

    def said(modes, share, residual):
        values = (Value(lambda _: modes), Value(lambda _: share, 0.1), Value(lambda _: residual, round_off=True))
        monkeypatch.setattr(paper_page, "STUDY", [Piece("It takes # and # of #.", values)])
        return len(stale(None))

    assert said(12, 1.7e-10, 1e-16) == 0
    assert (said(14, 1.7e-10, 1e-16), said(12, 2e-10, 1e-16), said(12, 1.7e-10, 3e-14)) == (1, 1, 1)
    assert said(float("nan"), float("nan"), float("nan")) == 3


@pytest.mark.parametrize("text, number, half", [
    ("1,100", 1100.0, 0.5), ("− 0.03", -0.03, 0.005), ("1.89769·10⁵", 189769.0, 0.5),
    ("10⁻⁶", 1e-6, 0.5e-6), ("+ 1.6·10⁻¹⁰", 1.6e-10, 0.5e-11)])
def test_numbers_are_read_as_they_are_written(text, number, half):
    assert number_of(text) == pytest.approx((number, half), rel=1e-12)
