from __future__ import annotations

from mudline.study.pages import Tables


def page(tables: Tables) -> str:
    return ""


def advice(tables: Tables) -> str:
    return ""
