"""Spoil a file's bytes, repeatably: flipped bits, cut and doubled spans, hostile values for good ones."""

from __future__ import annotations

import contextlib
import random
import re
import struct

#: What takes the place of a number or a word, or is put between any two bytes.
VALUES = (
    b"0", b"-1", b"1e308", b"-1e-320", b"1e200", b".nan", b".inf", b"NaN", b"Infinity", b"9" * 400,
    b"9" * 5000, b"18446744073709551616", b"true", b"null", b"~", b"off", b"''", b'""', b"[]", b"{}", b"[[]]",
    b"a" * 300, b'"\\0"', b'"\\e[31m"', b"\x1b]0;x\x07", b"\xff\xfe", b"\x00", b"\xe2\x80\xae", b"!!int x",
    b"!!timestamp 2", b"!!python/name:os.system", b"&a [*a]", b"*a", b"<<: *a", b"? [a]", b"---\n",
    b"%YAML 9\n", b"|\n", b">\n", b"[" * 3000, b"{a: " * 3000, b"- " * 3000, b"/dev/zero", b"../../x",
    b"~nobody/x", b"<!DOCTYPE a>", b"<a>" * 3000, b"&#0;", b"<![CDATA[", b'{"type": null}', b"0x10", b"1_000",
    b"12:30", b"-", b":", b",", b";", b"\n", b"\t",
)  # fmt: skip
_WORDS = re.compile(rb"[-+\w.]+")
_NUMBERS = re.compile(rb"[-+]?\d[\d.eE+-]*")


def mutate(data: bytes, other: bytes, dice: random.Random, is_text: bool) -> bytes:
    """Return `data` with one to four changes.

    Args:
        data: a whole file.
        other: another file of the kind, to take pieces from.
        dice: makes the changes; the same state makes the same file.
        is_text: whether values are exchanged, too.
    """
    kinds = [_flip, _cut, _double, _truncate, _splice]
    # Most texts are to get past the parser: values change more often than single bytes.
    kinds += [_number] * 12 + [_value] * 6 + [_line] * 2 + [_insert] * 2 if is_text else [_flip, _flip, _word]
    for _ in range(dice.choice((1, 1, 1, 1, 2, 3))):
        data = dice.choice(kinds)(data, other, dice)
    return data


def _flip(data: bytes, _: bytes, dice: random.Random) -> bytes:
    changed = bytearray(data)
    for _k in range(dice.choice((1, 1, 2, 8))):
        if changed:
            changed[dice.randrange(len(changed))] ^= 1 << dice.randrange(8)
    return bytes(changed)


def _span(data: bytes, dice: random.Random) -> tuple[int, int]:
    start = dice.randrange(len(data) + 1)
    return start, min(len(data), start + dice.choice((1, 2, 8, 40, 400)))


def _cut(data: bytes, _: bytes, dice: random.Random) -> bytes:
    start, end = _span(data, dice)
    return data[:start] + data[end:]


def _double(data: bytes, _: bytes, dice: random.Random) -> bytes:
    start, end = _span(data, dice)
    return data[:end] + data[start:end] * dice.choice((1, 2, 200)) + data[end:]


def _truncate(data: bytes, _: bytes, dice: random.Random) -> bytes:
    return data[: dice.randrange(len(data) + 1)]


def _splice(data: bytes, other: bytes, dice: random.Random) -> bytes:
    start, end = _span(other, dice)
    at = dice.randrange(len(data) + 1)
    return data[:at] + other[start:end] + data[at + dice.choice((0, end - start)) :]


def _word(data: bytes, _: bytes, dice: random.Random) -> bytes:
    """A length or an offset of a binary file becomes another."""
    kind = dice.choice(("<I", "<Q", ">H", ">I"))
    bits = struct.calcsize(kind) * 8
    value = dice.choice((0, 1, 2**31, 2**16, 10**6, 2**bits - 1, dice.getrandbits(bits))) % 2**bits
    at = dice.randrange(len(data) + 1)
    return data[:at] + struct.pack(kind, value) + data[at + bits // 8 :]


def _value(data: bytes, _: bytes, dice: random.Random) -> bytes:
    found = list(_WORDS.finditer(data))
    value = dice.choice(VALUES)
    if not found:
        return data + value
    word = dice.choice(found)
    return data[: word.start()] + value + data[word.end() :]


def _number(data: bytes, _: bytes, dice: random.Random) -> bytes:
    """One number becomes another of any size, whole if it was."""
    found = list(_NUMBERS.finditer(data))
    if not found:
        return data
    word = dice.choice(found)
    with contextlib.suppress(ValueError):
        factor = dice.choice((-1.0, 0.0, 0.3, 0.9, 1.1, 3.0, 10.0, 100.0, 1e-4, 1e-12, 1e4, 1e9, 1e300))
        value = float(word[0]) * factor if factor else dice.choice((0.0, 1.0, dice.uniform(-200, 200)))
        text = str(round(value)) if word[0].isdigit() and abs(value) < 1e15 else f"{value:g}"
        return data[: word.start()] + text.encode() + data[word.end() :]
    return data


def _insert(data: bytes, _: bytes, dice: random.Random) -> bytes:
    at = dice.randrange(len(data) + 1)
    return data[:at] + dice.choice(VALUES) + data[at:]


def _line(data: bytes, _: bytes, dice: random.Random) -> bytes:
    """One line is left out, doubled, or indented."""
    lines = data.split(b"\n")
    k = dice.randrange(len(lines))
    lines[k : k + 1] = dice.choice(([], [lines[k]] * 2, [b"  " + lines[k]], [lines[k].lstrip()]))
    return b"\n".join(lines)
