# SPDX-License-Identifier: BSD-3-Clause
"""Arrays as text in a page: little-endian, deflated, base64; numbers as whole ones of a step where
that is enough. assets/base.js reads them."""
from __future__ import annotations

import base64
import html
import json
import zlib
from typing import Any

import numpy as np

from ..data.errors import Error

Packed = dict[str, Any]
TYPES = {"int16": "<i2", "uint8": "|u1", "uint16": "<u2", "uint32": "<u4", "float32": "<f4"}


def packed(values: Any, kind: str, differences: bool = False) -> Packed:
    """An array of one of TYPES. `differences`: along the first axis, each but the first less the one
    before (int16 only, they wrap round): what changes slowly packs better so."""
    array = np.ascontiguousarray(values).astype(TYPES[kind])
    stored = array
    if differences and len(array) > 1:
        whole = array.astype(np.int32)
        stored = np.concatenate([whole[:1], np.diff(whole, axis=0)]).astype("<i2")
    data = np.frombuffer(stored.tobytes(), dtype=np.uint8).reshape(-1, array.itemsize)
    # The first bytes of all numbers, then the second ones: alike ones stand together.
    return {"type": kind, "shape": list(array.shape), "differences": bool(differences),
            "data": base64.b64encode(zlib.compress(data.T.tobytes(), 9)).decode()}


def gaps(values: np.ndarray) -> np.ndarray:
    """With NaN, which curves leave out, for all that is not finite."""
    return np.where(np.isfinite(values), values, np.nan)


def quantised(values: np.ndarray) -> Packed:
    """Signed numbers to 1/32767 of the largest one, "scale" for each step."""
    top = float(np.abs(values).max(initial=0.0)) or 1.0
    scale = top / 32767
    return {**packed(np.round(np.asarray(values) / scale), "int16", True), "scale": scale}


def shades(values: np.ndarray) -> Packed:
    """Numbers for colours, to 1/254 of what they and zero span: "low" + number × "scale", which is zero
    where they are."""
    low, high = float(values.min(initial=0.0)), float(values.max(initial=0.0))
    scale = (high - low) / 254 or 1.0
    below = int(np.ceil(-low / scale))  # steps: zero is one of them
    return {**packed(np.round(values / scale) + below, "uint8"), "low": -below * scale, "scale": scale}


def size_of(data: Any) -> int:
    """Characters that it will be in the page."""
    return len(json_text(data))


def json_text(data: Any) -> str:
    """JSON that may stand in a <script>: nothing in it ends that or begins a comment."""
    try:
        text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    except ValueError:
        raise Error("its numbers are not finite (NaN or infinite)") from None
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def escaped(text: object) -> str:
    """Text as HTML, in and out of attributes. Bytes that were no UTF-8 become question marks."""
    return html.escape(str(text).encode("utf-8", "replace").decode(), quote=True)


def number(value: Any, digits: int = 4) -> str:
    """A number to read: 0.1197, 2.05e-15, 1200; what is none: –."""
    if value is None or isinstance(value, float) and not np.isfinite(value):
        return "–"
    if isinstance(value, (int, np.integer)):
        return f"{int(value):,}".replace(",", "\u202f")
    size = abs(float(value))
    if size and (size < 1e-3 or size >= 1e6):
        mantissa, exponent = f"{value:.{max(digits - 2, 1)}e}".split("e")
        mantissa = f"{float(mantissa):g}"
        return f"{mantissa}·10{_raised(int(exponent))}".replace("-", "−")
    whole = max(digits, len(f"{size:.0f}"))  # 3795, not 3.8e+03
    return f"{value:.{whole}g}".replace("-", "−")


def _raised(exponent: int) -> str:
    return "".join("⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".index(sign)] for sign in str(exponent))
