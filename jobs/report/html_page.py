"""One HTML page that needs no other file: text, tables, and matplotlib's figures as images within it; readable on paper."""

import base64
import html
import io

import matplotlib.pyplot as plt

STYLE = """
body { font: 15px/1.45 Georgia, serif; color: #222; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.25em; border-bottom: 1px solid #999; margin-top: 2em; }
table { border-collapse: collapse; margin: 0.8em 0; }
td, th { padding: 0.2em 0.8em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; } th { border-bottom: 1px solid #666; }
figure { margin: 1em 0; } figure img { max-width: 100%; } figcaption { color: #555; font-size: 0.9em; }
.missing { color: #8a4b00; } pre { font-size: 0.8em; overflow-x: auto; }
@media print { body { max-width: none; margin: 0; font-size: 10pt; } figure { break-inside: avoid; } h2 { break-after: avoid; } }
"""


class Page:
    def __init__(self, title):
        self.title = title
        self.parts = [f"<h1>{html.escape(title)}</h1>"]

    def heading(self, words):
        self.parts.append(f"<h2>{html.escape(words)}</h2>")

    def text(self, words):
        self.parts.append(f"<p>{html.escape(words)}</p>")

    def missing(self, words):
        """What the job has not given yet, and how to get it."""
        self.parts.append(f'<p class="missing">{html.escape(words)}</p>')

    def preformatted(self, words):
        self.parts.append(f"<pre>{html.escape(words)}</pre>")

    def table(self, head, rows):
        number = lambda value: f'<td class="number">{value:,.4g}</td>'
        cell = lambda value: number(value) if isinstance(value, float) else f"<td>{html.escape(str(value))}</td>"
        body = "".join("<tr>" + "".join(map(cell, row)) + "</tr>" for row in rows)
        titles = "".join(f"<th>{html.escape(word)}</th>" for word in head)
        self.parts.append(f"<table><tr>{titles}</tr>{body}</table>")

    def figure(self, figure, caption):
        data = io.BytesIO()
        figure.savefig(data, format="png", dpi=110)
        plt.close(figure)
        image = base64.b64encode(data.getvalue()).decode()
        words = html.escape(caption)
        source = f"data:image/png;base64,{image}"
        self.parts.append(f'<figure><img alt="{words}" src="{source}"><figcaption>{words}</figcaption></figure>')

    def write(self, path):
        head = f'<meta charset="utf-8"><title>{html.escape(self.title)}</title><style>{STYLE}</style>'
        body = "\n".join(self.parts)
        open(path, "w").write(f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n{body}\n</body></html>\n')
