"""The report as one HTML file that needs no network."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

import plotly.graph_objects as go
from plotly.offline import get_plotlyjs

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.55 system-ui, sans-serif; color: #1f2328; margin: 0; background: #fff; }
main { max-width: 1120px; margin: 0 auto; padding: 2rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .5rem; }
h2 { font-size: 1.4rem; margin: 3rem 0 .5rem; padding-top: 1rem; border-top: 1px solid #d1d9e0; }
h3 { font-size: 1.1rem; margin: 2rem 0 .4rem; }
nav a { margin-right: 1rem; }
a { color: #0b57d0; }
.note { background: #fff8e1; border-left: 4px solid #e8a100; padding: .7rem 1rem; }
figure { margin: 1.2rem 0 2rem; }
figcaption { color: #59636e; font-size: .92rem; }
.wide { overflow-x: auto; }
.wide > div { min-width: 720px; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid #d1d9e0; padding: .35rem .7rem; text-align: left; }
td.n, th.n { text-align: right; }
"""
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
)
"""The page may load nothing: what it shows is in the file."""


@dataclass(frozen=True)
class Figure:
    """A figure with what it shows; `name` is unique in the page."""

    name: str
    title: str
    caption: str
    figure: go.Figure


@dataclass(frozen=True)
class Table:
    """A table; columns whose cells are right-aligned start at `numbers_from`."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""
    numbers_from: int = 1


@dataclass(frozen=True)
class Section:
    """A part of the report: paragraphs of plain text, then figures and tables in order."""

    name: str
    title: str
    paragraphs: tuple[str, ...]
    parts: tuple[Figure | Table, ...]


def page_of(title: str, note: str, sections: tuple[Section, ...]) -> str:
    """The whole page; plotly.js is in it once."""
    links = "".join(f'<a href="#{s.name}">{escape(s.title)}</a>' for s in sections)
    body = "".join(_section(section) for section in sections)
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        f"<title>{escape(title)}</title><style>{STYLE}</style>"
        f"<script>{get_plotlyjs()}</script></head><body><main>"
        f'<h1>{escape(title)}</h1><p class="note">{escape(note)}</p><nav>{links}</nav>'
        f"{body}</main></body></html>\n"
    )


def _section(section: Section) -> str:
    text = "".join(f"<p>{escape(paragraph)}</p>" for paragraph in section.paragraphs)
    parts = "".join(
        _figure(part) if isinstance(part, Figure) else _table(part) for part in section.parts
    )
    return f'<section id="{section.name}"><h2>{escape(section.title)}</h2>{text}{parts}</section>'


def _figure(part: Figure) -> str:
    plot = part.figure.to_html(
        full_html=False,
        include_plotlyjs=False,
        include_mathjax=False,
        div_id=part.name,
        config={"displaylogo": False, "responsive": True, "showTips": False},
    )
    return (
        f'<h3>{escape(part.title)}</h3><figure><div class="wide">{plot}</div>'
        f"<figcaption>{escape(part.caption)}</figcaption></figure>"
    )


def _table(part: Table) -> str:
    def row(cells: tuple[str, ...], tag: str) -> str:
        return "".join(
            f"<{tag}{' class=n' if i >= part.numbers_from else ''}>{escape(cell)}</{tag}>"
            for i, cell in enumerate(cells)
        )

    lines = "".join(f"<tr>{row(cells, 'td')}</tr>" for cells in part.rows)
    return (
        f'<h3>{escape(part.title)}</h3><figure><div class="wide"><table><thead>'
        f"<tr>{row(part.head, 'th')}</tr></thead><tbody>{lines}</tbody></table></div>"
        f"<figcaption>{escape(part.caption)}</figcaption></figure>"
    )
