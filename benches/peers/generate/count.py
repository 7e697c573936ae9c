"""Counts multiplications and additions in generated source, in the same way for all."""

import re

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
EXPONENT = re.compile(r"(?<![\w.])(\d+\.?\d*)e[+-]?\d+")
# A sign is a binary operator if an operand ends before it.
PRODUCT = re.compile(r"(?<=[\w.)\]])\s*\*\s*(?=[\w(-])|\bpow\(|\bcasadi_sq\(")
SUM = re.compile(r"(?<=[\w.)\]])\s*[+-]\s*(?=[\w(-])")


def operations(function):
    """Returns the numbers of multiplications and additions in the body of a function, squares as multiplications."""
    body = function[function.index("{") :]
    text = EXPONENT.sub(r"\1", COMMENT.sub("", body))
    return [len(PRODUCT.findall(text)), len(SUM.findall(text))]
