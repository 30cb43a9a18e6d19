"""Whether the elements of an HTML page are all closed."""

import html.parser


class Balanced(html.parser.HTMLParser):
    """`open`: which elements are left open."""

    VOID = ("meta", "img", "br")

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attrs):
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if self.open and self.open[-1] == tag:
            self.open.pop()
