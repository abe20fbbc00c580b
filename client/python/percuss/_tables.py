# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Results as tables: pandas, where it is installed, and HTML for notebooks."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

SHOWN = 24
"""Rows of a table in a notebook; of longer ones the middle is left out."""


def frame(columns: Mapping[str, Any]) -> Any:
    """A pandas.DataFrame of these columns."""
    try:
        import pandas
    except ImportError as missing:
        raise ImportError("to_dataframe needs pandas: pip install 'percuss[pandas]'") from missing
    return pandas.DataFrame(dict(columns))


def stack(parts: Sequence[Mapping[str, Any]], empty: Iterable[str]) -> Any:
    """The rows of all parts, one below the other, in one frame; of none, the columns alone."""
    if not parts:
        return frame({name: [] for name in empty})
    frames = [frame(part) for part in parts]
    import pandas

    return pandas.concat(frames, ignore_index=True)


def _cell(value: Any) -> str:
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return f"<td style='text-align: {'right' if isinstance(value, (int, float)) else 'left'}'>{escape(text)}</td>"


def html(caption: str, heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """A table with its caption above."""
    lines = [f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows]
    if len(lines) > SHOWN:
        between = f"<tr><td colspan='{len(heads)}'>&#8230; {len(lines) - SHOWN} more &#8230;</td></tr>"
        lines = [*lines[: SHOWN // 2], between, *lines[-SHOWN // 2 :]]
    head = "".join(f"<th>{escape(one)}</th>" for one in heads)
    return (
        f"<table><caption>{escape(caption)}</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"
    )
