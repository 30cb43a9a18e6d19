"""A report's page: one file that opens from disk and prints."""

import base64
import html
import io
from collections.abc import Iterable
from string import Template

_PAGE = Template("""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>$title</title>
<style>
body { font: 15px/1.5 Georgia, serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem;
       color: #222 }
h1, h2, th { font-family: Helvetica, Arial, sans-serif }
h1 { font-size: 1.6rem; margin-bottom: 0 } h2 { font-size: 1.15rem; margin-top: 2.2rem }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.92rem }
td, th { padding: 0.25rem 0.9rem 0.25rem 0; border-bottom: 1px solid #ddd; text-align: left }
table { width: 100% } td:first-child { width: 50% }
td + td { font-variant-numeric: tabular-nums }
figure { margin: 1rem 0; break-inside: avoid } figure img, figure svg { width: 100%; height: auto }
figcaption, .small { font-size: 0.9rem; color: #555 }
.met { color: #1b7a3d } .missed { color: #b3261e }
</style></head><body>
<h1>$title</h1>
<p class="small">$subtitle</p>
$body
</body></html>
""")

_MARKS = {True: '<span class="met">met</span>', False: '<span class="missed">not met</span>'}


def whole(title: str, subtitle: str, parts: Iterable[str]) -> str:
    """The HTML of a page; parts are HTML."""
    return _PAGE.substitute(title=title, subtitle=subtitle, body="\n".join(parts))


def table(heads: Iterable[str], rows: Iterable[Iterable]) -> str:
    """Cells are HTML."""
    lines = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{''.join(f'<th>{head}</th>' for head in heads)}</tr>{lines}</table>"


def mark(met: bool | None) -> str:
    """The verdict on an aim; None: there is none."""
    return _MARKS.get(met, "")


def embed(figure, caption: str, title: str) -> str:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=150)
    data = base64.b64encode(buffer.getvalue()).decode()
    return (
        f'<figure><img alt="{html.escape(title)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )
