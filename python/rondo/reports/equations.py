# SPDX-License-Identifier: BSD-3-Clause
"""The equations that a page names, as MathML, with their numbers in docs/theory.md."""
from __future__ import annotations

from .document import table


def _i(text: str) -> str:
    return f"<mi>{text}</mi>"


def _t(text: str) -> str:
    return f"<mtext>{text.replace(' ', chr(160))}</mtext>"


def _o(text: str) -> str:
    return f'<mo stretchy="false">{text}</mo>' if text in "()|‖" else f"<mo>{text}</mo>"


def _n(text: str) -> str:
    return f"<mn>{text}</mn>"


def _row(*parts: str) -> str:
    return f"<mrow>{''.join(parts)}</mrow>"


def _sub(base: str, below: str) -> str:
    return f"<msub>{base}{below}</msub>"


def _sup(base: str, above: str) -> str:
    return f"<msup>{base}{above}</msup>"


def _over(above: str, below: str) -> str:
    return f"<mfrac>{above}{below}</mfrac>"


def _dot(base: str, dots: str = "˙") -> str:
    return f'<mover accent="true">{base}{_o(dots)}</mover>'


M, C, K, U, V, R = _i("M"), _i("C"), _i("K"), _i("u"), _i("v"), _i("R")
PLUS, MINUS, IS, LEAST, MOST, NORMAL = (_o(sign) for sign in ("+", "−", "=", "≥", "≤", "⊥"))
ZERO, HALF = _n("0"), _over(_n("1"), _n("2"))
R_N, R_T, MU = _sub(_i("r"), _i("n")), _sub(_i("r"), _i("t")), _i("μ")
W_N, W_T = _sub(_i("w"), _i("n")), _sub(_i("w"), _i("t"))
T = _i("T")
S2 = _sup(_i("s"), _n("2"))


def _math(*parts: str) -> str:
    return f'<math display="block">{"".join(parts)}</math>'


MOTION = _math(M, _dot(U, "¨"), PLUS, _o("("), C, PLUS, _n("2"), _i("s"), M, _i("J"), _o(")"), _dot(U), PLUS,
               K, U, PLUS, M, _o("("), _dot(_i("s")), _i("J"), MINUS, S2, _o(")"), _o("("), _i("X"), PLUS, U,
               _o(")"), PLUS, M, _sup(R, T), _o("("), _dot(_i("c"), "¨"), MINUS, _i("g"), _o(")"), IS,
               _sub(_i("f"), _i("c")))
SIGNORINI = _math(ZERO, MOST, R_N, NORMAL, W_N, PLUS, _i("ε"), LEAST, ZERO)
COULOMB = _math(_o("|"), R_T, _o("|"), MOST, MU, R_N, _o(","), _t("  "), R_T, IS, MINUS, MU, R_N,
                _over(W_T, _row(_o("|"), W_T, _o("|"))), _t("  where  "), W_T, _o("≠"), ZERO)
ENERGY = _math(_i("E"), IS, HALF, _sup(V, T), M, V, PLUS, HALF, _sup(_sub(U, _row(_i("n"), PLUS, _n("1"))), T),
               K, _sub(U, _i("n")))
BALANCE = _math(_i("E"), MINUS, _sub(_i("E"), _t("start")), IS, *[
    sign + _sub(_i(letter), _t(name)) for sign, letter, name in (
        ("", "W", "frame"), ("<mo>+</mo>", "W", "contact"), ("<mo>−</mo>", "D", "mass"),
        ("<mo>−</mo>", "D", "stiffness"), ("<mo>+</mo>", "W", "scheme"))])
SPLIT = _math(*[sign + _sub(_i(letter), _t(name)) for sign, letter, name in (
    ("", "W", "contact"), ("<mo>=</mo>", "W", "rim"), ("<mo>−</mo>", "D", "friction"),
    ("<mo>−</mo>", "L", "impact"))])
STATIC = _math(K, _sub(U, _i("k")), IS, _sup(_i("H"), T), _sub(_i("r"), _i("k")), _o(","), _t("  "), ZERO, MOST,
               R_N, NORMAL, W_N, LEAST, ZERO)
INFLATION = _math(_over(_row(_o("∂"), _i("Π")), _row(_o("∂"), U)), IS, ZERO, _o(","), _t("  "), _i("Π"), IS,
                  _sub(_i("Ψ"), _t("rubber")), PLUS, _sub(_i("Ψ"), _t("cords")), MINUS, _i("p"), _i("V"), MINUS,
                  HALF, S2, f"<munder>{_o('∑')}{_i('i')}</munder>", _sub(_i("m"), _i("i")),
                  f"<msubsup>{_i('r')}{_i('i')}{_n('2')}</msubsup>")
POD = _math(_sup(_i("W"), HALF), _i("S"), IS, _i("U"), _i("Σ"), _sup(_i("V"), T), _o(","), _t("  "),
            _i("Φ"), IS, _sup(_i("W"), _row(MINUS, HALF)), _i("U"))
LEFT = _math(_sup(_row(_o("‖"), _i("A"), MINUS, _sub(_i("U"), _i("r")), _sup(_sub(_i("U"), _i("r")), T), _i("A"),
                       _o("‖")), _n("2")), IS,
             f"<munder>{_o('∑')}{_row(_i('i'), _o('&gt;'), _i('r'))}</munder>",
             f"<msubsup>{_i('σ')}{_i('i')}{_n('2')}</msubsup>")

BY_NAME = {
    "motion": ("Motion, in the frame that turns with the rim", "3.1", MOTION,
               "M masses of the nodes, K stiffness, C damping, u displacement, s spin (counter-clockwise), "
               "J a quarter turn, R turns from this frame to the fixed one, c place of the center, g gravity, "
               "f with index c the forces of contact. Solved by central differences, step by step."),
    "signorini": ("Contact: nothing pulls, nothing goes through", "4.3", SIGNORINI,
                  "r with index n is the impulse along the ground's normal, w with index n the velocity away "
                  "from the ground after the step, ε what restitution adds. One of the two is zero. No "
                  "penalty: the law is met to round-off."),
    "coulomb": ("Friction", "4.3", COULOMB, "What slides is held back by μ times the normal impulse; what is "
                                            "held by less sticks, and does not move at all."),
    "energy": ("Energy, at half steps", "5.1", ENERGY, "Kinetic and strain energy: the columns kinetic and "
                                                       "strain of history.csv."),
    "balance": ("The ledger: what changes the energy", "5.2", BALANCE,
                "Each term is a column of history.csv: work_frame, work_contact, dissipation_mass, "
                "dissipation_stiffness, work_scheme. What the two sides leave is energy_residual: round-off, and of "
                "second order in the step with elastic bodies that nothing holds."),
    "split": ("The part of contact", "5.5", SPLIT,
              "Columns work_rim, dissipation_friction, loss_impact: what the rim does against the ground, and "
              "what friction and impacts take of it."),
    "static": ("Balance without inertia, and contact", "6.4", STATIC,
               "At each increment of the depth: K stiffness, u displacement, H picks the nodes that may touch, "
               "r forces of contact, w with index n the gap. Friction as Coulomb's law has it, over the slip "
               "of an increment."),
    "inflation": ("Equilibrium under air and spin", "docs/tyre.md", INFLATION,
                  "Ψ are the energies of the rubber and of the cords at finite strain, u the displacement, p the "
                  "pressure, V the volume of the cavity in the deformed wheel, s the spin, m masses of the nodes "
                  "and r their distances from the axle. Solved by Newton's method, step by step of the loads."),
    "pod": ("Modes from snapshots", "7.2", POD,
            "S holds a snapshot in each column, W the weights (masses of the nodes). Columns of Φ are the "
            "modes, Σ holds the singular values σ, largest first, V their courses in time."),
    "left": ("What r modes leave out", "7.2a", LEFT, "The share of the energy left out is this sum over that "
                                                     "of all σ²: the error of the best fit, exactly."),
}


def equations(*names: str) -> str:
    """Those of these names, one after another."""
    items = []
    for name in names:
        heading, number, math, words = BY_NAME[name]
        items.append(f'<div class="equation"><h3>{heading} <small>({number})</small></h3>{math}'
                     f"<p>{words}</p></div>")
    return ("<p>Numbers are those of <code>docs/theory.md</code>, the theory pages that come with the "
            "program.</p>" + "".join(items) + SOURCE)


SOURCE = ("<p>Source of the model: N. Adam, A. Gravouil, D. Dureisseix, <cite>Réduction de modèle et problèmes "
          'de contact en dynamique explicite</cite>, CSMA 2017 (<a href="https://hal.science/hal-01899327">'
          "hal-01899327</a>); the scheme: F. Fekak, M. Brun, A. Gravouil, B. Depale, <cite>Comput. Mech.</cite> "
          "60 (2017).</p>")

WORDS = (
    ("co-rotating frame", "axes that turn with the rim; the displacement is what the body does beside turning"),
    ("contact patch", "the part of the surface that presses on the ground"),
    ("critical step", "the longest time step at which the computation is stable"),
    ("ledger", "the account of all work done on the body and taken from it; it shows whether steps are right"),
    ("per metre of width", "a plane body is a slice: forces are N/m, energies J/m, as if it were 1 m wide"),
    ("slip ratio", "how much faster the surface of the wheel goes than the wheel: 0 rolls freely, 1 spins on "
                   "the spot, −1 is locked"),
    ("snapshot", "all places and velocities at one time"),
    ("von Mises stress", "one number for how hard the material is strained, in MPa"),
)


def glossary() -> str:
    return table(("word", "what it means"), WORDS, "Words")
