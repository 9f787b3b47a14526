"""Checks the pages that Doxygen has made: each link within them leads to a file, and to a place in it that is there."""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The links of a page, and the places that links may lead to."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.links = []
        self.places = set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if value is None:
                continue
            if name in ("href", "src") and tag in ("a", "img", "object", "iframe"):
                self.links.append(value)
            elif name == "id" or (name == "name" and tag == "a"):
                self.places.add(value)


def broken_links(folder):
    """Returns a line for each broken link, and the number of links that were looked at."""
    pages = {path.name: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.html"))}
    broken = []
    count = 0
    for name, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or link.startswith("//"):
                continue  # This leads to another site, which no test asks.
            count += 1
            target = urllib.parse.unquote(parts.path) or name
            place = urllib.parse.unquote(parts.fragment)
            if not (folder / target).is_file():
                broken.append(f"{name}: there is no {target}")
            elif place and target in pages and place not in pages[target].places:
                broken.append(f"{name}: {target} has no place {place}")
    return broken, count


def main():
    folder = pathlib.Path(sys.argv[1])
    broken, count = broken_links(folder)
    print("\n".join(sorted(set(broken))))
    print(f"{count} links, {len(broken)} of them broken")
    return 1 if broken or count < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
